"""Subsurface fields of the half-plane and of the whole model, or of the finite elements where there
is no other, on one colour scale; and their difference on its own."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from operator import sub
from typing import TYPE_CHECKING

import numpy as np

from analytic.stress_state import Extremum, StressState
from comparisons.common.numbers import decimal, plain, significant
from comparisons.drawing.style import COLUMN, Picture, data_uri, figure, hatch, stacked
from comparisons.figures.quantity import LABELS, WHOLE
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

LEFT, WIDTH = 0.62, COLUMN - 0.85  # inches, of a field
TITLE, FOOT, BAR, BAR_LABEL, INSET = 0.28, 0.42, 0.1, 0.34, 0.36  # inches
BANDS = 16  # of colour on the whole scale, about
COVERED = 99.5  # per cent of a field's points that its scale covers at least
NOTHING = 1e-12  # p0: a difference below it is none
PIXELS = 220  # to the inch
SMALLEST_POWER = -2  # of ten: smaller ticks are written with the power apart
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MOST_TICKS = 9  # of a colour bar
STRIPES = 0.045, 0.3  # inches from one to the next, and the share that each covers
SHADE = 0.22  # of black, of a stripe
ROUND = np.array([1.0, 2.0, 2.5, 5.0, 10.0])  # steps of a scale, times a power of ten


def round_bands(fields: list[np.ndarray], signed: bool) -> np.ndarray:
    """Ascending bounds in round steps, symmetric if `signed`, that cover nearly every point."""
    top = max(max(np.nanpercentile(np.abs(field), COVERED) for field in fields), NOTHING)
    wanted = (2.0 if signed else 1.0) * top / BANDS
    power = 10.0 ** np.floor(np.log10(wanted))
    step = power * ROUND[np.searchsorted(ROUND, wanted / power * (1.0 - 1e-9))]
    count = int(np.ceil(top / step * (1.0 - 1e-9)))
    # zero lies inside the middle band of a signed scale, so that noise about it has one colour
    return step * (np.arange(-count, count + 2) - 0.5 if signed else np.arange(count + 1.0))


def cross(axes: "Axes", x: float, z: float) -> None:
    """Mark a point so that it is seen on every colour."""
    for colour, thick in (("white", 2.6), ("black", 1.1)):
        look = {"color": colour, "markersize": 7.5, "markeredgewidth": thick, "clip_on": False}
        axes.plot(x, z, marker="+", **look)


def layout(models: int, height: float) -> "tuple[Figure, list[Axes], list[Axes]]":
    """An empty figure, its fields from top to bottom, and its colour bars. The models stand above
    one bar; with two models their difference follows, above another."""
    block, bar = (TITLE, height), (FOOT, BAR)
    panels = [block] * models + [bar]
    if models > 1:
        panels += [(BAR_LABEL + TITLE, height), bar]
    drawn = figure(COLUMN, sum(map(sum, panels)) + BAR_LABEL)
    places = stacked(drawn, panels, LEFT, COLUMN - LEFT - WIDTH)
    bars = places[models::2]
    places = places[:models] + places[models + 1 :: 2]
    for axes in bars:
        box, inset = axes.get_position(), INSET / COLUMN
        axes.set_position((box.x0 + inset, box.y0, box.width - inset, box.height))
    for axes in places[: models - 1]:
        axes.tick_params(labelbottom=False)
    places[models - 1].set_xlabel("x/a")
    return drawn, places, bars


def fill(
    axes: "Axes",
    x: np.ndarray,
    z: np.ndarray,
    values: np.ndarray,
    bands: np.ndarray,
    colours: str,
    signed: bool,
) -> "ScalarMappable":
    """Bands of colour, drawn as pixels: as curves they would take megabytes.

    bands   in equal steps
    What is negative is striped, so that a grey printer leaves the sign.
    """
    import matplotlib
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm

    colour_map = matplotlib.colormaps[colours]
    norm = BoundaryNorm(bands, colour_map.N, extend="both" if signed else "max")
    scale, step = ScalarMappable(norm, colour_map), bands[1] - bands[0]
    # a colour for each band, below and beyond them, and none where there is no value
    middles = bands[0] + step * (np.arange(-1, len(bands)) + 0.5)
    table = np.vstack([scale.to_rgba(middles, bytes=True), np.zeros(4, dtype=np.uint8)])
    pixels = (_pixels(axes, x, z, values) - bands[0]) / step
    band = np.clip(np.floor(pixels), -1.0, len(bands) - 1.0) + 1.0
    band = np.where(np.isnan(band), len(middles), band).astype(np.uint8)
    if signed:
        table = np.vstack([table, table])
        table[len(middles) + 1 :, :3] = (1.0 - SHADE) * table[: len(middles) + 1, :3]
        negative = np.count_nonzero(bands < 0.0)
        band[_stripes(band.shape) & (band < negative)] += len(middles) + 1
    axes.imshow(table[band], interpolation="none", aspect="auto", extent=(x[0], x[-1], z[-1], z[0]))
    axes.set(xlim=(x[0], x[-1]), ylim=(z[-1], z[0]), ylabel="z/a")
    axes.grid(False)
    return scale


def _pixels(axes: "Axes", x: np.ndarray, z: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The field on even pixels, linear between the window's points."""
    box, (wide, tall) = axes.get_position(), axes.figure.get_size_inches()
    columns, rows = int(PIXELS * box.width * wide), int(PIXELS * box.height * tall)
    across = x[0] + (np.arange(columns) + 0.5) / columns * (x[-1] - x[0])
    down = z[0] + (np.arange(rows) + 0.5) / rows * (z[-1] - z[0])
    return _between(x, across, _between(z, down, values).T).T


