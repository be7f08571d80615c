"""The verification for people to read: on the terminal, and as a page of its own."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.cases import MODEL_LABELS, bounds_text, holds, rows_table, verdict_lines
from comparisons.campaigns.verify.coverage import GROUPS, Coverage, Pair, Verification, pairs_of
from comparisons.output.page.html import STYLES, rendered
from comparisons.output.terminal import plain_table

if TYPE_CHECKING:
    from rich.console import RenderableType

COLUMNS = ("figures", "informative", "covered", "median ratio", "90 %")
OTHERS = "Orders, manufactured solutions, independent solver"
OTHER_COLUMNS = ("group", "measured", "value", "bound", "holds")
PAIR_COLUMNS = ("table", "model", "case", "quantity", "exact", "error")
PAIR_COLUMNS += ("uncertainty", "ratio", "covered")


def coverage_line(verification: Verification) -> str:
    """The line that scripts look for; rounded down, so that 95 means at least 95."""
    share = verification.coverage.covered
    return f"coverage {np.floor(100.0 * share + 1e-9) if np.isfinite(share) else 0.0:.0f} %"


def verify_summary(verification: Verification) -> "RenderableType":
    """Coverage by model, quantity and kind, rows without pairs or that do not hold, the verdict."""
    from rich.console import Group

    tables = []
    for names in GROUPS:
        table = plain_table(*names, numbers=COLUMNS)
        for row in _coverage_rows(verification, names):
            table.add_row(*row)
        tables += [table, ""]
    shown = [row for row in verification.rows if not (row.holds and pairs_of(row))]
    return Group(
        *tables, rows_table(shown), verdict_lines(verification), coverage_line(verification)
    )


def verify_page(verification: Verification) -> str:
    figures = [
        [
            *(row.case.group, f"{row.case.name}: {f.quantity}"),
            *(f"{f.value:.4g}", bounds_text(f), _yes(holds(f))),
        ]
        for row in verification.rows
        if not pairs_of(row)
        for f in row.judged
    ]
    coverages = (
        (f"Coverage by {', '.join(names)}", (*names, *COLUMNS), _coverage_rows(verification, names))
        for names in GROUPS
    )
    tables = [*coverages, (OTHERS, OTHER_COLUMNS, figures)]
    tables.append(("Figures", PAIR_COLUMNS, map(_pair_row, verification.pairs)))
    title = f"{'Holds' if verification.holds else 'Does not hold'}: {coverage_line(verification)}"
    template = Path(__file__).parent / "verify.html.j2"
    return rendered(template, policy=STYLES, title=title, faults=verification.faults, tables=tables)


def _pair_row(pair: Pair) -> tuple[str, ...]:
    words = pair.table, MODEL_LABELS[pair.model], pair.case, pair.quantity
    ratio = "" if pair.overestimation is None else f"{pair.overestimation:.2f}"
    numbers = f"{pair.exact.value:.6g}", f"{pair.error:.2e}", f"{pair.figure.numerical:.2e}"
    return (*words, *numbers, ratio, _yes(pair.covered))


def _coverage_rows(verification: Verification, names: tuple[str, ...]) -> list[tuple[str, ...]]:
    rows = []
    for group, covered in verification.groups(*names).items():
        named = zip(names, group, strict=True)
        words = (MODEL_LABELS[word] if name == "model" else word for name, word in named)
        rows.append((*words, *_cells(covered)))
    return [*rows, ("all", *[""] * (len(names) - 1), *_cells(verification.coverage))]


def _cells(group: Coverage) -> tuple[str, ...]:
    if not group.informative:
        return (str(group.count), "0", "", "", "")
    ratios = group.median_overestimation, group.overestimation_quantile
    covered = f"{100.0 * group.covered:.1f} %"
    return (str(group.count), str(group.informative), covered, *(f"{r:.1f}" for r in ratios))


def _yes(true: bool) -> str:
    return "yes" if true else "NO"
