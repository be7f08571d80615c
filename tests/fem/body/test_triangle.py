"""The quadrature rule on the triangle."""

import numpy as np
import pytest

from fem.body.triangle import collapsed_gauss, inverse


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_the_rule_on_the_triangle_is_exact_to_its_degree_and_not_beyond(degree):
    """Integral of r^a s^b over the triangle: a! b! / (a + b + 2)!."""
    at, weight = collapsed_gauss(degree)
    exact = 2 * degree - 2
    assert weight @ at[:, 1] ** exact == pytest.approx(1 / (exact + 1) / (exact + 2), rel=1e-14)
    assert weight @ (at[:, 0] ** exact) == pytest.approx(1 / (exact + 1) / (exact + 2), rel=1e-14)
    beyond = 2 * degree
    assert weight @ at[:, 1] ** beyond != pytest.approx(1 / (beyond + 1) / (beyond + 2), rel=1e-6)


def test_inverses_are_those_of_numpy():
    matrices = np.random.default_rng(2).normal(size=(40, 3, 2, 2))
    np.testing.assert_allclose(inverse(matrices), np.linalg.inv(matrices), rtol=1e-10)
