"""Structured meshes of a block with exact control of the vertices, made without gmsh."""

from collections.abc import Callable

import numpy as np

from meshes.block import BlockMesh, BlockSpec, add_midpoints


def structured(
    x: np.ndarray, z: np.ndarray, height: Callable | None = None, seed: int | None = None
) -> BlockMesh:
    """Two triangles to each cell of the grid x (ascending) by z (from 0 to the depth) [m].

    `height` moves the top by -height(x), decreasing linearly to the bottom; `seed` moves the inner
    vertices by up to a fifth of a cell, against symmetries that hide a mistake.
    """
    grid_x, grid_z = np.meshgrid(x, z, indexing="ij")
    if seed is not None:
        random = np.random.default_rng(seed)
        for grid, line, axis in ((grid_x, x, 0), (grid_z, z, 1)):
            cell = np.gradient(line)[1:-1]
            cell = cell[:, None] if axis == 0 else cell[None, :]
            grid[1:-1, 1:-1] += 0.2 * cell * random.uniform(-1, 1, grid[1:-1, 1:-1].shape)
    vertices = np.column_stack([grid_x.ravel(), grid_z.ravel()])
    number = np.arange(len(vertices)).reshape(grid_x.shape)
    a, b, c, d = (
        n.ravel() for n in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    )
    corners = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    points, triangles = add_midpoints(vertices, corners)
    shift = np.zeros_like(points)
    if height is not None:
        shift[:, 1] = -height(points[:, 0]) * (1.0 - points[:, 1] / z[-1])
    spec = BlockSpec(0.5 * (x[-1] - x[0]), z[-1], np.array([[x[0], x[-1]]]), float(x[1] - x[0]))
    return BlockMesh(points, triangles, shift, spec)
