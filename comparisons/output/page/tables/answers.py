"""Answers from outside as rows of text, for the page and for the terminal."""

from comparisons.common.numbers import (
    given_percent,
    percent,
    plain,
    scale_of,
    significant,
    with_unit,
)
from comparisons.figures.figure import Figure, Figures, grouped
from comparisons.figures.quantity import LABELS, QUANTITIES, label
from comparisons.output.page.tables.text import error_text, is_shown, listed
from comparisons.studies import contact
from comparisons.studies.answers.answer import NAME, ComparedAnswer
from comparisons.studies.study import Run, TextTable

NOT_STATED = "not stated"


def compared_answers(run: Run) -> tuple[ComparedAnswer, ...]:
    """None without any."""
    found = run.data(NAME)
    return () if found is None else found.answers


def answer_rows(run: Run, answer: ComparedAnswer) -> list[tuple[str, ...]]:
    """Quantity's name, friction, the answer's figure and the reference's with unit, difference,
    uncertainty, the answer's own, tolerance, verdict."""
    rows, known = [], run.figures.of(study=NAME, source=answer.name)
    for name in (name for name in QUANTITIES if is_shown(run, name)):
        differences = known.of(quantity=name, against=answer.reference)
        cells = [(each.friction, _cells(run, known, each)) for each in differences]
        for same in grouped(cells, lambda row: row[1]):
            rows.append((name, listed(friction for friction, _ in same), *same[0][1]))
    return rows


def _cells(run: Run, known: Figures, difference: Figure) -> tuple[str, ...]:
    name, bound = difference.quantity, difference.tolerance
    wanted = {"quantity": name, "at": difference.at, "against": None}
    own = known.one(**wanted)
    reference = run.figures.one(study=contact.NAME, source=difference.against, **wanted)
    values = [figure and figure.value for figure in (own, own and reference)]
    scale = scale_of(values, QUANTITIES[name].unit)
    stated = difference.uncertainty.parts.get("own")
    return (
        *("" if value is None else scale.text(value) for value in values),
        error_text(name, difference.value, difference.numerical),
        percent(difference.numerical),
        NOT_STATED if stated is None else percent(stated),
        "" if bound is None else given_percent(bound),
        difference.verdict or "",
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


def answer_table(run: Run, answer: ComparedAnswer) -> TextTable:
    """The rows of an answer for the page."""
    head = ("quantity", "friction", answer.name, LABELS[answer.reference], "difference")
    head += ("uncertainty", "its own", "tolerance", "verdict")
    rows = tuple((label(name), *cells) for name, *cells in answer_rows(run, answer))
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
