"""The finite-element mesh: the whole block, under the contact, under the highest pressure.

Edges are drawn as pixels: as curves they would take megabytes. What is finer than these is dark."""

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
    from matplotlib.figure import Figure

FINE = 0.028  # inches: what has no longer edge is all dark
COLOUR = 0.12, 0.31, 0.47
LEFT, RIGHT = 0.68, 0.22  # inches beside a mesh
LEAST, MOST = 0.8, 1.9  # inches: its height
NARROWEST = 1.1  # inches: its width, for the numbers of its axis
ROOM = 0.3  # beside the contact, of half of it
EDGES = 256  # in one line, with gaps: each line costs by itself
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
        if drawn is None:  # of a thin layer: all is dark
            continue
        caption = f"The {words}; {surface}." if pictures else f"Mesh of the {words}: {known}"
        said = f"Finite-element mesh of the {words}: {count}."
        pictures.append(picture(drawn, said, caption, data=False))
    return pictures


def _drawn(points: np.ndarray, pairs: np.ndarray, view: Sequence[float]) -> "Figure | None":
    """Edges between points (n, 2) from a left to a right end and down to a depth [m]; None where
    all are too short to be seen."""
    from matplotlib.collections import LineCollection

    unit = scale_of(view, "m")
    low, high, depth = (end / unit.factor for end in view)
    share = view[2] / (view[1] - view[0])
    width = max(min(THIRD - LEFT - RIGHT, MOST / share), NARROWEST)
    height = np.clip(width * share, LEAST, MOST)
    ends = (points / unit.factor)[pairs]
    inside = (ends[:, :, 0].max(axis=1) >= low) & (ends[:, :, 0].min(axis=1) <= high)
    ends = ends[inside & (ends[:, :, 1].min(axis=1) <= depth)]
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    if lengths.max() * width < FINE * (high - low):
        return None
    drawn, [axes] = panels(THIRD, [(0.14, height)], LEFT, THIRD - LEFT - width)
    gaps = np.pad(ends, ((0, 0), (0, 1), (0, 0)), constant_values=np.nan)
    some = np.array_split(gaps, -(-len(gaps) // EDGES))
    lines = [edges.reshape(-1, 2) for edges in some]
    edges = LineCollection(lines, colors=[COLOUR], linewidths=0.4, rasterized=True)
    axes.add_collection(edges, autolim=False)
    top = min(0.0, max(ends[:, :, 1].min(), -0.2 * depth)) - 0.03 * depth
    labels = {"xlabel": f"x [{unit.name}]", "ylabel": f"z [{unit.name}]"}
    axes.set(xlim=(low, high), ylim=(depth, top), **labels)
    axes.grid(False)
    return drawn
