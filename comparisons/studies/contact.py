"""From the levels of both models to figures with uncertainties, and to verdicts."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.figures.uncertainty import (
    LENGTHS,
    Uncertainty,
    far_boundary,
    iteration,
    length_resolution,
    of_increments,
    relative_resolution,
)
from comparisons.figures.verdict import Comparison, judge
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window

# Of the uncertainty that a difference may have: figures that are shown may have half as much again.
SHOWN = 2.0 / 3.0
NEAR, DEEP = 0.1, 0.5  # bounds of the near and the deep field, in Hertz half-widths


@dataclass(frozen=True)
class PairHistory:
    """The difference of both models at one friction coefficient."""

    friction: float
    # by quantity: (half-plane - finite elements) / finite elements, or the relative L2 norm; one
    # table a level, coarse to fine
    differences: tuple[dict[str, float], ...]
    # of those of the last level, absolute: the differences are relative
    uncertainties: dict[str, Uncertainty]


def figures(level: Level, problem: Problem, friction: float) -> dict[str, float]:
    """The compared quantities that one model has by itself, SI."""
    found = {
        "peak_pressure": float(level.solution.pressure.max()),
        "contact_length": level.contact_length,
        "contact_ratio": level.contact_length / (2.0 * problem.hertz.half_width),
    }
    stress = level.stress(friction)
    if stress is not None:
        found["tau1_max"] = stress.extremes["tau1"].value
        tau1 = stress.extremes["tau1"]
        found["tau1_max_depth"] = tau1.z + float(boundary_rise(problem, level, tau1.x))
        found["txz_max_abs"] = abs(stress.extremes["txz"].value)
    return found


def boundary_rise(problem: Problem, level: Level, x: ArrayLike) -> np.ndarray:
    """Height [m] of the level's boundary above places x [m], from which depths count."""
    scene = problem.scene
    if level.mesh is None or scene.finite_element.geometry == "flat":
        return np.zeros(np.shape(x))
    return problem.surface.profile.spline()(x)


