"""Pictures seen first: each judged figure's error against its tolerance, and the run in one
picture, everything over the same x."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, plain, significant
from comparisons.drawing import style
from comparisons.drawing.curves import over, panels
from comparisons.drawing.field import ColourScale, FieldPanel, colour_bar, draw_field
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, label
from comparisons.judging.contact import seen
from comparisons.judging.study import Run
from comparisons.output.page.pictures.contact import draw_stack

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn

LEFT, RIGHT = 0.78, 0.14  # inches
# Inches above a panel, and of the panel.
PRESSURES, DIFFERENCES, SURFACES = (0.08, 2.1), (0.3, 0.5), (0.14, 0.9)
SHEAR, BAR = (0.3, 1.8), (0.44, 0.1)
FOOT = 0.26  # inches
ROOM = 0.15  # beside the contact, of half of it

ROW, TOP, BOTTOM = 0.56, 0.34, 0.5  # inches: of a bar and its words, and the space around all bars
THICK, ABOVE = 0.34, 0.23  # of a row: a bar, and from its middle up to its words
FARTHEST = 6.0  # tolerances: what is beyond is cut off
COLOURS = {"holds": "#0b5c8f", "fails": "#a8410a", "inconclusive": "#8a9199"}
WORDS = COLOURS | {"inconclusive": "#565c63"}  # in a darker grey


def overview_picture(run: Run) -> style.Picture:
    """Pressures, the difference of models, surfaces under load, and the shear below."""
    said = "Over the same x: pressures over Hertz's"
    if len(run.runs) > 1:
        said += f", how far models are apart ({_models(run, run.deciding_friction)})"
    said += ", surfaces under load with heights stretched"
    if run.window is not None:
        said += ", principal shear stress τ₁ below"
    largest = "" if run.window is None else f" {_largest(run)}."
    drawn = overview(run, style.COLUMN)
    alternative = f"The run in one picture: pressures, surfaces under load.{largest}"
    return style.picture(drawn, alternative, f"{said}.", data=False)


def overview(run: Run, width: float) -> "Drawn":
    """The picture, so many inches wide."""
    hertz, friction = run.problem.hertz, run.deciding_friction
    compares, window, across = len(run.runs) > 1, run.window, seen(run, ROOM)
    rows = [PRESSURES, *[DIFFERENCES] * compares, SURFACES, *[SHEAR, BAR] * (window is not None)]
    foot = FOOT if window is not None else style.LABEL + 0.15
    drawn, axes = panels(width, rows, LEFT, RIGHT, foot)
    bar = axes.pop() if window is not None else None
    ends = across[0] / hertz.half_width, across[1] / hertz.half_width
    draw_stack(axes, run, across, Scale(hertz.half_width, "a"))
    if compares:
        axes[1].set_title(_models(run, friction))
    if window is not None:
        _shear(axes[-1], bar, run, ends)
        axes[-1].set_ylim(window.z[-1] / hertz.half_width, 0.0)
    for panel in axes:
        panel.yaxis.set_label_coords(-0.8 * LEFT / (width - LEFT - RIGHT), 0.5)
    over(axes, "x/a", ends)
    return drawn


def _models(run: Run, friction: float) -> str:
    """Models whose pressures are subtracted."""
    return " − ".join(LABELS[name] for name in run.pair(friction))


def _shear(axes: "Axes", bar: "Axes", run: Run, across: tuple[float, float]) -> None:
    """The last model's principal shear; its largest is marked where it lies between two x/a."""
    hertz, window, friction = run.problem.hertz, run.window, run.deciding_friction
    [*_, last] = run.levels(friction).values()
    stress = last.stress
    field, place = stress.field.tau1 / hertz.peak_pressure, stress.extremes["tau1"]
    mark = place.x / hertz.half_width, place.z / hertz.half_width
    mark = mark if across[0] <= mark[0] <= across[1] else None
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    scale = ColourScale.over("τ₁/p₀", [field])
    shown = draw_field(axes, x, z, FieldPanel(_largest(run), field, mark), scale)
    colour_bar(bar, shown, scale)


