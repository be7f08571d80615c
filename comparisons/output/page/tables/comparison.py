"""The comparison as rows of text, for the page and for the terminal.

In: the figures of a run. Out: a row a quantity, with equal ones of several friction coefficients in
one."""

from comparisons.common.numbers import Scale, percent, with_unit
from comparisons.drawing.blocks import TableRow, TextTable, compared_cells, table_rows
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import COMPARED, HYPHENATED, NORMS, QUANTITIES, label
from comparisons.judging import contact
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.study import LAYERED, MODEL_ERROR, Run
from comparisons.models.problem import Problem
from comparisons.models.smooth import scale_words

SAME_PROBLEM = "the same problem"


def comparison_rows(run: Run) -> list[TableRow]:
    """Both models' figures with unit, empty for norms, then `judged_cells`."""

    def cells(difference: Figure) -> tuple[str, ...]:
        values = contact.pair_of(run, difference)
        return compared_cells(difference, values, COMPARED[difference.quantity].unit)

    return table_rows(run.compared, COMPARED, cells)


def comparison_table(run: Run) -> TextTable:
    """The same for the page; below a figure in grey that over Hertz's. The problem that the finite
    elements solve is its title where it is that of all rows."""
    shown, rows = comparison_rows(run), []
    problems = {row.quantity: reference_of(run, row.quantity) for row in shown}
    title = "" if len({*problems.values()}) > 1 else _problem(*{*problems.values()})
    head = ("quantity", "friction", first_model(run), "finite elements", "difference")
    head += ("uncertainty", "tolerance", "verdict", *["reference"] * (not title))
    for row in shown:
        name, models = row.quantity, contact.pair_of(run, row.figure)
        over = (in_hertz(run.problem, name, figure and figure.value) for figure in models)
        values = map("\n".join, zip(row.cells[:2], over, strict=True))
        named = f"{label(name)}\n{capped(run, row.figure)}", row.friction
        rows.append((*named, *values, *row.cells[2:], *[problems[name]] * (not title)))
    return TextTable(title, head, tuple(rows), "comparison", words=not title)


def _problem(reference: str) -> str:
    same = f"{reference} as the half-plane"
    other = f"the half-plane's problem with {reference}"
    return f"The finite elements solve {same if reference == SAME_PROBLEM else other}"


def capped(run: Run, difference: Figure) -> str:
    """That the hardness holds the peaks of both models, which makes them equal by itself."""
    models = contact.pair_of(run, difference)
    return "capped in both" if all(f and "capped" in f.notes for f in models) else ""


def first_model(run: Run) -> str:
    """What is compared with the finite elements."""
    return "layered half-plane" if run.compared.of(study=LAYERED) else "half-plane"


def reference_of(run: Run, quantity: str) -> str:
    """What the finite elements solve: the half-plane's problem, or that with effects that bear on
    the quantity; those without an estimate bear on all, and all on norms."""
    selection = run.data(MODEL_ERROR).selection
    named = [
        EFFECTS[name].label
        for name in EFFECTS
        if name in selection.contained
        and (quantity in NORMS or quantity in selection.estimates.get(name, [quantity]))
    ]
    return ", ".join(named) or SAME_PROBLEM


def figure_rows(run: Run) -> list[TableRow]:
    """Of the only model: figure with unit and over Hertz's, uncertainty."""

    def cells(figure: Figure) -> tuple[str, ...]:
        name, value = figure.quantity, figure.value
        size = with_unit(value, QUANTITIES[name].unit)
        return size, in_hertz(run.problem, name, value), percent(figure.numerical)

    return table_rows(run.figures.of(study=contact.NAME), QUANTITIES, cells)


def figure_table(run: Run) -> TextTable:
    """The same for the page."""
    [model], over = run.runs, f"over {scale_words(run.problem)}"
    head = ("quantity", "friction", f"{HYPHENATED[model]} model", over, "uncertainty")
    rows = ((label(row.quantity), row.friction, *row.cells) for row in figure_rows(run))
    return TextTable("", head, tuple(rows))


def in_hertz(problem: Problem, quantity: str, value: float | None) -> str:
    """The figure over that of the smooth contact under the same load."""
    meaning = COMPARED[quantity]
    if value is None or meaning.over is None:
        return ""
    times, symbol = meaning.over
    return Scale(times * meaning.scale(problem.hertz), symbol).text(value)
