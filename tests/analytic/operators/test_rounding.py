"""Direct solvers and products by FFT err by rounding, as LAPACK tests its solvers.

    ||b - A x|| / (||A|| ||x|| eps) < 30   whatever the condition of A is

(Anderson et al. 1999, LAPACK working note 41, test ratios of xGET02), for the ordinary grid and for
the matrices of worst condition: many nodes, incompressible layers, coatings of high contrast."""

from functools import partial

import numpy as np
import pytest

from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import coupled_half_planes

THRESHOLD = 30.0  # LAPACK's own for its test ratios
ELASTOMER = LayeredBody(Material(1.0, 0.5 - 1e-9), 0.02, "bonded")
COATED = LayeredBody(Material(1e6, 0.3), 1.0, Material(1.0, 0.3))
half_plane = partial(HalfPlane, pitch=1.0, modulus=1.0)
elastomer = partial(LayeredSurface, pitch=0.05, body=ELASTOMER)
stiff_coating = partial(LayeredSurface, pitch=1e-3, body=COATED)
sliding = partial(coupled_half_planes, pitch=1.0, modulus=1.0, friction_dundurs=1.0)
SCATTERED = np.flatnonzero(np.random.default_rng(4).uniform(size=1000) < 0.1)[:120]


def solver_ratio(operator, nodes) -> float:
    """The ratio of two random right sides, the larger one."""
    right = np.random.default_rng(1).standard_normal((len(nodes), 2)) * operator.column[0]
    matrix, solution = operator.block(nodes), operator.solve(nodes, right)
    residual = np.abs(right - matrix @ solution).sum(axis=0)
    size = np.linalg.norm(matrix, 1) * np.abs(solution).sum(axis=0)
    return float(np.max(residual / size)) / np.finfo(float).eps


@pytest.mark.parametrize(
    ("operator", "nodes"),
    [
        (half_plane(1000), SCATTERED),
        (half_plane(1000), np.arange(300, 540)),
        (elastomer(400), np.arange(80, 320)),
        (stiff_coating(400), np.arange(100, 220)),
        (sliding(1000), SCATTERED),
    ],
    ids=["half-plane, scattered", "half-plane", "elastomer", "stiff coating", "sliding"],
)
def test_few_nodes_are_solved_for_to_rounding(operator, nodes):
    assert solver_ratio(operator, nodes) < THRESHOLD


def test_a_solver_in_32_bits_is_seen(monkeypatch):
    def loose(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.linalg.solve(matrix, right).astype(np.float32).astype(float)

    monkeypatch.setattr("analytic.operators.convolution.cholesky_solve", loose)
    assert solver_ratio(half_plane(1000), SCATTERED) > 1e3 * THRESHOLD


@pytest.mark.parametrize(
    ("make", "count", "kind"),
    [
        (half_plane, 4096, float),
        (half_plane, 65536, float),
        (half_plane, 4096, np.float32),
        (elastomer, 4096, float),
        (sliding, 4096, float),
    ],
)
def test_a_product_by_fft_errs_by_rounding(make, count, kind):
    """Against longer numbers, row by row; the ratio grows like log n at most."""
    operator = make(count)
    pressure = np.random.default_rng(2).uniform(0.0, 1.0, count).astype(kind)
    rows = np.unique(np.linspace(0, count - 1, 64).astype(int))
    distance = rows[:, None] - np.arange(count)
    matrix = np.where(distance >= 0, operator.column[abs(distance)], operator.row[abs(distance)])
    exact = matrix.astype(np.longdouble) @ pressure.astype(np.longdouble)
    error = np.abs(operator.apply(pressure)[rows] - exact).max()
    size = np.abs(matrix).sum(axis=1).max() * np.abs(pressure).max()
    assert error / (size * np.finfo(kind).eps) < THRESHOLD
