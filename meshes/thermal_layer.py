"""Blocks graded to the thermal layers of a source that the material moves past.

Heat reaches kappa/V against the motion and the depth sqrt(kappa s/V) at a distance s behind each
point where the flux begins or ends. The edges of the surface's elements follow both:

    e(x) = min(h + g d,  max(L, sqrt(L s)) / n  behind such a point,  L/n + g s  ahead of it)

With n = 1 or more quadratic elements need no upwinding (`fem.heat.conduction`). A finer level has
h/2, 2 n and g/sqrt(2): temperatures converge with order 2, as fluxes jump at the ends of a band.

Nomenclature (lengths in m)
    L    kappa/|V|, infinite at rest      h   edge under the source      n   elements to a layer
    d    distance to the nearest source   s   distance to an end of one  g   growth [-]"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from meshes.block import BlockSpec, MeshError
from meshes.boundary import graded_line

MOST_EDGES = 50_000  # of the surface
SLACK = 1e-9
# Part of the source's width beside which a coating is no longer filled: what is left of its wake
# changes temperatures under the source by less than 1e-3.
WAKE = 0.5


def layer_size(
    patches: np.ndarray, size: float, growth: float, length: float, layers: float
) -> Callable[[np.ndarray], np.ndarray]:
    """e [m] as a function of x (n,) [m], for material that moves towards +x (`length` < 0: -x)."""
    ends = np.asarray(patches, dtype=float).reshape(-1, 2)
    reach = abs(length)

    def edge(x: np.ndarray) -> np.ndarray:
        beside = np.maximum(ends[:, :1] - x, x - ends[:, 1:]).min(axis=0)
        wanted = size + growth * np.maximum(0.0, beside)
        if np.isinf(reach):
            return wanted
        behind = (x - ends.reshape(-1, 1)) * np.sign(length)
        layer = np.sqrt(reach * np.maximum(behind, reach)) / layers
        ahead = reach / layers + growth * np.maximum(0.0, -behind)
        return np.minimum(wanted, np.where(behind >= 0.0, layer, ahead).min(axis=0))

    return edge


def thermal_spec(
    patches: np.ndarray,
    size: float,
    *,
    half_width: float,
    depth: float,
    length: float = np.inf,
    layers: float = 2.0,
    growth: float = 0.2,
    interface: float | None = None,
) -> BlockSpec:
    """Block that `build_block` meshes for heat through `patches` (k, 2) [m], ascending and
    disjoint, whose ends become vertices; lengths as above [m], `layers` is n.
    `length` is kappa/V with the sign of the material's velocity, infinite at rest, by the smaller
    kappa of body and coating. Raises MeshError where its layers are too thin to mesh."""
    if 2.0 * layers * np.sqrt(2.0 * half_width / abs(length)) > MOST_EDGES:
        raise MeshError(
            f"thermal layers of {abs(length):.3g} m (diffusivity over speed) are too thin to mesh "
            f"on a surface of {2.0 * half_width:.3g} m"
        )
    law = layer_size(patches, size, growth, length, layers)
    inside = np.asarray(patches, dtype=float).ravel()
    stops = np.unique([-half_width, *inside, half_width])
    pieces = [graded_line(a, b, law)[:-1] for a, b in pairwise(stops)]
    vertices = np.concatenate([*pieces, stops[-1:]])
    # beyond the last point that the layers refine the block's own law goes on alike
    alone = layer_size(patches, size, growth, np.inf, layers)(vertices)
    beside = np.maximum(inside[0] - vertices, vertices - inside[-1])
    refined = law(vertices) < alone * (1.0 - SLACK)
    if interface is not None:
        refined &= beside < WAKE * np.ptp(inside)
    first, *_, last = np.flatnonzero(refined | (beside <= 0.0))
    vertices = vertices[first : last + 1]
    return BlockSpec(
        half_width,
        depth,
        vertices[None, [0, -1]],
        float(np.diff(vertices).min()),
        growth,
        interface=interface,
        vertices=vertices,
    )
