"""What uncertain inputs do to the half-plane's figures, as a table and in a sentence."""

from comparisons.assessment.scatter.figures import ScatteredFigure
from comparisons.common.numbers import percent, with_unit
from comparisons.common.quantities import QUANTITIES, label
from comparisons.report.tables.text import TextTable, error_text
from comparisons.results.outcome import Outcome

LISTED = 3  # inputs of a figure in the table
SMALL = 1.0 / 3.0  # a model error over what the inputs do, to be called small


def scatter_table(outcome: Outcome) -> TextTable | None:
    """A row for each quantity and friction coefficient; None without [scatter]."""
    if outcome.scatter is None:
        return None
    rows = [
        (
            label(figure.quantity),
            f"{figure.friction:g}",
            *(with_unit(v, QUANTITIES[figure.quantity].unit)
              for v in (figure.nominal, figure.mean, *figure.interval)),
            percent(figure.relative),
            ", ".join(largest_shares(figure)),
        )
        for figure in outcome.scatter.figures
    ]  # fmt: skip
    head = ("", "friction", "nominal", "mean", "2.5 %", "97.5 %", "± of nominal", "by input")
    return TextTable("Uncertain inputs, half-plane", head, tuple(rows))


def largest_shares(figure: ScatteredFigure, most: int = LISTED) -> list[str]:
    """The inputs with the largest total shares of the variance, each with its first-order one."""
    parts = sorted((figure.shares or {}).items(), key=lambda part: -part[1]["total"])
    return [
        f"{name.replace('_', ' ')} "
        f"{percent(max(part['first'], 0.0), uncertainty=part['first_uncertainty'])}"
        for name, part in parts[:most]
    ]


def scatter_lines(outcome: Outcome) -> list[str]:
    """Of every judged figure at the friction coefficient that decides: what the inputs do."""
    found = []
    friction = outcome.deciding_friction
    for figure in outcome.scatter.figures if outcome.scatter else ():
        if figure.friction == friction and figure.quantity in outcome.problem.scene.tolerance:
            most = ", ".join(largest_shares(figure, 1))
            found.append(f"{label(figure.quantity)} ±{percent(figure.relative)}, most by {most}")
    return found


def beside_inputs(outcome: Outcome, quantity: str, friction: float) -> str:
    """How the model error of a figure compares with what the inputs do to it; "" where either is
    not known."""
    figure = outcome.scatter and outcome.scatter.of(quantity, friction)
    if not figure or outcome.budget is None:
        return ""
    error = outcome.budget.of(quantity, friction)
    size = abs(error.value)
    if size + error.uncertainty < SMALL * figure.relative:
        how = "is small beside it"
    elif size - error.uncertainty > figure.relative:
        how = "is larger"
    else:
        how = "is of that size"
    shown = error_text(quantity, error.value, error.uncertainty)
    moved = f"Your inputs move the {label(quantity)} by ±{percent(figure.relative)}"
    return f"{moved}: the half-plane's model error of {shown} {how}."
