"""Subsurface stresses of the half-plane and of the whole model, or of the finite elements where
there is no other: fields on one colour scale, their difference on its own, and sections over depth,
after Bailey and Sayles (1991), figure 11."""

import math
from dataclasses import dataclass
from operator import sub
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import decimal, percent_as_written, plain, significant
from comparisons.drawing import style
from comparisons.drawing.curves import (
    COINCIDE,
    Curve,
    distinct,
    joint_label,
    joint_legend,
    names_above,
    panels,
)
from comparisons.drawing.field import COVERED, ColourScale, FieldPanel, draw_fields
from comparisons.figures.quantity import LABELS, WHOLE
from comparisons.judging.contact import peak_position
from comparisons.judging.study import MODEL_ERROR, Run
from comparisons.models.level import STRAIN
from comparisons.models.smooth import closed_form
from comparisons.studies.quiescent_zone import NAME as ZONE
from comparisons.studies.quiescent_zone import zones_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NEAR = 0.1  # half-widths: depth of what is enlarged next to the surface
STRETCHED = 1.25  # inches: height of fields next to the surface
FEWEST_ROWS = 4
SLIGHT, BELOW = 0.01, 1.5  # of the largest plastic strain; depths to which it is drawn, of its own
# Triangles of three points in one of six.
QUARTERS = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])
TITLE, TALL, FOOT = 0.3, 1.65, 0.46  # inches, of sections
LEFT, RIGHT, BETWEEN = 0.616, 0.392, 0.28  # inches
MOST_NAMES = 6  # of lines in a section


@dataclass(frozen=True)
class Component:
    """A drawn stress: name in result files, sign and words in the page, colours of its bands."""

    name: str
    largest: str  # of its size, as figures have it
    symbol: str
    words: str
    colours: str
    signed: bool


COMPONENTS = (
    Component("tau1", "tau1_max", "τ₁", "principal shear stress", "viridis", signed=False),
    Component("txz", "txz_max_abs", "τxz", "orthogonal shear stress", "RdBu_r", signed=True),
)


def field_pictures(run: Run) -> list[style.Picture]:
    """Pictures of each component, one a friction coefficient; none without fields."""
    if run.window is None:
        return []
    return [
        picture
        for component in COMPONENTS
        for picture in _pictures(run, component, "under the contact", len(run.window.z))
    ]


def near_surface_pictures(run: Run) -> list[style.Picture]:
    """The principal shear next to a rough surface, depths stretched; one a friction coefficient."""
    if run.window is None or run.problem.scene.profile is None:
        return []
    depths = run.window.z
    rows = int(np.count_nonzero(depths <= NEAR * run.problem.hertz.half_width))
    if rows < FEWEST_ROWS or rows == len(depths):
        return []
    return _pictures(run, COMPONENTS[0], "next to the surface", rows, STRETCHED)


def _pictures(
    run: Run, component: Component, place: str, rows: int, height: float | None = None
) -> list[style.Picture]:
    """One a friction coefficient, of the window's first `rows` depths, `height` inches tall or
    to scale; all on the same colour scales."""
    hertz, window, frictions = run.problem.hertz, run.window, run.frictions
    x, z = window.x / hertz.half_width, window.z[:rows] / hertz.half_width
    fields = [
        {
            name: getattr(level.stress.field, component.name)[:rows] / hertz.peak_pressure
            for name, level in run.pair(friction).items()
        }
        for friction in frictions
    ]
    every = [values for models in fields for values in models.values()]
    label, look = f"{component.symbol}/p₀", (component.colours, component.signed)
    scale = ColourScale.over(label, every, *look)
    shown = [_panels(run, component, *pair) for pair in zip(frictions, fields, strict=True)]
    apart = [sub(*m.values()) for m, p in zip(fields, shown, strict=True) if len(p) > 1]
    of_differences = ColourScale.of_differences(f"Δ{label}", apart) if apart else None
    pictures = []
    for friction, models, drawn_as in zip(frictions, fields, shown, strict=True):
        difference, notes = None, ""
        if len(drawn_as) > 1:
            difference = " − ".join(LABELS[name] for name in models), of_differences
        if len(models) > 1:
            end = of_differences.bands[-1] if difference else None
            notes = _difference_said(x, z, sub(*models.values()), end)
        drawn = draw_fields(x, z, drawn_as, scale, height, difference)
        words = f"{component.words.capitalize()} {component.symbol} {place}"
        words += f", friction {plain(friction)}"
        striped = ", stripes what is negative" if component.signed or difference else ""
        if any(np.isnan(values).any() for values in models.values()):
            notes += " White: hollows below the mean line, from which z counts."
        if WHOLE in models:
            notes += " Of the whole model each point stands where it was before loading."
        alternative = f"{words}. {'; '.join(panel.title for panel in drawn_as)}.{notes}"
        caption = f"{words}; + marks the largest value{striped}.{notes}"
        pictures.append(style.picture(drawn, alternative, caption, data=False))
    return pictures


