"""What uncertain inputs do to the half-plane's figures, as a table and in a sentence."""

from comparisons.common.numbers import percent, with_unit
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.output.page.tables.text import error_text, listed
from comparisons.studies.scatter.figures import NAME, ScatteredFigure
from comparisons.studies.study import MODEL_ERROR, Run, TextTable

LISTED = 2  # inputs of a figure in the table
SMALL = 1.0 / 3.0  # a model error over what the inputs do, to be called small
SHORT = {"youngs_modulus": "E", "poissons_ratio": "ν", "_": " "}


def scatter_table(outcome: Run) -> TextTable | None:
    """A row for each quantity, and each friction coefficient that matters; None without scatter."""
    if outcome.data(NAME) is None:
        return None
    rows = []
    for same in grouped(outcome.data(NAME).figures, _cells):
        words, *cells = _cells(same[0])
        rows.append((words, listed(figure.friction for figure in same), *cells))
    head = ("", "friction", "nominal", "mean", "central 95 %", "of nominal", "by input")
    return TextTable("Half-plane", head, tuple(rows))


def _cells(figure: ScatteredFigure) -> tuple[str, ...]:
    unit = QUANTITIES[figure.quantity].unit
    nominal, mean, low, high = (
        with_unit(value, unit) for value in (figure.nominal, figure.mean, *figure.interval)
    )
    parts = ", ".join(largest_shares(figure))
    name = label(figure.quantity)
    return name, nominal, mean, f"{low} to {high}", f"±{percent(figure.relative)}", parts


def largest_shares(figure: ScatteredFigure, most: int = LISTED) -> list[str]:
    """The inputs with the largest total shares of the variance, each with its first-order one."""
    parts = sorted((figure.shares or {}).items(), key=lambda part: -part[1]["total"])
    found = []
    for name, part in parts[:most]:
        for long, short in SHORT.items():
            name = name.replace(long, short)
        size = percent(max(part["first"], 0.0), uncertainty=part["first_uncertainty"])
        found.append(f"{name} {size}")
    return found


def scatter_lines(outcome: Run) -> list[str]:
    """Of every judged figure at the friction coefficient that decides: what the inputs do."""
    found = []
    friction = outcome.deciding_friction
    scatter = outcome.data(NAME)
    for figure in scatter.figures if scatter else ():
        if figure.friction == friction and figure.quantity in outcome.problem.scene.tolerances:
            most = ", ".join(largest_shares(figure, 1))
            found.append(f"{label(figure.quantity)} ±{percent(figure.relative)}, most by {most}")
    return found


def beside_inputs(outcome: Run, quantity: str, friction: float) -> str:
    """How the model error of a figure compares with what inputs do to it; "" if one is unknown."""
    scatter = outcome.data(NAME)
    figure = scatter and scatter.of(quantity, friction)
    error = outcome.figures.one(study=MODEL_ERROR, quantity=quantity, friction=friction)
    if not figure or error is None:
        return ""
    size = abs(error.value)
    if size + error.numerical < SMALL * figure.relative:
        how = "is small beside it"
    elif size - error.numerical > figure.relative:
        how = "is larger"
    else:
        how = "is of that size"
    shown = error_text(quantity, error.value, error.numerical)
    moved = f"Your inputs move the {label(quantity)} by ±{percent(figure.relative)}"
    return f"{moved}: the half-plane's model error of {shown} {how}."
