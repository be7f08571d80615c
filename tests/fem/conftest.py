"""Bodies to test on: structured blocks with exact control of the nodes; a pressed half-plane."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.material import Material
from fem.compliance import FiniteElementCompliance
from fem.elasticity import Support, elastic_body
from fem.stress import NodalStress, nodal_stress
from fem.surface import hat_nodes
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.second_order import add_midpoints


def structured(
    x: np.ndarray, z: np.ndarray, height: Callable | None = None, seed: int | None = None
) -> BlockMesh:
    """Two triangles to each cell of the grid x (ascending) by z (from 0 to the depth).

    `height` moves the top by -height(x), fading linearly to the bottom; `seed` jitters the inner
    vertices by up to a fifth of a cell so that no symmetry hides a mistake.
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


def graded_grid(extent: float, first: float, ratio: float) -> np.ndarray:
    """0 to `extent` in steps that start near `first` and grow by `ratio`."""
    count = int(np.ceil(np.log1p(extent * (ratio - 1.0) / first) / np.log(ratio)))
    steps = ratio ** np.arange(count)
    return np.concatenate([[0.0], np.cumsum(steps) / steps.sum()]) * extent


@pytest.fixture(scope="session")
def structured_block() -> Callable[..., BlockMesh]:
    return structured


@pytest.fixture(scope="session")
def graded() -> Callable[..., np.ndarray]:
    return graded_grid


# Degree 8 on the square, collapsed onto the triangle: far more than what is tested.
LINE, LINE_WEIGHT = np.polynomial.legendre.leggauss(5)
LINE, LINE_WEIGHT = 0.5 * (1.0 + LINE), 0.5 * LINE_WEIGHT
AREA = np.array([[r, s * (1.0 - r)] for r in LINE for s in LINE])
AREA_WEIGHT = np.array(
    [w * v * (1.0 - r) for r, w in zip(LINE, LINE_WEIGHT, strict=True) for v in LINE_WEIGHT]
)


def quadratic(t: np.ndarray) -> np.ndarray:
    """Shape functions (3, q) on an edge: start, middle, end."""
    return np.stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)])


def forces_of(
    mesh: BlockMesh, stress: Callable, body_force: Callable | None = None, degree: int = 2
) -> np.ndarray:
    """Nodal forces (n, 2) of the boundary tractions of a stress field (and of a body force).

    `stress`(x, z) gives sx, sz, txz; `body_force`(x, z) two components; `degree` is that of the
    displacement. Written apart from the code under test: plain loops over nodes, own quadrature.
    """
    from fem.nodes import nodes_of
    from fem.triangle import edge_shapes, jacobians, shapes

    elements = nodes_of(mesh, degree).elements
    points = mesh.points + mesh.shift
    corner = points[mesh.triangles[:, :3]]
    side, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    turn = np.sign(side[:, 0] * other[:, 1] - side[:, 1] * other[:, 0])
    load = np.zeros((elements.max() + 1, 2))
    inner = [range(3 + k * (degree - 1), 3 + (k + 1) * (degree - 1)) for k in range(3)]
    own = elements[:, [[k, *inner[k], (k + 1) % 3] for k in range(3)]].reshape(-1, degree + 1)
    edges = mesh.triangles[:, [[0, 3, 1], [1, 4, 2], [2, 5, 0]]].reshape(-1, 3)
    turn = np.repeat(turn, 3)
    outer = np.bincount(edges[:, 1], minlength=len(points))[edges[:, 1]] == 1
    edges, own, turn = edges[outer], own[outer], turn[outer]
    slope = np.stack([4 * LINE - 3, 4 - 8 * LINE, 4 * LINE - 1])
    place = np.einsum("eac,aq->eqc", points[edges], quadratic(LINE))
    tangent = np.einsum("eac,aq->eqc", points[edges], slope) * turn[:, None, None]
    sx, sz, txz = np.broadcast_arrays(*stress(place[..., 0], place[..., 1]))
    along, down = tangent[..., 1], -tangent[..., 0]
    traction = np.stack([sx * along + txz * down, txz * along + sz * down], axis=-1)
    for node, shape in enumerate(edge_shapes(LINE, degree).T):
        np.add.at(load, own[:, node], np.einsum("eqc,q->ec", traction, LINE_WEIGHT * shape))
    if body_force is not None:
        nodes = points[mesh.triangles]
        place = np.einsum("mac,qa->mqc", nodes, shapes(AREA))
        volume = np.abs(np.linalg.det(jacobians(nodes, AREA))) * AREA_WEIGHT
        force = np.stack(body_force(place[..., 0], place[..., 1]), axis=-1)
        for node, shape in enumerate(shapes(AREA, degree).T):
            np.add.at(load, elements[:, node], np.einsum("mqc,mq->mc", force, volume * shape))
    return load


