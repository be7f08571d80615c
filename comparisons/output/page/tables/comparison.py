"""The comparison as rows of text, for the page and for the terminal.

In: the figures of a run. Out: a row a quantity, with equal ones of several friction coefficients in
one."""

from dataclasses import dataclass

from comparisons.common.numbers import Scale, listed, percent, with_unit
from comparisons.drawing.blocks import TextTable, compared_cells
from comparisons.figures.figure import Figure, grouped
from comparisons.figures.quantity import COMPARED, HYPHENATED, MODELS, NORMS, QUANTITIES, label
from comparisons.models.problem import Problem
from comparisons.models.smooth import scale_words
from comparisons.studies import contact
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.study import LAYERED, MODEL_ERROR, Run

SAME_PROBLEM = "the same problem"


@dataclass(frozen=True)
class ComparisonRow:
    """A quantity at one friction coefficient, or at several that give the same figures."""

    quantity: str
    friction: str
    half_plane: str  # with unit; empty for the norm of a difference
    finite_element: str
    difference: str  # in the digits that the uncertainty supports
    uncertainty: str
    tolerance: str
    verdict: str  # "" where nothing was judged
    in_hertz: tuple[str, str]  # both models' figures in units of the Hertz contact's
    reference: str  # what problem the finite elements' figure is one of
    note: str  # what to know before the figures are taken for evidence


def comparison_rows(run: Run) -> list[ComparisonRow]:
    """In the order of quantities, then of friction coefficients."""
    rows, differences = [], run.compared
    for name in COMPARED:
        pairs = [(figure, _values(run, figure)) for figure in differences.of(quantity=name)]
        for same in grouped(pairs, _shown):
            rows.append(_row(run, *same[0], listed(figure.friction for figure, _ in same)))
    return rows


def comparison_table(run: Run) -> TextTable:
    """The same for the page; below a figure in grey that over Hertz's. The problem that the finite
    elements solve is its title where it is that of all rows."""
    first, shown = first_model(run), comparison_rows(run)
    problems = {row.reference for row in shown}
    title = "" if len(problems) > 1 else f"The finite elements solve {_problem(*problems)}"
    head = ("quantity", "friction", first, "finite elements", "difference", "uncertainty")
    head += ("tolerance", "verdict", *["reference"] * (not title))
    rows = tuple(
        (
            f"{label(row.quantity)}\n{row.note}",
            row.friction,
            f"{row.half_plane}\n{row.in_hertz[0]}",
            f"{row.finite_element}\n{row.in_hertz[1]}",
            *(row.difference, row.uncertainty, row.tolerance, row.verdict),
            *[row.reference] * (not title),
        )
        for row in shown
    )
    return TextTable(title, head, rows, "comparison", words=not title)


def _problem(reference: str) -> str:
    same = reference == SAME_PROBLEM
    return (
        f"{reference} as the half-plane" if same else f"the half-plane's problem with {reference}"
    )


def _values(run: Run, difference: Figure) -> tuple[Figure | None, Figure | None]:
    """Both models' figures, None of a norm."""
    at = {"quantity": difference.quantity, "at": difference.at}
    layered = run.figures.one(study=LAYERED, source=difference.source, against=None, **at)
    one, other = (run.figures.one(study=contact.NAME, source=m, **at) for m in MODELS)
    return (one if difference.study != LAYERED else layered), other


def _shown(pair: tuple[Figure, tuple[Figure | None, ...]]) -> tuple:
    difference, values = pair
    sizes = tuple(figure and figure.value for figure in values)
    return difference.value, difference.numerical, *sizes


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


def figure_rows(run: Run) -> list[tuple[str, ...]]:
    """Of the only model: quantity, friction, figure with unit and over Hertz's, uncertainty."""
    known = [f for f in run.figures.of(study=contact.NAME) if f.quantity in QUANTITIES]
    known.sort(key=lambda figure: list(QUANTITIES).index(figure.quantity))
    rows = []
    for same in grouped(known, lambda figure: (figure.quantity, figure.value, figure.numerical)):
        name, value, uncertainty = same[0].quantity, same[0].value, same[0].numerical
        sizes = with_unit(value, QUANTITIES[name].unit), in_hertz(run.problem, name, value)
        frictions = listed(figure.friction for figure in same)
        rows.append((name, frictions, *sizes, percent(uncertainty)))
    return rows


def figure_table(run: Run) -> TextTable:
    """The same for the page."""
    [model], over = run.runs, f"over {scale_words(run.problem)}"
    head = ("quantity", "friction", f"{HYPHENATED[model]} model", over, "uncertainty")
    rows = ((label(name), *cells) for name, *cells in figure_rows(run))
    return TextTable("", head, tuple(rows))


def _row(
    run: Run, difference: Figure, models: tuple[Figure | None, Figure | None], frictions: str
) -> ComparisonRow:
    name = difference.quantity
    # the hardness holds the peaks of both models, which makes them equal by itself
    capped = "capped in both" if all(f and "capped" in f.notes for f in models) else ""
    return ComparisonRow(
        name,
        frictions,
        *compared_cells(difference, models, COMPARED[name].unit),
        in_hertz=tuple(in_hertz(run.problem, name, f and f.value) for f in models),
        reference=reference_of(run, name),
        note=capped,
    )


def in_hertz(problem: Problem, quantity: str, value: float | None) -> str:
    """The figure over that of the smooth contact under the same load."""
    meaning = COMPARED[quantity]
    if value is None or meaning.over is None:
        return ""
    times, symbol = meaning.over
    return Scale(times * meaning.scale(problem.hertz), symbol).text(value)
