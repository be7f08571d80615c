"""A cost study for its reader: cost.json, a table for the terminal, and cost.html with diagrams.

In: a finished study. Out: what to take, every row with its errors, error against time."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.campaigns.cost.measure import FAILED, OK, CostRow
from comparisons.campaigns.cost.recommend import Cost, needs_stress, scene_sections
from comparisons.common.numbers import integer, percent, percent_as_written, with_unit
from comparisons.drawing.style import COLUMN, REFERENCE, Picture, data_uri, drawing, figure
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
HEAD = ("method", "setting", "unknowns", "contact", "with stresses", "memory")
ERRORS = 5  # columns of errors in a narrow terminal
# Okabe and Ito's colours, a line style and a mark of its own for each.
DASHED = (0, (4, 1.6))
LOOKS = {
    "strips, FFT": ("#56B4E9", "-", "s"),
    "hats, FFT": ("#0072B2", "-", "o"),
    "hats, layered": ("#332288", "-", "v"),
    "hats, deformed": ("#882255", "-", "D"),
    "P2, linear": ("#DDAA33", DASHED, "v"),
    "P1": ("#CC79A7", DASHED, "^"),
    "P2": ("#D55E00", DASHED, "o"),
    "P3": ("#009E73", DASHED, "s"),
}
WORDS = {  # methods that are no finite elements, as the reader of a picture knows them
    "strips, FFT": "half-plane, strips",
    "hats, FFT": "half-plane, hats",
    "hats, layered": "half-plane with layer",
    "hats, deformed": "half-plane, deformed surface",
}
SMALL = {"textcoords": "offset points", "fontsize": 8.0}
# White around what stands over lines.
HALO = {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
HEIGHT = 4.3  # inches, of a diagram
LEAST = 1e-7  # smaller errors are drawn there


def content_of(cost: Cost) -> dict:
    """The content of cost.json: SI units, errors relative, None for what is unknown."""
    return {
        "schema": SCHEMA,
        "scene": cost.problem.surface.as_dict(cost.problem.scene),
        "reference": {
            name: {
                "source": best.source,
                "values": [values[name] for values in best.values if name in values],
                "uncertainty": best.floors[name],
            }
            for name in QUANTITIES
            if (best := cost.references.get(name))
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
    """All rows, beside each other or, in a narrow terminal, in parts; then what to take."""
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    names = shown(cost)
    heads = [head.replace(" ", "\n") for head in (*HEAD, *(SHORT[name] for name in names))]
    styles = {OK: "", FAILED: STYLES["differ"]}

    def table(*columns: int) -> Table:
        first, *numbers = (heads[k] for k in columns)
        made = plain_table(first, numbers=numbers)
        for row in cost.rows:
            style, texts = styles.get(row.status, STYLES["inconclusive"]), cells(cost, row, names)
            made.add_row(*(Text(texts[k].translate(PLAIN), style=style) for k in columns))
        return made

    errors = range(len(HEAD), len(heads))
    several = [table(0, 1, *errors[k : k + ERRORS]) for k in range(0, len(errors), ERRORS)]
    parts = [part for rows in (table(*range(len(HEAD))), *several) for part in (rows, "")][:-1]
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
    recommendations = []
    for chosen in cost.recommendations:
        rows = filter(None, (chosen.half_plane, chosen.finite_element))
        settings = [_toml(scene_sections(row, cost.problem)) for row in rows]
        recommendations.append((chosen.sentence, settings))
    with drawing():
        pictures = [cost_picture(cost, name) for name in cost.references if name not in REDUNDANT]
    return rendered(
        Path(__file__).parent / "cost.html.j2",
        policy=POLICY,
        title=f"Cost: {cost.problem.scene.title}",
        recommendations=recommendations,
        pictures=pictures,
        head=(*HEAD, *map(label, names)),
        rows=[(row.status, cells(cost, row, names)) for row in cost.rows],
        refusals=refusals(cost),
        notes=notes_of(cost),
    )


def _toml(sections: dict[str, dict]) -> str:
    """What to write into the scene, as TOML on one line."""

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
    names = dict.fromkeys((*SHOWN, *cost.problem.scene.tolerances))
    return [name for name in names if name in cost.references and name not in REDUNDANT]


def cells(cost: Cost, row: CostRow, names: list[str]) -> tuple[str, ...]:
    """A row's texts under HEAD and the quantities' names."""
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
    """What errors are measured by, how seconds are, and where."""
    by_source: dict[str, list[str]] = {}
    for name, reference in cost.references.items():
        if name not in REDUNDANT:
            floor = percent(reference.floors[name])
            known = "" if reference.row is None else f" (known to {floor})"
            by_source.setdefault(reference.source, []).append(SHORT[name] + known)
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


def cost_picture(cost: Cost, quantity: str) -> Picture:
    """Error against time: methods as lines, the reference's uncertainty, the Pareto front."""
    stresses, reference = needs_stress([quantity]), cost.references[quantity]
    drawn = figure(COLUMN, HEIGHT)
    axes = drawn.add_axes((0.125, 0.105, 0.855, 0.685))
    floor = max(reference.floors[quantity], LEAST)

    def points(rows: Iterable[CostRow]) -> list[tuple[float, float]]:
        return [(row.seconds(stresses), max(row.errors[quantity].value, LEAST)) for row in rows]

    known = [row for row in cost.rows if row.status == OK and quantity in row.errors]
    for method in dict.fromkeys(row.method for row in cost.rows):
        line = points(row for row in known if row.method == method)
        if line:
            colour, dashes, mark = LOOKS[method.name]
            look = {"color": colour, "linestyle": dashes, "marker": mark, "markersize": 4.5}
            words = WORDS.get(method.name, f"finite elements, {method.name}")
            axes.plot(*zip(*line, strict=True), linewidth=1.1, label=words, **look)
    if front := points(cost.fronts[quantity]):
        look = {"linestyle": "none", "marker": "o", "markersize": 10.0, "markerfacecolor": "none"}
        look |= {"markeredgecolor": "#222222", "markeredgewidth": 0.9}
        axes.plot(*zip(*front, strict=True), label="Pareto front", **look)
    tolerance = cost.problem.scene.tolerances.get(quantity)
    named = ""
    cheapest = [one.cheapest for one in cost.recommendations if one.quantity == quantity]
    if cheapest and cheapest[0] is not None:
        words = f"cheapest to {percent_as_written(tolerance)}"
        taken = with_unit(cheapest[0].seconds(stresses), "s", 2)
        named = f" {words.capitalize()}: {cheapest[0].method.name} {cheapest[0].label}, {taken}."
        look = {"linestyle": "none", "marker": "*", "markersize": 13.0, "color": "#F0E442"}
        look |= {"markeredgecolor": "#222222", "markeredgewidth": 0.7, "zorder": 4}
        axes.plot(*zip(*points(cheapest), strict=True), label=words, **look)
    axes.set(xscale="log", yscale="log")
    first, last = axes.get_xlim()
    if reference.row is not None and math.isfinite(floor):
        low = min(axes.get_ylim()[0], 0.5 * floor)
        axes.axhspan(low, floor, facecolor="#eceff1", zorder=0)
        axes.set_ylim(bottom=low)
        look = {"ha": "right", "va": "top", "color": "#555555", "bbox": HALO, **SMALL}
        axes.annotate(f"reference uncertain to {percent(floor)}", (last, floor), (-3, -3), **look)
    if tolerance is not None:
        axes.axhline(tolerance, **REFERENCE)
        words = f"tolerance {percent_as_written(tolerance)}"
        look = {"ha": "right", "bbox": HALO, **SMALL}
        axes.annotate(words, (last, tolerance), (-3, 4), **look)
    part = "stresses included" if stresses else "contact alone"
    axes.set(xlim=(first, last), xlabel=f"processor time [s], {part}", ylabel="relative error")
    drawn.legend(loc="upper left", ncol=2, bbox_to_anchor=(0.1, 1.0), columnspacing=1.2)
    best = "; ".join(
        f"{row.method.name} {row.label} {percent(row.errors[quantity].value)} in "
        f"{with_unit(row.seconds(stresses), 's', 2)}"
        for row in cost.fronts[quantity]
    )
    return Picture(
        source=data_uri(drawn),
        alternative=f"Error of the {label(quantity)} over time. Pareto front: {best}.",
        caption=f"Error of the {label(quantity)} against {reference.source}, over time.{named}",
    )
