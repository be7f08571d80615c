"""Fields as bands of colour under each other, each scale with its bar."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.report.figures.style import COLUMN, figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

WIDTH = COLUMN - 0.85  # inches, of a field
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
        axes.plot(
            x, z, marker="+", color=colour, markersize=7.5, markeredgewidth=thick, clip_on=False
        )


def layout(models: int, height: float) -> "tuple[Figure, list[Axes], list[Axes]]":
    """An empty figure, its fields from top to bottom, and its colour bars.

    The models stand above one bar; with two models their difference follows, above another.
    """
    comparing = models > 1
    title, bar, label, foot = 0.28, 0.1, 0.34, 0.42
    block = title + height
    total = models * block + foot + bar + label + (block + foot + bar + label if comparing else 0.0)
    drawn = figure(COLUMN, total)
    places, bars = [], []
    edge = total

    def axes(low: float, tall: float, inset: float = 0.0) -> "Axes":
        return drawn.add_axes(
            ((0.62 + inset) / COLUMN, low / total, (WIDTH - inset) / COLUMN, tall / total)
        )

    for _ in range(models):
        edge -= block
        places.append(axes(edge, height))
    edge -= foot + bar
    bars.append(axes(edge, bar, inset=0.36))
    edge -= label
    if comparing:
        edge -= block
        places.append(axes(edge, height))
        edge -= foot + bar
        bars.append(axes(edge, bar, inset=0.36))
    for place in places[: models - 1]:
        place.tick_params(labelbottom=False)
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

    What is negative is striped, so that a grey printer leaves the sign.
    """
    import matplotlib
    from matplotlib.colors import BoundaryNorm

    colour_map = matplotlib.colormaps[colours]
    norm = BoundaryNorm(bands, colour_map.N, extend="both" if signed else "max")
    pixels = _pixels(axes, x, z, values)
    placed = {
        "interpolation": "none",
        "aspect": "auto",
        "extent": (x[0], x[-1], z[-1], z[0]),
    }
    shown = axes.imshow(pixels, cmap=colour_map, norm=norm, **placed)
    if signed:
        axes.imshow(_stripes(pixels < bands[bands < 0.0][-1]), **placed)
    axes.set(xlim=(x[0], x[-1]), ylim=(z[-1], z[0]), ylabel="z/a")
    axes.grid(False)
    return shown


def _pixels(axes: "Axes", x: np.ndarray, z: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The field on the picture's own even pixels, linear between the window's points."""
    from scipy.ndimage import map_coordinates

    box, (wide, tall) = axes.get_position(), axes.figure.get_size_inches()
    columns, rows = int(PIXELS * box.width * wide), int(PIXELS * box.height * tall)
    across = x[0] + (np.arange(columns) + 0.5) / columns * (x[-1] - x[0])
    down = z[0] + (np.arange(rows) + 0.5) / rows * (z[-1] - z[0])
    at = np.meshgrid(
        np.interp(down, z, np.arange(len(z))),
        np.interp(across, x, np.arange(len(x))),
        indexing="ij",
    )
    return map_coordinates(values, at, order=1)


def _stripes(where: np.ndarray) -> np.ndarray:
    """Of transparent black (m, n, 4), where they are wanted."""
    apart, share = STRIPES
    down, across = np.indices(where.shape)
    struck = ((down + across) / (apart * PIXELS)) % 1.0 < share
    shade = np.zeros((*where.shape, 4))
    shade[..., 3] = SHADE * (where & struck)
    return shade


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
        look = {"facecolor": "none", "edgecolor": (0.0, 0.0, 0.0, SHADE), "hatch": "//////"}
        axes.axvspan(bands[0], -0.5 * step, linewidth=0.0, **look)
    axes.tick_params(length=2.0, pad=1.5)
    axes.annotate(
        label, (0.0, 0.5), (-18, 0), "axes fraction", "offset points", ha="right", va="center"
    )
