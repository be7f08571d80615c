"""Meshes of the blocks of tests/blocks.py, and measures of their elements."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from blocks import ALL

from meshes.block import BlockMesh, real_points
from meshes.build import build_block


@pytest.fixture(scope="session")
def built() -> Callable[[str], BlockMesh]:
    """The mesh of a block by its name, built once for all modules."""
    return cache(lambda name: build_block(ALL[name]))


@pytest.fixture
def mesh(request, built) -> BlockMesh:
    return built(request.param)


@pytest.fixture(scope="session")
def signed_areas() -> Callable[[BlockMesh], np.ndarray]:
    """Areas (m,) of the straight triangles of a flat mesh, by its vertices."""

    def of(mesh: BlockMesh) -> np.ndarray:
        corner = mesh.points[mesh.triangles[:, :3]]
        u, v = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
        return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])

    return of


@pytest.fixture(scope="session")
def determinants() -> Callable[[BlockMesh, np.ndarray], np.ndarray]:
    """Determinants of the quadratic map (m, q) at points (q, 2), from its shapes' derivatives."""

    def of(mesh: BlockMesh, at: np.ndarray) -> np.ndarray:
        r, s = at.T
        t = 1.0 - r - s
        zero = np.zeros_like(r)
        d_r = np.stack([1 - 4 * t, 4 * r - 1, zero, 4 * (t - r), 4 * s, -4 * s], axis=1)
        d_s = np.stack([1 - 4 * t, zero, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)], axis=1)
        nodes = real_points(mesh)[mesh.triangles]
        a, b = (np.einsum("qk,ekd->eqd", d, nodes) for d in (d_r, d_s))
        return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

    return of


@pytest.fixture(scope="session")
def triangle_rule() -> tuple[np.ndarray, np.ndarray]:
    """Points (6, 2) and weights, of sum 1/2, exact to degree 4 on the triangle: Strang and Fix."""
    a, b = 0.445948490915965, 0.091576213509771
    points = [[c, d] for e in (a, b) for c, d in ((e, e), (1 - 2 * e, e), (e, 1 - 2 * e))]
    return np.array(points), 0.5 * np.repeat([0.223381589678011, 0.109951743655322], 3)


@pytest.fixture(scope="session")
def curved_area(determinants, triangle_rule) -> Callable[[BlockMesh], float]:
    """Area of a mesh with quadratic edges, whose determinants have degree 2."""
    points, weights = triangle_rule
    return lambda mesh: float((determinants(mesh, points) @ weights).sum())
