"""Isometric views as stacked lines with hidden lines removed: a field as a landscape over x and z.

The surface lies at the back, depth comes towards the viewer, stress stands upwards. Strips between
two neighbouring depths are painted from the back to the front, each with the line of its nearer
depth on it; whatever is painted later stands in front. That is right for any view from above.

matplotlib's mplot3d is not used: it fails where pip's copy lies beside Debian's.
"""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap, Normalize

# On the page: where x, depth (each by a) and stress (by p0) go, right and up.
ALONG = np.array([1.0, 0.0])
DOWN = np.array([-0.5, -0.85])
UP = np.array([0.0, 1.55])
PAINTED, LETTERED = 0.5, 3.0  # z-orders: below 1 all is one image
LINE = {"color": "#1c1f23", "linewidth": 0.32}
FRAME = {"color": "#555555", "linewidth": 0.7, "zorder": LETTERED}
CUT = "#e4e2dd"  # the block's front and side


def projected(x: np.ndarray, z: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Places on the page (..., 2) of x [a], depth z [a] and height [p0], broadcast together."""
    x, z, height = np.broadcast_arrays(x, z, height)
    return x[..., None] * ALONG + z[..., None] * DOWN + height[..., None] * UP


def draw_isometric(
    axes: "Axes",
    x: np.ndarray,
    z: np.ndarray,
    values: np.ndarray,
    floor: float,
    colours: "Colormap",
    norm: "Normalize",
) -> None:
    """Paint the landscape.

    x (k,) and z (m,) [a], z ascending from the surface; values (m, k) [p0]
    floor  [p0] height of the block's foot, below all values
    """
    from matplotlib.collections import LineCollection, PolyCollection

    axes.set_rasterization_zorder(1.0)
    places = projected(x, z[:, None], values)
    for row in range(len(z) - 1):
        far, near = places[row], places[row + 1]
        quads = np.stack([far[:-1], far[1:], near[1:], near[:-1]], axis=1)
        middle = 0.25 * (
            values[row, :-1] + values[row, 1:] + values[row + 1, :-1] + values[row + 1, 1:]
        )
        look = {"edgecolors": "face", "linewidths": 0.2, "zorder": PAINTED}
        axes.add_collection(PolyCollection(quads, facecolors=colours(norm(middle)), **look))
        if row == 0:
            axes.add_collection(LineCollection([far], zorder=PAINTED, **LINE))
        axes.add_collection(LineCollection([near], zorder=PAINTED, **LINE))
    for top, foot in (
        (places[-1], projected(x, z[-1], floor)),
        (places[:, -1], projected(x[-1], z, floor)),
    ):
        outline = np.concatenate([top, foot[::-1]])
        look = {"edgecolors": LINE["color"], "linewidths": 0.4, "zorder": PAINTED}
        axes.add_collection(PolyCollection([outline], facecolors=CUT, **look))


def draw_scales(
    axes: "Axes", x: np.ndarray, z: np.ndarray, floor: float, heights: np.ndarray, symbol: str
) -> None:
    """Ticks along the block's foot, and a scale of stress at its nearest corner, with units.

    heights  [p0] ticks of the scale
    """
    low, high, deep = x[0], x[-1], z[-1]

    def letter(at: np.ndarray, way: tuple[float, float], words: str) -> None:
        axes.text(*(at + np.array(way)), words, ha="center", va="center", zorder=LETTERED)

    for place in np.arange(np.ceil(low), high + 1e-9):
        _tick(axes, projected(place, deep, floor), (0.0, -0.045), f"{place:g}", "top")
    letter(projected(0.5 * (low + high), deep, floor), (0.0, -0.28), "x/a")
    for depth in np.linspace(0.0, deep, 3):
        _tick(axes, projected(high, depth, floor), (0.05, -0.02), f"{depth:.2g}", "center")
    letter(projected(high, 0.5 * deep, floor), (0.38, -0.14), "z/a")
    foot, top = projected(low, deep, heights[0]), projected(low, deep, heights[-1])
    axes.plot(*zip(foot, top, strict=True), **FRAME)
    for height in heights:
        _tick(axes, projected(low, deep, height), (-0.045, 0.0), f"{height:.2g}", "center")
    letter(top, (0.0, 0.14), f"{symbol}/p₀")


def frame(axes: "Axes", x: np.ndarray, z: np.ndarray, floor: float, ceiling: float) -> None:
    """Limit the axes to the block and its letters, and hide them."""
    left, right, bottom, top = bounds(x, z, floor, ceiling)
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    axes.set_axis_off()


def bounds(
    x: np.ndarray, z: np.ndarray, floor: float, ceiling: float
) -> tuple[float, float, float, float]:
    """Left, right, bottom and top [a] of the page that a block and its letters take."""
    corners = projected(x[[0, -1]], z[[0, -1], None], floor).reshape(-1, 2)
    left, right = corners[:, 0].min() - 0.3, corners[:, 0].max() + 0.2
    bottom, top = corners[:, 1].min() - 0.36, projected(0.0, 0.0, ceiling)[1] + 0.08
    return float(left), float(right), float(bottom), float(top)


def _tick(
    axes: "Axes", at: np.ndarray, way: tuple[float, float], words: str, vertical: str
) -> None:
    end = at + np.array(way)
    axes.plot(*zip(at, end, strict=True), **FRAME)
    side = "center" if way[0] == 0.0 else "left" if way[0] > 0.0 else "right"
    look = {"ha": side, "va": vertical, "zorder": LETTERED, "size": 7.5}
    axes.text(*(end + 0.5 * np.array(way)), words.replace("-", "−"), **look)
