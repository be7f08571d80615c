"""The verdict in one sentence, with the number that decides it."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from comparisons.outcome import Outcome
from comparisons.quantities import QUANTITIES
from comparisons.report.numbers import (
    given,
    given_percent,
    percent,
    plain,
    significant,
    vanishes,
    with_unit,
)
from comparisons.report.words import MODELS, in_words, label
from comparisons.verdict import Comparison

Kind = Literal["holds", "fails", "undecided", "not compared", "not converged"]


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
    verdict, why = outcome.result["half_space"]["verdict"], outcome.result["half_space"]["why"]
    judged = [row for row in outcome.comparisons if row.verdict is not None]
    if not judged:
        return Headline(
            "undecided", "The half-plane cannot be judged here: no figure has a tolerance."
        )
    several = len(outcome.problem.scene.friction) > 1
    if verdict == "fails":
        outside = _by_distance(row for row in judged if row.verdict == "differ")
        more = len(outside) - 1
        others = f"; {more} more of {len(judged)} judged figures" if more else ""
        are = " are outside their tolerance" if more > 1 else " is outside its tolerance"
        return Headline(
            "fails",
            f"The half-plane fails here: the {_said(outside[0], several)}"
            f"{others + are if more else ''}.",
        )
    if verdict == "holds":
        return Headline(
            "holds",
            f"The half-plane holds here: {_all_judged(judged)}; nearest to its tolerance, the "
            f"{_said(_by_distance(judged)[0], several)}.",
        )
    unclear = [row for row in judged if row.verdict == "indistinct"]
    if unclear:
        row = max(unclear, key=lambda row: (row.uncertainty or float("inf")) / row.tolerance)
        return Headline(
            "undecided",
            f"The half-plane cannot be judged here: the {_said(row, several)}; an uncertainty "
            "above the tolerance asks for refinement, not for a conclusion.",
        )
    nearest = _said(_by_distance(judged)[0], several)
    return Headline(
        "undecided",
        f"The half-plane cannot be judged here: {in_words(why)}; nearest to its tolerance, the "
        f"{nearest}.",
    )


def _all_judged(judged: list[Comparison]) -> str:
    return (
        "the one judged figure agrees"
        if len(judged) == 1
        else f"all {len(judged)} judged figures agree"
    )


def _by_distance(rows: Iterable[Comparison]) -> list[Comparison]:
    """Farthest outside, or nearest to, its tolerance first."""
    return sorted(rows, key=lambda row: -abs(row.difference) / row.tolerance)


def _said(row: Comparison, several: bool) -> str:
    """A comparison as a clause: what differs, by how much, tolerance, uncertainty."""
    quantity = QUANTITIES[row.quantity]
    where = f" at friction {plain(row.friction)}" if several and quantity.needs_stress else ""
    bounds = f"(tolerance {given_percent(row.tolerance)}, uncertainty {percent(row.uncertainty)})"
    subject = f"{label(row.quantity)}{where}"
    if row.difference is None:
        return f"{subject} has no relative difference {bounds}"
    size = percent(abs(row.difference), uncertainty=row.uncertainty)
    if quantity.of_pair:
        return f"{subject} is {size} {bounds}"
    if vanishes(row.difference, row.uncertainty):
        within = " within their uncertainty" if row.difference else ""
        return f"{subject} is the same in both models{within} {bounds}"
    side = "above" if row.difference > 0.0 else "below"
    return f"{subject} is {size} {side} the finite elements' {bounds}"


def _one_model(outcome: Outcome) -> str:
    [(name, run)] = outcome.runs.items()
    peak, p0 = float(run.finest.solution.pressure.max()), outcome.problem.hertz.peak_pressure
    return (
        f"Only the {MODELS[name]} model was run: peak pressure {with_unit(peak, 'Pa')}, "
        f"{significant(peak / p0)} times Hertz, contact length "
        f"{with_unit(run.finest.contact_length, 'm')}; nothing was compared."
    )


def _unconverged(outcome: Outcome) -> str:
    found = [
        f"{MODELS[name]}, pressure elements of {given(level.grid.pitch, 'm')}"
        for name, run in outcome.runs.items()
        for level in run.levels
        if not level.solution.converged
    ]
    found += [
        f"half-plane with surfaces moved by friction {plain(coupling.friction)}"
        for coupling in outcome.couplings
        if not coupling.converged
    ]
    worn = outcome.problem.scene.worn
    if worn is not None and not worn.converged:
        failed = sum(not one.converged for one in worn.passes)
        found.insert(0, f"running-in, {failed} of {len(worn.passes)} passes")
    return ", ".join(found)
