"""The verdict in one sentence, with the number that decides it."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.assessment.verdict import ToleranceCheck, validity_verdict
from comparisons.common.numbers import (
    given_percent,
    percent,
    plain,
    significant,
    with_unit,
)
from comparisons.common.quantities import HYPHENATED, LABELS, QUANTITIES, label
from comparisons.results.outcome import Outcome

Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]


@dataclass(frozen=True)
class Headline:
    """`kind` in a word or two, and the sentence."""

    kind: Kind
    sentence: str


def headline(outcome: Outcome) -> Headline:
    """What the reader needs first."""
    if not outcome.converged:
        return Headline(
            "not converged",
            f"A solver did not converge ({_unconverged(outcome)}): what was computed is shown, "
            "but no conclusion rests on it.",
        )
    if not outcome.plan.compares:
        return Headline("not compared", _one_model(outcome))
    checks = outcome.budget.tolerance_checks(outcome.problem.scene.tolerance)
    verdict, _ = validity_verdict(checks)
    if not checks:
        return Headline(
            "inconclusive", "The half-plane cannot be judged here: no figure has a tolerance."
        )
    several = len(outcome.problem.scene.friction) > 1
    if verdict == "holds":
        return Headline(
            "holds",
            f"The half-plane holds here: {_all_judged(checks)}; nearest to its tolerance, "
            f"{_said(_nearest(checks), several)}.",
        )
    if verdict == "fails":
        outside = [s for s in checks if s.is_outside]
        more = len(outside) - 1
        are = "are" if more > 1 else "is"
        others = f"; {more} more of {len(checks)} judged errors {are} outside" if more else ""
        return Headline(
            "fails",
            f"The half-plane fails here: {_said(_nearest(outside), several)}"
            f"{_made_of(outcome, _nearest(outside))}{others}.",
        )
    unclear = [s for s in checks if not s.is_inside]
    numerical = [s for s in unclear if s.is_unresolved]
    worst = _nearest(numerical or unclear)
    if numerical:
        return Headline(
            "inconclusive",
            f"The half-plane cannot be judged here: {_said(worst, several)}, an uncertainty that "
            "reaches across the tolerance.",
        )
    missing = max(worst.not_modelled, key=lambda name: worst.not_modelled[name])
    return Headline(
        "inconclusive",
        f"The half-plane cannot be judged here: {_said(worst, several)}, but what no model of this "
        f"run contains may move it by {percent(math.hypot(*worst.not_modelled.values()))}, "
        f"{EFFECTS[missing].label} most.",
    )


def _all_judged(checks: list[ToleranceCheck]) -> str:
    if len(checks) == 1:
        return "the one judged error is within its tolerance"
    several = "both" if len(checks) == 2 else f"all {len(checks)}"
    return f"{several} judged errors are within their tolerances"


def _nearest(checks: Iterable[ToleranceCheck]) -> ToleranceCheck:
    """The one farthest outside, or nearest to, its tolerance, its doubt included."""
    return max(checks, key=lambda s: (abs(s.value) + s.total_uncertainty) / s.tolerance)


def _said(check: ToleranceCheck, several: bool) -> str:
    """An error of the half-plane as a clause: what, how much, tolerance, uncertainty."""
    quantity = QUANTITIES[check.quantity]
    where = f" at friction {plain(check.friction)}" if several and quantity.needs_stress else ""
    doubt = check.uncertainty
    size = percent(check.value, signed=not quantity.of_pair, uncertainty=doubt)
    return (
        f"its own error in the {label(check.quantity)}{where} is {size} "
        f"(tolerance {given_percent(check.tolerance)}, uncertainty {percent(doubt)})"
    )


def _made_of(outcome: Outcome, check: ToleranceCheck) -> str:
    """The effect that makes most of an error, if one makes more than half."""
    own = outcome.budget.of(check.quantity, check.friction)
    if not own.effects:
        return ""
    name = max(own.effects, key=lambda name: abs(own.effects[name].value))
    made = abs(own.effects[name].value)
    return f", most of it {EFFECTS[name].label}" if made > 0.5 * abs(own.value) else ""


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
        f"half-plane with surfaces moved by friction {plain(coupling.friction)}"
        for coupling in outcome.couplings
        if not coupling.converged
    ]
    run_in = outcome.problem.scene.run_in
    if run_in is not None and not run_in.converged:
        failed = sum(not one.converged for one in run_in.passes)
        found.insert(0, f"running-in, {failed} of {len(run_in.passes)} passes")
    return ", ".join(found)
