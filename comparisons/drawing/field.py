"""Fields over x and depth as bands of colour, each above its scale.

In: values (m, n) at x (n,) and depths z (m,). Out: axes of a picture. What is negative is
striped, so that a grey printer leaves the sign."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Self

import numpy as np

from comparisons.drawing.curves import panels
from comparisons.drawing.style import COLUMN, HATCHED, power_of_ten

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

LEFT, WIDTH = 0.66, COLUMN - 0.85  # inches, of a field
LOW, TALL = 0.9, 2.6  # inches: least and greatest height of a field to scale
TITLE, FOOT, BAR, BAR_LABEL, INSET = 0.28, 0.42, 0.1, 0.34, 0.36  # inches
BANDS = 16  # of colour on the whole scale, about
COVERED = 99.5  # per cent of a field's points that its scale covers at least
NOTHING = 1e-12  # a largest value below it is none
PIXELS = 220  # to the inch
SMALLEST_POWER = -2  # of ten: smaller ticks are written with the power apart
MOST_TICKS = 9  # of a colour bar
STRIPES = 0.045, 0.3  # inches from one to the next, and the share that each covers
SHADE = 0.22  # of black, of a stripe
ROUND = np.array([1.0, 2.0, 2.5, 5.0, 10.0])  # steps of a scale, times a power of ten
DIFFERENCE_COLOURS = "PuOr_r"


def round_bands(fields: list[np.ndarray], signed: bool) -> np.ndarray:
    """Ascending bounds in round steps, symmetric if `signed`, that cover nearly every point."""
    top = max(max(np.nanpercentile(np.abs(field), COVERED) for field in fields), NOTHING)
    wanted = (2.0 if signed else 1.0) * top / BANDS
    power = 10.0 ** np.floor(np.log10(wanted))
    step = power * ROUND[np.searchsorted(ROUND, wanted / power * (1.0 - 1e-9))]
    count = int(np.ceil(top / step * (1.0 - 1e-9)))
    # zero lies inside the middle band of a signed scale, so that noise about it has one colour
    return step * (np.arange(-count, count + 2) - 0.5 if signed else np.arange(count + 1.0))


@dataclass(frozen=True)
class FieldPanel:
    """A field under its title, and where it is marked."""

    title: str
    values: np.ndarray  # (m, n)
    mark: tuple[float, float] | None = None  # x, z


@dataclass(frozen=True)
class ColourScale:
    """Label of a scale, its bands, and their colours."""

    label: str
    bands: np.ndarray  # ascending, in equal steps
    colours: str
    signed: bool

    @classmethod
    def over(
        cls, label: str, fields: list[np.ndarray], colours: str = "viridis", signed: bool = False
    ) -> Self:
        """One scale for all the fields."""
        return cls(label, round_bands(fields, signed), colours, signed)

    @classmethod
    def of_differences(cls, label: str, differences: list[np.ndarray]) -> Self:
        return cls.over(label, differences, DIFFERENCE_COLOURS, signed=True)


def layout(counts: Sequence[int], height: float) -> "tuple[Figure, list[list[Axes]]]":
    """An empty figure with groups of so many fields, one below the other; under each group, last of
    its axes, its colour bar."""
    rows = []
    for count in counts:
        above = TITLE + (BAR_LABEL if rows else 0.0)
        rows += [(above, height), *[(TITLE, height)] * (count - 1), (FOOT, BAR)]
    drawn, axes = panels(COLUMN, rows, LEFT, COLUMN - LEFT - WIDTH, BAR_LABEL)
    groups, inset = [[axes.pop(0) for _ in range(count + 1)] for count in counts], INSET / COLUMN
    for *above, last, bar in groups:
        for place in above:
            place.tick_params(labelbottom=False)
        last.set_xlabel("x/a")
        box = bar.get_position()
        bar.set_position((box.x0 + inset, box.y0, box.width - inset, box.height))
    return drawn, groups


def draw_field(
    axes: "Axes", x: np.ndarray, z: np.ndarray, panel: FieldPanel, scale: ColourScale
) -> "ScalarMappable":
    """Title, mark, and bands of colour, drawn as pixels: as curves they would take megabytes."""
    import matplotlib
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import BoundaryNorm

    bands, ends = scale.bands, "both" if scale.signed else "max"
    norm = BoundaryNorm(bands, matplotlib.colormaps[scale.colours].N, extend=ends)
    shown, pixels = ScalarMappable(norm, scale.colours), _pixels(axes, x, z, panel.values)
    image = shown.to_rgba(np.ma.masked_invalid(pixels), bytes=True)  # nothing where no value is
    if scale.signed:  # zero lies inside the middle band
        struck = _stripes(pixels.shape) & (pixels < bands[bands < 0.0][-1])
        image[struck, :3] = (1.0 - SHADE) * image[struck, :3]
    axes.imshow(image, interpolation="none", aspect="auto", extent=(x[0], x[-1], z[-1], z[0]))
    axes.set(xlim=(x[0], x[-1]), ylim=(z[-1], z[0]), ylabel="z/a")
    axes.grid(False)
    for colour, thick in (("white", 2.6), ("black", 1.1)) if panel.mark is not None else ():
        look = {"color": colour, "markersize": 7.5, "markeredgewidth": thick, "clip_on": False}
        axes.plot(*panel.mark, marker="+", **look)  # seen on every colour
    axes.set_title(panel.title)
    return shown


def _pixels(axes: "Axes", x: np.ndarray, z: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The field on even pixels, linear between the window's points."""
    from scipy.interpolate import interp1d

    box, (wide, tall) = axes.get_position(), axes.figure.get_size_inches()
    columns, rows = int(PIXELS * box.width * wide), int(PIXELS * box.height * tall)
    across = x[0] + (np.arange(columns) + 0.5) / columns * (x[-1] - x[0])
    down = z[0] + (np.arange(rows) + 0.5) / rows * (z[-1] - z[0])
    return interp1d(x, interp1d(z, values, axis=0)(down))(across)


