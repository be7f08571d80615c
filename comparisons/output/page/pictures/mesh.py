"""The finite-element mesh: the whole block, under the contact, under the highest pressure.

Elements smaller than the picture can show are drawn as what they would look like: a dark patch.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import integer, scale_of, with_unit
from comparisons.drawing.curves import panels
from comparisons.drawing.style import THIRD, Picture, picture
from comparisons.judging.contact import peak_position, seen
from comparisons.judging.study import Run
from meshes.block import real_points, unique_edges

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CELL = 0.028  # inches: edges shorter than that make the cell that they lie in dark
COLOUR = 0.12, 0.31, 0.47
LEFT, RIGHT = 0.68, 0.22  # inches beside a mesh
LEAST, MOST = 0.8, 1.9  # inches: its height
NARROWEST = 1.1  # inches: its width, for the numbers of its axis
ROOM = 0.3  # beside the contact, of half of it
PEAK_EDGES = 24  # edges at the surface to either side of the highest peak


def mesh_pictures(run: Run) -> list[Picture]:
    """Nothing without finite elements."""
    model = run.runs.get("finite_element")
    if model is None or model.finest.mesh is None:
        return []
    level, mesh = model.finest, model.finest.mesh
    points, corners = real_points(mesh), mesh.triangles[:, :3]
    pairs, _ = unique_edges(corners)
    half, depth, edge = mesh.spec.half_width, mesh.spec.depth, mesh.spec.surface_size
    (low, high), fine = seen(run, ROOM), PEAK_EDGES * edge
    peak = peak_position(level)
    count = f"{integer(len(corners))} quadratic triangles, {integer(level.unknowns)} unknowns"
    views = {
        "whole block": (-half, half, depth),
        "body under the contact": (
            max(low, -half),
            min(high, half),
            min(0.5 * (high - low), depth),
        ),
        "body under the highest pressure": (peak - fine, peak + fine, min(fine, depth)),
    }
    known = f"{count}; as a file: finite_element/mesh.msh. Dark: too fine to draw."
    surface = f"edges at the surface are {with_unit(edge, 'm', 3)} long"
    pictures = []
    for words, view in views.items():
        drawn = _drawn(points, pairs, view)
        if not drawn.axes[0].lines:  # of a thin layer: all is dark
            continue
        caption = f"The {words}; {surface}." if pictures else f"Mesh of the {words}: {known}"
        said = f"Finite-element mesh of the {words}: {count}."
        pictures.append(picture(drawn, said, caption, data=False))
    return pictures


def _drawn(points: np.ndarray, pairs: np.ndarray, view: Sequence[float]) -> "Figure":
    """Edges between points (n, 2) from a left to a right end and down to a depth [m]."""
    unit = scale_of(view, "m")
    low, high, depth = (end / unit.factor for end in view)
    share = view[2] / (view[1] - view[0])
    width = max(min(THIRD - LEFT - RIGHT, MOST / share), NARROWEST)
    height = np.clip(width * share, LEAST, MOST)
    drawn, [axes] = panels(THIRD, [(0.14, height)], LEFT, THIRD - LEFT - width)
    points = points / unit.factor
    top = min(0.0, max(points[:, 1].min(), -0.2 * depth)) - 0.03 * depth
    labels = {"xlabel": f"x [{unit.name}]", "ylabel": f"z [{unit.name}]"}
    axes.set(xlim=(low, high), ylim=(depth, top), **labels)
    axes.grid(False)
    (x, other_x), (z, other_z) = points[pairs.T, 0], points[pairs.T, 1]
    inside = (np.maximum(x, other_x) >= low) & (np.minimum(x, other_x) <= high)
    pairs = pairs[inside & (np.minimum(z, other_z) <= depth)]
    ends = points[pairs]
    cell = CELL * (high - low) / width
    visible = np.hypot(*(ends[:, 1] - ends[:, 0]).T) >= cell
    # one curve with breaks: a twentieth of the size of as many curves as edges
    broken = np.vstack([points, (np.nan, np.nan)])[_strokes(pairs[visible], len(points))]
    if visible.any():
        axes.plot(*broken.T, color=COLOUR, linewidth=0.4)
    if not visible.all():
        short = ends[~visible]
        points = np.vstack([short.mean(axis=1), *short.swapaxes(0, 1)])
        _dark_cells(axes, points, (low, high, depth), cell)
    return drawn


def _strokes(edges: np.ndarray, pause: int) -> list[int]:
    """Points in the order of a pen that draws every edge (n, 2) once; `pause`: it is lifted."""
    beside: dict[int, dict[int, None]] = {}
    for one, other in edges.tolist():
        beside.setdefault(one, {})[other] = None
        beside.setdefault(other, {})[one] = None
    order: list[int] = []
    for start in beside:
        while beside[start]:
            at = start
            while beside[at]:
                order.append(at)
                onward = next(iter(beside[at]))
                del beside[at][onward], beside[onward][at]
                at = onward
            order += [at, pause]
    return order


def _dark_cells(
    axes: "Axes", points: np.ndarray, bounds: tuple[float, float, float], cell: float
) -> None:
    """Cells that hold points (n, 2), drawn dark."""
    low, high, depth = bounds
    top = points[:, 1].min()
    shape = int(np.ceil((depth - top) / cell)), int(np.ceil((high - low) / cell))
    at = np.floor((points - (low, top)) / cell).astype(int)[:, ::-1]
    at = at[np.all((at >= 0) & (at < shape), axis=1)]
    dark = np.zeros((*shape, 4))
    dark[tuple(at.T)] = *COLOUR, 1.0
    extent = (low, low + shape[1] * cell, top + shape[0] * cell, top)
    axes.imshow(dark, extent=extent, interpolation="none", aspect="auto", zorder=1.5)
