"""From the flat block's mesh to that of a roller's true shape: a sector of a disc.

    (x, z)  ->  (x (1 - z/R), s(x) + (R - s(x)) z/R),     s(x) = R - sqrt(R^2 - x^2),

takes the surface to the roller's circle without moving it along x, lines of equal depth to circles
about the roller's centre (0, R), and upright lines to the straight rays to that centre. z points
into the roller, as for every body.

    R  radius of the roller [m]      s  sagitta, depth of its surface below its lowest point [m]
"""

from dataclasses import replace

import numpy as np

from meshes.block import BlockMesh
from meshes.errors import MeshError
from meshes.quality import LEAST_ANGLE_ROUGH_DEGREES, check_quality

# At 0.8 R the surface's elements are stretched to 5/3 of their length along x, at 0.7 R of depth
# they are squeezed to 0.3 of it.
WIDEST, DEEPEST = 0.8, 0.7


def sagitta(x: np.ndarray, radius: float) -> np.ndarray:
    """s(x) [m] of a circle of `radius` [m], to rounding however flat it is."""
    return x**2 / (radius + np.sqrt(radius**2 - x**2))


def bent(mesh: BlockMesh, radius: float) -> BlockMesh:
    """Mesh of the sector of a disc of `radius` [m], from the mesh of a flat block.

    Its surface keeps x; its base is the inner arc and its sides are rays, which a support holds as
    it does the block's. All nodes, vertices and midpoints, go where the map takes them: edges are
    parabolas through three points of their true curves.

    Raises MeshError when the block is not flat, wider to a side than WIDEST or deeper than DEEPEST
    of the radius, or when the elements are not fit to solve on.
    """
    half, depth = mesh.spec.half_width, mesh.spec.depth
    if mesh.shift.any():
        raise MeshError("only a flat block can be bent to a disc")
    for name, length, share in (("half-width", half, WIDEST), ("depth", depth, DEEPEST)):
        if not length <= share * radius:
            raise MeshError(
                f"a block of {name} {length:g} m cannot be bent to a disc of radius {radius:g} m: "
                f"at most {share:g} of the radius is allowed, {share * radius:g} m"
            )
    x, z = mesh.points.T
    toward = z / radius
    shift = np.column_stack([-x * toward, sagitta(x, radius) * (1.0 - toward)])
    disc = replace(mesh, shift=shift)
    quality = check_quality(disc, least_angle_degrees=LEAST_ANGLE_ROUGH_DEGREES)
    return replace(disc, quality=mesh.quality | quality)