def _largest(run: Run) -> str:
    """Largest principal shear, which is drawn, of the last model, and of the first one."""
    friction, p0 = run.deciding_friction, run.problem.hertz.peak_pressure
    largest = {
        name: significant(level.stress.extremes["tau1"].value / p0, 3)
        for name, level in run.levels(friction).items()
    }
    [*others, last] = largest
    beside = f" ({LABELS[others[0]]} {largest[others[0]]} p₀)" if others else ""
    return f"τ₁, {LABELS[last]}, μ = {plain(friction)}: largest {largest[last]} p₀ at +{beside}"


def judged_picture(run: Run) -> style.Picture | None:
    """A bar for each judged model error in tolerances; None where nothing is judged."""
    errors = list(run.model_errors)
    if not errors:
        return None
    drawn = style.figure(style.COLUMN, TOP + ROW * len(errors) + BOTTOM)
    [axes] = style.stacked(drawn, [(TOP, ROW * len(errors))], 0.15, 0.15)
    ends = [abs(e.value) + e.numerical + e.not_modelled for e in errors]
    most = max(end / e.tolerance for end, e in zip(ends, errors, strict=True))
    reach = min(max(1.5, 1.1 * most), FARTHEST) if np.isfinite(most) else FARTHEST
    axes.set(xlim=(-reach, reach), ylim=(0.6 - len(errors), 0.85), yticks=[])
    axes.axvspan(-1.0, 1.0, color="#e8eef2", linewidth=0.0, zorder=0.5)
    for row, error in enumerate(errors):
        _bar(axes, -float(row), error, several=len(run.frictions) > 1)
    rows = -np.arange(float(len(errors)))  # between them the line would cross words
    axes.vlines(0.0 * rows, rows - 0.55, rows + ABOVE, color="#555555", linewidth=0.7)
    axes.spines["left"].set_visible(False)
    axes.grid(False, axis="y")
    axes.set(xlabel="model error / tolerance", title="within the tolerance: shaded")
    words = "; ".join(
        f"{label(e.quantity)}, friction {plain(e.friction)}: {e.words()}" for e in errors
    )
    return style.picture(
        drawn,
        f"The half-plane's model errors over their tolerances. {words}.",
        "The half-plane's model error in each judged figure over its tolerance, to the left where "
        "the half-plane's is too low. Black: its uncertainty. Striped: what may be added by what "
        "no model of the run has. What reaches beyond the picture is cut off.",
        data=False,
    )


def _bar(axes: "Axes", y: float, error: Figure, several: bool) -> None:
    """A bar from zero to the error, its uncertainty, what is not modelled, and words above."""
    at, colour = error.value / error.tolerance, COLOURS[error.verdict]
    certain, left = (size / error.tolerance for size in (error.numerical, error.not_modelled))
    limit = axes.get_xlim()[1]
    low, high = np.clip([at - certain - left, at + certain + left], axes.get_xlim()[0], limit)
    axes.barh(y, np.clip(at, -limit, limit), height=THICK, color=colour, linewidth=0.0)
    if left > 0.0:
        look = {"facecolor": "none", "edgecolor": "#555555", "linewidth": 0.0, **style.HATCHED}
        axes.barh(y, high - low, left=low, height=THICK, **look)
    if np.isfinite(certain):
        style.whisker(axes, at, y, (certain, certain))
    sliding = f", μ = {plain(error.friction)}" if several else ""
    name = label(error.quantity).replace("principal shear stress ", "")  # room for the error
    named = axes.text(axes.get_xlim()[0], y + ABOVE, name + sliding, va="bottom")
    # next to it: what a narrow screen shows first
    beside = {"xycoords": named, "xytext": (8, 0), "textcoords": "offset points"}
    look = {"color": WORDS[error.verdict], "weight": "bold", "va": "bottom"}
    axes.annotate(error.words(), (1.0, 0.0), **beside, **look)
