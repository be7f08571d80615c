"""The half-plane's model error: its error beyond the numerical ones, split into effects.

All is relative to the whole, the finite elements with every effect that matters, so that the error
is the same whether an effect is added here or switched on in the scene. A figure's error is the
models' difference on their finest level plus what the scene's own finite elements do not contain of
the whole, on the level of the effects. Norms do not add: their error is the norm of the half-plane
against the whole on that level, with the far boundary of the models' difference.
"""

from dataclasses import dataclass

import numpy as np

from comparisons.assessment.comparison import pair_history
from comparisons.assessment.convergence import grid_convergence
from comparisons.assessment.effects.contributions import EffectContributions
from comparisons.assessment.effects.quantities_of_interest import (
    QuantitiesOfInterest,
    quantities_of,
    relative_sizes,
)
from comparisons.assessment.effects.variants import strain_share_uncertainty
from comparisons.assessment.uncertainty import (
    LENGTHS,
    difference_of_figures,
    difference_of_norms,
    iteration,
    relative_resolution,
)
from comparisons.assessment.verdict import Comparison
from comparisons.common.quantities import QUANTITIES
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window


@dataclass(frozen=True)
class Estimate:
    """A relative size with its uncertainty, absolute in the same measure."""

    value: float
    uncertainty: float


@dataclass(frozen=True)
class ModelError:
    """Of one quantity at one friction coefficient, relative to the whole.

    effects      by name, what each changes in the finite elements
    interaction  what the linear effects change jointly beyond their sum
    value        (half-plane - whole) / whole, or the norm of that difference
    uncertainty  of `value`
    stand_in     its part that refinement cannot lower: finite strain measured on a stand-in
    """

    quantity: str
    friction: float
    effects: dict[str, Estimate]
    interaction: float
    value: float
    uncertainty: float
    stand_in: float = 0.0


def model_errors(
    problem: Problem,
    window: Window | None,
    runs: dict[str, ModelRun],
    rows: list[Comparison],
    history: list[EffectContributions],
) -> list[ModelError]:
    """One for each row, all of one friction coefficient.

    rows     the models' comparison at that friction
    history  the effects there on the first levels, coarse to fine
    """
    friction, last = rows[0].friction, history[-1]
    whole = [parts.own + parts.not_contained for parts in history]
    number = len(history) - 1
    levels = runs["half_plane"].levels[: len(history)]
    half_plane = [quantities_of(level, problem, friction) for level in levels]
    unsolved = iteration(
        *(level for run in runs.values() for level in (run.finest, run.levels[number]))
    )
    reference = runs["finite_element"].levels[number]
    edge = relative_resolution(reference, reference)

    def share(name: str, changes: list[QuantitiesOfInterest]) -> Estimate:
        if QUANTITIES[name].of_pair:
            values = [
                relative_sizes(change, reference, problem, window)[name]
                for change, reference in zip(changes, whole, strict=True)
            ]
        else:  # by one scale: a place may jump to the surface on one level alone
            scale = _scale(whole[-1].figures[name], name, problem)
            values = [change.figures[name] / scale for change in changes]
        if not any(values):
            return Estimate(0.0, 0.0)
        resolution = edge if name in LENGTHS else 0.0
        refined = grid_convergence(values, QUANTITIES[name].formal_order, resolution)
        return Estimate(values[-1], refined.uncertainty + unsolved)

    not_contained = [parts.not_contained for parts in history]
    own = [one - other for one, other in zip(half_plane, whole, strict=True)]
    pair = pair_history(runs["half_plane"], runs["finite_element"], problem, friction, window)
    interaction = relative_sizes(last.interaction, whole[-1], problem, window)
    found = []
    for row in rows:
        name = row.quantity
        effects = {
            effect: share(name, [parts.effects[effect] for parts in history])
            for effect in last.effects
        }
        stand_in = 0.0
        if "finite_strain" in effects:
            strain = effects["finite_strain"]
            stand_in = strain_share_uncertainty(problem) * abs(strain.value)
            effects["finite_strain"] = Estimate(strain.value, strain.uncertainty + stand_in)
        numerical = np.inf if row.uncertainty is None else row.uncertainty
        missing = share(name, not_contained)
        if not QUANTITIES[name].of_pair:
            added = last.not_contained.figures[name]
            value, uncertainty = _of_figure(row, numerical, added, missing, problem)
        elif last.not_contained.pressure.any() or any(last.not_contained.figures.values()):
            norm, there = share(name, own), pair.norms[number][name]
            parts = numerical, abs(there - row.difference), missing.uncertainty
            value = norm.value
            domain = pair.uncertainties[name].domain
            uncertainty = difference_of_norms(norm.uncertainty, domain, parts)
        else:
            value, uncertainty = row.difference, numerical
        joint = interaction[name]
        found.append(
            ModelError(name, friction, effects, joint, value, uncertainty + stand_in, stand_in)
        )
    return found


def _of_figure(
    row: Comparison, numerical: float, added: float, missing: Estimate, problem: Problem
) -> tuple[float, float]:
    """Error of a figure and its uncertainty, relative to the whole.

    numerical  uncertainty of the models' difference, relative to the finite elements
    added      what the whole adds to these [SI]; `missing` the same, relative to the whole
    """
    whole = row.finite_element + added
    scale = _scale(whole, row.quantity, problem)
    numerical *= _scale(row.finite_element, row.quantity, problem) / scale
    uncertainty = difference_of_figures(numerical, row.half_plane / scale, missing.uncertainty)
    return (row.half_plane - whole) / scale, uncertainty


def _scale(figure: float, name: str, problem: Problem) -> float:
    """What differences are measured by [SI]: the figure, the Hertz contact's where it vanishes."""
    return abs(figure) or QUANTITIES[name].scale(problem.hertz)