def norms(
    level: Level, reference: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """The compared quantities of a pair of levels on the same pressure elements: relative L2."""
    stresses = [each.stress(friction) for each in (level, reference)]
    return pair_norms(
        (level.solution.pressure, reference.solution.pressure),
        tuple(None if stress is None else stress.field.tau1 for stress in stresses),
        problem,
        window,
    )


def pair_norms(
    pressures: tuple[np.ndarray, np.ndarray],
    tau1: tuple[np.ndarray | None, np.ndarray | None],
    problem: Problem,
    window: Window | None,
) -> dict[str, float]:
    """Relative L2 norms of the difference of two pressures (n,) and of two fields of tau1 (m, k)
    on the window, None without one; the second of each is the reference."""
    found = {"pressure_l2": relative_l2(*pressures)}
    if all(field is not None for field in tau1):
        found |= field_norms(*tau1, problem, window)
    return found


def field_norms(
    tau1: np.ndarray, reference: np.ndarray, problem: Problem, window: Window
) -> dict[str, float]:
    """Relative L2 norms of the difference of two fields (m, k), by the window's depths."""
    weights, depth = layer_thickness(window.z)[:, None], window.z / problem.hertz.half_width
    return {
        f"tau1_field_{name}": relative_l2(tau1[part], reference[part], weights[part])
        for name, part in (("near", depth < NEAR), ("deep", depth > DEEP))
        if np.any(part)
    }


def uncertainties(run: ModelRun, problem: Problem, friction: float) -> dict[str, Uncertainty]:
    """Of every figure that the model has by itself."""
    history = [figures(level, problem, friction) for level in run.levels]
    repeated = by_repetition(run, lambda level: figures(level, problem, friction))
    found = {}
    for name, value in history[-1].items():
        values = [of_level[name] for of_level in history]
        resolution = 0.0
        if name in LENGTHS:
            resolution = length_resolution(run.finest.grid.pitch, len(run.finest.patches))
            resolution *= value / run.finest.contact_length
        convergence = grid_convergence(values, QUANTITIES[name].formal_order, resolution)
        scale = abs(value) or QUANTITIES[name].scale(problem.hertz)
        found[name] = Uncertainty(
            iteration=iteration(run.finest),
            discretisation=convergence.uncertainty / scale,
            domain=repeated[name][0] / scale,
            convergence=convergence,
            increments=repeated[name][1] / scale,
        )
    return found


def by_repetition(
    run: ModelRun, read: Callable[[Level], dict[str, float]]
) -> dict[str, tuple[float, float]]:
    """Uncertainties by the far boundary and by the increments of flow of what is read off a level,
    in its units: by the coarsest level and what it was repeated with."""
    first, check = read(run.levels[0]), run.far_boundary_check
    moved = first if check is None else read(check)
    increments = [*map(read, run.longer_increments), first]
    return {
        name: (
            far_boundary(moved.get(name, value), value),
            of_increments([each.get(name, value) for each in increments]),
        )
        for name, value in first.items()
    }


def differences(
    level: Level, reference: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """(level - reference) / reference of every figure, over the Hertz contact's where the
    reference's vanishes, and the norms; in the order of QUANTITIES."""
    one, other = (figures(each, problem, friction) for each in (level, reference))
    found = norms(level, reference, problem, friction, window)
    found |= relative_differences(one, other, problem)
    return {name: found[name] for name in QUANTITIES if name in found}


def relative_differences(
    one: dict[str, float], reference: dict[str, float], problem: Problem
) -> dict[str, float]:
    """(one - reference) / reference of figures by name, or over Hertz's where that vanishes."""
    found = {}
    for name, value in one.items():
        scale = abs(reference[name]) or QUANTITIES[name].scale(problem.hertz)
        found[name] = (value - reference[name]) / scale
    return found


def pair_history(
    half_plane: ModelRun,
    finite_element: ModelRun,
    problem: Problem,
    friction: float,
    window: Window | None,
) -> PairHistory:
    """The differences as figures of their own: both models have the same pressure elements, and
    what these leave out, is in both."""
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
    found = {}
    for name, difference in history[-1].items():
        resolution = relative_resolution(*finest) if name in LENGTHS else 0.0
        values = [of_level[name] for of_level in history]
        convergence = grid_convergence(values, QUANTITIES[name].formal_order, resolution)
        ratio = 1.0 if QUANTITIES[name].of_pair else max(1.0, abs(1.0 + difference))
        domain, increments = repeated[name]
        found[name] = Uncertainty(
            iteration=ratio * iteration(*finest),
            discretisation=convergence.uncertainty,
            domain=domain,
            convergence=convergence,
            increments=increments,
        )
    return PairHistory(friction, tuple(history), found)


def pair_histories(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> tuple[PairHistory, ...]:
    """One a friction coefficient, of finished runs of both models."""
    pair = runs["half_plane"], runs["finite_element"]
    return tuple(pair_history(*pair, problem, mu, window) for mu in problem.scene.load.friction)


def discretisations(
    runs: dict[str, ModelRun], problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """Discretisation uncertainty that refinement is to lower: the larger of the difference's, which
    is judged, and of SHOWN times each model's own, for figures are shown too; or of one model. Not
    the sum: what the pressure elements leave out is in both and cancels in the difference."""
    each = [uncertainties(run, problem, friction) for run in runs.values()]
    if len(runs) == 1:
        return {name: found.discretisation for name, found in each[0].items()}
    pair = pair_history(*runs.values(), problem, friction, window).uncertainties
    sizes = {name: found.discretisation for name, found in pair.items()}
    for name in each[0]:
        own = max(found[name].discretisation for found in each)
        sizes[name] = max(sizes[name], SHOWN * own)
    return sizes


def compared(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> tuple[Comparison, ...]:
    """Every quantity of finished runs of both models, in the order of friction, then QUANTITIES."""
    rows = []
    for pair in pair_histories(problem, runs, window):
        friction = pair.friction
        found = [figures(runs[model].finest, problem, friction) for model in MODELS]
        for name, difference in pair.differences[-1].items():
            uncertainty = pair.uncertainties[name].total
            tolerance = problem.scene.tolerances.get(name)
            verdict = judge(difference, uncertainty, tolerance) if tolerance else None
            known = uncertainty if np.isfinite(uncertainty) else None
            values = (of_model.get(name) for of_model in found)
            rows.append(Comparison(name, friction, *values, difference, known, tolerance, verdict))
    return tuple(rows)


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


def layer_thickness(depths: np.ndarray) -> np.ndarray:
    """Thickness (m,) [m] that each of the ascending depths (m,) [m] stands for in an integral."""
    return np.gradient(depths) if len(depths) > 1 else np.ones(1)