@cache
def _stripes(shape: tuple[int, int]) -> np.ndarray:
    """Pixels that are struck."""
    apart, share = STRIPES
    down, across = np.arange(shape[0])[:, None], np.arange(shape[1])
    return ((down + across) / (apart * PIXELS)) % 1.0 < share


def colour_bar(axes: "Axes", shown: "ScalarMappable", scale: ColourScale) -> None:
    """The scale under a field: ticks in round steps, at zero if it is on the scale."""
    label, bands = scale.label, scale.bands
    bar = axes.figure.colorbar(shown, cax=axes, orientation="horizontal")
    bar.outline.set_linewidth(0.5)
    step = bands[1] - bands[0]
    apart = step * (1 + len(bands) // MOST_TICKS)
    ticks = apart * np.arange(np.ceil(bands[0] / apart), np.floor(bands[-1] / apart * 1.000001) + 1)
    power = int(np.floor(np.log10(ticks[-1])))
    if power < SMALLEST_POWER:
        label = f"{label}\n× {power_of_ten(power)}"
    else:
        power = 0
    labels = [f"{tick * 10.0**-power:.4g}" for tick in ticks]
    bar.set_ticks(ticks, labels=[text.replace("-", "−") for text in labels])
    bar.minorticks_off()
    if bands[0] < 0.0:
        ends = [bands[0], -0.5 * step]
        look = {"facecolor": "none", "edgecolor": (0.0, 0.0, 0.0, SHADE), "linewidth": 0.0}
        axes.axvspan(*ends, **look, **HATCHED)
    axes.tick_params(length=2.0, pad=1.5)
    beside = {"xytext": (-18, 0), "xycoords": "axes fraction", "textcoords": "offset points"}
    axes.annotate(label, (0.0, 0.5), **beside, ha="right", va="center")


def draw_fields(
    x: np.ndarray,
    z: np.ndarray,
    fields: Sequence[FieldPanel],
    scale: ColourScale,
    height: float | None = None,
    difference: tuple[str, ColourScale] | None = None,
) -> "Figure":
    """One or two fields of `height` inches, to scale without, above one scale; of two also the
    first less the second, with its title, above another."""
    to_scale = float(np.clip(WIDTH * np.ptp(z) / np.ptp(x), LOW, TALL))
    groups = [(fields, scale)]
    if difference is not None:
        title, other = difference
        groups.append(([FieldPanel(title, fields[0].values - fields[1].values)], other))
    drawn, places = layout([len(one) for one, _ in groups], height or to_scale)
    for (some, colours), (*above, bar) in zip(groups, places, strict=True):
        shown = [draw_field(at, x, z, one, colours) for at, one in zip(above, some, strict=True)]
        colour_bar(bar, shown[-1], colours)
    return drawn
