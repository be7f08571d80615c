"""What uncertain inputs do to the half-plane's figures, on the page and in sentences."""

from comparisons.common.numbers import listed, percent, with_unit
from comparisons.drawing.blocks import Block, Note, TextTable
from comparisons.figures.figure import Figure, grouped
from comparisons.figures.quantity import QUANTITIES, error_text, label
from comparisons.studies.scatter.study import NAME, SAMPLES, by_inputs
from comparisons.studies.study import MODEL_ERROR, Run

LISTED = 2  # inputs of a figure in the table
SMALL = 1.0 / 3.0  # a model error over what the inputs do, to be called small
SHORT = {"youngs_modulus": "E", "poissons_ratio": "ν", "_": " "}
NOTE = """The half-plane on its coarsest pressure elements, {solutions} times with inputs drawn from
the scene's [scatter] (Sobol's sequence), scaled to the finest: mean, central 95 %, and the
first-order share of each input in the variance, the largest first (Saltelli et al. 2010). Shares
that do not add up to 1 belong to inputs that act together.{failures} In the pictures of pressures
the same 95 % are a band."""


def blocks(run: Run) -> list[Block]:
    findings = run.found[NAME]
    [counts] = findings.table(SAMPLES).rows()
    why = findings.said("first failure")
    failures = f" {counts['failed']} had no solution, the first because: {why}."
    note = NOTE.format(solutions=counts["solutions"], failures=failures if why else "")
    return [Block("inputs", (scatter_table(run), Note(note)), "Uncertain inputs")]


def scatter_table(run: Run) -> TextTable:
    """A row for each quantity, and each friction coefficient that matters."""
    rows = []
    for same in grouped(run.figures.of(study=NAME), _cells):
        words, *cells = _cells(same[0])
        rows.append((words, listed(figure.friction for figure in same), *cells))
    head = ("", "friction", "nominal", "mean", "central 95 %", "of nominal", "by input")
    return TextTable("Half-plane", head, tuple(rows))


def _cells(figure: Figure) -> tuple[str, ...]:
    unit, spread = QUANTITIES[figure.quantity].unit, figure.spread
    nominal, mean, low, high = (
        with_unit(value, unit) for value in (figure.value, spread.mean, *spread.interval)
    )
    parts = ", ".join(largest_shares(figure))
    name = label(figure.quantity)
    return name, nominal, mean, f"{low} to {high}", f"±{percent(by_inputs(figure))}", parts


def largest_shares(figure: Figure, most: int = LISTED) -> list[str]:
    """The inputs with the largest total shares of the variance, each with its first-order one."""
    parts = sorted((figure.spread.shares or {}).items(), key=lambda part: -part[1]["total"])
    shares = []
    for name, part in parts[:most]:
        for long, short in SHORT.items():
            name = name.replace(long, short)
        size = percent(max(part["first"], 0.0), uncertainty=part["first_uncertainty"])
        shares.append(f"{name} {size}")
    return shares


def lines(run: Run) -> list[tuple[str, str]]:
    """Of every judged figure at the friction coefficient that decides: what the inputs do."""
    said = []
    for figure in run.figures.of(study=NAME, friction=run.deciding_friction):
        if figure.quantity in run.problem.scene.tolerances:
            most = ", ".join(largest_shares(figure, 1))
            text = f"{label(figure.quantity)} ±{percent(by_inputs(figure))}, most by {most}"
            said.append(("inputs", text))
    return said


def beside_inputs(run: Run, quantity: str, friction: float) -> str:
    """How the model error of a figure compares with what inputs do to it; "" if one is unknown."""
    figure, error = (
        run.figures.one(study=study, quantity=quantity, friction=friction)
        for study in (NAME, MODEL_ERROR)
    )
    if figure is None or error is None:
        return ""
    size, moved = abs(error.value), by_inputs(figure)
    if size + error.numerical < SMALL * moved:
        how = "is small beside it"
    elif size - error.numerical > moved:
        how = "is larger"
    else:
        how = "is of that size"
    shown = error_text(quantity, error.value, error.numerical)
    inputs = f"Your inputs move the {label(quantity)} by ±{percent(moved)}"
    return f"{inputs}: the half-plane's model error of {shown} {how}."
