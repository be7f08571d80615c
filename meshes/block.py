"""Plain data of a block mesh: what to build, and what came out.

The block occupies |x| <= half_width, 0 <= z <= depth, z into the body. Its top side z = 0 is
the mean line; a rough boundary is the top side moved to z = -height(x).
"""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class BlockSpec:
    """What to mesh. Lengths in m.

    half_width, depth   the block
    intervals           (k, 2) stretches of the surface to refine, ascending and disjoint
    surface_size        element edge on those stretches; every end of an interval and every
                        multiple of surface_size between is a mesh node (equal edges)
    growth              size = surface_size + growth * distance to the nearest interval
    window              (x0, x1, z1, size) or None: inside x0 <= x <= x1, z <= z1 no element is
                        larger than size, so that a stress field there is resolved
    interface           depth of a line across the whole block that element edges follow (the
                        lower boundary of a coating), or None
    vertices            (k,) ascending x of the mesh nodes on the surface from the start of the
                        first interval to the end of the last, in place of equal edges there, or
                        None; sizes below follow these edges
    """

    half_width: float
    depth: float
    intervals: np.ndarray
    surface_size: float
    growth: float = 0.2
    window: tuple[float, float, float, float] | None = None
    interface: float | None = None
    vertices: np.ndarray | None = None


@dataclass(frozen=True)
class BlockMesh:
    """Second-order triangles of the flat block, with the way to the real body kept aside.

    points     (n, 2) x and z [m] of vertices and edge midpoints, flat block
    triangles  (m, 6) gmsh order: 3 vertices, then midpoints of edges (0,1), (1,2), (2,0)
    shift      (n, 2) [m] displacement that turns the flat block into the real body, rough or
               bent; zero for the flat mesh. The points of the real body are points + shift.
    spec       what was asked for
    """

    points: np.ndarray
    triangles: np.ndarray
    shift: np.ndarray
    spec: BlockSpec
    quality: dict = field(default_factory=dict)
