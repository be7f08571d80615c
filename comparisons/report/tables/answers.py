"""Answers from outside as rows of text, for the page and for the terminal."""

from dataclasses import replace

from comparisons.common.numbers import (
    given_percent,
    percent,
    plain,
    scale_of,
    significant,
    with_unit,
)
from comparisons.figures.quantity import LABELS, QUANTITIES, label
from comparisons.report.tables.text import TextTable, error_text, grouped, is_shown, listed
from comparisons.results.outcome import Outcome
from comparisons.studies.answers.answer import AnswerRow, ComparedAnswer

NOT_STATED = "not stated"


def answer_rows(outcome: Outcome, answer: ComparedAnswer) -> list[tuple[str, ...]]:
    """Quantity's name, friction, the answer's figure and the reference's with unit, difference,
    uncertainty, the answer's own, tolerance, verdict."""
    found = []
    for name in (name for name in QUANTITIES if is_shown(outcome, name)):
        rows = [row for row in answer.rows if row.quantity == name]
        for same in grouped(rows, lambda row: replace(row, friction=0.0)):
            found.append(_cells(same[0], listed(row.friction for row in same)))
    return found


def _cells(row: AnswerRow, frictions: str) -> tuple[str, ...]:
    values = row.answer, row.reference
    scale = scale_of(values, QUANTITIES[row.quantity].unit)
    return (
        row.quantity,
        frictions,
        *("" if value is None else scale.text(value) for value in values),
        error_text(row.quantity, row.difference, row.uncertainty),
        percent(row.uncertainty),
        NOT_STATED if row.own_uncertainty is None else percent(row.own_uncertainty),
        "" if row.tolerance is None else given_percent(row.tolerance),
        row.verdict or "",
    )


def answer_facts(answer: ComparedAnswer) -> list[tuple[str, str]]:
    """What an answer owes to no mesh: its load, the contact conditions, what explains it."""
    finest = answer.finest
    facts = [
        ("resolution", f"{with_unit(finest.spacing, 'm', 3)} from point to point in contact"),
        ("load", f"{percent(answer.balance, signed=True, digits=3)} off the scene's"),
    ]
    for model, found in answer.conditions.items():
        sizes = (
            f"{words} {significant(found[name], 2)}"
            for name, words in (("complementarity", "work of the gaps"), ("penetration", "overlap"))
        )
        facts.append((f"contact conditions, {LABELS[model]}", ", ".join(sizes)))
    return [*facts, *(("hint", hint.text) for hint in answer.hints)]


def answer_table(outcome: Outcome, answer: ComparedAnswer) -> TextTable:
    """The rows of an answer for the page."""
    head = ("quantity", "friction", answer.name, LABELS[answer.reference], "difference")
    head += ("uncertainty", "its own", "tolerance", "verdict")
    rows = tuple((label(name), *cells) for name, *cells in answer_rows(outcome, answer))
    return TextTable("", head, rows)


def measured_table(answer: ComparedAnswer) -> TextTable | None:
    """V&V 20's comparison of measured data with each model; None where nothing was measured."""
    sizes = ("u_num", "u_input", "u_D", "u_val")
    rows = tuple(
        (
            f"{label(name)}, {LABELS[row['model']]}",
            plain(row["friction"]),
            percent(row["E"], signed=True),
            *(percent(row[size]) for size in sizes),
        )
        for name, rows in answer.validation.items()
        for row in rows
    )
    head = ("model less data", "friction", "E", *sizes)
    return TextTable("In the terms of ASME V&V 20", head, rows) if rows else None
