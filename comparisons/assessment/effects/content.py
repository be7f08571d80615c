"""The half-plane's model error and the error budget as result.json has them."""

import math

from comparisons.assessment.comparison import uncertainties
from comparisons.assessment.effects.budget import ErrorBudget
from comparisons.assessment.effects.effects import EFFECTS
from comparisons.assessment.uncertainty import Uncertainty
from comparisons.assessment.verdict import Comparison
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem


def model_error_content(problem: Problem, budget: ErrorBudget) -> dict[str, list[dict]]:
    """By quantity, one entry a friction coefficient; relative to the whole model, None for what is
    unknown or not judged."""
    tolerance = problem.scene.tolerance
    verdicts = {(c.quantity, c.friction): c.verdict for c in budget.tolerance_checks(tolerance)}
    found: dict[str, list[dict]] = {}
    for error in budget.own:
        found.setdefault(error.quantity, []).append(
            {
                "friction": error.friction,
                "value": error.value,
                "uncertainty": _known(error.uncertainty),
                "effects": {
                    name: {"value": effect.value, "uncertainty": _known(effect.uncertainty)}
                    for name, effect in error.effects.items()
                },
                "interaction": error.interaction,
                "not_modelled": budget.choice.not_modelled(error.quantity),
                "tolerance": tolerance.get(error.quantity),
                "verdict": verdicts.get((error.quantity, error.friction)),
            }
        )
    return found


def error_budget_content(
    problem: Problem,
    runs: dict[str, ModelRun],
    rows: tuple[Comparison, ...],
    budget: ErrorBudget,
) -> dict:
    """What became of every effect, and by quantity the numerical parts and the sampling's, all
    relative; None for what is unknown."""
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
    elif name in choice.negligible:
        status, why = "negligible", "its estimate is below a tenth of every tolerance"
    else:
        status, why = "does not apply", "it does not apply, or has no size"
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


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
