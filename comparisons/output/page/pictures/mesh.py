"""The finite-element mesh: the whole block, under the contact, under the highest pressure.

Elements smaller than the picture can show are drawn as what they would look like: a dark patch.
"""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import integer, scale_of, with_unit
from comparisons.drawing.curves import panels
from comparisons.drawing.style import COLUMN, Picture, picture
from comparisons.studies.contact import peak_position
from comparisons.studies.study import Run
from meshes.block import real_points, unique_edges

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CELL = 0.028  # inches: edges shorter than that make the cell that they lie in dark
COLOUR = 0.12, 0.31, 0.47
CONTACT = 1.3  # half-widths to either side
PEAK_EDGES = 24  # edges at the surface to either side of the highest peak


def mesh_pictures(outcome: Run) -> list[Picture]:
    """Nothing without finite elements."""
    run = outcome.runs.get("finite_element")
    if run is None or run.finest.mesh is None:
        return []
    level, hertz = run.finest, outcome.problem.hertz
    mesh = level.mesh
    points, corners = real_points(mesh), mesh.triangles[:, :3]
    pairs, _ = unique_edges(corners)
    half, depth, edge = mesh.spec.half_width, mesh.spec.depth, mesh.spec.surface_size
    peak = peak_position(level)
    reach = min(CONTACT * hertz.half_width, half)
    fine = PEAK_EDGES * edge
    count = f"{integer(len(corners))} quadratic triangles, {integer(level.unknowns)} unknowns"
    under = f"Under the contact; edges at the surface are {with_unit(edge, 'm', 3)} long."
    views = (
        (
            "the whole block",
            (-half, half, depth),
            f"Mesh of the whole block: {count}; as a file: finite_element/mesh.msh.",
        ),
        ("the body under the contact", (-reach, reach, min(reach, depth)), under),
        (
            "the body under the highest pressure",
            (peak - fine, peak + fine, min(fine, depth)),
            "Under the highest pressure.",
        ),
    )
    return [
        picture(
            _drawn(points, pairs, view),
            f"Finite-element mesh of {words}: {count}.",
            caption,
            data=False,
        )
        for words, view, caption in views
    ]


def _drawn(points: np.ndarray, pairs: np.ndarray, view: tuple[float, float, float]) -> "Figure":
    low, high, depth = view
    unit = scale_of([low, high, depth], "m")
    width = COLUMN - 0.8
    height = float(np.clip(width * depth / (high - low), 0.8, 4.2))
    drawn, [axes] = panels(COLUMN, [(0.14, height)], 0.68)
    points, bounds = points / unit.factor, tuple(end / unit.factor for end in view)
    top = points[:, 1].min()
    cell = CELL * (bounds[1] - bounds[0]) / width
    _edges(axes, points, pairs, bounds, cell)
    near_top = min(0.0, max(top, -0.2 * bounds[2]))
    axes.set(
        xlim=bounds[:2],
        ylim=(bounds[2], near_top - 0.03 * bounds[2]),
        xlabel=f"x [{unit.name}]",
        ylabel=f"z [{unit.name}]",
    )
    axes.grid(False)
    return drawn


def _edges(
    axes: "Axes",
    points: np.ndarray,
    pairs: np.ndarray,
    bounds: tuple[float, float, float],
    cell: float,
) -> None:
    """Edges (n, 2) that reach into the view; those shorter than `cell` as dark cells."""
    low, high, depth = bounds
    (x, other_x), (z, other_z) = points[pairs.T, 0], points[pairs.T, 1]
    inside = (np.maximum(x, other_x) >= low) & (np.minimum(x, other_x) <= high)
    pairs = pairs[inside & (np.minimum(z, other_z) <= depth)]
    ends = points[pairs]
    visible = np.hypot(*(ends[:, 1] - ends[:, 0]).T) >= cell
    # one curve with breaks: a twentieth of the size of as many curves as edges
    broken = np.vstack([points, (np.nan, np.nan)])[_strokes(pairs[visible], len(points))]
    axes.plot(*broken.T, color=COLOUR, linewidth=0.4)
    short = ends[~visible]
    _dark_cells(axes, 0.5 * (short[:, 0] + short[:, 1]), bounds, cell)


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
    low, high, depth = bounds
    if not len(points):
        return
    top = points[:, 1].min()
    shape = int(np.ceil((depth - top) / cell)), int(np.ceil((high - low) / cell))
    at = np.floor((points - (low, top)) / cell).astype(int)[:, ::-1]
    at = at[np.all((at >= 0) & (at < shape), axis=1)]
    dark = np.zeros((*shape, 4))
    dark[tuple(at.T)] = *COLOUR, 1.0
    extent = (low, low + shape[1] * cell, top + shape[0] * cell, top)
    axes.imshow(dark, extent=extent, interpolation="none", aspect="auto", zorder=1.5)
