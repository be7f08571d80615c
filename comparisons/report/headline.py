"""The verdict in one sentence, with the number that decides it."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from comparisons.common.numbers import given_percent, percent, plain, significant, with_unit
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES, label
from comparisons.figures.verdict import ToleranceCheck
from comparisons.report.tables.scatter import beside_inputs
from comparisons.report.tables.text import error_text
from comparisons.report.tables.yielding import flow_sentence
from comparisons.results.outcome import Outcome
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.selection import law_leaned_on
from comparisons.studies.model_error.validity import validity_verdict

Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]


@dataclass(frozen=True)
class Headline:
    """`kind` in a word or two, and the sentence."""

    kind: Kind
    sentence: str


def headline(outcome: Outcome) -> Headline:
    """What the reader needs first: the verdict, and what there is to say of flow."""
    said, flow = _verdict(outcome), flow_sentence(outcome)
    if not outcome.converged:
        return said
    if outcome.plan.compares and outcome.flow.beyond_doubt:
        rest = f"{said.sentence[0].lower()}{said.sentence[1:]}"
        return Headline("fails", f"{_sentence(flow)} Were it elastic: {rest}")
    return Headline(said.kind, f"{said.sentence} {_inputs(outcome)}{_sentence(flow)}")


def _inputs(outcome: Outcome) -> str:
    """What uncertain inputs do to the figure that decides, where that is more than its tolerance:
    a model error below that is not what a user would see first."""
    checks = outcome.tolerance_checks
    if outcome.scatter is None or not checks:
        return ""
    check = _nearest(checks)
    figure = outcome.scatter.of(check.quantity, check.friction)
    if figure is None or figure.relative <= check.tolerance:
        return ""
    return beside_inputs(outcome, check.quantity, check.friction) + " "


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _verdict(outcome: Outcome) -> Headline:
    if not outcome.converged:
        return Headline(
            "not converged",
            f"A solver did not converge ({_unconverged(outcome)}): what was computed is shown, "
            "but no conclusion rests on it.",
        )
    if not outcome.plan.compares:
        return Headline("not compared", _one_model(outcome))
    checks = outcome.tolerance_checks
    verdict, _ = validity_verdict(checks)
    several = len(outcome.problem.scene.load.friction) > 1
    law = law_leaned_on(outcome.budget.selection, outcome.problem.scene)
    if verdict == "holds":
        nearest = _said(_nearest(checks), several)
        said = f"{_all_judged(checks)}; nearest to its tolerance, {nearest}"
        return Headline("holds", f"The half-plane holds here: {said}{law}.")
    if verdict == "fails":
        outside = [check for check in checks if check.verdict == "fails"]
        worst, more = _nearest(outside), len(outside) - 1
        are = "are" if more > 1 else "is"
        others = f"; {more} more of {len(checks)} judged errors {are} outside" if more else ""
        said = f"{_said(worst, several)}{_dominant(outcome, worst)}{others}"
        return Headline("fails", f"The half-plane fails here: {said}{law}.")
    said = _inconclusive(checks, several) if checks else "no figure has a tolerance"
    return Headline("inconclusive", f"The half-plane cannot be judged here: {said}.")


def _inconclusive(checks: list[ToleranceCheck], several: bool) -> str:
    """What prevents a verdict: the uncertainty of an error, or what is not modelled."""
    worst = _nearest([check for check in checks if check.verdict != "holds"])
    if not worst.not_modelled or worst.is_unresolved:
        return f"{_said(worst, several)}, an uncertainty that reaches across the tolerance"
    largest = max(worst.not_modelled, key=worst.not_modelled.get)
    remedy = "; body.law and roller.law can name one" if largest == "law_of_elasticity" else ""
    return (
        f"{_said(worst, several)}, but effects that are not modelled may change it by "
        f"{percent(worst.unknown)} (estimate), {EFFECTS[largest].label} most{remedy}"
    )


def _all_judged(checks: list[ToleranceCheck]) -> str:
    if len(checks) == 1:
        return "the one judged error is within its tolerance"
    several = "both" if len(checks) == 2 else f"all {len(checks)}"
    return f"{several} judged errors are within their tolerances"


def _nearest(checks: Iterable[ToleranceCheck]) -> ToleranceCheck:
    """The one farthest outside, or nearest to, its tolerance, uncertainty included."""
    return max(checks, key=lambda s: (abs(s.value) + s.total_uncertainty) / s.tolerance)


def _said(check: ToleranceCheck, several: bool) -> str:
    """An error of the half-plane as a clause: what, how much, tolerance, uncertainty."""
    stress = QUANTITIES[check.quantity].needs_stress
    where = f" at friction {plain(check.friction)}" if several and stress else ""
    return (
        f"its model error in the {label(check.quantity)}{where} is "
        f"{error_text(check.quantity, check.value, check.uncertainty)} (tolerance "
        f"{given_percent(check.tolerance)}, uncertainty {percent(check.uncertainty)})"
    )


def _dominant(outcome: Outcome, check: ToleranceCheck) -> str:
    """That the effects interact, or the one that makes more than half of an error, if any does."""
    error = outcome.budget.of(check.quantity, check.friction)
    if error.interacts:
        return "; the effects interact"
    sizes = {name: abs(effect.value) for name, effect in error.effects.items()}
    largest = max(sizes, key=sizes.get, default=None)
    if largest is None or sizes[largest] <= 0.5 * abs(error.value):
        return ""
    return f", dominated by {EFFECTS[largest].label}"


def _one_model(outcome: Outcome) -> str:
    [(name, run)] = outcome.runs.items()
    peak, p0 = float(run.finest.solution.pressure.max()), outcome.problem.hertz.peak_pressure
    return (
        f"Only the {HYPHENATED[name]} model was run: peak pressure {with_unit(peak, 'Pa')}, "
        f"{significant(peak / p0)} times Hertz, contact length "
        f"{with_unit(run.finest.contact_length, 'm')}; nothing was compared."
    )


def _unconverged(outcome: Outcome) -> str:
    found = [
        f"{LABELS[name]}, pressure elements of {with_unit(level.grid.pitch, 'm', 3)}"
        for name, run in outcome.runs.items()
        for level in run.levels
        if not level.solution.converged
    ]
    found += [
        f"half-plane with normal-tangential coupling, friction {plain(coupling.friction)}"
        for coupling in outcome.couplings
        if not coupling.converged
    ]
    run_in = outcome.problem.surface.run_in
    if run_in is not None and not run_in.converged:
        failed = sum(not one.converged for one in run_in.passes)
        found.insert(0, f"running-in, {failed} of {len(run_in.passes)} passes")
    return ", ".join(found)
