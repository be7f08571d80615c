"""Partial slip: tractions below the limit of friction, step by step along a history of loads.

Under a pressure p the traction is bounded, |q| <= mu p. In a step from one state of loads to the
next the roller slips over the body by

    s = d - A (q - q0) - T'(p - p0) - (e - e0) x,    q = mu p where s > 0,  q = -mu p where s < 0

and sticks, s = 0, where q is between (0: before the step). With r = mu p - q that is the contact
problem of `analytic.contact.problem`, each node with a hardness of its own,

    s >= 0 at r = 0,    s = 0 at 0 < r < 2 mu p,    s <= 0 at r = 2 mu p,    w'r = mu P - Q,

r its pressure and s its gap: of alike bodies r is the pressure under the load P - Q/mu (Ciavarella
1998, Int. J. Solids Struct. 35, 2349-2362; Jaeger 1998, J. Tribol. 120, 677-684). Of unlike bodies
tractions move the surfaces normally, G + C p + T q, too: both problems are solved in turn. Each
turn leaves about beta (beta + mu) of what was wrong.

A step is exact, however long, where slip spreads without turning back; else it is implicit, of
first order in its length. Pressing unlike bodies makes tractions by itself (Spence 1975).

    p, q    pressure and traction on the body towards +x [Pa]       mu   friction
    C, A    normal and tangential compliance of both surfaces [m^2/Pa]; half-planes have A = C
    T       normal displacement under q, its transpose tangential displacement under p [m^2/Pa]
    s       slip, weighted by each hat [m^2]: of the roller over the body, towards +x
    d       tangential displacement of the roller in the step [m]   w    weights [m]
    e       strain of the body along x by a load elsewhere          P, Q  loads per length [N/m]"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import TangentialHalfPlane

Vectors = Callable[[np.ndarray], np.ndarray]
# Of weighted gap, weights, constraints and a start
Solve = Callable[[np.ndarray, np.ndarray, Constraints, np.ndarray | None], ContactSolution]

SETTLED = 1e-8  # of the largest pressure: what the last turn of both problems moves
MOST_TURNS = 60
ROUNDING = 1e-6  # of the limit: tractions nearer to it slip


@dataclass(frozen=True)
class SurfacePair:
    """Both surfaces, by what they do under hats of p and q (n,) [Pa]: weighted displacements [m^2].

    raised, dragged   T and its transpose; None of bodies that are alike"""

    weighted_gap: np.ndarray  # G (n,) [m^2]
    weights: np.ndarray  # w (n,) [m]
    x: np.ndarray  # (n,) [m]
    friction: float
    hardness: float  # largest pressure [Pa]
    tangential: Vectors  # A
    solve_normal: Solve
    solve_tangential: Solve
    raised: Vectors | None = None
    dragged: Vectors | None = None
    settled: float = SETTLED

    def carried(self, pressure: np.ndarray, traction: np.ndarray) -> np.ndarray:
        """Displacement (n,) [m] of the body's surface over the roller's along x, from their form
        without load."""
        moved = self.tangential(traction)
        if self.dragged is not None:
            moved = moved + self.dragged(pressure)
        return moved / self.weights


@dataclass(frozen=True)
class Loads:
    """Per length [N/m], and the body's strain along x."""

    normal: float
    tangential: float = 0.0
    strain: float = 0.0


@dataclass(frozen=True)
class SlipState:
    """After a step. Nodal values (n,)."""

    loads: Loads
    normal: ContactSolution  # pressure [Pa] and gap [m]
    traction: np.ndarray  # q [Pa]
    slip: np.ndarray  # s / w of the step [m]
    displacement: float  # of the roller since its first load, along x [m]; datum of the operators
    work: float  # of friction in the step, per length [J/m]
    residual: float  # worst of both problems
    converged: bool