def _between(places: np.ndarray, wanted: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Rows of values at ascending places, linear in between, at the wanted places."""
    at = np.interp(wanted, places, np.arange(len(places)))
    before = np.minimum(at.astype(int), len(places) - 2)
    share = (at - before)[:, None]
    return (1.0 - share) * values[before] + share * values[before + 1]


@cache
def _stripes(shape: tuple[int, int]) -> np.ndarray:
    """Which pixels are struck."""
    apart, share = STRIPES
    down, across = np.arange(shape[0])[:, None], np.arange(shape[1])
    return ((down + across) / (apart * PIXELS)) % 1.0 < share


def colour_bar(
    drawn: "Figure", axes: "Axes", shown: "ScalarMappable", label: str, bands: np.ndarray
) -> None:
    """The scale under a field: ticks in round steps, at zero if it is on the scale."""
    bar = drawn.colorbar(shown, cax=axes, orientation="horizontal")
    bar.outline.set_linewidth(0.5)
    step = bands[1] - bands[0]
    apart = step * (1 + len(bands) // MOST_TICKS)
    ticks = apart * np.arange(np.ceil(bands[0] / apart), np.floor(bands[-1] / apart * 1.000001) + 1)
    power = int(np.floor(np.log10(ticks[-1])))
    if power < SMALLEST_POWER:
        label = f"{label}\n× 10{str(power).translate(SUPERSCRIPT)}"
    else:
        power = 0
    labels = [f"{tick * 10.0**-power:.4g}" for tick in ticks]
    bar.set_ticks(ticks, labels=[text.replace("-", "−") for text in labels])
    bar.minorticks_off()
    if bands[0] < 0.0:
        ends = [bands[0], -0.5 * step]
        negative = axes.fill([*ends, *reversed(ends)], [0.0, 0.0, 1.0, 1.0], facecolor="none")
        hatch(axes, negative, (0.0, 0.0, 0.0, SHADE))
    axes.tick_params(length=2.0, pad=1.5)
    beside = {"xytext": (-18, 0), "xycoords": "axes fraction", "textcoords": "offset points"}
    axes.annotate(label, (0.0, 0.5), **beside, ha="right", va="center")


LOW, TALL = 0.9, 2.6  # inches: least and greatest height of a field
NEAR = 0.1  # half-widths: depth of the pictures next to the surface
STRETCHED = 1.25  # inches: their height
FEWEST_ROWS = 4


@dataclass(frozen=True)
class Component:
    """A drawn stress: name in result files, sign and words in the page, colours of its bands."""

    name: str
    symbol: str
    words: str
    colours: str
    signed: bool
    of: Callable[[StressState], np.ndarray]


COMPONENTS = (
    Component("tau1", "τ₁", "principal shear stress", "viridis", False, lambda s: s.tau1),
    Component("txz", "τxz", "orthogonal shear stress", "RdBu_r", True, lambda s: s.txz),
)
DIFFERENCE_COLOURS = "PuOr_r"


@dataclass(frozen=True)
class FieldView:
    """What a picture shows: the window's first `rows` depths, drawn `height` inches tall."""

    rows: int
    height: float
    words: str


def field_pictures(outcome: Run) -> list[tuple[float, list[Picture]]]:
    """For every friction coefficient a picture of each component; nothing without fields."""
    window = outcome.window
    if window is None:
        return []
    height = float(np.clip(WIDTH * np.ptp(window.z) / np.ptp(window.x), LOW, TALL))
    view = FieldView(len(window.z), height, "under the contact")
    by_component = [_pictures(outcome, component, view) for component in COMPONENTS]
    return [
        (friction, [pictures[k] for pictures in by_component])
        for k, friction in enumerate(outcome.problem.scene.load.friction)
    ]


def near_surface_pictures(outcome: Run) -> list[Picture]:
    """The principal shear next to a rough surface, depths stretched; one a friction coefficient."""
    window = outcome.window
    if window is None or outcome.problem.scene.profile is None:
        return []
    rows = int(np.count_nonzero(window.z <= NEAR * outcome.problem.hertz.half_width))
    if rows < FEWEST_ROWS or rows == len(window.z):
        return []
    return _pictures(outcome, COMPONENTS[0], FieldView(rows, STRETCHED, "next to the surface"))


def _pictures(outcome: Run, component: Component, view: FieldView) -> list[Picture]:
    """One a friction coefficient, all on the same colour scales."""
    p0 = outcome.problem.hertz.peak_pressure
    fields = [
        {
            name: component.of(level.stress(friction).field)[: view.rows] / p0
            for name, level in outcome.pair(friction).items()
        }
        for friction in outcome.problem.scene.load.friction
    ]
    bands = round_bands([f for models in fields for f in models.values()], component.signed)
    differences = [sub(*models.values()) for models in fields if len(models) > 1]
    other_bands = round_bands(differences, signed=True) if differences else None
    return [
        _picture(outcome, friction, component, view, models, bands, other_bands)
        for friction, models in zip(outcome.problem.scene.load.friction, fields, strict=True)
    ]


def _picture(
    outcome: Run,
    friction: float,
    component: Component,
    view: FieldView,
    fields: dict[str, np.ndarray],
    bands: np.ndarray,
    difference_bands: np.ndarray | None,
) -> Picture:
    hertz, window = outcome.problem.hertz, outcome.window
    x, z = window.x / hertz.half_width, window.z[: view.rows] / hertz.half_width
    drawn, places, bars = layout(len(fields), view.height)
    found, levels = [], outcome.pair(friction)
    for place, (name, values) in zip(places, fields.items(), strict=False):
        extreme = levels[name].stress(friction).extremes[component.name]
        shown = fill(place, x, z, values, bands, component.colours, component.signed)
        if extreme.z <= window.z[view.rows - 1]:
            cross(place, extreme.x / hertz.half_width, extreme.z / hertz.half_width)
        found.append(f"{LABELS[name]}: {_largest(outcome, extreme, component)}")
        place.set_title(found[-1])
    colour_bar(drawn, bars[0], shown, f"{component.symbol}/p₀", bands)
    largest = ""
    if len(fields) > 1:
        difference = sub(*fields.values())
        shown = fill(places[-1], x, z, difference, difference_bands, DIFFERENCE_COLOURS, True)
        largest = f" {_difference_said(x, z, difference, difference_bands[-1])}"
        places[-1].set_title(" − ".join(LABELS[name] for name in fields))
        colour_bar(drawn, bars[1], shown, f"Δ{component.symbol}/p₀", difference_bands)
    places[-1].set_xlabel("x/a")
    words = f"{component.words.capitalize()} {component.symbol} {view.words}"
    striped = ", stripes what is negative" if component.signed or largest else ""
    cut = any(np.isnan(values).any() for values in fields.values())
    largest += " White: hollows below the mean line, from which z counts." if cut else ""
    if WHOLE in fields:
        largest += " Of the whole model each point stands where it was before loading."
    pointed = {
        "component": COMPONENTS.index(component),
        "friction": outcome.problem.scene.load.friction.index(friction),
        "boxes": [_box(place) for place in places],
        "x": [round(float(end), 6) for end in x[[0, -1]]],
        "z": [round(float(end), 6) for end in z[[0, -1]]],
    }
    return Picture(
        source=data_uri(drawn),
        alternative=f"{words}, friction {plain(friction)}. {'; '.join(found)}.{largest}",
        caption=(
            f"{words}, friction {plain(friction)}; + marks the largest value{striped}.{largest}"
        ),
        field=json.dumps(pointed),
    )


def _box(axes: "Axes") -> list[float]:
    """Left, top, width and height of a field as shares of the picture, from its upper left."""
    place = axes.get_position()
    return [round(v, 4) for v in (place.x0, 1.0 - place.y1, place.width, place.height)]


def _difference_said(x: np.ndarray, z: np.ndarray, difference: np.ndarray, end: float) -> str:
    """Where the colours of the difference end, why there, and its largest value."""
    row, column = np.unravel_index(np.nanargmax(np.abs(difference)), difference.shape)
    largest = difference[row, column]
    covers = f", which covers {COVERED:g} % of the points or more, to show what is small"
    reason = covers if abs(largest) > end else ""
    return (
        f"The difference's colours end at ±{significant(end, 2)} p₀{reason}; the largest "
        f"difference at a point of the grid, {significant(largest, 2)} p₀, stands at "
        f"x = {decimal(x[column])} a, z = {significant(z[row], 2)} a."
    )


def _largest(outcome: Run, extreme: Extremum, component: Component) -> str:
    hertz = outcome.problem.hertz
    word = f"largest |{component.symbol}|" if component.signed else "largest"
    return (
        f"{word} {significant(abs(extreme.value) / hertz.peak_pressure)} p₀ at "
        f"x = {decimal(extreme.x / hertz.half_width)} a, "
        f"z = {significant(extreme.z / hertz.half_width, 3)} a"
    )
