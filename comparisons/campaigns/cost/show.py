"""A cost study for its reader: cost.json, a table for the terminal, and cost.html.

In: a finished study. Out: what to take, every row with its errors, diagrams."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.campaigns.cost.picture import cost_picture
from comparisons.campaigns.cost.recommend import Cost, Recommendation, scene_sections
from comparisons.campaigns.cost.study import FAILED, OK, CostRow
from comparisons.common.numbers import integer, percent, with_unit
from comparisons.drawing.style import drawing
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.output.page.html import STYLES as POLICY
from comparisons.output.page.html import rendered
from comparisons.output.terminal import PLAIN, SHORT, STYLES, plain_table

if TYPE_CHECKING:
    from rich.console import Console, ConsoleOptions, RenderableType

SCHEMA = 2
SHOWN = ("peak_pressure", "contact_length", "pressure_l2", "tau1_max", "tau1_max_depth")
REDUNDANT = ("contact_ratio",)  # the contact length over a constant
MARK = " *"  # on the Pareto front
ERRORS = 5  # columns of errors in a narrow terminal


def content_of(cost: Cost) -> dict:
    """The content of cost.json: SI units, errors relative, None for what is unknown."""
    names = [name for name in QUANTITIES if name in cost.references]
    return {
        "schema": SCHEMA,
        "scene": cost.problem.surface.as_dict(cost.problem.scene),
        "reference": {
            name: {"source": r.source, "values": list(r.values), "uncertainty": r.floor}
            for name, r in ((name, cost.references[name]) for name in names)
        },
        "rows": [_row(cost, row) for row in cost.rows],
        "recommendations": [
            {
                "quantity": chosen.quantity,
                "tolerance": chosen.tolerance,
                "sentence": chosen.sentence,
                "half_plane": _taken(cost, chosen.half_plane),
                "finite_element": _taken(cost, chosen.finite_element),
                "cheapest": _taken(cost, chosen.cheapest, scene=False),
            }
            for chosen in cost.recommendations
        ],
        "versions": cost.versions,
        "machine": cost.machine,
    }


def _row(cost: Cost, row: CostRow) -> dict:
    measured = row.measured
    content = {
        "method": row.method.name,
        "model": row.method.model,
        "pitch": row.setting,
        "status": row.status,
        "because": row.because,
    }
    if measured is None:
        return content
    return content | {
        "elements": measured.level.grid.count,
        "unknowns": measured.level.unknowns,
        "seconds": measured.seconds,
        "total": measured.total,
        "smallest_total": measured.spread[0],
        "largest_total": measured.spread[1],
        "wall": measured.wall,
        "repeats": measured.repeats,
        "peak_memory": measured.memory,
        "figures": list(measured.values),
        "errors": {n: row.errors[n].value if n in row.errors else None for n in cost.references},
        "best_for": [name for name, front in cost.fronts.items() if row in front],
    }


def _taken(cost: Cost, row: CostRow | None, scene: bool = True) -> dict | None:
    """Its place in `rows`, and what to write into the scene for it."""
    if row is None:
        return None
    taken = {"row": cost.rows.index(row), "method": row.method.name}
    return taken | {"scene": scene_sections(row, cost.problem)} if scene else taken


def cost_table(cost: Cost) -> "RenderableType":
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    names = shown(cost)
    heads = ("method", "setting", "unknowns", "contact", "with\nstresses", "memory")
    heads += tuple(SHORT[name].replace(" ", "\n") for name in names)
    styles = {OK: "", FAILED: STYLES["differ"]}

    def table(*columns: int) -> Table:
        first, *numbers = (heads[k] for k in columns)
        made = plain_table(first, numbers=numbers)
        for row in cost.rows:
            style, texts = styles.get(row.status, STYLES["inconclusive"]), cells(cost, row, names)
            made.add_row(*(Text(texts[k].translate(PLAIN), style=style) for k in columns))
        return made

    errors = range(6, len(heads))
    several = [table(0, 1, *errors[k : k + ERRORS]) for k in range(0, len(errors), ERRORS)]
    parts = [part for rows in (table(*range(6)), *several) for part in (rows, "")][:-1]
    rows = WhatFits(table(*range(len(heads))), tuple(parts))
    lines = [Text(chosen.sentence.translate(PLAIN)) for chosen in cost.recommendations]
    small = [*refusals(cost), *notes_of(cost)]
    notes = [Text(line.translate(PLAIN), style="dim") for line in small]
    title = Text(cost.problem.scene.title, style="bold")
    return Group(title, "", rows, "", *lines, "", *notes)


@dataclass(frozen=True)
class WhatFits:
    """Something for rich to print, or its parts where the terminal is narrower."""

    whole: "RenderableType"
    parts: "tuple[RenderableType, ...]"

    def __rich_console__(
        self, console: "Console", options: "ConsoleOptions"
    ) -> "Iterator[RenderableType]":
        from rich.measure import Measurement

        unbounded = options.update(width=10 * options.max_width)
        wide = Measurement.get(console, unbounded, self.whole).maximum
        yield from (self.whole,) if wide <= options.max_width else self.parts


def cost_page(cost: Cost) -> str:
    names = shown(cost)
    head = ("method", "setting", "unknowns", "contact", "with stresses", "memory")
    with drawing():
        pictures = [cost_picture(cost, name) for name in cost.references if name not in REDUNDANT]
    return rendered(
        Path(__file__).parent / "cost.html.j2",
        policy=POLICY,
        title=f"Cost: {cost.problem.scene.title}",
        recommendations=[
            (chosen.sentence, _settings(cost, chosen)) for chosen in cost.recommendations
        ],
        pictures=pictures,
        head=(*head, *map(label, names)),
        rows=[(row.status, cells(cost, row, names)) for row in cost.rows],
        refusals=refusals(cost),
        notes=notes_of(cost),
    )


def _settings(cost: Cost, recommendation: Recommendation) -> list[str]:
    """What to write into the scene, as TOML: a line a model."""
    rows = (recommendation.half_plane, recommendation.finite_element)
    return [_toml(scene_sections(row, cost.problem)) for row in rows if row is not None]


def _toml(sections: dict[str, dict]) -> str:
    def written(name: str, value: object) -> str:
        if name == "pitch":
            value = with_unit(value, "m", 3).translate(PLAIN)  # as the setting is named
        return f'"{value}"' if isinstance(value, str) else f"{value!r}"

    return ", ".join(
        f"{name} = {{{', '.join(f'{k} = {written(k, v)}' for k, v in fields.items())}}}"
        for name, fields in sections.items()
    )


def shown(cost: Cost) -> list[str]:
    """Quantities with a column: the usual ones, and those that the scene judges."""
    judged = cost.problem.scene.tolerances
    names = (*SHOWN, *(name for name in judged if name not in SHOWN))
    return [name for name in names if name in cost.references and name not in REDUNDANT]


def cells(cost: Cost, row: CostRow, names: list[str]) -> tuple[str, ...]:
    measured = row.measured
    if measured is None:
        return (row.method.name, row.label, row.status, *[""] * (3 + len(names)))
    stresses = cost.problem.scene.stress is not None
    return (
        row.method.name,
        row.label,
        integer(measured.level.unknowns),
        with_unit(row.seconds(False), "s", 2),
        with_unit(row.seconds(True), "s", 2) if stresses else "",
        with_unit(measured.memory, "byte", 3),
        *(_error(cost, row, name) for name in names),
    )


def _error(cost: Cost, row: CostRow, name: str) -> str:
    if name not in row.errors:
        best = cost.references[name].row
        is_best = best is not None and row.measured is best.measured
        return "reference" if is_best else ""
    error, floor = row.errors[name].value, row.errors[name].numerical
    text = f"< {percent(floor)}" if error < floor else percent(error)
    if row.status != OK:
        return f"{text} {row.status}"
    return text + (MARK if row in cost.fronts[name] else "")


def refusals(cost: Cost) -> list[str]:
    return [
        f"{row.method.name} {row.label if row.setting else ''}".strip()
        + f" {row.status}: {row.because}"
        for row in cost.rows
        if row.status != OK
    ]


def notes_of(cost: Cost) -> list[str]:
    by_source: dict[str, list[str]] = {}
    for name, reference in cost.references.items():
        if name in REDUNDANT:
            continue
        floor = "" if reference.row is None else f" (known to {percent(reference.floor)})"
        by_source.setdefault(reference.source, []).append(SHORT[name] + floor)
    sources = "; ".join(f"{source}: {', '.join(names)}" for source, names in by_source.items())
    repeats = max((r.measured.repeats for r in cost.rows if r.measured), default=0)
    versions = ", ".join(f"{k} {v}" for k, v in cost.versions.items() if v is not None)
    machine = ", ".join(f"{k} {v}" for k, v in cost.machine.items() if v is not None)
    return [
        f"Errors are relative, the largest of any friction coefficient, against {sources}.",
        "*: nothing measured is both cheaper and closer (Pareto front). Seconds are processor time "
        f"of that setting alone: medians of up to {repeats} solutions after one that does not "
        "count.",
        f"Machine: {machine}.",
        f"Versions: {versions}.",
    ]