def _panels(
    run: Run, component: Component, friction: float, models: dict[str, np.ndarray]
) -> list[FieldPanel]:
    """A field for each model; the last alone where it is the first's, within COINCIDE or what is
    uncertain of the largest value's model error."""
    *others, last = models.values()
    if others:
        error = run.figures.one(study=MODEL_ERROR, quantity=component.largest, friction=friction)
        unsure = error.numerical if error and math.isfinite(error.numerical) else 0.0
        limit = max(COINCIDE, unsure) * np.nanmax(np.abs(last))
        if np.nanmax(np.abs(others[0] - last)) <= limit:
            return [_panel(run, tuple(models), friction, component, last)]
    return [_panel(run, (name,), friction, component, models[name]) for name in models]


def _panel(
    run: Run, names: tuple[str, ...], friction: float, component: Component, values: np.ndarray
) -> FieldPanel:
    """The field of models, of the last where there are several, under its largest value, which is
    marked where it is inside."""
    hertz, level = run.problem.hertz, run.pair(friction)[names[-1]]
    extreme = level.stress.extremes[component.name]
    mark = extreme.x / hertz.half_width, extreme.z / hertz.half_width
    largest = f"largest |{component.symbol}|" if component.signed else "largest"
    largest += f" {significant(abs(extreme.value) / hertz.peak_pressure)} p₀"
    title = (
        f"{'both models' if names[1:] else LABELS[names[0]]}: {largest} at "
        f"x = {decimal(mark[0])} a, z = {significant(mark[1], 3)} a"
    )
    inside = extreme.z <= run.window.z[len(values) - 1]
    return FieldPanel(title, values, mark if inside else None)


def _difference_said(
    x: np.ndarray, z: np.ndarray, difference: np.ndarray, end: float | None
) -> str:
    """Where the colours of the difference end and why there, or why it has none; its largest
    value."""
    row, column = np.unravel_index(np.nanargmax(np.abs(difference)), difference.shape)
    largest = difference[row, column]
    near = percent_as_written(COINCIDE)
    said = f"Both models coincide, within {near} of the largest value or what is uncertain of it"
    if end is not None:
        covers = f", which covers {COVERED:g} % of the points or more, to show what is small"
        reason = covers if abs(largest) > end else ""
        said = f"The difference's colours end at ±{significant(end, 2)} p₀{reason}"
    return (
        f" {said}; the largest difference at a point of the grid, {significant(largest, 2)} p₀, "
        f"stands at x = {decimal(x[column])} a, z = {significant(z[row], 2)} a."
    )


def plastic_strain_pictures(run: Run) -> list[style.Picture]:
    """The equivalent plastic strain by the last model, where it flows; one a friction coefficient.
    None without fields."""
    frictions = run.frictions if run.window is not None else ()
    return list(filter(None, (_strain_picture(run, friction) for friction in frictions)))


def _strain_picture(run: Run, friction: float) -> style.Picture | None:
    from matplotlib.tri import LinearTriInterpolator, Triangulation

    half_width, window = run.problem.hertz.half_width, run.window
    name, level = list(run.levels(friction).items())[-1]
    if not level.plastic_strain:
        return None
    on_mesh = level.field_on_mesh
    strain, corners = 100.0 * on_mesh.others[STRAIN], on_mesh.triangles
    if corners.shape[1] > 3:
        corners = corners[:, QUARTERS].reshape(-1, 3)
    at = LinearTriInterpolator(Triangulation(*on_mesh.points.T, corners), strain)
    values = np.ma.filled(at(*np.meshgrid(window.x, window.z)), np.nan)
    x, z = window.x / half_width, window.z / half_width
    flows = np.nanmax(values, axis=1, initial=0.0) > SLIGHT * strain.max()
    rows = max(FEWEST_ROWS, np.count_nonzero(z <= BELOW * z[flows].max(initial=0.0)))
    place, depth = on_mesh.points[strain.argmax()] / half_width
    inside = x[0] <= place <= x[-1] and depth <= z[rows - 1]
    title = f"{LABELS[name]}: largest {significant(strain.max(), 3)} % at x = {decimal(place)} a, "
    title += f"z = {significant(depth, 2)} a"
    panel = FieldPanel(title, values[:rows], (place, depth) if inside else None)
    scale = ColourScale.over("ε̄ₚ [%]", [values[:rows]], "YlOrRd")
    drawn = draw_fields(x, z[:rows], [panel], scale)
    words = f"Equivalent plastic strain under the load, friction {plain(friction)}"
    caption = f"{words}, as far down as the body flows; + marks the largest value."
    return style.picture(drawn, f"{words}. {title}.", caption, data=False)


