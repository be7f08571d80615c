"""The half-plane with what an operator can carry: layer, coating, coupling, exact circle, a cap.

In: a scene and the effects that its whole has. Out: levels on the half-plane's pressure elements,
with the stresses of the layered body. Nothing is meshed: the compliance of a layer or a coating is
a convolution (`analytic.layers.operator`), and its stresses are those of a half-plane and what the
base adds (`analytic.layers.stress`)."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial, reduce

import numpy as np

from analytic.contact.deformed_surface import DeformedContact
from analytic.contact.end_stress import EndStress
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid, roller_gap
from analytic.layers.operator import TangentialLayer
from analytic.layers.stress import AddedStress
from analytic.material import Material
from analytic.operators.half_plane import ModelOperator, SumOfConvolutions
from analytic.operators.tangential import CoupledPair, TangentialHalfPlane
from analytic.stress.field import StressField
from analytic.stress.maxima import StressMaxima, stress_maxima
from analytic.stress_state import StressState
from comparisons.common.progress import Stages, peak_memory
from comparisons.judging.effects.catalogue import COUPLED
from comparisons.judging.effects.estimates import TABOR
from comparisons.judging.yielding import FlowAssessment
from comparisons.models.half_plane import field_on
from comparisons.models.level import Level, StressResult, highest
from comparisons.models.nearest_operator import (
    is_layered,
    layered_body,
    nearest_operator,
    solve_on,
)
from comparisons.models.problem import Problem, ends_of
from comparisons.models.window import Window, search_window
from comparisons.scenes.scene import Scene

CAP = "cap"  # on the pressure, where the body yields and the scene has no hardness
WORDS = {
    "finite_size": "layer",
    "coating": "coating",
    COUPLED: "coupling",
    "exact_circle": "exact circle",
    CAP: f"pressures up to {TABOR:g} Y",
}
THINNEST = 1.0 / 40.0  # of the search window's reach: layers whose stresses are worth their waves


def carried(problem: Problem, effects: Iterable[str], flow: FlowAssessment) -> frozenset[str]:
    """What an operator can carry of the whole's effects, and a cap where the body yields."""
    scene = problem.scene
    held = set(carried_linear(scene, effects))
    yields = scene.body.yield_stress is not None and scene.body.hardness is None
    if yields and not scene.periodic and flow.worst.peak > TABOR * scene.body.yield_stress:
        held.add(CAP)
    return frozenset(held)


def carried_linear(scene: Scene, effects: Iterable[str]) -> frozenset[str]:
    """The same without a cap."""
    if scene.periodic:
        return frozenset()
    alone = {"finite_size"} if scene.body.thickness is None else set()
    return frozenset(set(effects) & set(WORDS) - alone)


def carried_deformed(problem: Problem, effects: Iterable[str]) -> frozenset[str]:
    """The effects of the whole that the half-plane has on its deformed surface: what is quadratic
    there is known of half-planes alone. Friction moves these surfaces as it does the whole's."""
    scene, effects = problem.scene, set(effects)
    bounded = is_layered(scene) or scene.periodic or scene.body.width is not None
    if "finite_strain" not in effects or bounded:
        return frozenset()
    moves = any(scene.load.friction) and problem.dundurs_beta != 0.0
    return frozenset(effects & {"finite_strain", "exact_circle"} | ({COUPLED} if moves else set()))


def words_of(held: frozenset[str]) -> str:
    where = "half-plane on the deformed surface" if "finite_strain" in held else "half-plane"
    beside = ", ".join(words for name, words in WORDS.items() if name in held)
    return f"{where} with {beside}" if beside else where


def problem_carrying(problem: Problem, held: frozenset[str]) -> Problem:
    """The problem with the shape and the cap that the operator's solution has."""
    shape = "circle" if "exact_circle" in held else "parabola"
    fields: dict[str, object] = {"finite_element.roller_shape": shape}
    if CAP in held:
        fields["body.hardness"] = TABOR * problem.scene.body.yield_stress
    if "coating" not in held:
        fields["coating"] = None
    if "finite_size" not in held:
        fields |= {"body.thickness": None, "body.base": None}
    return replace(problem, scene=problem.scene.unchecked(fields))


def why_no_stresses(problem: Problem, window: Window | None) -> str | None:
    """Why there are no stresses of a layered body, or None."""
    body = layered_body(problem.scene)
    if window is None or body is None or body.thickness > THINNEST * np.ptp(problem.extent):
        return None
    return "the layer is too thin for the waves of its stresses"


