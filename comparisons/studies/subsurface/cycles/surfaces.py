"""The surface that flow leaves, beside the fresh one and the one that running-in makes of it: what
an elastic half-plane bears on each."""

from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactError
from analytic.grid import HatGrid
from analytic.profile import Profile
from analytic.running_in import run_in
from comparisons.models.nearest_operator import nearest_operator, solve_on
from comparisons.models.problem import Problem
from comparisons.studies.model_error.estimates import TABOR
from comparisons.studies.subsurface.cycles.passes import CycledLevel

FRESH, ONCE, LAST, FLATTENED = "fresh", "pressed_once", "after_all", "run_in"
FLATTENINGS = 15  # places of the roller of running-in along a travel


@dataclass(frozen=True)
class LeftSurface:
    """A surface on the pressure elements, and the contact of an elastic half-plane there."""

    height: np.ndarray  # (n,) [m]
    pressure: np.ndarray  # (n,) [Pa]
    length: float  # [m] in contact
    ra: float  # [m] mean distance from the mean height, over the stretch that was pressed

    @property
    def peak(self) -> float:
        """Largest pressure [Pa], mean over neighbouring hats."""
        from fem.nonlinear.press_plastic import averaged_pressure

        return float(averaged_pressure(self.pressure).max())


@dataclass(frozen=True)
class LeftSurfaces:
    """By FRESH, ONCE, LAST and, where the trace carries the load so, FLATTENED."""

    x: np.ndarray  # (n,) [m]
    stretch: tuple[float, float]  # [m] that was pressed
    by_name: dict[str, LeftSurface]
    rms: float  # [m] of once pressed against flattened, over the stretch, but for a shift
    bearing_rms: float  # [m] the same of their heights in order: of the bearing curves
    lowered_rms: float  # [m] of what one pass changes, but for a shift


def hardness_of(problem: Problem) -> float:
    """At which running-in presses flat [Pa]."""
    scene = problem.scene
    known = scene.running_in and scene.running_in.hardness
    return known or scene.body.hardness or TABOR * scene.body.yield_stress


def left_surfaces(problem: Problem, level: CycledLevel, travel: float) -> LeftSurfaces:
    """Of the passes on a level; `problem` as of them."""
    first = round(float(level.x[0] / level.pitch))
    grid = HatGrid(level.pitch, first, first + len(level.x) - 1)
    pressed = level.x[level.pressure[0] > 0.0]
    stretch = (-0.5 * travel, 0.5 * travel) if travel else (pressed[0], pressed[-1])
    inside = (level.x >= stretch[0]) & (level.x <= stretch[1])
    lowerings = {FRESH: np.zeros(grid.count), ONCE: level.lowering[0], LAST: level.lowering[1]}
    with suppress(ContactError):  # where the trace cannot carry the load at the hardness
        lowerings[FLATTENED] = _flattened(problem, grid, travel)
    gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)
    constraints = replace(problem.constraints(), hardness=np.inf)
    operator = nearest_operator(problem.scene, grid, 0.0)

    def surface(lowering: np.ndarray) -> LeftSurface:
        lowered = gap + grid.weights * lowering
        solution = solve_on(operator, lowered, grid.weights, constraints)
        patches = contact_patches(grid.x, solution.pressure, solution.gap)
        height = level.height - lowering
        ra = np.abs(height - height[inside].mean())[inside].mean()
        length = float(np.ptp(patches, axis=1).sum())
        return LeftSurface(height, solution.pressure, length, float(ra))

    by_name = {name: surface(lowering) for name, lowering in lowerings.items()}
    rms = bearing = np.nan
    once = by_name[ONCE].height[inside]
    if FLATTENED in by_name:
        flat = by_name[FLATTENED].height[inside]
        rms, bearing = _rms(once - flat), _rms(np.sort(once) - np.sort(flat))
    lowered = _rms(lowerings[ONCE][inside])
    return LeftSurfaces(level.x, tuple(map(float, stretch)), by_name, rms, bearing, lowered)


def _rms(values: np.ndarray) -> float:
    """About their mean."""
    return float(np.std(values))


def _flattened(problem: Problem, grid: HatGrid, travel: float) -> np.ndarray:
    """Mean lowering (n,) [m] by running-in with the same load."""
    profile = problem.surface.profile
    if profile is None:
        nodes = grid.pitch * np.arange(2 * grid.first, 2 * grid.last + 1)
        profile = Profile(nodes, np.zeros(len(nodes)))
    limits = Constraints(load=problem.hertz.load_per_length, hardness=hardness_of(problem))
    places = np.linspace(-0.5, 0.5, FLATTENINGS) * travel if travel else np.zeros(1)
    radius = problem.scene.roller.radius
    done = run_in(profile, radius, problem.modulus, limits, places, pitch=grid.pitch)
    before, after = profile.spline(), done.profile.spline()
    knots = np.union1d(profile.x, done.profile.x)
    return grid.hat_integrals(lambda x: before(x) - after(x), knots) / grid.weights
