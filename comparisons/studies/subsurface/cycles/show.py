"""Cycles on the page and in the terminal.

In: a run with [cycles]. Out: a line, tables of passes and of surfaces, pictures of the plastic
strain by pass, of residual stresses over depth, and of the surfaces with their pressures."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import percent, percent_as_written, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Note, Pictures, TextTable
from comparisons.drawing.curves import distinct, legend_above, names_above, over, panels
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import MODELS
from comparisons.studies.study import WHY_NOT, Run
from comparisons.studies.subsurface.cycles.study import NAME, QUANTITIES, SOURCE, VERDICT
from comparisons.studies.subsurface.cycles.surfaces import (
    FLATTENED,
    FRESH,
    LAST,
    ONCE,
    LeftSurfaces,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

WORDS = {FRESH: "fresh", ONCE: "pressed once", LAST: "after all passes", FLATTENED: "run in"}
COLOURS = {FRESH: "#222222", ONCE: "#0072B2", LAST: "#D55E00", FLATTENED: "#009E73"}
DASHES = {FRESH: (0, (1, 1.3)), ONCE: "-", LAST: (0, (4, 1.6)), FLATTENED: (0, (7, 1.2, 1.4, 1.2))}
AXES = [{**style.LINES[name], "linewidth": 1.2} for name in MODELS]  # of stresses along x and y
SHOWN = 6  # passes of the table, the last among them
LEAST = 1e-3  # of the share of the first pass that counts: less is not drawn
OF_SURFACES = ("peak_reloaded", "length_reloaded", "ra")
SHAPES = "shape_rms", "bearing_rms", "lowered_rms"
NOTE = """Finite elements at small strains; plastic strain and back stress go from pass to pass. A
body has shaken down where a pass adds less plastic strain, to and fro, than the stated share of the
first. k = Y/√3 (von Mises)."""
OF_ROLLING = """The smooth body is endless, each pass steady. Melan's limit (Johnson 1985, section
9.2) is that of the virgin yield stress; isotropic hardening raises it pass by pass. By his theorem
the residual stresses and the hardening left let nothing flow up to p₀ = {carried} k."""
OF_PRESSING = """Surfaces: what flow leaves without the roller, and what running-in with the same
load at the hardness (the scene's, or 3 Y) makes of the fresh surface. On each an elastic half-plane
bears the load once more, without a cap; peaks are means over neighbouring pressure elements."""


def files(run: Run) -> dict[str, dict[str, np.ndarray]]:
    """cycles_stress.csv over depth; but for an endless body cycles_surface.csv over x."""
    data = run.data(NAME)
    if data is None:
        return {}
    finest = data.levels[-1]
    columns = {"z [m]": finest.z}
    for words, profile in zip(("first pass", "last pass"), finest.profile, strict=True):
        columns |= {f"sx after the {words} [Pa]": profile[:, 0]}
        columns |= {f"sy after the {words} [Pa]": profile[:, 1]}
    written = {f"{SOURCE}/cycles_stress.csv": columns}
    if data.left is not None:
        columns = {"x [m]": finest.x}
        for name, surface in data.left.by_name.items():
            columns |= {f"height {WORDS[name]} [m]": surface.height}
            columns |= {f"half-plane's pressure {WORDS[name]} [Pa]": surface.pressure}
        for words, pressure in zip(("first pass", "last pass"), finest.pressure, strict=True):
            columns |= {f"finite elements' pressure in the {words} [Pa]": pressure}
        written[f"{SOURCE}/cycles_surface.csv"] = columns
    return written


def blocks(run: Run) -> list[Block]:
    why_not = run.findings[NAME].said(WHY_NOT)
    if why_not is not None:
        return [Block("cycles", (Note(f"Cycles: {why_not}."),), "Cycles")]
    data = run.data(NAME)
    pictures = Pictures(("cycles_passes", "cycles_stress"), abreast=True)
    verdict = Note(f"The body {run.findings[NAME].said(VERDICT)}.".replace("p0", "p₀"))
    if data.left is None:
        carried = significant(run.figures.one(study=NAME, quantity="carried").value, 3)
        note = Note(f"{NOTE} {OF_ROLLING.format(carried=carried)}")
        items = (verdict, pictures, passes_table(run), note)
    else:
        shown = Pictures(("cycles_surface",)), surfaces_table(run)
        items = (verdict, pictures, passes_table(run), *shown, Note(f"{NOTE} {OF_PRESSING}"))
    return [Block("cycles", items, "Cycles")]


def passes_table(run: Run) -> TextTable:
    """The first passes and the last, on the finest level."""
    series = run.findings[NAME].table("passes")
    rows, cells = series.rows(), []
    first = rows[0]["flow"] or 1.0
    for row in rows[: SHOWN - 1] + rows[SHOWN - 1 :][-1:]:
        units = ("plastic_work", "residual", "residual_depth", "peak", "length")
        texts = (with_unit(row[name], series.columns[name].unit, 3) for name in units)
        texts = (text.replace("^2", "²") for text in texts)
        added = significant(row["flow"], 3), percent(row["flow"] / first)
        cells.append((str(row["pass"]), *added, significant(row["net"], 3), *texts))
    head = ("pass", "plastic strain added", "of the first", "of it stays", "plastic work")
    return TextTable("", (*head, "residual σx", "its depth", "peak", "length"), tuple(cells))


def surfaces_table(run: Run) -> TextTable:
    """What the half-plane bears on each surface, the finite elements beside it, and shapes."""
    known, rows = run.figures.of(study=NAME), []

    def cell(figure: Figure | None) -> str:
        return (
            "" if figure is None else with_unit(figure.value, QUANTITIES[figure.quantity].unit, 3)
        )

    for name in run.data(NAME).left.by_name:
        texts = (cell(known.one(quantity=quantity, source=name)) for quantity in OF_SURFACES)
        rows.append((WORDS[name], *texts))
    last = (cell(known.one(quantity=quantity)) for quantity in ("peak_last", "length_last"))
    rows.append(("finite elements, last pass", *last, ""))
    for quantity in SHAPES:
        figure = known.one(quantity=quantity)
        if figure is not None:
            rows.append((QUANTITIES[quantity].label, "", "", cell(figure)))
    return TextTable("", ("surface", "peak", "contact length", "Ra, rms"), tuple(rows))


def lines(run: Run) -> list[tuple[str, str]]:
    """The verdict; what pressing flat misses; or why nothing was done."""
    findings, known = run.findings[NAME], run.figures.of(study=NAME)
    why_not = findings.said(WHY_NOT)
    if why_not is not None:
        return [("cycles", f"not done: it {why_not}")]
    said = [("cycles", f"the body {findings.said(VERDICT)}")]
    flat, once = (known.one(quantity="peak_reloaded", source=name) for name in (FLATTENED, ONCE))
    if flat is not None:
        lengths = [
            known.one(quantity="length_reloaded", source=f.source).value for f in (flat, once)
        ]
        peak, length = flat.value / once.value - 1.0, lengths[0] / lengths[1] - 1.0
        text = "the half-plane on the surface that was pressed flat, against that which flow left: "
        text += f"peak {percent(peak, signed=True)}, length {percent(length, signed=True)}"
        said.append(("run in", text))
    return said


def passes_picture(run: Run) -> style.Picture | None:
    """Plastic strain by pass, on every level."""
    data = run.data(NAME)
    if data is None:
        return None
    abreast, room = names_above(style.COLUMN, 4)
    drawn, [panel] = panels(style.COLUMN, [(room, 2.4)])
    looks = zip(data.levels[::-1], COLOURS.values(), style.DASHES, strict=False)
    for level, colour, dash in looks:
        numbers = np.arange(1, len(level.passes.flow) + 1)
        flow = np.where(level.passes.flow > 0.0, level.passes.flow, np.nan)
        label = f"elements of {with_unit(level.pitch, 'm', 2)}"
        look = {"color": colour, "linestyle": dash, "marker": "o", "markersize": 3}
        panel.plot(numbers, flow, label=label, **look)
    first = data.levels[-1].passes.flow[0]
    if first:
        share = run.problem.scene.cycles.share
        label = f"{percent_as_written(share)} of the first"
        panel.axhline(share * first, label=label, **style.REFERENCE)
        panel.set_yscale("log")
        low, _ = panel.get_ylim()
        panel.set_ylim(max(low, LEAST * share * first))
    panel.set_ylabel("plastic strain added")
    panel.set_xlabel("pass")
    panel.xaxis.get_major_locator().set_params(integer=True)
    legend_above(panel, abreast)
    caption = "Largest equivalent plastic strain that each pass adds, to and fro."
    return style.picture(drawn, caption, caption)


def stress_picture(run: Run) -> style.Picture | None:
    """Residual stresses over depth."""
    data = run.data(NAME)
    if data is None:
        return None
    finest = data.levels[-1]
    abreast, room = names_above(style.COLUMN, 4)
    drawn, [panel] = panels(style.COLUMN, [(room, 2.4)])
    unit = scale_of(finest.z, "m")
    first, last = (profile.T for profile in finest.profile)
    for axis, look, *parts in zip("xy", AXES, first, last, strict=True):
        curves = {n: (finest.z, p / 1e6) for n, p in zip(("first", "last"), parts, strict=True)}
        for names, (z, stress) in distinct(curves).items():
            # the first over the last, which is wide and pale: both are seen where they coincide
            beside = style.PALE if names == ("last",) else {}
            words = f"σ{axis}, {' = '.join(names)} pass"
            panel.plot(z / unit.factor, stress, label=words, **{**look, **beside})
    panel.axhline(0.0, **style.OUTLINE)
    panel.set_ylabel("residual stress [MPa]")
    over([panel], f"z [{unit.name}]", finest.z / unit.factor)
    legend_above(panel, abreast)
    place = "at every place along x" if data.left is None else "below the largest pressure"
    caption = f"Residual stresses without the roller over depth, {place}."
    return style.picture(drawn, caption, caption)


def surface_picture(run: Run) -> style.Picture | None:
    """The surfaces, and the half-plane's pressures on each."""
    data = run.data(NAME)
    if data is None or data.left is None:
        return None
    caption = (
        "Surfaces about their mean height, heights stretched, and the pressures of an elastic "
        "half-plane that bears the load on each."
    )
    return style.picture(lambda width: _surfaces(data.left, width), caption, caption)


def _surfaces(left: LeftSurfaces, width: float) -> "Drawn":
    abreast, room = names_above(width, len(left.by_name))
    drawn, [top, below] = panels(width, [(room, 2.0), (0.14, 2.0)])
    aside = 0.1 * (left.stretch[1] - left.stretch[0])
    shown = (left.x >= left.stretch[0] - aside) & (left.x <= left.stretch[1] + aside)
    unit = scale_of(left.x, "m")
    heights = scale_of([np.ptp(left.by_name[ONCE].height[shown])], "m")
    x = left.x[shown] / unit.factor
    for name, surface in left.by_name.items():
        look = {"color": COLOURS[name], "linestyle": DASHES[name], "linewidth": 1.0}
        height = surface.height - surface.height[shown].mean()
        top.plot(x, height[shown] / heights.factor, label=WORDS[name], **look)
        below.plot(x, surface.pressure[shown] / 1e9, **look)
    top.set_ylabel(f"height [{heights.name}]")
    below.set_ylabel("pressure [GPa]")
    over([top, below], f"x [{unit.name}]", x)
    legend_above(top, abreast)
    return drawn


PICTURES = {
    "cycles_passes": passes_picture,
    "cycles_stress": stress_picture,
    "cycles_surface": surface_picture,
}
