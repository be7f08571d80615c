"""The half-plane's own error: what is left between the models when the numerics are accounted for.

Both models have the same pressure elements on every level, whose error they share. So it is the
difference of the models whose convergence under refinement is judged, as
`comparisons.assessment.comparison` does for norms of differences, and not the convergence of each.
"""

from dataclasses import dataclass

import numpy as np

from comparisons.assessment.comparison import figures, norms
from comparisons.assessment.uncertainty import (
    LENGTHS,
    far_boundary,
    grid_convergence,
    relative_resolution,
    summed_iteration,
)
from comparisons.common.quantities import QUANTITIES
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window


@dataclass(frozen=True)
class PointError:
    """Of a quantity: the models' values [SI] on the finest level (None: a norm of both), the
    half-plane's error relative to the finite elements, and the numerical uncertainty of that
    (None: unknown)."""

    half_plane: float | None
    finite_element: float | None
    difference: float
    uncertainty: float | None


def model_errors(
    half_plane: ModelRun,
    finite_element: ModelRun,
    problem: Problem,
    friction: float,
    window: Window | None,
) -> dict[str, PointError]:
    """By quantity, in the order of QUANTITIES."""
    pairs = zip(half_plane.levels, finite_element.levels, strict=True)
    history = [_differences(one, other, problem, friction, window) for one, other in pairs]
    moved = history[0]
    if finite_element.far_boundary_check is not None:
        moved = _differences(
            half_plane.levels[0], finite_element.far_boundary_check, problem, friction, window
        )
    one = figures(half_plane.finest, problem, friction)
    other = figures(finite_element.finest, problem, friction)
    finest = half_plane.finest, finite_element.finest
    found = {}
    for name in (name for name in QUANTITIES if name in history[-1]):
        convergence = grid_convergence(
            [differences[name] for differences in history],
            QUANTITIES[name].formal_order,
            relative_resolution(*finest) if name in LENGTHS else 0.0,
        )
        domain = far_boundary(moved[name], history[0][name])
        doubt = convergence.uncertainty + domain + summed_iteration(*finest)
        found[name] = PointError(
            one.get(name),
            other.get(name),
            history[-1][name],
            float(doubt) if np.isfinite(doubt) else None,
        )
    return found


def _differences(
    one: Level, other: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """Of a pair of levels: (half-plane - finite elements) / finite elements, and the norms."""
    first, second = figures(one, problem, friction), figures(other, problem, friction)
    found = {
        name: (value - second[name]) / (abs(second[name]) or QUANTITIES[name].scale(problem.hertz))
        for name, value in first.items()
    }
    return found | norms(one, other, problem, friction, window)
