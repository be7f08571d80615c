"""Both models against each other: differences of figures, and their verdicts; norms beside them.

In: solved levels of both models on the same pressure elements. Out: a judged figure a quantity and
friction coefficient, (half-plane - finite elements) / finite elements, and plain ones, the relative
L2 norms of the pressures' difference and of that of tau1 on the common window."""

from collections.abc import Iterator, Mapping

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Findings
from comparisons.figures.quantity import COMPARED, MODELS, NORMS, QUANTITIES
from comparisons.figures.uncertainty import Uncertainty, iteration, length_resolution, numerical
from comparisons.judging.contact import (
    by_repetition,
    formal_order,
    left_by_crest,
    uncertainties,
    values_of,
)
from comparisons.judging.study import Case, Solved, Study
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window

NAME = "comparison"
# Of the uncertainty that a difference may have: figures that are shown may have half as much again.
SHOWN = 2.0 / 3.0


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Every quantity and norm of both models, in the order of friction."""
    figures = []
    for case in solved.cases:
        pair = [case.runs[model] for model in MODELS]
        figures += differences_of(*pair, case).values()
        figures += norms_of(*pair, case, solved.window)
    return Findings(tuple(figures))


def differences_of(half_plane: ModelRun, finite_element: ModelRun, case: Case) -> dict[str, Figure]:
    """By quantity. The differences are figures of their own: both models have the same pressure
    elements, and what these leave out, is in both."""
    problem, coarsest = case.problem, half_plane.levels[0]
    pairs = zip(half_plane.levels, finite_element.levels, strict=True)
    history = [differences(one, other, problem) for one, other in pairs]
    repeated = by_repetition(finite_element, lambda level: differences(coarsest, level, problem))
    finest = half_plane.finest, finite_element.finest
    reference, made = values_of(finite_element.finest, problem), {}
    for name, difference in history[-1].items():
        quantity, tolerance = QUANTITIES[name], problem.scene.tolerances.get(name)
        resolution = relative_resolution(*finest) if name == "contact_length" else 0.0
        values = tuple(of_level[name] for of_level in history)
        order = formal_order(name, finest, problem)
        convergence = grid_convergence(values, order, resolution)
        unsolved = iteration(*(level.solution for level in finest))
        unsolved *= max(1.0, abs(1.0 + difference))
        # meshes and hats lack not the same of a crest: their difference was seen to stand still on
        # levels that lack it, and to fall from 2 % to nothing on those that come to resolve it
        left = max(left_by_crest(name, level) for level in finest)
        parts = unsolved, max(convergence.uncertainty, left), *repeated[name]
        made[name] = Figure(
            study=NAME,
            quantity=name,
            source="half_plane",
            value=difference,
            at=case.at,
            against="finite_element",
            scale=abs(reference[name]) or quantity.scale(problem.hertz),
            uncertainty=numerical(*parts, convergence),
            bounds=(-tolerance, tolerance) if tolerance else None,
            levels=values,
        )
    return made


def norms_of(
    half_plane: ModelRun, finite_element: ModelRun, case: Case, window: Window | None
) -> Iterator[Figure]:
    """The norms of both models' difference. They may be equal by chance: what a repetition changes
    counts by its own norm."""
    pairs = zip(half_plane.levels, finite_element.levels, strict=True)
    history, first = [norms(*pair, window) for pair in pairs], finite_element.levels[0]
    repeated = by_repetition(finite_element, lambda level: norms(level, first, window))
    unsolved = iteration(half_plane.finest.solution, finite_element.finest.solution)
    for name, size in history[-1].items():
        values = tuple(of_level[name] for of_level in history)
        convergence = grid_convergence(values, NORMS[name].formal_order)
        parts = unsolved, convergence.uncertainty, *repeated[name]
        yield Figure(
            study=NAME,
            quantity=name,
            source="half_plane",
            value=size,
            at=case.at,
            against="finite_element",
            uncertainty=numerical(*parts, convergence),
            levels=values,
        )


def differences(level: Level, reference: Level, problem: Problem) -> dict[str, float]:
    """(level - reference) / reference of every figure, over the Hertz contact's where the
    reference's vanishes."""
    one, other = (values_of(known, problem) for known in (level, reference))
    return relative_differences(one, other, problem)


def relative_differences(
    one: dict[str, float], reference: dict[str, float], problem: Problem
) -> dict[str, float]:
    """(one - reference) / reference of figures by name, or over Hertz's where that vanishes."""
    sizes = {}
    for name, value in one.items():
        scale = abs(reference[name]) or QUANTITIES[name].scale(problem.hertz)
        sizes[name] = (value - reference[name]) / scale
    return sizes


def relative_resolution(level: Level, reference: Level) -> float:
    """How finely the difference of two contact lengths is read, of two models or of an effect,
    relative to the reference's: both err."""
    edges = [length_resolution(of.grid.pitch, len(of.patches)) for of in (level, reference)]
    ratio = level.contact_length / reference.contact_length
    return (edges[0] + ratio * edges[1]) / reference.contact_length


def norms(level: Level, reference: Level, window: Window | None) -> dict[str, float]:
    """Relative L2 norms of the difference of the pressures of two levels on the same elements, and
    of their tau1 on the window, where both have that."""
    sizes = {"pressure_l2": relative_l2(level.solution.pressure, reference.solution.pressure)}
    tau1 = [known.stress and known.stress.tau1 for known in (level, reference)]
    if all(field is not None for field in tau1):
        thickness = np.gradient(window.z)[:, None]  # of the layer that each depth stands for
        sizes["tau1_l2"] = relative_l2(*tau1, thickness)
    return sizes


def relative_l2(
    values: np.ndarray, reference: np.ndarray, weights: np.ndarray | float = 1.0
) -> float:
    """||values - reference|| / ||reference||; points where either is not finite are left out."""
    known = np.isfinite(values) & np.isfinite(reference)
    if not known.all():
        weights = np.broadcast_to(weights, values.shape)[known]
        values, reference = values[known], reference[known]
    size = np.sum(weights * reference**2)
    if size == 0.0:
        return 0.0 if not np.any(values) else np.inf
    return float(np.sqrt(np.sum(weights * (values - reference) ** 2) / size))


def discretisations(case: Case) -> dict[str, float]:
    """The discretisation uncertainty that refinement is to lower: the difference's, which is
    judged, or SHOWN times a model's own, whose figures are shown, where that is larger; of one
    model alone its own. Not the sum: what the pressure elements leave out cancels."""
    by_model = [uncertainties(run, case.problem) for run in case.runs.values()]
    if len(by_model) == 1:
        return {name: _left(stated) for name, stated in by_model[0].items()}
    pair = differences_of(*case.runs.values(), case)
    sizes = {name: _left(difference.uncertainty) for name, difference in pair.items()}
    for name in by_model[0]:
        larger = max(_left(stated[name]) for stated in by_model)
        sizes[name] = max(sizes[name], SHOWN * larger)
    return sizes


def _left(stated: Uncertainty) -> float:
    return stated.parts["discretisation"]


STUDY = Study(NAME, COMPARED, solve, applies=lambda solved: solved.plan.compares)
