"""A body pressed by a roller without linearisation: finite strains, current positions and normals.

The body follows its law at finite strains (`fem.nonlinear.hyperelastic.HyperelasticBody`). The
contact is on its deformed surface, with a rigid roller (`fem.contact.rigid_roller.CurrentContact`)
or an elastic one, itself at finite strains (`fem.contact.deformed_roller.PairContact`).

Friction drags the bodies past each other, by an amount that for unbounded bodies is known but for a
constant: a held block or a disc gives ten times what the half-plane's own datum gives. Left to
itself the roller would stand over another point of the trace. Both are moved back along x until the
displacement of each surface along x is zero in the pressure's mean: under load the roller stands
where the scene has put it. Of a disc the middle of the circle that fits its deformed rim best is
moved back. Friction also turns it, which moves its surface and not its shape: it is turned back
about that middle. Left to itself it would carry the dents under the asperities along, and
corrections that move the pressures' dents and turn the disc apart would diverge."""

from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from fem.body.elasticity import ElasticBody
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.deformed_roller import DeformedSurface, PairContact, TwoBodies
from fem.contact.nonlinear import (
    ContactState,
    NonlinearSolution,
    solve_nonlinear_contact,
    state_at_rest,
)
from fem.contact.rigid_roller import CurrentContact, Roller
from fem.contact.terms import Contact, LinearContact, LinearResponse, Response
from fem.nonlinear.hyperelastic import CauchyRecovery, HyperelasticBody, along_surface
from fem.solver.mumps import FemError
from fem.stress.surface_load import SurfaceLoad

# Of `FiniteCompliance`: forces left over the contact's, at least and at most, and as a part of the
# change of the pressures, of which three tenths can make a first step look better than all others;
# secants, and what one must differ from the others: from less than 0.02 on small last steps mislead
# those under a changed load.
RESIDUAL, MOST_LEFT, SETTLED = 1e-9, 3e-3, 0.1
SECANTS, SECANT_RANK = 10, 0.05
MOST_CORRECTIONS = 25
# Of Newton's method: mean slip of the surfaces that is left, of a hat, and solutions to get there.
ASIDE, MOST_SETTINGS = 1e-3, 6
MOST_CAPS = 15  # solutions until the largest pressure settles
LEANING = 5e-8  # of the load: what friction on tilted tangents may still take of it
CAP_LEFT = 1e-8  # of the largest pressure that the last solution's stretch would change


