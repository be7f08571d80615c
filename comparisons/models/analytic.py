"""Every analytic model of a scene on one level of refinement.

A model is the half-plane and the effects that it has beside: the LAYERS and the coupling of
`comparisons.models.operators`, an exact circle (`exact_circle`), the deformed surface
(`finite_strain`), a hardness (CAP). Nothing is meshed: the compliance of a layer or a coating
is a convolution, and its stresses are those of a half-plane and what the base adds
(`analytic.layers.stress`)."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain

import numpy as np
from numpy.typing import ArrayLike

from analytic.contact.coupled import solve_coupled
from analytic.contact.deformed_surface import DeformedContact
from analytic.contact.end_stress import EndStress
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid, roller_gap
from analytic.layers.stress import AddedStress
from analytic.material import Material
from analytic.stress.field import StressField
from analytic.stress.maxima import stress_maxima
from analytic.stress_state import Extremum, StressState
from comparisons.common.progress import Stages, peak_memory
from comparisons.models.crest import unresolved_crest
from comparisons.models.level import ExpectedCost, Level, StressResult
from comparisons.models.operators import (
    body_operator,
    layered_body,
    operator_of,
    patches_of,
    pressed_on,
)
from comparisons.models.problem import TABOR, Problem
from comparisons.models.readings import beside_hats, field_on
from comparisons.models.window import Window, search_window

CAP = "cap"  # on the pressure, where the body yields and the scene has no hardness
# Of a level with stresses, measured from 5 000 to 160 000 nodes on windows as wide as the contact.
SECONDS_PER_NODE, BYTES_PER_NODE = 3.5e-5, 700.0
# Of a window far wider than the contact: each point of the ring on which pressures are convolved,
# beyond the first, and each where extremes are searched; measured to 2 million.
FREE_POINTS, SECONDS_PER_POINT, BYTES_PER_POINT, BYTES_PER_SEARCHED = 1e5, 2e-5, 130.0, 90.0


def expected_of(count: int) -> ExpectedCost:
    """Cost of a level of so many pressure elements."""
    return ExpectedCost(count, BYTES_PER_NODE * count, SECONDS_PER_NODE * count)


def expected_with(problem: Problem, pitch: float) -> ExpectedCost:
    """Cost of a level of a pitch [m] with its stresses."""
    cost, window = expected_of(problem.grid(pitch).count), problem.window
    if window is None:
        return cost
    pressed, searched = np.ptp(problem.extent), search_window(problem)
    pressed *= 1.0 if problem.period is None else 3.0  # three periods of pressures
    ring = (np.ptp(window.ends) + pressed) * window.subdivisions(pitch) / pitch
    points = max(0.0, ring - FREE_POINTS)
    memory = BYTES_PER_POINT * points + BYTES_PER_SEARCHED * len(searched.x) * len(searched.z)
    seconds = max(cost.seconds, SECONDS_PER_POINT * points)
    return ExpectedCost(cost.unknowns, max(cost.memory, memory), seconds)


def analytic_level(
    problem: Problem,
    effects: frozenset[str],
    grid: HatGrid,
    stages: Stages,
    fields: int = 0,
) -> dict[float, Level]:
    """Solve one level at friction coefficients that share a contact: contact, and with [stress] the
    largest stresses.

    effects  that the model has beside the half-plane's assumptions
    fields   as those of a `Model`; of bodies without a layer"""
    if CAP in effects:
        cap = {"body.hardness": TABOR * problem.scene.body.yield_stress}
        problem = replace(problem, scene=problem.scene.unchecked(cap))
    with stages.stage("contact", "half-plane: contact"):
        solution = _pressed(problem, effects, grid)
        moved = body_operator(problem, grid, effects).apply(solution.pressure)
        level = Level(
            grid=grid,
            solution=solution,
            displacement=moved / grid.weights,
            patches=patches_of(grid, solution),
            seconds=stages.seconds,
            unknowns=grid.count,
            unresolved_crest=unresolved_crest(problem, grid, solution, effects),
            expected_seconds=expected_with(problem, grid.pitch).seconds,
        )
    if problem.window is None:
        level = replace(level, peak_memory=peak_memory())
        return dict.fromkeys(problem.scene.load.friction, level)
    with stages.stage("stresses", "half-plane: stresses"):
        stresses = tuple(_stresses(problem, effects, level, fields))
    memory = peak_memory()
    return {s.friction: replace(level, stress=s, peak_memory=memory) for s in stresses}


def _pressed(problem: Problem, effects: frozenset[str], grid: HatGrid) -> ContactSolution:
    """The contact, on the deformed surface where the effects hold finite strain."""
    shape = "circle" if "exact_circle" in effects else "parabola"
    operator = operator_of(problem, grid, effects)
    solution = pressed_on(problem, grid, operator, gap=problem.gap_under(shape))
    if "finite_strain" not in effects:
        return solution
    scene, profile = problem.scene, problem.surface.profile
    height = np.zeros_like if profile is None else profile.spline()
    sagitta = roller_gap(scene.roller.radius, None, shape)
    bodies = scene.body.material, scene.roller.material, height, sagitta
    deformed = DeformedContact(grid, *bodies, problem.knots)
    how = grid.weights, problem.constraints()
    return deformed.pressed(lambda gap, start: solve_coupled(operator, gap, *how, start), solution)


@dataclass(frozen=True)
class _Side:
    """The layer, or what lies below it; of a body without one all of it."""

    material: Material
    added: AddedStress | None
    below: bool
    rest: EndStress  # what hats leave out
    searched: Window  # from which extremes are searched

    def beside(self, friction: ArrayLike, x: np.ndarray, z: np.ndarray) -> StressState:
        """Stresses beside those of the half-plane's hats."""
        rest = self.rest.stress(friction, x, z)
        if self.added is None:
            return rest
        return rest.plus(1.0, self.added.at(friction, x, z, self.below))

    def fields(self, level: Level, frictions: tuple[float, ...]) -> dict[float, StressField]:
        """By friction coefficient, where extremes are searched."""
        made = field_on(level, self.searched, self.rest)
        fields = {friction: made.at(friction) for friction in frictions}
        if self.added is None:
            return fields
        parts = self.added.field(made.x, made.z, self.below)
        for friction, field in fields.items():
            added = StressState(*(parts[:3] + friction * parts[3:]))
            fields[friction] = StressField(made.x, made.z, field.stress.plus(1.0, added))
        return fields


