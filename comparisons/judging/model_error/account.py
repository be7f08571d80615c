"""The half-plane's model error as figures, and what became of every effect.

In: an error budget. Out: a figure a quantity and friction coefficient, judged where it has a
tolerance, with its parts; the effects' account."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from comparisons.figures.figure import Column, Figure, Findings, Part, Series, Statement
from comparisons.figures.quantity import QUANTITIES, WHOLE
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.effects.laws import EFFECT as LAW
from comparisons.judging.effects.laws import trust
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.model_error.model_error import ModelError, Solutions
from comparisons.models.level import Level
from comparisons.models.problem import COUPLED, Problem

NAME = "model_error"
INTERACTION, JUMP = "interaction", "jump"  # parts beside the effects
INPUTS = "inputs"  # of the uncertainty: what the errors of measured constants change
TRUST = "law of elasticity"  # name of what is said of the strains that it bears


def figure_of(
    error: ModelError, selection: EffectSelection, tolerance: Mapping[str, float]
) -> Figure:
    """A model error, relative to the whole model."""
    parts = [*error.effects.values(), Part(INTERACTION, error.interaction), Part(JUMP, error.jump)]
    unknown, sure = selection.not_modelled(error.quantity), {"numerical": error.uncertainty}
    if error.law.half:
        parts.append(Part(LAW, error.law.middle, error.law.half))
        unknown[LAW] = error.law.half
    if error.law.scatter:
        sure[INPUTS] = error.law.scatter
    bound = tolerance.get(error.quantity)
    return Figure(
        study=NAME,
        quantity=error.quantity,
        source="half_plane",
        value=error.value,
        at={"friction": error.friction},
        against=WHOLE,
        scale=error.scale,
        uncertainty=Uncertainty(sure),
        unknown=unknown,
        bounds=None if bound is None else (-bound, bound),
        parts=tuple(parts),
        place=error.moved,
    )


@dataclass(frozen=True)
class ErrorBudget:
    """What separates the half-plane from the whole model, and both from the surface."""

    selection: EffectSelection  # which effects were computed
    levels: int  # that the whole was taken to; 0 where it has no solution
    unsplit: str | None  # why the difference of the models could not be split, else None
    model_errors: tuple[ModelError, ...]  # of each quantity at each friction coefficient
    seconds: float  # that the effects took
    # of each case, the finite elements with every effect that matters, on the finest level of the
    # effects, with their fields
    wholes: tuple[Level, ...] = ()
    # which further level of the whole cannot change a verdict, else None
    left_out: str | None = None
    # of each case, what else is compared with the whole; empty where it has no solution
    solutions: tuple[Solutions, ...] = ()
    # by effect, and of the whole beside the scene's own: seconds, and largest memory [bytes]
    took: dict[str, tuple[float, int]] = field(default_factory=dict)

    def of(self, quantity: str, friction: float) -> ModelError:
        wanted = quantity, friction
        return next(e for e in self.model_errors if (e.quantity, e.friction) == wanted)

    def figures(self, tolerance: Mapping[str, float]) -> list[Figure]:
        """Every model error, judged where it has a tolerance."""
        return [figure_of(error, self.selection, tolerance) for error in self.model_errors]


def findings_of(budget: ErrorBudget, problem: Problem) -> Findings:
    """Of a finished comparison."""
    figures = budget.figures(problem.scene.tolerances)
    account = {name: effect_account(name, budget.selection) for name in EFFECTS}
    columns = {
        "effect": Column(tuple(account)),
        "status": Column(tuple(status for status, _ in account.values())),
        "because": Column(tuple(why for _, why in account.values())),
    }
    for quantity in QUANTITIES:
        sizes = [budget.selection.estimates.get(name, {}).get(quantity) for name in EFFECTS]
        columns[quantity] = Column(tuple(None if size == math.inf else size for size in sizes))
    cost = {"levels": Column((budget.levels,)), "seconds": Column((budget.seconds,), "s")}
    series = (
        Series("effects", columns, is_account=True),
        Series("cost", cost, WHOLE, is_account=True),
    )
    said = {"not split": budget.unsplit, "left out": budget.left_out}
    if "finite_strain" in budget.selection.whole and budget.wholes:
        frictions = problem.scene.load.friction
        said[TRUST] = trust(problem, budget.wholes[frictions.index(max(frictions))])
    statements = tuple(Statement(name, text) for name, text in said.items() if text is not None)
    return Findings(tuple(figures), series, statements, budget)


def effect_account(name: str, selection: EffectSelection) -> tuple[str, str]:
    """What became of an effect, and why."""
    if name in selection.contained:
        return "contained", "the scene's own finite elements have it"
    if name == LAW and selection.laws:
        return "computed", "; ".join(law.words for law in selection.laws)
    if name in selection.added:
        return "computed", "its estimate exceeds a tenth of a tolerance"
    if name in selection.impossible:
        return "not computed", selection.impossible[name]
    if name in selection.found:
        return "negligible", "it was computed, and moves no figure by a tenth of its tolerance"
    if name in selection.negligible:
        return "negligible", "its estimate is below a tenth of every tolerance"
    if name == COUPLED and name in selection.estimates:  # with friction, it cannot be without
        return "contained", f"it is a part of {EFFECTS['finite_strain'].label}"
    return "does not apply", "it does not apply, or has no size"