@dataclass
class FiniteDeformation:
    """A body in contact with a roller, in its deformed state.

    pressure       (count,) [Pa] its vertical force per undeformed length of x, without friction's
    displacement   (n, 2) [m] at the body's nodes
    approach       depth [m] of the roller's lowest point, before it deforms, below z = 0 of the
                   undeformed body
    gap            (count,) [m] mean opening under each hat, along z
    load           [N/m] vertical force of the pressure and of its friction"""

    body: ElasticBody
    hats: np.ndarray
    roller: Roller  # as pressed by; of an elastic one its deformed surface
    friction: float
    solution: NonlinearSolution
    initial_gap: np.ndarray  # (count,) [m] that of the undeformed bodies, the approach apart
    load: float

    def __post_init__(self) -> None:
        state = self.solution.state
        self.pressure, self.approach, self.gap = state.pressure, state.approach, self.solution.gap
        self.displacement = state.displacements[0][: len(self.body.nodes)]

    @cached_property
    def place(self) -> np.ndarray:
        """Deformed x (count,) [m] of the hats' nodes."""
        at = self.hats[1:-1]
        return at + np.interp(at, self.body.top.x, self._moved[:, 0])

    @cached_property
    def stretch(self) -> np.ndarray:
        """(count,) deformed over undeformed length along x at the hats' nodes."""
        return self._stretched(self.hats[1:-1])

    @cached_property
    def cauchy_pressure(self) -> np.ndarray:
        """(count,) [Pa] force per deformed area, at `place`."""
        return self.pressure / self.stretch

    @cached_property
    def cauchy(self) -> CauchyRecovery:
        """Cauchy's stresses at the deformed mesh points; `across` is nu (sx + sz) for small strains
        only."""

        def direction(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            now = x + np.interp(x, self.body.top.x, self._moved[:, 0])
            return self.roller(now)[1], np.ones_like(x)

        load = SurfaceLoad(self.body, self.hats, self.pressure, self.friction, direction)
        x = self.body.top.x
        pressure = np.interp(x, self.hats, np.pad(self.pressure, 1)) / self._stretched(x)
        return CauchyRecovery(self.body, self.displacement, load, pressure)

    @cached_property
    def _moved(self) -> np.ndarray:
        return self.body.at_points(self.displacement)[self.body.top.point]

    def _stretched(self, x: np.ndarray) -> np.ndarray:
        """Deformed over undeformed length along x at undeformed x."""
        top = self.body.top.x
        return np.interp(x, top, 1.0 + along_surface(top, self._moved)[:, 0])


class FiniteContact:
    """A body and a roller at finite strains, each by its own law, before they are pressed.

    compliance of the body on the hats, (count + 2,) [m] on the undeformed surface, without flow
    roller     a rigid one's shape, `fem.contact.rigid_roller.circle(radius)`; or an elastic one on
               the same hats, its body in its own frame, z into it, with its shape as the boundary
    start      (count,) [Pa] linear pressure under the same load
    friction   q = friction p along the common tangent, towards +x on the body
    disc       whether an elastic roller is one, its rim the boundary with the contact
    gap        (count,) [m^2] of the undeformed bodies, weighted by each hat"""

    def __init__(
        self,
        compliance: FiniteElementCompliance,
        roller: Roller | FiniteElementCompliance,
        start: np.ndarray,
        friction: float = 0.0,
        disc: bool = False,
    ) -> None:
        body, hats = compliance.body, compliance.hats
        self.body, self.hats, self.friction, self.start = body, hats, friction, start
        self.roller, self.elastic, self.compliance = roller, (body,), compliance
        # of each body, the hats on it and their friction
        self._disc, self._pressed = disc, [(compliance, friction)]
        if isinstance(roller, FiniteElementCompliance):
            self._pressed.append((roller, -friction))
            self.elastic = body, roller.body
            moduli = tuple(part.material.youngs_modulus for part in self.elastic)
            self.response = TwoBodies(*map(HyperelasticBody, self.elastic), moduli)
            self.contact = PairContact(body, hats, roller.body, friction)
        else:
            self.response = HyperelasticBody(body)
            self.contact = CurrentContact(body, hats, roller, friction)
        self.weights = 0.5 * (hats[2:] - hats[:-2])
        moved = np.vstack([on.displacement(start, mu) for on, mu in self._pressed])
        self.linear, _ = self.set_back(np.where(self.response.held, 0.0, moved), start)
        self.gap = self.contact.loaded(np.zeros_like(self.linear), start)[0]

    def by_newton(
        self, load: float | None, approach: float | None = None, hardness: float = np.inf
    ) -> "FiniteDeformation":
        """Pressed on its own tangents, from the linear solution under `start`: by a load P [N/m],
        the vertical force, or to an `approach` d [m] of the roller's lowest point from z = 0,
        positive into the body. `hardness` H [Pa] caps Cauchy's pressure: `pressure` by as much more
        as the surface under a hat is stretched, which each solution tells the next. Raises FemError
        if it does not converge, ValueError for a load that the hats cannot bear."""
        state = ContactState((self.linear,), self.start, approach=0.0)
        asked = load and self.pressing(load, self.linear, self.start)
        constant, cap = np.zeros_like(self.weights), np.full_like(self.weights, hardness)
        for _ in range(MOST_SETTINGS if np.isinf(hardness) else MOST_CAPS):
            problem, wanted = [(self.response, self.contact)], (asked, approach, cap)
            start = constant, self.weights, state
            begun = partial(self._begun, asked, approach, hardness)
            solution = solve_nonlinear_contact(problem, *start, *wanted, begun)
            state, deformed = solution.state, self.deformed(solution)
            moved, asked, is_settled = self.settled(state, load, asked)
            state = replace(state, displacements=(moved,))
            if np.isfinite(hardness):
                stretched = hardness * deformed.stretch
                change = np.abs(stretched - cap)[state.pressure > 0.0].max()
                is_settled = is_settled and change <= CAP_LEFT * hardness
                pressure = np.where(state.pressure >= cap, stretched, state.pressure)
                state, cap = replace(state, pressure=pressure), stretched
            if is_settled:
                break
        else:
            if np.isfinite(hardness):
                raise FemError(f"the largest pressure did not settle in {MOST_CAPS} solutions")
        # what the last solution's stretch changes of these is none of its residual
        return self.deformed(
            replace(solution, state=replace(solution.state, pressure=state.pressure))
        )

    def settled(
        self, state: ContactState, load: float | None, asked: float | None
    ) -> tuple[np.ndarray, float | None, bool]:
        """Start of the next solution, after the state of pressures that press with `asked` [N/m]: a
        displacement (n, 2) [m] with the bodies moved back; the force that a `load` [N/m] leaves to
        pressures, None where the approach is prescribed; and whether neither differs by more than
        ASIDE of a hat and LEANING of the load."""
        moved, off = self.set_back(state.displacements[0], state.pressure)
        is_settled = off <= ASIDE * self.weights.mean()
        if load is None:
            return moved, None, is_settled
        pressing = self.pressing(load, *state.displacements, state.pressure)
        return moved, pressing, is_settled and abs(pressing - asked) <= LEANING * load

    def borne(self, moved: np.ndarray, pressure: np.ndarray) -> float:
        """The vertical force [N/m] on the body of pressures (count,) [Pa] and of their friction,
        which pulls along the tangents: integral (1 - mu s') p dX."""
        if not self.friction:
            return float(self.weights @ pressure)
        return self.vertical(self.contact.loaded(moved, pressure)[1])

    def vertical(self, force: np.ndarray) -> float:
        """The vertical force [N/m] on the body of nodal forces (2n,) [N/m] on both."""
        return float(force.reshape(-1, 2)[: len(self.body.nodes), 1].sum())

    def pressing(self, load: float, moved: np.ndarray, pressure: np.ndarray) -> float:
        """Force of the pressures alone [N/m] where they and their friction bear a `load` [N/m],
        by the tangents of one state."""
        return load * float(self.weights @ pressure) / self.borne(moved, pressure)

    def set_back(
        self, moved: np.ndarray, pressure: np.ndarray, turned: bool = True
    ) -> tuple[np.ndarray, float]:
        """The displacement (n, 2) [m] with each body moved along x, so that in the mean of a
        pressure (count,) [Pa] its surface stays where it was; a disc so that its middle does, and
        `turned` until its surface does; and by how much at most they were moved [m]."""
        pieces, aside = np.split(moved, [len(self.body.nodes)]), 0.0
        at, force = self.hats[1:-1], pressure * self.weights
        for place, (body, piece) in enumerate(zip(self.elastic, pieces, strict=False)):
            surface = body.surface
            along = np.interp(at, surface.x, piece[surface.point, 0])
            mean = float(force @ along / force.sum())
            if place and self._disc:
                x, z, radius = _circle(*(body.nodes + piece)[surface.point].T)
                angle, mean = (mean - x) / radius if turned else 0.0, x
                piece = _turned(body.nodes, piece, (x, z), angle)
            pieces[place], aside = piece - (mean, 0.0), max(aside, abs(mean))
        return np.vstack(pieces), aside

    def _begun(
        self, load: float | None, approach: float | None, hardness: float, part: float
    ) -> ContactState:
        """The linear solution under a `part` of the load."""
        wanted = [part * value if value else value for value in (load, approach)]
        rest = state_at_rest(self._linear, self.start)
        problem = self._linear, self.gap, self.weights, rest, *wanted, hardness
        state = solve_nonlinear_contact(*problem).state
        moved, _ = self.set_back(np.vstack(state.displacements), state.pressure)
        moved = np.where(self.response.held, part * self.linear, moved)
        return replace(state, displacements=(moved,), load=0.0)

    @cached_property
    def _linear(self) -> list[tuple[Response, Contact]]:
        """The linear bodies in contact on their undeformed surfaces."""
        return [(LinearResponse(on.body), LinearContact(on, mu)) for on, mu in self._pressed]

    def deformed(self, solution: NonlinearSolution) -> "FiniteDeformation":
        """The bodies in a state of contact."""
        roller = self.roller
        if isinstance(roller, FiniteElementCompliance):
            reached = solution.state.displacements[0][len(self.body.nodes) :]
            roller = DeformedSurface(roller.body, reached)
        state, initial = solution.state, self.gap / self.weights
        load = self.borne(*state.displacements, state.pressure)
        return FiniteDeformation(
            self.body, self.hats, roller, self.friction, solution, initial, load
        )


class FiniteCompliance:
    """Equilibrium at finite strains under given pressures, by the linear bodies' own factors.

        u <- u + K^-1 (T(u) p - F(u))

    with secants through the last SECANTS steps (Anderson 1965), those under former pressures
    included. The tangent differs from K by the order of the strains: each step leaves about that
    part of the forces. The displacement starts from the last one; forces are solved as accurately
    as the pressure has settled.

    steps  so far, one assembly and one back-substitution each
    left   forces over the contact's, at the last pressure
    borne  vertical force [N/m] on the body of the last pressure and its friction"""

    def __init__(self, contact: FiniteContact) -> None:
        self._contact, self.displacement = contact, contact.linear
        # the last pressure, and the forces (2n,) [N/m] inside the bodies under it
        self._last: np.ndarray | None = None
        self._internal: np.ndarray | None = None
        self._secants: list[tuple[np.ndarray, np.ndarray]] = []
        self.steps, self.left, self.borne = 0, np.inf, 0.0

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Weighted gap (count,) [m^2] over that of the undeformed bodies, the approach apart, under
        pressures (count,) [Pa]. Raises FemError where there is no equilibrium near the last one."""
        wanted, contact = MOST_LEFT, self._contact
        if self._last is not None:
            change = np.linalg.norm(pressure - self._last) / np.linalg.norm(pressure)
            if change == 0.0:  # as accurate as it was asked for
                return contact.contact.loaded(self.displacement, pressure)[0] - contact.gap
            wanted = float(np.clip(SETTLED * change, RESIDUAL, MOST_LEFT))
        self._last, moved, internal, before = pressure, self.displacement, self._internal, None
        soft, free = contact.response.softness, ~contact.response.held.ravel()
        for _ in range(MOST_CORRECTIONS):
            moved, _ = contact.set_back(moved, pressure)
            gap, applied = contact.contact.loaded(moved, pressure)
            if internal is None:  # else known: the last pressure's, but for a disc's turn since
                internal = contact.response.force(moved).ravel()
            left = np.where(free, applied - internal, 0.0)
            size = np.linalg.norm(soft * np.where(free, applied, 0.0))
            rest = float(np.linalg.norm(soft * left) / size)
            if rest <= wanted:
                self.displacement, self._internal, self.left = moved, internal, rest
                self.borne = contact.vertical(applied)
                return gap - contact.gap
            pieces = np.split(left.reshape(-1, 2), [len(contact.body.nodes)])
            bodies = zip(contact.elastic, pieces, strict=False)
            step = np.vstack([body.solve(piece) for body, piece in bodies]).ravel()
            reached = moved.ravel() + step
            if before is not None:
                self._learn(reached - before[0], step - before[1])
            before = reached, step
            onward = reached - sum((known @ step) * led for known, led in self._secants)
            moved, internal = onward.reshape(-1, 2), None
            self.steps += 1
        raise FemError(f"forces of {rest:.1e} are left after {MOST_CORRECTIONS} corrections")

    def solution(self, pressure: np.ndarray, approach: float) -> NonlinearSolution:
        """The state of the last pressure at its `approach` [m]. FemError for inverted elements."""
        contact, moved = self._contact, self.displacement
        contact.response.accept(moved)
        load = float(contact.weights @ pressure)
        gap = contact.contact.loaded(moved, pressure)[0] / contact.weights - approach
        state = ContactState((moved,), pressure, approach, load)
        return NonlinearSolution(state, gap, ((self.left,),), self.steps)

    def _learn(self, move: np.ndarray, change: np.ndarray) -> None:
        """Keep what a move (2n,) [m] of the corrected displacement has changed in the correction
        (2n,) [m], apart from what is known: the changes are orthogonal and of size one."""
        whole = np.linalg.norm(change)
        for known, led in self._secants:
            amount = known @ change
            change, move = change - amount * known, move - amount * led
        size = np.linalg.norm(change)
        if size > SECANT_RANK * whole:
            self._secants = [*self._secants[1 - SECANTS :], (change / size, move / size)]


def _circle(x: np.ndarray, z: np.ndarray) -> tuple[float, float, float]:
    """Middle x, z and radius [m] of the circle that fits points (n,) [m] best, each with as much
    weight as it has arc (Kasa 1976, IEEE Trans. Instrum. Meas. 25, 8)."""
    size = np.ptp(x)
    x, z = x / size, z / size
    weight = np.sqrt(np.gradient(np.append(0.0, np.cumsum(np.hypot(np.diff(x), np.diff(z))))))
    columns = np.column_stack([2.0 * x, 2.0 * z, np.ones_like(x)]) * weight[:, None]
    a, b, c = np.linalg.lstsq(columns, weight * (x**2 + z**2), rcond=None)[0]
    return float(a * size), float(b * size), float(np.sqrt(c + a**2 + b**2) * size)


def _turned(
    nodes: np.ndarray, moved: np.ndarray, middle: tuple[float, float], angle: float
) -> np.ndarray:
    """Displacements (n, 2) [m] of nodes (n, 2) [m] that are then turned about a `middle` [m], those
    with less z towards -x."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return moved + (nodes + moved - middle) @ [[cosine - 1.0, -sine], [sine, cosine - 1.0]]
