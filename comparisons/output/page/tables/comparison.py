"""The comparison as a table, for the page and for the terminal.

In: the figures of a run. Out: a row a quantity, with equal ones of several friction coefficients in
one."""

from comparisons.drawing.blocks import TextTable
from comparisons.drawing.tables import figure_table, in_context
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import COMPARED, LABELS, NORMS
from comparisons.judging import contact
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.study import MODEL_ERROR, Run

SAME_PROBLEM = "the same problem"


def comparison_table(run: Run, brief: bool = False) -> TextTable:
    """Both models' figures and their differences, or those of the only one; below a figure in grey
    that over Hertz's. The problem that the finite elements solve is the title where it is that of
    all rows.

    brief  for a terminal"""
    compared = run.compared
    sources = {name for figure in compared for name in (figure.source, figure.against)}
    studies = {contact.NAME, *(figure.study for figure in compared)}
    known = [f for f in run.figures if f.study in studies and f.source in (sources or run.runs)]
    over, title, beside = in_context(run.problem.hertz, COMPARED), "", {}
    if not compared:
        over_hertz = f"over {'mean' if run.problem.scene.periodic else 'Hertz'}"
        return figure_table(known, COMPARED, beside={over_hertz: over}, brief=brief)
    problems = {figure.quantity: reference_of(run, figure.quantity) for figure in compared}
    if len({*problems.values()}) == 1:
        title = _problem(next(iter(problems.values())))
    elif not brief:
        beside = {"reference": lambda figure: problems[figure.quantity]}

    def below(figure: Figure) -> str:
        return capped(run, figure) or ("" if brief else over(figure))

    return figure_table(known, COMPARED, title, below, beside, brief=brief)


def _problem(reference: str) -> str:
    same = f"{reference} as the half-plane"
    other = f"the half-plane's problem with {reference}"
    return f"The finite elements solve {same if reference == SAME_PROBLEM else other}"


def capped(run: Run, difference: Figure) -> str:
    """Note that the hardness holds the peaks of both models, which makes them equal by itself."""
    if difference.against is None:
        return ""
    values = run.figures.of(quantity=difference.quantity, at=difference.at, against=None)
    held = {figure.source for figure in values if "capped" in figure.notes}
    return "capped in both" if {difference.source, difference.against} <= held else ""


def first_model(run: Run) -> str:
    """Model that is compared with the finite elements."""
    return LABELS[run.compared[0].source] if run.compared else LABELS["half_plane"]


def reference_of(run: Run, quantity: str) -> str:
    """Problem that the finite elements solve: the half-plane's, or that with effects that bear on
    the quantity; those without an estimate bear on all, and all on norms."""
    selection = run.data(MODEL_ERROR).selection
    named = [
        EFFECTS[name].label
        for name in EFFECTS
        if name in selection.contained
        and (quantity in NORMS or quantity in selection.estimates.get(name, [quantity]))
    ]
    return ", ".join(named) or SAME_PROBLEM
