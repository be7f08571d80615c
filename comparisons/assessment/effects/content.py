"""The error budget as result.json has it."""

import math

from comparisons.assessment.comparison import Uncertainty, uncertainties
from comparisons.assessment.effects.budget import ErrorBudget
from comparisons.assessment.effects.effects import EFFECTS
from comparisons.assessment.effects.model_error import Estimate, ModelError
from comparisons.assessment.verdict import Comparison
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem


def budget_content(
    problem: Problem,
    runs: dict[str, ModelRun],
    rows: tuple[Comparison, ...],
    budget: ErrorBudget,
) -> dict:
    """By quantity and friction coefficient, all relative; None for what is unknown."""
    doubts = {
        (model, friction): uncertainties(run, problem, friction)
        for model, run in runs.items()
        for friction in problem.scene.friction
    }
    quantities: dict[str, list[dict]] = {}
    for row in rows:
        numerical = {
            model: _numerical(doubts[model, row.friction].get(row.quantity)) for model in runs
        }
        quantities.setdefault(row.quantity, []).append(
            {"friction": row.friction}
            | ({} if row.half_plane is None else {"numerical": numerical})
            | {"input": budget.sampling.get(row.friction, {}).get(row.quantity)}
            | _own(budget.of(row.quantity, row.friction))
            | {"not_modelled": budget.choice.not_modelled(row.quantity)}
        )
    return {
        "effects": {name: _effect(name, budget) for name in EFFECTS},
        "levels": budget.levels,
        "unsplit": budget.unsplit,
        "cost": {"seconds": budget.seconds},
        "quantities": quantities,
    }


def _effect(name: str, budget: ErrorBudget) -> dict:
    """What became of an effect, and by what estimate."""
    choice = budget.choice
    estimate = choice.estimates.get(name)
    if name in choice.contained:
        status, why = "contained", "the scene's own finite elements have it"
    elif name in choice.added:
        status, why = "computed", "its estimate exceeds a tenth of a tolerance"
    elif name in choice.impossible:
        status, why = "not computed", choice.impossible[name]
    elif name in choice.left_out:
        status, why = "left out", "its estimate is below a tenth of every tolerance"
    else:
        status, why = "none", "it does not apply, or has no size"
    return {"status": status, "because": why, "estimate": estimate}


def _numerical(doubt: Uncertainty | None) -> dict | None:
    if doubt is None:
        return None
    convergence = doubt.convergence
    return {
        "iteration": doubt.iteration,
        "discretisation": _known(doubt.discretisation),
        "domain": doubt.domain,
        "convergence": convergence.behaviour,
        "order": convergence.order,
        "limit": convergence.limit,
    }


def _own(own: ModelError) -> dict:
    return {
        "effects": {name: _share(share) for name, share in own.effects.items()},
        "interaction": own.interaction,
        "model_error": {"value": own.value, "uncertainty": _known(own.uncertainty)},
    }


def _share(share: Estimate) -> dict:
    return {"value": share.value, "uncertainty": _known(share.uncertainty)}


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