def section_pictures(run: Run) -> list[style.Picture]:
    """The principal shear over depth, through the highest pressure of the last model and through
    the edge of the smooth contact; none without field. The verticals are the columns of the common
    window that lie nearest."""
    if run.window is None:
        return []
    [*_, last] = run.levels(run.deciding_friction).values()
    wanted = {
        "the highest pressure": peak_position(last),
        "the edge of the smooth contact, x = +a": run.problem.hertz.half_width,
    }
    x = run.window.x
    spacing = x[1] - x[0]
    places = {
        words: int(np.argmin(np.abs(x - place)))
        for words, place in wanted.items()
        if x[0] - spacing <= place <= x[-1] + spacing
    }
    return [_section_picture(run, column, words) for words, column in places.items()]


def _section_picture(run: Run, column: int, words: str) -> style.Picture:
    hertz, frictions, said = run.problem.hertz, run.frictions, []
    abreast, top = names_above(style.COLUMN, MOST_NAMES)
    depths = [run.window.z[-1] / hertz.half_width]
    if run.problem.scene.profile is not None and depths[0] > 2.0 * NEAR:
        depths.append(NEAR)
    rows = [(top + 0.08, TALL), *[(TITLE, TALL)] * (len(frictions) - 1)]
    drawn, every = panels(style.COLUMN, rows, LEFT, RIGHT, FOOT, len(depths), BETWEEN)
    for friction, row in zip(frictions, np.reshape(every, (-1, len(depths))), strict=True):
        curves = _curves(run, friction, column)
        for panel, depth in zip(row, depths, strict=True):
            _section(panel, run, column, friction, curves, depth)
            panel.tick_params(labelbottom=friction == frictions[-1], labelleft=panel is row[0])
        for panel in row:
            panel.set_ylim(0.0, max(p.dataLim.y1 for p in row) * 1.08)
        row[0].set(title=f"friction {plain(friction)}", ylabel="τ₁/p₀")
        largest = (f"{LABELS[n]} {significant(np.nanmax(v), 3)} p₀" for n, (_, v) in curves.items())
        said.append(f"friction {plain(friction)}: {', '.join(largest)}")
    for panel in row:
        panel.set_xlabel("z/a")
    look = {"borderaxespad": 0.1, "columnspacing": 1.2}
    joint_legend(drawn, abreast, bbox_to_anchor=(0.1, 1.0), **look)
    at = decimal(run.window.x[column] / hertz.half_width)
    near = f" The right half enlarges the first {NEAR} a." if len(depths) > 1 else ""
    return style.picture(
        drawn,
        f"Principal shear over depth through {words}. Largest: {'; '.join(said)}.",
        f"Principal shear stress τ₁ over depth through {words} (x = {at} a), with the exact "
        f"section of the smooth contact at the same x.{near} Largest: {'; '.join(said)}.",
    )


def _curves(run: Run, friction: float, column: int) -> dict[str, Curve]:
    """Every model's over z/a."""
    hertz, levels = run.problem.hertz, run.levels(friction)
    z, p0 = run.window.z / hertz.half_width, hertz.peak_pressure
    fields = {name: level.stress.field for name, level in levels.items()}
    return {name: (z, field.tau1[:, column] / p0) for name, field in fields.items()}


def _zones(run: Run, friction: float) -> list[tuple[float, float]]:
    """Ends of the first model's quiescent zone."""
    half_width, first = run.problem.hertz.half_width, next(iter(run.runs))
    return [
        tuple(zone.figures[name].value / half_width for name in ("start", "stop"))
        for zone in zones_of(run.findings.get(ZONE))
        if (zone.model, zone.friction) == (first, friction) and "start" in zone.figures
    ]


def _section(
    axes: "Axes",
    run: Run,
    column: int,
    friction: float,
    curves: dict[str, Curve],
    depth: float,
) -> None:
    hertz = run.problem.hertz
    x, z = run.window.x[column], run.window.z
    shown = z <= 1.000001 * depth * hertz.half_width
    at = z[shown] / hertz.half_width
    for names, (_, values) in distinct(curves).items():
        axes.plot(at, values[shown], label=joint_label(names), **style.LINES[names[0]])
    smooth = closed_form(run.problem)
    if smooth is not None:
        exact = smooth.stress(x, z[shown], friction).tau1 / hertz.peak_pressure
        axes.plot(at, exact, label=f"{smooth.name}, exact", **style.REFERENCE)
    for ends in _zones(run, friction):
        axes.axvspan(*ends, color="#009E73", alpha=0.14, linewidth=0.0, label="quiescent zone")
    axes.set_xlim(0.0, depth)
    axes.locator_params(axis="x", nbins=5, prune="upper")  # the last would meet the next panel's
