"""Both models against each other: differences of figures and norms, and their verdicts.

In: solved levels of both models on the same pressure elements. Out: a judged figure a quantity and
friction coefficient, (half-plane - finite elements) / finite elements or a relative L2 norm."""

from collections.abc import Mapping

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Findings
from comparisons.figures.norm import relative_l2
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.figures.uncertainty import (
    LENGTHS,
    Uncertainty,
    iteration,
    numerical,
    relative_resolution,
)
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.contact import by_repetition, formal_order, uncertainties, values_of
from comparisons.studies.study import Solved, Study

NAME = "comparison"
# Of the uncertainty that a difference may have: figures that are shown may have half as much again.
SHOWN = 2.0 / 3.0


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    return Findings(compared(solved.problem, solved.runs, solved.window))


def compared(
    problem: Problem, runs: Mapping[str, ModelRun], window: Window | None
) -> tuple[Figure, ...]:
    """Every quantity of finished runs of both models, in the order of friction, then QUANTITIES."""
    pair, frictions = [runs[model] for model in MODELS], problem.scene.load.friction
    return tuple(
        figure
        for friction in frictions
        for figure in differences_of(*pair, problem, friction, window).values()
    )


def differences_of(
    half_plane: ModelRun,
    finite_element: ModelRun,
    problem: Problem,
    friction: float,
    window: Window | None,
) -> dict[str, Figure]:
    """By quantity. The differences are figures of their own: both models have the same pressure
    elements, and what these leave out, is in both."""
    half_plane, finite_element = half_plane.under(friction), finite_element.under(friction)
    pairs = zip(half_plane.levels, finite_element.levels, strict=True)
    history = [differences(one, other, problem, friction, window) for one, other in pairs]
    first, coarsest = finite_element.levels[0], half_plane.levels[0]
    repeated = by_repetition(
        finite_element, lambda level: differences(coarsest, level, problem, friction, window)
    )
    # two norms may be equal by chance: theirs is the norm of what the repetition changes
    repeated |= by_repetition(
        finite_element, lambda level: norms(level, first, problem, friction, window)
    )
    finest = half_plane.finest, finite_element.finest
    reference, made = values_of(finite_element.finest, problem, friction), {}
    for name, difference in history[-1].items():
        quantity, tolerance = QUANTITIES[name], problem.scene.tolerances.get(name)
        resolution = relative_resolution(*finest) if name in LENGTHS else 0.0
        values = tuple(of_level[name] for of_level in history)
        order = formal_order(name, finest, problem, friction)
        convergence = grid_convergence(values, order, resolution)
        unsolved = iteration(*finest)
        if not quantity.of_pair:
            unsolved *= max(1.0, abs(1.0 + difference))
        parts = unsolved, convergence.uncertainty, *repeated[name]
        made[name] = Figure(
            study=NAME,
            quantity=name,
            source="half_plane",
            value=difference,
            at={"friction": friction},
            against="finite_element",
            scale=abs(reference.get(name, 0.0)) or quantity.scale(problem.hertz),
            uncertainty=numerical(*parts, convergence),
            bounds=(-tolerance, tolerance) if tolerance else None,
            levels=values,
        )
    return made


def differences(
    level: Level, reference: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """(level - reference) / reference of every figure, over the Hertz contact's where the
    reference's vanishes, and the norms; in the order of QUANTITIES."""
    one, other = (values_of(known, problem, friction) for known in (level, reference))
    sizes = norms(level, reference, problem, friction, window)
    sizes |= relative_differences(one, other, problem)
    return {name: sizes[name] for name in QUANTITIES if name in sizes}


def relative_differences(
    one: dict[str, float], reference: dict[str, float], problem: Problem
) -> dict[str, float]:
    """(one - reference) / reference of figures by name, or over Hertz's where that vanishes."""
    sizes = {}
    for name, value in one.items():
        scale = abs(reference[name]) or QUANTITIES[name].scale(problem.hertz)
        sizes[name] = (value - reference[name]) / scale
    return sizes


def norms(
    level: Level, reference: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """The compared quantities of a pair of levels on the same pressure elements: relative L2."""
    stresses = [known.stress(friction) for known in (level, reference)]
    return pair_norms(
        (level.solution.pressure, reference.solution.pressure),
        tuple(None if stress is None else stress.sparse_tau1 for stress in stresses),
        problem,
        window,
    )


def pair_norms(
    pressures: tuple[np.ndarray, np.ndarray],
    tau1: tuple[np.ndarray | None, np.ndarray | None],
    problem: Problem,
    window: Window | None,
) -> dict[str, float]:
    """Relative L2 norms of the difference of two pressures (n,) and of two fields of tau1 (m, k) at
    the window's sparse points, None without one; the second of each is the reference."""
    sizes = {"pressure_l2": relative_l2(*pressures)}
    if all(field is not None for field in tau1):
        sizes |= field_norms(*tau1, problem, window)
    return sizes


def field_norms(
    tau1: np.ndarray, reference: np.ndarray, problem: Problem, window: Window
) -> dict[str, float]:
    """Relative L2 norms of the difference of two fields (m, k) at the window's sparse points, by
    their depths."""
    at = window.sparse
    weights = layer_thickness(at.z)[:, None]
    return {
        f"tau1_field_{name}": relative_l2(tau1[part], reference[part], weights[part])
        for name, part in at.compared(problem.hertz.half_width).items()
        if np.any(part)
    }


def discretisations(
    runs: dict[str, ModelRun], problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """The discretisation uncertainty that refinement is to lower: the difference's, which is
    judged, or SHOWN times a model's own, whose figures are shown, where that is larger; of one
    model alone its own. Not the sum: what the pressure elements leave out cancels."""
    by_model = [uncertainties(run, problem, friction) for run in runs.values()]
    if len(runs) == 1:
        return {name: _left(stated) for name, stated in by_model[0].items()}
    pair = differences_of(*runs.values(), problem, friction, window)
    sizes = {name: _left(difference.uncertainty) for name, difference in pair.items()}
    for name in by_model[0]:
        larger = max(_left(stated[name]) for stated in by_model)
        sizes[name] = max(sizes[name], SHOWN * larger)
    return sizes


def _left(stated: Uncertainty) -> float:
    return stated.parts["discretisation"]


def layer_thickness(depths: np.ndarray) -> np.ndarray:
    """Thickness (m,) [m] that each of the ascending depths (m,) [m] stands for in an integral."""
    return np.gradient(depths) if len(depths) > 1 else np.ones(1)


STUDY = Study(NAME, QUANTITIES, solve, applies=lambda solved: solved.plan.compares)
