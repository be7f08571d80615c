"""The half-plane's own error: what is left when numerics are accounted for, split into effects.

Figures: what the models differ by on their finest level, and what the scene's own finite elements
still lack of the whole, on the level that the effects were taken to. Norms do not add: theirs are
those of the half-plane against the whole, on that level.
"""

from dataclasses import dataclass

import numpy as np

from comparisons.budget.answers import Answer, answer_of, sizes
from comparisons.budget.bodies import strain_doubt
from comparisons.budget.choice import Choice
from comparisons.budget.parts import Parts
from comparisons.compare import PRESSURE_PER_RESIDUAL, length_resolution
from comparisons.level import ModelRun, Window
from comparisons.problem import Problem
from comparisons.quantities import QUANTITIES
from comparisons.uncertainty import grid_convergence, two_grids
from comparisons.verdict import Comparison

LENGTHS = ("contact_length", "contact_ratio")


@dataclass(frozen=True)
class Share:
    """A relative size with its uncertainty, absolute in the same measure."""

    value: float
    uncertainty: float


@dataclass(frozen=True)
class OwnError:
    """Of one quantity at one friction coefficient, relative to the finite elements.

    effects      by name, what each changes in the finite elements
    interaction  what the linear effects change together beyond their sum
    value        (half-plane - whole) / finite elements, or the norm of that difference
    uncertainty  of `value`
    stand_in     the part of that which refinement cannot lower: how well the stand-in's strain
                 tells that of two bodies
    """

    quantity: str
    friction: float
    effects: dict[str, Share]
    interaction: float
    value: float
    uncertainty: float
    stand_in: float = 0.0


def own_errors(
    problem: Problem,
    window: Window | None,
    runs: dict[str, ModelRun],
    rows: list[Comparison],
    history: list[Parts],
    choice: Choice,
) -> list[OwnError]:
    """One for each row, all of one friction coefficient.

    rows     the models' comparison at that friction
    history  the effects there on the first levels, coarse to fine
    """
    friction, last = rows[0].friction, history[-1]
    base = [parts.own for parts in history]
    half_plane = [
        answer_of(level, problem, friction) for level in runs["half_plane"].levels[: len(history)]
    ]
    residual = max(
        level.solution.residuals.worst
        for run in runs.values()
        for level in (run.finest, run.levels[len(history) - 1])
    )
    grid = runs["finite_element"].levels[len(history) - 1]
    edge = 2.0 * length_resolution(grid.grid.pitch, len(grid.patches)) / grid.contact_length

    def share(name: str, changes: list[Answer]) -> Share:
        values = [
            sizes(change, whole, problem, window)[name]
            for change, whole in zip(changes, base, strict=True)
        ]
        if not any(values):
            return Share(0.0, 0.0)
        doubt = _doubt(values, name, edge)
        return Share(values[-1], doubt + PRESSURE_PER_RESIDUAL * residual)

    lacking = [parts.lacking for parts in history]
    own = [
        one - (whole + missing)
        for one, whole, missing in zip(half_plane, base, lacking, strict=True)
    ]
    found = []
    for row in rows:
        name = row.quantity
        effects = {
            effect: share(name, [parts.effects[effect] for parts in history])
            for effect in last.effects
        }
        stand_in = 0.0
        if "finite strain" in effects:
            strain = effects["finite strain"]
            stand_in = strain_doubt(problem) * abs(strain.value)
            effects["finite strain"] = Share(strain.value, strain.uncertainty + stand_in)
        if QUANTITIES[name].of_pair and _is_any(last.lacking):
            whole = share(name, own)
            value, doubt = whole.value, whole.uncertainty
        else:
            missing = Share(0.0, 0.0) if QUANTITIES[name].of_pair else share(name, lacking)
            value = row.difference - missing.value
            numerical = np.inf if row.uncertainty is None else row.uncertainty
            doubt = numerical + missing.uncertainty
        found.append(
            OwnError(
                name,
                friction,
                effects,
                sizes(last.interaction, base[-1], problem, window)[name],
                value,
                doubt + stand_in,
                stand_in,
            )
        )
    return found


def _doubt(values: list[float], name: str, edge: float) -> float:
    """Discretisation uncertainty of a difference of bodies on two levels or more."""
    resolution = edge if name in LENGTHS else 0.0
    if len(values) < 3:
        return two_grids(values, resolution)
    return grid_convergence(values, QUANTITIES[name].formal_order, resolution).uncertainty


def _is_any(answer: Answer) -> bool:
    return bool(np.any(answer.pressure)) or any(answer.figures.values())