def stepped(pair: SurfacePair, before: SlipState | None, loads: Loads) -> SlipState:
    """The state under `loads` that follows on another; None: the bodies do not touch."""
    limit = pair.friction * loads.normal
    if not abs(loads.tangential) < limit:
        raise ValueError(
            f"the tangential load must be below {limit:g} N/m, not {loads.tangential:g} N/m"
        )
    traction, displacement = np.zeros_like(pair.weights), 0.0
    pressed = np.zeros_like(traction)
    former, normal, pressure = Loads(0.0), None, None
    if before is not None:
        traction, displacement, former = before.traction, before.displacement, before.loads
        pressed = pressure = before.normal.pressure
        normal = before.normal if former.normal == loads.normal else None
    forward = 1.0 if loads.tangential >= former.tangential else -1.0
    moved = (loads.strain - former.strain) * pair.x * pair.weights - pair.tangential(traction)
    constraints, tangential = Constraints(load=loads.normal, hardness=pair.hardness), None
    for _ in range(MOST_TURNS):
        last, reached = pressure, traction
        if normal is None or pair.raised is not None:
            lifted = 0.0 if pair.raised is None else pair.raised(traction)
            gap = pair.weighted_gap + lifted
            normal = pair.solve_normal(gap, pair.weights, constraints, pressure)
            pressure = normal.pressure
        dragged = 0.0 if pair.dragged is None else pair.dragged(pressure - pressed)
        rest = limit - forward * loads.tangential
        start = tangential and tangential.pressure
        tangential = _tangential(pair, pressure, forward * (moved + dragged), rest, start)
        traction = forward * (pair.friction * pressure - tangential.pressure)
        settled = pair.raised is None
        if last is not None and not settled:
            changes = pressure - last, (traction - reached) / pair.friction
            settled = np.max(np.abs(changes)) <= pair.settled * pressure.max()
        if settled:
            break
    slip = forward * tangential.gap
    # what touched before: the others have moved while they were apart
    touched = (pressure > 0.0) & (pressed > 0.0)
    rubbing = np.where(touched, 0.5 * (pressure + pressed), 0.0)
    return SlipState(
        loads=loads,
        normal=normal,
        traction=traction,
        slip=slip,
        displacement=displacement - forward * tangential.approach,
        work=float(pair.friction * (rubbing @ (np.abs(slip) * pair.weights))),
        residual=max(normal.residuals.worst, tangential.residuals.worst),
        converged=settled and normal.converged and tangential.converged,
    )


def _tangential(
    pair: SurfacePair,
    pressure: np.ndarray,
    moved: np.ndarray,
    load: float,
    start: np.ndarray | None,
) -> ContactSolution:
    """r and s under r's `load`, of surfaces that are `moved` (n,) [m^2] by what is not q, both
    counted in the direction in which the load goes: it is there that the surfaces slip."""
    limit = pair.friction * pressure
    constraints = Constraints(load=load, hardness=2.0 * limit)
    start = None if start is None else np.minimum(start, 2.0 * limit)
    gap = -(pair.tangential(limit) + moved)
    return pair.solve_tangential(gap, pair.weights, constraints, start)


def half_planes(
    grid: HatGrid,
    weighted_gap: np.ndarray,
    modulus: float,
    dundurs_beta: float,
    friction: float,
    hardness: float = np.inf,
) -> SurfacePair:
    """Two half-planes, on whose surfaces A = C and T is a convolution.

    weighted_gap  G (n,) [m^2]            modulus   E* [Pa]
    dundurs_beta  of the body against the roller (`analytic.material.dundurs_constants`)
    hardness      largest pressure [Pa]"""
    operator = HalfPlane(grid.count, grid.pitch, modulus)
    solve = partial(solve_contact, operator)
    raised = dragged = None
    if dundurs_beta:
        raised, dragged = (
            TangentialHalfPlane(grid.count, grid.pitch, sign * dundurs_beta / modulus).apply
            for sign in (1.0, -1.0)
        )
    return SurfacePair(
        weighted_gap=weighted_gap,
        weights=grid.weights,
        x=grid.x,
        friction=friction,
        hardness=hardness,
        tangential=operator.apply,
        solve_normal=solve,
        solve_tangential=solve,
        raised=raised,
        dragged=dragged,
    )


def pressed_in(load: float, steps: int) -> tuple[Loads, ...]:
    """Loads [N/m] under which a contact of parabolas grows by equal steps."""
    return tuple(Loads(load * (k / steps) ** 2) for k in range(1, steps + 1))


def stick_zones(x: np.ndarray, state: SlipState, friction: float) -> np.ndarray:
    """Zones (k, 2) [m] that stick in a state's step, ascending; x (n,) [m] uniform. Their ends are
    those of contact patches: slip opens beside them as a gap does, and may end at one."""
    limit = friction * state.normal.pressure
    reserve = limit - np.abs(state.traction)
    reserve[reserve <= ROUNDING * limit] = 0.0  # what slips, too, may miss its limit by rounding
    touching = state.normal.pressure > 0.0
    opening = np.where(touching, np.abs(state.slip), friction * state.normal.gap)
    return contact_patches(x, reserve, opening)
