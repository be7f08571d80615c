"""The verification for people to read: on the terminal, and as a page of its own."""

from html import escape
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.quantities import LABELS
from comparisons.studies.verify.pairs import Coverage, Pair
from comparisons.studies.verify.result import Verification

if TYPE_CHECKING:
    from rich.console import RenderableType

COLUMNS = ("figures", "that tell", "covered", "median width", "90 %")
NAMES = {**LABELS, "layer": "analytic layer"}
STYLE = """
body { font: 15px/1.4 system-ui, sans-serif; margin: 2em auto; max-width: 70em; padding: 0 1em }
table { border-collapse: collapse; margin: 1em 0 }
th, td { padding: .15em .8em; text-align: right; border-bottom: 1px solid #ddd }
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2), .text { text-align: left }
.no { color: #b00; font-weight: bold }
"""


def coverage_line(found: Verification) -> str:
    """The line that scripts look for; rounded down, so that 95 means at least 95."""
    share = found.coverage.covered
    return f"coverage {np.floor(100.0 * share + 1e-9) if np.isfinite(share) else 0.0:.0f} %"


def verify_summary(found: Verification) -> "RenderableType":
    """Coverage by model and quantity, checks, what does not hold, and the verdict."""
    from rich import box
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    table.add_column("model", overflow="fold")
    table.add_column("quantity", overflow="fold")
    for name in COLUMNS:
        table.add_column(name, justify="right", overflow="fold")
    for (model, quantity), group in found.groups.items():
        table.add_row(NAMES[model], quantity, *_cells(group))
    table.add_section()
    table.add_row("all", "", *_cells(found.coverage))
    checks = [Text(_check_line(found, group)) for group in _groups(found)]
    faults = [Text(f"does not hold: {line}", style="bold red") for line in found.faults]
    verdict = Text("HOLDS" if found.holds else "DOES NOT HOLD", style="bold")
    verdict.append(f"  in {sum(found.seconds.values()):.0f} s")
    return Group(table, "", *checks, *faults, Text(coverage_line(found)), verdict)


def verify_page(found: Verification) -> str:
    """One self-contained page: the same table, every check and every figure."""
    groups = [
        [NAMES[model], quantity, *_cells(group)]
        for (model, quantity), group in found.groups.items()
    ]
    checks = [
        [c.group, c.name, f"{c.value:.4g}", f"{c.low:.4g} to {c.high:.4g}", _yes(c.holds)]
        for c in found.checks
    ]
    pairs = [_pair_cells(pair) for pair in found.pairs]
    heads = ("model", "quantity", *COLUMNS)
    faults = "".join(f"<p class=no>{escape(line)}</p>" for line in found.faults)
    return "\n".join(
        [
            "<!doctype html><html lang=en><meta charset=utf-8><title>crosscheck verify</title>",
            f"<style>{STYLE}</style>",
            f"<h1>{'Holds' if found.holds else 'Does not hold'}: {coverage_line(found)}</h1>",
            "<p>Stated uncertainty against true error, wherever the exact answer is known. Width: "
            "stated uncertainty over true error. Figures whose error is rounding do not tell.</p>",
            faults,
            _table(heads, [*groups, ["all", "", *_cells(found.coverage)]]),
            "<h2>Orders, manufactured solutions, second road</h2>",
            _table(("group", "measured", "value", "expected", "holds"), checks),
            "<h2>Figures</h2>",
            _table(
                ("model", "case", "quantity", "exact", "error", "uncertainty", "width", "covered"),
                pairs,
            ),
            "</html>\n",
        ]
    )


def _cells(group: Coverage) -> tuple[str, ...]:
    if not group.tell:
        return (str(group.count), "0", "", "", "")
    return (
        str(group.count),
        str(group.tell),
        f"{100.0 * group.covered:.1f} %",
        f"{group.median_width:.1f}",
        f"{group.large_width:.1f}",
    )


def _pair_cells(pair: Pair) -> list[str]:
    width = "" if pair.width is None else f"{pair.width:.2f}"
    return [
        NAMES[pair.model],
        pair.case,
        pair.quantity,
        f"{pair.exact:.6g}",
        f"{pair.error:.2e}",
        f"{pair.stated:.2e}",
        width,
        _yes(pair.covered),
    ]


def _yes(true: bool) -> str:
    return "yes" if true else "NO"


def _groups(found: Verification) -> list[str]:
    return list(dict.fromkeys(check.group for check in found.checks))


def _check_line(found: Verification, group: str) -> str:
    checks = [check for check in found.checks if check.group == group]
    return f"{group}: {sum(check.holds for check in checks)} of {len(checks)} hold"


def _table(heads: tuple[str, ...], rows: list[list[str]]) -> str:
    def cells(values: list[str] | tuple[str, ...], tag: str) -> str:
        return "".join(
            f"<{tag}{' class=no' if value == 'NO' else ''}>{escape(value)}</{tag}>"
            for value in values
        )

    body = "\n".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows)
    return f"<table><tr>{cells(heads, 'th')}</tr>\n{body}\n</table>"
