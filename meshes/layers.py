"""Stretched elements of a coating beside its core: columns of layers, two triangles to a cell."""

import numpy as np

from meshes.coating import LAYERS
from meshes.errors import MeshError


def with_layers(
    vertices: np.ndarray,
    triangles: np.ndarray,
    interface: float | None,
    beside: tuple[np.ndarray, ...],
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 2) [m] and triangles (m, 3) with the columns `beside` (see `Outline`) added.

    Their nodes on the interface [m] and at the end of the core must be among the vertices.
    Raises MeshError if one is not.
    """
    for x in beside:
        columns, depths = np.meshgrid(x, np.linspace(0.0, interface, LAYERS + 1), indexing="ij")
        number = np.full(columns.shape, -1, dtype=np.int64)
        number[0], number[1:, -1] = (
            known(vertices, columns[0], depths[0]),
            known(vertices, columns[1:, -1], depths[1:, -1]),
        )
        new = number < 0
        number[new] = len(vertices) + np.arange(np.count_nonzero(new))
        vertices = np.concatenate([vertices, np.column_stack([columns[new], depths[new]])])
        inner, outer = number[:-1], number[1:]
        a, b, c, d = (n.ravel() for n in (inner[:, :-1], outer[:, :-1], outer[:, 1:], inner[:, 1:]))
        cells = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
        # Outwards is to the left in one of the strips: there the sense of rotation turns.
        cells = cells if x[-1] > x[0] else cells[:, ::-1]
        triangles = np.concatenate([triangles, cells])
    return vertices, triangles


def known(vertices: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Numbers of the vertices that lie exactly at x, z (k,) [m]."""
    on = np.flatnonzero(np.isin(vertices[:, 0], x) & np.isin(vertices[:, 1], z))
    number = {tuple(vertices[k]): k for k in on}
    try:
        return np.array([number[point] for point in zip(x, z, strict=True)], dtype=np.int64)
    except KeyError as error:
        raise MeshError("the layers beside a coating's core do not fit what lies below") from error
