"""The table of a cost study for the terminal: every row, what to take, and what it was run on."""

from typing import TYPE_CHECKING

from comparisons.common.numbers import integer, percent, with_unit
from comparisons.report.terminal import PLAIN, SHORT, STYLES
from comparisons.studies.cost.choice import Assessed
from comparisons.studies.cost.result import Cost
from comparisons.studies.cost.study import FAILED, OK

if TYPE_CHECKING:
    from rich.console import RenderableType

SHOWN = ("peak_pressure", "contact_length", "pressure_l2", "tau1_max", "tau1_max_depth")
NEEDLESS = ("contact_ratio",)  # the length's over a constant
MARK = " *"  # nothing is both cheaper and closer


def cost_summary(cost: Cost) -> "RenderableType":
    """Rows, sentences, references and machine."""
    from rich import box
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    names = shown(cost)
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    table.add_column("method")
    heads = ("setting", "unknowns", "contact", "with\nstresses", "memory")
    for column in (*heads, *(SHORT[name].replace(" ", "\n", 1) for name in names)):
        table.add_column(column, justify="right", overflow="fold")
    for each in cost.assessed:
        style = (
            "" if each.row.status == OK else STYLES["differ" if _failed(each) else "inconclusive"]
        )
        table.add_row(*(Text(c.translate(PLAIN), style=style) for c in cells(cost, each, names)))
    lines = [Text(choice.sentence.translate(PLAIN)) for choice in cost.choices]
    notes = [
        Text(line.translate(PLAIN), style="dim") for line in [*refusals(cost), *notes_of(cost)]
    ]
    title = Text(cost.problem.scene.title, style="bold")
    return Group(title, "", table, "", *lines, "", *notes)


def shown(cost: Cost) -> list[str]:
    """Quantities with a column: the usual ones, and those that the scene judges."""
    judged = cost.problem.scene.tolerance
    names = (*SHOWN, *(name for name in judged if name not in SHOWN))
    return [name for name in names if name in cost.references and name not in NEEDLESS]


def cells(cost: Cost, each: Assessed, names: list[str]) -> tuple[str, ...]:
    """Text of a row."""
    row, measured = each.row, each.row.measured
    setting = percent(row.setting, digits=1) if row.method.adapted and row.setting else row.label
    if measured is None:
        return (row.method.name, setting, row.status, *[""] * (3 + len(names)))
    stresses = cost.problem.scene.stress is not None
    return (
        row.method.name,
        setting,
        integer(measured.answer.unknowns),
        with_unit(row.seconds(False), "s", 2),
        with_unit(row.seconds(True), "s", 2) if stresses else "",
        with_unit(measured.memory, "byte", 3),
        *(_error(cost, each, name) for name in names),
    )


def _error(cost: Cost, each: Assessed, name: str) -> str:
    error, floor = each.errors.get(name), cost.floors[name]
    if error is None:
        return "reference" if each.row is cost.references[name].row else ""
    text = f"< {percent(floor)}" if error < floor else percent(error)
    if each.row.status != OK:
        return f"{text} {each.row.status}"
    return text + (MARK if each in cost.fronts[name] else "")


def refusals(cost: Cost) -> list[str]:
    """Why rows are not there, a line each."""
    return [
        f"{row.method.name} {row.label if row.setting else ''}".strip()
        + f" {row.status}: {row.because}"
        for row in cost.study.rows
        if row.status != OK
    ]


def notes_of(cost: Cost) -> list[str]:
    """How to read the numbers, what errors are measured by, and where all was run."""
    by: dict[str, list[str]] = {}
    for name, reference in cost.references.items():
        if name in NEEDLESS:
            continue
        floor = "" if reference.row is None else f" (known to {percent(reference.floor)})"
        by.setdefault(reference.source, []).append(SHORT[name] + floor)
    sources = "; ".join(f"{source}: {', '.join(names)}" for source, names in by.items())
    repeats = max((r.measured.repeats for r in cost.study.rows if r.measured), default=0)
    versions = ", ".join(f"{k} {v}" for k, v in cost.versions.items() if v is not None)
    machine = ", ".join(f"{k} {v}" for k, v in cost.machine.items() if v is not None)
    return [
        f"Errors are relative, the largest of any friction coefficient, against {sources}.",
        "*: nothing measured is both cheaper and closer. Seconds of the processor, of that setting "
        f"alone: medians of up to {repeats} goes after one that does not count.",
        f"Machine: {machine}.",
        f"Versions: {versions}.",
    ]


def _failed(each: Assessed) -> bool:
    return each.row.status == FAILED
