"""The rows of the stiff and extreme cases for people to read."""

from typing import TYPE_CHECKING

from comparisons.studies.robustness.row import Figure
from comparisons.studies.robustness.run import FILE, Stability

if TYPE_CHECKING:
    from rich.table import Table


def stability_table(result: Stability) -> "Table":
    """The rows for people to read: the figure that each is about, or that it fails by."""
    from rich.table import Table
    from rich.text import Text

    passed = sum(row.passed for row in result.rows)
    table = Table(
        "model",
        "case",
        "holds",
        "figure",
        "value",
        "bound",
        "cond.",
        "cost x",
        "s",
        caption_justify="left",
        caption=f"{passed} of {len(result.rows)} cases hold, {result.seconds:.0f} s, "
        f"{result.directory / FILE}",
    )
    for row in result.rows:
        holds = Text("yes", style="green") if row.passed else Text("NO", style="bold red")
        shown = row.telling
        figure = row.error or (f"{shown.name} ({shown.against})" if shown else "shows nothing")
        value = f"{shown.value:.2g}" if shown else ""
        bound = _bound(shown) if shown else ""
        cost = row.findings.cost.get("times_the_ordinary")
        table.add_row(
            row.case.model.replace("_", "-"),
            Text(f"{row.case.group}: {row.case.name}"),
            holds,
            Text(figure),
            value,
            bound,
            "" if row.findings.condition is None else f"{row.findings.condition:.0e}",
            "" if cost is None else f"{cost:.1f}",
            f"{row.seconds:.1f}",
        )
    return table


def _bound(figure: Figure) -> str:
    if figure.least > 0.0:
        return f"{figure.least:.2g} to {figure.most:.2g}"
    return f"{figure.most:.2g}"
