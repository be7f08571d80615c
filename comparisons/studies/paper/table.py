"""The claims as a table for the terminal."""

from typing import TYPE_CHECKING

from comparisons.report.terminal import PLAIN, STYLES
from comparisons.studies.paper.words import row_of, summary

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comparisons.studies.paper.reproduce import Paper


def paper_table(paper: "Paper") -> "RenderableType":
    """One row a claim, how many ended how, and where the page is."""
    from rich import box
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    table.add_column("claim")
    table.add_column("figure")
    for column in ("half-plane", "finite elements"):
        table.add_column(column, justify="right")
    table.add_column("outcome")
    for each in paper.judged:
        row = row_of(each)
        cells = (row.title, row.figure, row.half_plane, row.finite_element)
        plain = [cell.replace("±", "+-").translate(PLAIN) for cell in cells]
        table.add_row(*plain, Text(row.outcome, style=STYLES[row.kind]))
    return Group(
        table, "", summary(paper.judged), f"figures and claims {paper.directory / 'paper.html'}"
    )
