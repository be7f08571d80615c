"""Many runs on one page: a row each that leads to its report, sorted by any column."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from comparisons.outcome import Outcome
from comparisons.quantities import QUANTITIES
from comparisons.report.headline import headline
from comparisons.report.html import inline, rendered
from comparisons.report.numbers import MINUS, given_percent, percent, scale_of, significant
from comparisons.report.sheet import GROUPS
from comparisons.report.words import LABELS, label

FIGURES = ("peak_pressure", "contact_length", "tau1_max")
OWN = "half-plane's own error in the {}"


@dataclass(frozen=True)
class Cell:
    """Text, and the number [SI] that it is sorted by; None where there is none."""

    text: str
    value: float | None


@dataclass(frozen=True)
class SummaryRow:
    """A run.

    report  its page
    kind    the verdict in a word or two, with its sentence
    cells   by the head of their column; columns that no run has are not there
    """

    title: str
    report: Path
    kind: str
    sentence: str
    cells: dict[str, Cell]


def summary_row(outcome: Outcome) -> SummaryRow:
    """The row of a finished run."""
    said = headline(outcome)
    return SummaryRow(
        title=outcome.problem.scene.title,
        report=outcome.directory / "report.html",
        kind=said.kind,
        sentence=said.sentence,
        cells={**_groups(outcome), **_figures(outcome), **_own(outcome), **_times(outcome)},
    )


def summary_page(rows: Sequence[SummaryRow], place: Path) -> str:
    """The page, to be written into the folder `place`, from which its links lead."""
    heads = sorted({head for row in rows for head in row.cells}, key=_rank)
    kinds = [row.kind for row in rows]
    counts = {kind: kinds.count(kind) for kind in sorted(set(kinds))}
    script, policy = inline("summary.js")
    return rendered(
        "summary.html.j2",
        rows=rows,
        heads=heads,
        counts=counts,
        links=[_link(row.report, place) for row in rows],
        script=script,
        policy=policy,
    )


def _link(page: Path, place: Path) -> str:
    return quote(os.path.relpath(page.resolve(), place.resolve()))


def _rank(head: str) -> int:
    order = [
        *GROUPS.values(),
        *map(label, FIGURES),
        *(OWN.format(label(name)) for name in QUANTITIES),
        *(f"time, {name}" for name in LABELS.values()),
        "time, error budget",
    ]
    return order.index(head)


def _groups(outcome: Outcome) -> dict[str, Cell]:
    groups = outcome.result["groups"]
    return {
        GROUPS[name]: Cell(significant(groups[name], 3), groups[name])
        for name in GROUPS
        if groups[name] is not None
    }


def _figures(outcome: Outcome) -> dict[str, Cell]:
    """The finite elements', or the only model's, each the largest of any friction."""
    _, entries = list(outcome.result["models"].items())[-1]
    found = {}
    for name in FIGURES:
        part = "stress" if QUANTITIES[name].needs_stress else "contact"
        values = [entry[part][name] for entry in entries if entry[part] is not None]
        if values:
            largest = max(values)
            unit = QUANTITIES[name].unit
            found[label(name)] = Cell(scale_of([largest], unit).text(largest), largest)
    return found


def _own(outcome: Outcome) -> dict[str, Cell]:
    """Of what is judged, at the friction where it stands worst."""
    if outcome.budget is None:
        return {}
    found: dict[str, Cell] = {}
    for name, tolerance in outcome.problem.scene.tolerance.items():
        errors = [own for own in outcome.budget.own if own.quantity == name]
        if not errors:
            continue
        worst = max(errors, key=lambda own: abs(own.value) + own.uncertainty)
        size = percent(
            worst.value, signed=not QUANTITIES[name].of_pair, uncertainty=worst.uncertainty
        )
        text = f"{size} ± {percent(worst.uncertainty)} of {given_percent(tolerance)}"
        found[OWN.format(label(name))] = Cell(text.replace("-", MINUS), abs(worst.value))
    return found


def _times(outcome: Outcome) -> dict[str, Cell]:
    seconds = {LABELS[name]: sum(run.seconds.values()) for name, run in outcome.runs.items()}
    if outcome.budget is not None and outcome.budget.seconds:
        seconds["error budget"] = outcome.budget.seconds
    return {
        f"time, {name}": Cell(scale_of([time], "s").text(time, 3), time)
        for name, time in seconds.items()
    }
