"""The half-plane on hats of unequal pitch against the one on equal hats."""

import numpy as np
import pytest
from scipy.integrate import trapezoid
from unequal_hats import half_plane_matrix, hat_weights

from analytic.grid import HatGrid, hat_integrals
from analytic.operators.half_plane import HalfPlane


def random_nodes(seed=0, count=60, fine=2000):
    """Nodes on a fine grid with pitches that differ up to fifty times."""
    inner = np.random.default_rng(seed).choice(np.arange(6, fine - 1), count, replace=False)
    return np.concatenate([[0, 1, 2, 4], np.sort(inner), [fine]])


def test_equal_hats_are_those_of_the_grid():
    hats = 0.3 + 0.01 * np.arange(122)
    grid = HalfPlane(120, 0.01, 3.0).block(np.arange(120))
    assert half_plane_matrix(hats, 3.0) == pytest.approx(grid, rel=1e-7)
    other = HalfPlane(120, 0.01, 3.0, datum=7.0).block(np.arange(120))
    assert half_plane_matrix(hats, 3.0, datum=7.0) == pytest.approx(other, rel=1e-7)


def test_unequal_hats_are_sums_of_equal_ones():
    nodes = random_nodes()
    fine, pitch = np.arange(1, nodes[-1]), 1e-3
    spread = np.stack([np.interp(fine, nodes, hat) for hat in np.eye(len(nodes))[1:-1]])
    grid = HalfPlane(len(fine), pitch, 1.0).block(np.arange(len(fine)))
    exact = spread @ grid @ spread.T
    assert half_plane_matrix(pitch * nodes, 1.0) == pytest.approx(exact, rel=3e-6)


def test_matrix_is_symmetric_positive_and_scales_with_the_unit_of_length():
    hats = 1e-3 * random_nodes(1)
    matrix = half_plane_matrix(hats, 1.0)
    assert matrix == pytest.approx(matrix.T, rel=1e-12)
    assert np.linalg.eigvalsh(matrix).min() > 0.0
    assert half_plane_matrix(1e-6 * hats, 5.0) == pytest.approx(1e-12 / 5.0 * matrix, rel=1e-9)
    mirrored = half_plane_matrix(-hats[::-1], 1.0)
    assert mirrored == pytest.approx(matrix[::-1, ::-1], rel=1e-6)


def test_averages_over_unequal_hats_are_exact_for_polynomials():
    hats = np.array([-1.0, -0.4, -0.1, 0.7, 2.0])
    power = np.arange(7)
    exact = np.zeros((3, 7))
    for i in range(3):
        a, b, c = hats[i : i + 3]
        # The hat's second derivative is three deltas: integrate x^k twice.
        whole = [t ** (power + 2.0) / ((power + 1.0) * (power + 2.0)) for t in (a, b, c)]
        exact[i] = (whole[0] - whole[1]) / (b - a) + (whole[2] - whole[1]) / (c - b)
    found = np.stack([hat_integrals(hats, lambda x, k=k: x**k) for k in power], axis=1)
    assert found == pytest.approx(exact, rel=1e-12, abs=1e-14)
    assert found[:, 0] == pytest.approx(hat_weights(hats), rel=1e-14)


def test_averages_with_a_knot_follow_a_kink():
    hats = np.array([0.0, 1.0, 3.0])
    kink = 1.6
    found = hat_integrals(hats, lambda x: np.abs(x - kink), np.array([kink]))
    x = np.linspace(0.0, 3.0, 300001)
    direct = trapezoid(np.interp(x, hats, [0, 1, 0]) * np.abs(x - kink), x)
    assert found == pytest.approx(direct, rel=1e-8)


def test_a_grid_of_hats_has_the_same_averages():
    grid = HatGrid(0.1, -5, 9)
    nodes = 0.1 * np.arange(-6, 11)
    assert grid.hat_integrals(np.exp) == pytest.approx(hat_integrals(nodes, np.exp), rel=1e-13)