def _stresses(
    problem: Problem, effects: frozenset[str], level: Level, fields: int
) -> Iterator[StressResult]:
    """Extremes off the grid, of both sides of an interface, and for `fields` all on the window."""
    x, pressure = level.grid.unfolded_x, level.grid.unfolded(level.solution.pressure)
    sides, frictions = _sides(problem, effects, level), problem.scene.load.friction
    largest = [
        stress_maxima(
            x,
            pressure,
            side.fields(level, frictions),
            side.material.poissons_ratio,
            beside=side.beside,
            cells=problem.asperities,
        )
        for side in sides
    ]
    shown = fields and field_on(level, problem.window.every(fields), sides[0].rest)
    for friction in frictions:
        first, *others = (by_friction[friction] for by_friction in largest)
        for name, of_side in chain.from_iterable(map(dict.items, others)):
            # of each asperity (3, k) the side with the larger value
            first[name] = np.where(of_side[0] > first[name][0], of_side, first[name])
        extremes = {name: Extremum.highest(cells) for name, cells in first.items()}
        maxima = {name: first[name] for name in ("tau1", "txz")}
        field = shown.at(friction).stress if shown else None
        yield StressResult(friction, extremes, maxima, field)


def _sides(problem: Problem, effects: frozenset[str], level: Level) -> list[_Side]:
    """The layer and what lies below it; the body itself where there is no layer."""
    body, window = layered_body(problem.scene, effects), problem.window
    searched, rest = search_window(problem), beside_hats(problem, level)
    if body is None:
        return [_Side(problem.scene.body.material, None, False, rest, searched)]
    reach = min(window.x[0], searched.x[0]), max(window.x[-1], searched.x[-1])
    added = AddedStress.of(body, level.grid.x, level.solution.pressure, reach)
    is_inside = searched.z <= body.thickness * (1.0 + 1e-12)
    inside, below = np.minimum(searched.z[is_inside], body.thickness), searched.z[~is_inside]
    goes_on = not body.rigid and len(below) > 0
    if goes_on:  # both sides of the interface are searched
        inside = np.append(inside[inside < body.thickness], body.thickness)
        below = np.append(body.thickness, below)
    layer = _Side(body.material, added, False, rest, replace(searched, z=inside))
    if not goes_on:
        return [layer]
    return [layer, _Side(body.base, added, True, rest, replace(searched, z=below))]
