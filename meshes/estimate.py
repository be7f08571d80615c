"""How large a mesh will be, before it is built."""

import numpy as np

from meshes.block import BlockSpec
from meshes.build import check_spec
from meshes.coating import LAYERS, core
from meshes.size_law import largest_size, uncapped_size, wanted_size

# gmsh's Delaunay triangles have 1.17 times the number that equilateral ones of the wanted edge
# would have: measured 1.15 to 1.19 over half-planes, windows and sets of asperities.
TRIANGLES_PER_EQUILATERAL = 1.17
# A box is small enough when the size varies by less than this part of its mean within it.
VARIATION = 0.5


def estimate_unknowns(spec: BlockSpec) -> int:
    """Number of displacements, before any is fixed, of the second-order mesh of spec.

    From the integral of the size law, within 25 % of what build_block makes. Raises MeshError when
    spec cannot be meshed.
    """
    check_spec(spec)
    half, depth = spec.half_width, spec.depth
    low, high = (-half, half) if spec.interface is None else core(spec)
    filled = [[low, high, 0.0, spec.interface or depth]]
    layered = 0.0
    if spec.interface is not None:
        filled.append([-half, half, spec.interface, depth])
        beside = ([-half, low, 0.0, 0.0], [high, half, 0.0, 0.0])
        columns = sum(integral_of_power(spec, side, -1.0) for side in beside)
        layered = 2.0 * LAYERS * columns
    inside = sum(integral_of_power(spec, box, -2.0) for box in filled)
    triangles = layered + TRIANGLES_PER_EQUILATERAL * 4.0 / np.sqrt(3.0) * inside
    sides = [
        [-half, half, 0.0, 0.0],
        [-half, half, depth, depth],
        [-half, -half, 0.0, depth],
        [half, half, 0.0, depth],
    ]
    outer_edges = sum(integral_of_power(spec, side, -1.0) for side in sides)
    # Euler: v - e + m = 1 and 2 e = 3 m + b give v + e = 1 + 2 m + b.
    return round(2.0 * (1.0 + 2.0 * triangles + outer_edges))


def integral_of_power(spec: BlockSpec, box: list[float], power: float) -> float:
    """Integral of wanted_size ** power over a box x0, x1, z0, z1 [m], or a side without extent.

    Boxes are halved across their longer extent until the law, whose slope is at most the growth,
    is nearly constant in each or capped throughout; then three Gauss points each way.
    """
    nodes, weights = np.polynomial.legendre.leggauss(3)
    boxes = np.array([box], dtype=float)
    cap = largest_size(spec)
    total = 0.0
    while len(boxes):
        centre_x, centre_z = boxes[:, :2].mean(axis=1), boxes[:, 2:].mean(axis=1)
        half_x, half_z = 0.5 * np.diff(boxes[:, :2]).ravel(), 0.5 * np.diff(boxes[:, 2:]).ravel()
        change = spec.growth * np.hypot(half_x, half_z)
        size = uncapped_size(spec, centre_x, centre_z)
        done = (change <= VARIATION * np.minimum(size, cap)) | (size - change >= cap)
        x = centre_x[done, None, None] + half_x[done, None, None] * nodes[:, None]
        z = centre_z[done, None, None] + half_z[done, None, None] * nodes
        x, z = np.broadcast_arrays(x, z)
        mean = np.einsum("nij,i,j->n", wanted_size(spec, x, z) ** power, weights, weights) / 4.0
        extent = np.where(half_x > 0.0, 2.0 * half_x, 1.0) * np.where(
            half_z > 0.0, 2.0 * half_z, 1.0
        )
        total += float((mean * extent[done]).sum())

        left, right = boxes[~done].copy(), boxes[~done].copy()
        wide = half_x[~done] >= half_z[~done]
        left[wide, 1] = right[wide, 0] = centre_x[~done][wide]
        left[~wide, 3] = right[~wide, 2] = centre_z[~done][~wide]
        boxes = np.concatenate([left, right])
    return total