@pytest.fixture(scope="session")
def exact_forces() -> Callable[..., np.ndarray]:
    return forces_of


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
        shear, nu = self.material.shear_modulus, self.material.poissons_ratio
        mean = 2.0 * shear * nu / (1.0 - 2.0 * nu) * (ux_x + uz_z)
        return mean + 2 * shear * ux_x, mean + 2 * shear * uz_z, shear * (ux_z + uz_x)

    def body_force(self, x, z):
        h = 1e-5
        right, left = self.stress(x + h, z), self.stress(x - h, z)
        below, above = self.stress(x, z + h), self.stress(x, z - h)
        sx_x, _, txz_x = ((r - s) / (2 * h) for r, s in zip(right, left, strict=True))
        _, sz_z, txz_z = ((b - a) / (2 * h) for b, a in zip(below, above, strict=True))
        return -(sx_x + txz_z), -(txz_x + sz_z)


@pytest.fixture(scope="session")
def manufactured() -> type[Manufactured]:
    return Manufactured


def dense_contact(matrix: np.ndarray, gap: np.ndarray, weights: np.ndarray, load: float):
    """Pressure and approach of matrix p + gap - d weights >= 0, p >= 0, complementary, w'p = load.

    Plain active set on a dense matrix, written apart from every solver of the project.
    """
    inside = gap < 0.5 * gap.max()
    for _ in range(100):
        w = weights[inside]
        system = np.block([[matrix[np.ix_(inside, inside)], -w[:, None]], [w, np.zeros((1, 1))]])
        *pressure, approach = np.linalg.solve(system, np.append(-gap[inside], load))
        whole = np.zeros(len(gap))
        whole[inside] = pressure
        opening = matrix @ whole + gap - approach * weights
        wanted = np.where(inside, whole > 0.0, opening < 0.0)
        if np.array_equal(wanted, inside):
            return whole, approach
        inside = wanted
    raise AssertionError("the active set did not settle")


class Pressed:
    """A half-plane's stand-in and a rigid cylinder that would press it on half-width 1, peak 1."""

    def __init__(
        self,
        edges: int,
        growth: float = 0.2,
        half_width: float = 4000.0,
        depth: float = 4000.0,
        poisson: float = 0.3,
        **held,
    ) -> None:
        self.hertz = hertz_from_peak_pressure(1.0, 0.5, 1.0)
        spec = BlockSpec(half_width, depth, np.array([[-1.4, 1.4]]), 1.0 / edges, growth)
        self.body = elastic_body(
            build_block(spec), Material(1.0 - poisson**2, poisson), Support(**held)
        )
        pitch = 1.0 / edges
        reach = edges + 8
        self.x = pitch * np.arange(-reach, reach + 1)
        self.compliance = FiniteElementCompliance(
            self.body, hat_nodes(self.x[0], pitch, len(self.x))
        )
        gap = pitch * (self.x**2 + pitch**2 / 6.0)
        weights = np.full(len(self.x), pitch)
        self.pressure, self.approach = dense_contact(
            self.compliance.matrix(), gap, weights, self.hertz.load_per_length
        )

    def pressure_at(self, x: np.ndarray) -> np.ndarray:
        return np.interp(x, self.x, self.pressure)

    def displacement(self, friction: float) -> np.ndarray:
        return self.compliance.displacement(self.pressure, friction)

    def stress(self, friction: float) -> NodalStress:
        moved = self.displacement(friction)
        return nodal_stress(self.body, moved, self.compliance.hats, self.pressure, friction)


@pytest.fixture(scope="session")
def pressed() -> Callable[..., Pressed]:
    return cache(Pressed)


@pytest.fixture(scope="session")
def dense() -> Callable[..., tuple[np.ndarray, float]]:
    return dense_contact
