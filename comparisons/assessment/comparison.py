"""From the levels of both models to figures with uncertainties, and to verdicts."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from comparisons.assessment.convergence import grid_convergence
from comparisons.assessment.uncertainty import (
    LENGTHS,
    Uncertainty,
    difference_of_figures,
    far_boundary,
    iteration,
    length_resolution,
)
from comparisons.assessment.verdict import Comparison, judge
from comparisons.common.quantities import QUANTITIES
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window

NEAR, DEEP = 0.1, 0.5  # bounds of the near and the deep field, in Hertz half-widths


@dataclass(frozen=True)
class PairHistory:
    """The difference of both models at one friction coefficient.

    norms          relative L2 by quantity, one table a level, coarse to fine
    uncertainties  of those of the last level, absolute: the norms are relative
    """

    friction: float
    norms: tuple[dict[str, float], ...]
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
    return scene.profile.spline()(x)


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
    """Relative L2 norms of the difference of two fields (m, k) on the window, by the depths that
    have points in it."""
    weights = layer_thickness(window.z)[:, None]
    depth = window.z[:, None] / problem.hertz.half_width
    return {
        f"tau1_field_{name}": relative_l2(tau1, reference, np.where(part, weights, 0.0))
        for name, part in (("near", depth < NEAR), ("deep", depth > DEEP))
        if np.any(part)
    }


def uncertainties(run: ModelRun, problem: Problem, friction: float) -> dict[str, Uncertainty]:
    """Of every figure that the model has by itself."""
    history = [figures(level, problem, friction) for level in run.levels]
    moved = figures(run.far_boundary_check or run.levels[0], problem, friction)
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
            domain=far_boundary(moved[name], history[0][name]) / scale,
            convergence=convergence,
        )
    return found


def pair_history(
    half_plane: ModelRun,
    finite_element: ModelRun,
    problem: Problem,
    friction: float,
    window: Window | None,
) -> PairHistory:
    pairs = zip(half_plane.levels, finite_element.levels, strict=True)
    history = [norms(one, other, problem, friction, window) for one, other in pairs]
    first, check = finite_element.levels[0], finite_element.far_boundary_check
    moved = norms(check, first, problem, friction, window) if check else {}
    found = {}
    for name in history[-1]:
        convergence = grid_convergence([h[name] for h in history], QUANTITIES[name].formal_order)
        found[name] = Uncertainty(
            iteration=iteration(half_plane.finest, finite_element.finest),
            discretisation=convergence.uncertainty,
            domain=far_boundary(moved.get(name, 0.0)),
            convergence=convergence,
        )
    return PairHistory(friction, tuple(history), found)


def pair_histories(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> tuple[PairHistory, ...]:
    """One a friction coefficient, of finished runs of both models."""
    pair = runs["half_plane"], runs["finite_element"]
    return tuple(pair_history(*pair, problem, mu, window) for mu in problem.scene.friction)


def discretisations(
    runs: dict[str, ModelRun], problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """Discretisation uncertainty of what is judged: of the difference, or of one model alone."""
    each = [uncertainties(run, problem, friction) for run in runs.values()]
    found = {name: sum(u[name].discretisation for u in each) for name in each[0]}
    if len(runs) == 2:
        pair = pair_history(*runs.values(), problem, friction, window)
        found |= {name: u.discretisation for name, u in pair.uncertainties.items()}
    return found


def compared(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> tuple[Comparison, ...]:
    """Every quantity at every friction coefficient, of finished runs of both models."""
    frictions = problem.scene.friction
    return tuple(row for mu in frictions for row in _compared(problem, runs, mu, window))


def _compared(
    problem: Problem, runs: dict[str, ModelRun], friction: float, window: Window | None
) -> list[Comparison]:
    """At one friction coefficient, in the order of QUANTITIES."""
    half_plane, finite_element = runs["half_plane"], runs["finite_element"]
    one = figures(half_plane.finest, problem, friction)
    other = figures(finite_element.finest, problem, friction)
    of_one = uncertainties(half_plane, problem, friction)
    of_other = uncertainties(finite_element, problem, friction)
    of_norm = pair_history(half_plane, finite_element, problem, friction, window).uncertainties
    listed = []
    for name in QUANTITIES:
        if name in one:
            first, second = one[name], other[name]
            least = QUANTITIES[name].scale(problem.hertz)
            scale = abs(second) or least
            difference = (first - second) / scale
            own = (abs(first) or least) / scale * of_one[name].total
            uncertainty = difference_of_figures(own, first / scale, of_other[name].total)
        elif name in of_norm:
            first = second = None
            difference, uncertainty = of_norm[name].convergence.value, of_norm[name].total
        else:
            continue
        tolerance = problem.scene.tolerance.get(name)
        verdict = judge(difference, uncertainty, tolerance) if tolerance else None
        known = uncertainty if np.isfinite(uncertainty) else None
        listed.append(
            Comparison(name, friction, first, second, difference, known, tolerance, verdict)
        )
    return listed


def relative_l2(
    values: np.ndarray, reference: np.ndarray, weights: np.ndarray | float = 1.0
) -> float:
    """||values - reference|| / ||reference||; points where either is not finite are left out."""
    known = np.isfinite(values) & np.isfinite(reference)
    weights = np.broadcast_to(weights, values.shape)[known]
    size = np.sum(weights * reference[known] ** 2)
    if size == 0.0:
        return 0.0 if not np.any(values[known]) else np.inf
    return float(np.sqrt(np.sum(weights * (values[known] - reference[known]) ** 2) / size))


def layer_thickness(depths: np.ndarray) -> np.ndarray:
    """Thickness (m,) [m] that each of the ascending depths (m,) [m] stands for in an integral."""
    return np.gradient(depths) if len(depths) > 1 else np.ones(1)