def operator_level(
    problem: Problem,
    held: frozenset[str],
    frictions: tuple[float, ...],
    pitch: float,
    window: Window | None,
) -> dict[float, Level]:
    """By friction coefficient, on pressure elements of a pitch [m], with the largest stresses in
    the window.

    held       what the operator carries, or what the deformed surface has
    frictions  coefficients whose pressures are the same"""
    problem, stages = problem_carrying(problem, held), Stages()
    grid = problem.grid(pitch)
    with stages.stage("contact"):
        operator = operator_of(problem, grid, frictions[0] if COUPLED in held else 0.0)
        gap = grid.hat_integrals(problem.finite_element_gap, problem.knots)

        def solve(gap: np.ndarray, start: np.ndarray | None = None) -> ContactSolution:
            return solve_on(operator, gap, grid.weights, problem.constraints(), start)

        solution = solve(gap)
        if "finite_strain" in held:
            scene, profile = problem.scene, problem.surface.profile
            height = np.zeros_like if profile is None else profile.spline()
            roller = None if scene.roller.rigid else scene.roller.material
            sagitta = roller_gap(scene.roller.radius, None, scene.finite_element.roller_shape)
            shape = roller, height, sagitta, problem.knots
            deformed = DeformedContact(grid, scene.body.material, *shape)
            solution = deformed.pressed(solve, solution)
        level = Level(
            grid=grid,
            solution=solution,
            displacement=operator.apply(solution.pressure) / grid.weights,
            patches=contact_patches(grid.x, solution.pressure, solution.gap),
            seconds=stages.seconds,
            unknowns=grid.count,
        )
    if window is None:
        return dict.fromkeys(frictions, replace(level, peak_memory=peak_memory()))
    with stages.stage("stresses"):
        stresses = tuple(_stresses(problem, level, window, frictions))
    memory = peak_memory()
    return {s.friction: replace(level, stress=s, peak_memory=memory) for s in stresses}


def operator_of(problem: Problem, grid: HatGrid, coupling: float) -> ModelOperator:
    """Mutual compliance; under friction with what the tractions on both surfaces move."""
    scene = problem.scene
    if not (coupling and is_layered(scene)):
        return nearest_operator(scene, grid, coupling)
    moved = TangentialLayer(grid.count, grid.pitch, layered_body(scene))
    if not scene.roller.rigid:
        roller = TangentialHalfPlane(grid.count, grid.pitch, scene.roller.material, -1.0)
        moved = SumOfConvolutions(moved, roller)
    return CoupledPair(nearest_operator(scene, grid), moved, coupling)


@dataclass(frozen=True)
class _Side:
    """The layer, or what lies below it; of a body without one all of it."""

    material: Material
    added: AddedStress | None
    below: bool
    ends: EndStress
    searched: Window  # from which extremes are searched

    def added_at(self, friction: float, x: np.ndarray, z: np.ndarray) -> StressState:
        """Beside the half-plane's hats."""
        beside = self.ends.at(friction)(x, z)
        if self.added is None:
            return beside
        return beside.plus(1.0, self.added.at(friction, x, z, self.below))

    def field(self, level: Level, friction: float) -> StressField:
        field = field_on(level, self.searched, self.ends).at(friction)
        if self.added is None:
            return field
        parts = self.added.field(field.x, field.z, self.below)
        added = StressState(*(parts[:3] + friction * parts[3:]))
        return replace(field, stress=field.stress.plus(1.0, added))

    def maxima(self, problem: Problem, level: Level, friction: float) -> StressMaxima:
        return stress_maxima(
            level.grid.x,
            level.solution.pressure,
            friction,
            self.field(level, friction),
            self.material.poissons_ratio,
            beside=partial(self.added_at, friction),
            cells=problem.asperities,
        )


def _stresses(
    problem: Problem, level: Level, window: Window, frictions: tuple[float, ...]
) -> Iterator[StressResult]:
    """Extremes, of both sides of an interface."""
    sides = _sides(problem, level, window)
    for friction in frictions:
        largest = [side.maxima(problem, level, friction) for side in sides]
        maxima = {
            # of each asperity (3, k) the side with the larger value
            name: reduce(lambda a, b: np.where(b[0] > a[0], b, a), (s.cells[key] for s in largest))
            for name, key in (("tau1", "tau1"), ("txz", "txz_abs"))
        }
        extremes = {name: highest(cells) for name, cells in maxima.items()}
        extremes["von_mises"] = max((one.von_mises for one in largest), key=lambda e: e.value)
        yield StressResult(friction, extremes, maxima)


def _sides(problem: Problem, level: Level, window: Window) -> list[_Side]:
    """The layer and what lies below it; the body itself where there is no layer."""
    body, searched = layered_body(problem.scene), search_window(problem, window)
    ends = ends_of(problem, level.grid, level.solution)
    if body is None:
        return [_Side(problem.scene.body.material, None, False, ends, searched)]
    reach = min(window.x[0], searched.x[0]), max(window.x[-1], searched.x[-1])
    added, thickness = (
        AddedStress.of(body, level.grid.x, level.solution.pressure, reach),
        body.thickness,
    )
    is_inside = searched.z <= thickness * (1.0 + 1e-12)
    inside, below = np.minimum(searched.z[is_inside], thickness), searched.z[~is_inside]
    goes_on = not body.rigid and len(below) > 0
    if goes_on:  # both sides of the interface are searched
        inside = np.append(inside[inside < thickness], thickness)
        below = np.append(thickness, below)
    layer = _Side(body.material, added, False, ends, replace(searched, z=inside))
    if not goes_on:
        return [layer]
    return [layer, _Side(body.base, added, True, ends, replace(searched, z=below))]
