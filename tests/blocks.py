"""Blocks that meshes start from, by name; Hooke's law in plane strain; bodies moved, or as one."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from analytic.material import Material
from meshes.block import BlockMesh, BlockSpec, add_midpoints, structured

BLOCK = BlockSpec(20.0, 40.0, np.array([[-1.5, 1.5]]), 0.05)
PATCHES = np.array([[-1.5, -1.0], [0.3, 1.1]])
WINDOW = (-1.2, 1.0, 0.6, 0.04)

TOWARDS_ONE = 1.0 - np.linspace(1.0, 0.0, 13) ** 2
HALF = np.concatenate([TOWARDS_ONE, 1.0 + np.cumsum(np.geomspace(0.007, 0.1, 9))])
GRADED = np.concatenate([-HALF[:0:-1], HALF])


def block(half_width, depth, intervals, surface_size, growth=0.2, window=None):
    return BlockSpec(half_width, depth, np.array(intervals), surface_size, growth, window)


def with_vertices(vertices, half_width=20.0, depth=40.0, **more):
    ends = np.array([[vertices[0], vertices[-1]]])
    return BlockSpec(half_width, depth, ends, 0.05, vertices=vertices, **more)


SPECS = {
    "equal edges": {
        "half-plane": block(200.0, 400.0, [[-1.5, 1.5]], 0.05),
        "asperities": block(200.0, 400.0, [[-1.5, -1.0], [-0.9, -0.8], [0.3, 1.1]], 0.02),
        "window": block(20.0, 40.0, [[-1.0, 1.0]], 0.05, window=WINDOW),
        "deep": block(5e5, 1e6, [[-10.0, 10.0]], 1.0),
        "one edge": block(5e5, 1e6, [[0.0, 1.0]], 1.0),
        "thin layer": block(1.0, 0.02, [[-0.5, 0.5]], 0.01),
        "thinner than an edge": block(0.5, 0.02, [[-0.2, 0.2]], 0.05),
        "touching": block(200.0, 400.0, [[-1.0, 0.0], [0.0, 1.0]], 0.05),
        "at the sides": block(1.0, 8.0, [[-1.0, -0.5], [0.75, 1.0]], 0.05),
        "whole width": block(1.0, 2.0, [[-1.0, 1.0]], 0.05),
        "uniform": block(1.0, 1.0, [[-0.5, 0.0]], 0.1, growth=0.0),
        "slow growth": block(200.0, 400.0, [[-1.5, 1.5]], 0.05, growth=0.1),
        "fast growth": block(200.0, 400.0, [[-1.0, 0.0]], 0.05, growth=0.5),
        "micrometres": block(2e-2, 4e-2, [[-1e-4, 1e-4]], 2e-6),
    },
    "own vertices": {
        "graded": with_vertices(GRADED),
        "uneven": with_vertices(np.array([-0.3, -0.25, -0.1, 0.0, 0.02, 0.05, 0.11])),
        "graded, window": with_vertices(GRADED, window=(-2.0, 1.0, 0.5, 0.05)),
        "graded, coating": with_vertices(GRADED, interface=0.2),
        "graded, fast growth": with_vertices(GRADED, growth=0.5),
        "graded, whole width": with_vertices(GRADED, GRADED[-1], 3.0),
        "graded, thin": with_vertices(GRADED, 5.0, 0.3),
    },
    "coating": {
        "as thick as the contact": replace(BLOCK, interface=1.0),
        "thin coating": replace(BLOCK, interface=0.03),
        "as thin as an edge": replace(BLOCK, intervals=PATCHES, interface=0.05),
        "thick coating": replace(BLOCK, interface=15.0),
        "nearly all": replace(BLOCK, interface=36.0),
        "coating, window": replace(BLOCK, window=(-2.5, 1.0, 0.6, 0.04), interface=0.3),
        "coating, fast growth": replace(BLOCK, growth=0.5, interface=0.2),
        "coating, one size": BlockSpec(1.0, 1.0, np.array([[-0.5, 0.0]]), 0.1, 0.0, interface=0.4),
        "coating to a side": BlockSpec(2.0, 8.0, np.array([[-1.9, 0.1]]), 0.05, interface=0.06),
    },
}
ALL = {name: spec for kind in SPECS.values() for name, spec in kind.items()}


def of_kinds(*kinds: str) -> pytest.MarkDecorator:
    """One test for the mesh of each of these kinds of blocks."""
    names = [name for kind in kinds for name in SPECS[kind]]
    return pytest.mark.parametrize("mesh", names, indirect=True)


def top_vertices(mesh: BlockMesh) -> np.ndarray:
    """Ascending x (k,) [m] of the vertices on z = 0."""
    vertices = np.unique(mesh.triangles[:, :3])
    return np.sort(mesh.points[vertices][mesh.points[vertices, 1] == 0.0, 0])


def hooke(material: Material, exx, ezz, gxz) -> tuple:
    """sx, sz, txz [Pa] of strains exx, ezz, gxz."""
    shear, nu = material.shear_modulus, material.poissons_ratio
    mean = 2.0 * shear * nu / (1.0 - 2.0 * nu) * (exx + ezz)
    return mean + 2 * shear * exx, mean + 2 * shear * ezz, shear * gxz


def moved(body, size: float, seed: int) -> np.ndarray:
    """A smooth displacement (n, 2) [m] of some `size`, zero where the body is held."""
    wave = np.random.default_rng(seed).normal(size=(2, 4))
    x, z = body.nodes.T
    shape = np.stack([np.sin(row @ [x, z, x * z, z**2 + x**2]) for row in wave], axis=-1)
    return np.where(body.held, 0.0, size * shape)


class SumOfBodies:
    """Surfaces on the same hats pressed together: the sum of their weighted displacements."""

    def __init__(self, *bodies) -> None:
        self.bodies = bodies

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        return sum(body.apply(pressure) for body in self.bodies)


def graded(extent: float, first: float, ratio: float) -> np.ndarray:
    """0 to `extent` in steps that start near `first` and grow by `ratio`."""
    count = int(np.ceil(np.log1p(extent * (ratio - 1.0) / first) / np.log(ratio)))
    steps = ratio ** np.arange(count)
    return np.concatenate([[0.0], np.cumsum(steps) / steps.sum()]) * extent


def widened(middle: np.ndarray, beyond: np.ndarray) -> np.ndarray:
    """Ascending x: `middle`, and on both sides of it the distances `beyond` its ends, from 0 on."""
    return np.concatenate([middle[0] - beyond[:0:-1], middle, middle[-1] + beyond[1:]])


def structured_block(
    x: np.ndarray, z: np.ndarray, height: Callable | None = None, seed: int | None = None
) -> BlockMesh:
    """A structured block with its top at -height(x) and, by `seed`, random inner vertices.

    The shift decreases linearly to the bottom; inner vertices move by up to a fifth of a cell,
    against symmetries that hide a mistake.
    """
    mesh = structured(x, z)
    if seed is not None:
        vertices = mesh.points[: len(x) * len(z)].reshape(len(x), len(z), 2)
        random = np.random.default_rng(seed)
        for axis, cell in ((0, np.gradient(x)[1:-1, None]), (1, np.gradient(z)[None, 1:-1])):
            inner = vertices[1:-1, 1:-1, axis]
            inner += 0.2 * cell * random.uniform(-1, 1, inner.shape)
        points, _ = add_midpoints(vertices.reshape(-1, 2), mesh.triangles[:, :3])
        mesh = replace(mesh, points=points)
    if height is not None:
        mesh.shift[:, 1] = -height(mesh.points[:, 0]) * (1.0 - mesh.points[:, 1] / z[-1])
    return mesh


class Manufactured:
    """A smooth displacement that vanishes at depth 1, its stress, and the body force it needs."""

    def __init__(self, material: Material) -> None:
        self.material = material

    def displacement(self, x, z):
        return (z - 1) * np.sin(1.3 * x + 0.4 * z), (z - 1) * np.cos(0.7 * x - 0.9 * z)

    def stress(self, x, z):
        step = 1e-20  # imaginary: derivatives to machine precision
        ux_x, uz_x = (np.imag(u) / step for u in self.displacement(x + step * 1j, z))
        ux_z, uz_z = (np.imag(u) / step for u in self.displacement(x, z + step * 1j))
        return hooke(self.material, ux_x, uz_z, ux_z + uz_x)

    def body_force(self, x, z):
        h = 1e-5
        right, left = self.stress(x + h, z), self.stress(x - h, z)
        below, above = self.stress(x, z + h), self.stress(x, z - h)
        sx_x, _, txz_x = ((r - s) / (2 * h) for r, s in zip(right, left, strict=True))
        _, sz_z, txz_z = ((b - a) / (2 * h) for b, a in zip(below, above, strict=True))
        return -(sx_x + txz_z), -(txz_x + sz_z)
