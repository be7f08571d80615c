"""Where a line at spec.interface lies across the block, and how elements above it are made.

Under the ground that will be touched the coating is filled like the rest of the block, with
elements no larger than t / LAYERS. Beside it, where the size law asks for larger ones, LAYERS
layers of stretched elements go on to the sides of the block: they cost next to nothing, and the
displacements there change over lengths that the size law resolves.

Nomenclature (lengths in m)

    t       spec.interface, thickness of the coating
    core    x from which to which the coating is filled freely; stretched layers on both sides
"""

import numpy as np

from meshes.block import BlockMesh, BlockSpec

# Quadratic elements across the coating under the contact. Against six they change displacements by
# at most 5e-5 of their range, for moduli 0.1 to 100 times the body's; two by 2e-4.
LAYERS = 3
# Longest element of the stretched layers over their thickness. 400 in its place moves the whole
# surface by up to 4e-4 of that range, and leaves patches too flat to recover stresses from.
LONGEST = 50.0


def layer_size(spec: BlockSpec) -> float:
    """Largest element edge t / LAYERS [m] in the core of the coating."""
    return spec.interface / LAYERS


def core(spec: BlockSpec) -> tuple[float, float]:
    """Ends [m] of the coating's core: beyond them the size law alone asks for t / LAYERS or more.

    Whole block where the law does not grow, or where less than an edge would be left at a side.
    """
    half, size = spec.half_width, layer_size(spec)
    if spec.growth * 2.0 * half <= size:
        return -half, half
    low, high = float(spec.intervals[0][0]), float(spec.intervals[-1][1])
    if spec.window is not None and spec.window[3] < size:
        low, high = min(low, spec.window[0]), max(high, spec.window[1])
    low, high = low - size / spec.growth, high + size / spec.growth
    return (low if low > -half + size else -half), (high if high < half - size else half)


def stretched(mesh: BlockMesh) -> np.ndarray:
    """Which triangles (m,) belong to the stretched layers: their shape is meant."""
    spec = mesh.spec
    if spec.interface is None:
        return np.zeros(len(mesh.triangles), dtype=bool)
    x, z = mesh.points[mesh.triangles[:, :3]].mean(axis=1).T
    low, high = core(spec)
    return (z < spec.interface) & ((x < low) | (x > high))
