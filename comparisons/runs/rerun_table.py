"""The table of a repeated run: what moved; in a line each what did not, and what else is new."""

from typing import TYPE_CHECKING

from comparisons.report.terminal import STYLES
from comparisons.results.changes import ROUNDING, Moved
from comparisons.runs.rerun import Repetition

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

DIGITS = 9  # of a figure: enough to see what moved by more than rounding


def rerun_summary(repetition: Repetition) -> "RenderableType":
    """What moved, and what the repetition had that the record had not."""
    from rich.console import Group
    from rich.text import Text

    movement = repetition.movement
    parts: list[RenderableType] = [Text(repetition.outcome.problem.scene.title, style="bold"), ""]
    if movement.moved:
        parts += [_table(movement.moved), ""]
    parts.append(Text(_verdict(repetition), style=_style(repetition)))
    parts += [Text(line) for line in _lines(repetition)]
    return Group(*parts)


def _table(moved: tuple[Moved, ...]) -> "Table":
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    table.add_column("figure", overflow="fold")
    for column in ("recorded", "repeated", "relative\nchange", "stated\nuncert."):
        table.add_column(column, justify="right", overflow="fold")
    table.add_column("of")
    for row in moved:
        cells = (
            row.path,
            _value(row.recorded),
            _value(row.repeated),
            "" if row.change is None else f"{row.change:+.2e}",
            "" if not row.by else f"{row.stated:.2e}",
            row.by or "none",
        )
        style = STYLES["differ"] if row.beyond else ""
        table.add_row(*(Text(cell, style=style) for cell in cells))
    return table


def _value(value: object) -> str:
    if value is None:
        return "absent"
    if isinstance(value, list):
        return f"{len(value)} patch{'es' * (len(value) != 1)}"
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)


def _verdict(repetition: Repetition) -> str:
    moved, beyond = repetition.movement.moved, repetition.movement.beyond
    if not repetition.outcome.converged:
        return "NOT CONVERGED  a solver did not converge."
    if beyond:
        return (
            f"MOVED  {_count(len(beyond), 'figure')} moved by more than the stated uncertainty: "
            f"{', '.join(row.path for row in beyond[:3])}{', …' if len(beyond) > 3 else ''}."
        )
    if moved:
        return f"REPEATED  {_count(len(moved), 'figure')} moved, within the stated uncertainty."
    return "REPEATED  no figure moved."


def _style(repetition: Repetition) -> str:
    return STYLES["agree" if repetition.exit_status == 0 else "differ"]


def _lines(repetition: Repetition) -> list[str]:
    movement, (before, now) = repetition.movement, repetition.levels
    same = f"{_count(movement.same, 'figure')} equal to the last digit"
    if movement.rounding:
        same += f", {movement.rounding} more to a relative {ROUNDING:g}"
    lines = [f"{same}{'; pressures the same to the last bit' if repetition.bits else ''}."]
    if movement.new:
        lines.append(f"{_count(movement.new, 'figure')} of which the record knows nothing.")
    if before != now:
        refinement = repetition.outcome.result["refinement"]
        lines.append(f"Recorded on {before} levels, repeated on {now}: {refinement}.")
    if repetition.other:
        parts = (f"{n} {_known(a)}, now {_known(b)}" for n, (a, b) in repetition.other.items())
        lines.append(f"Other than recorded: {'; '.join(parts)}.")
    return lines


def _known(value: object) -> str:
    return "unknown" if value is None else str(value)


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'s' * (number != 1)}"
