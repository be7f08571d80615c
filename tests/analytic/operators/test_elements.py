"""Displacement coefficients of strips and hats against high-precision values and each other."""

import numpy as np
import pytest
from exact_stresses import hat_displacement
from scenes import reference
from strips import strip_displacement

from analytic.operators.elements import hat_galerkin


def rows(name: str, key: str) -> tuple[np.ndarray, np.ndarray]:
    """Offsets and values of the rows of a reference file that hold `key`."""
    table = reference(name)["rows"]
    kept = [row for row in table if key in row]
    assert len(kept) > 15
    return np.array([float(r["offset"]) for r in kept]), np.array([float(r[key]) for r in kept])


@pytest.mark.parametrize(
    ("name", "key", "function"),
    [
        ("c_influence_coefficients", "Lu", strip_displacement),
        ("c_influence_coefficients", "Lh", hat_displacement),
        ("galerkin_hat_coefficients", "Lg", hat_galerkin),
    ],
)
def test_reference_values_to_rounding(name, key, function):
    offset, expected = rows(name, key)
    np.testing.assert_allclose(function(offset), expected, rtol=3e-15)


@pytest.mark.parametrize(
    ("key", "function"), [("Ku", strip_displacement), ("Kh", hat_displacement)]
)
@pytest.mark.parametrize("datum", ["datum1000", "datum_self"])
def test_displacement_follows_from_the_difference_to_the_datum(key, function, datum):
    offset, expected = rows("c_influence_coefficients", f"{key}_{datum}")
    origin = function(1000.0 if datum == "datum1000" else 0.0)
    displacement = -2.0 / np.pi * (function(offset) - origin)
    np.testing.assert_allclose(displacement, expected, rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize(
    ("function", "join"), [(strip_displacement, 1.0), (hat_displacement, 1.5), (hat_galerkin, 3.0)]
)
def test_closed_form_and_moments_meet_where_they_join(function, join):
    for x in (join, 8.0 * join):
        below, above = function(np.array([np.nextafter(x, 0.0), x]))
        assert abs(above - below) < 1e-14


def test_hat_is_the_mean_of_strips_and_galerkin_the_mean_of_hats():
    """A strip smeared by a strip is a hat, and a hat smeared by two strips a cubic spline."""
    node, weight = np.polynomial.legendre.leggauss(24)
    x = np.array([2.5, 3.0, 7.0, 30.0])
    strips = strip_displacement(x[:, None] - 0.5 * node) @ weight / 2.0
    np.testing.assert_allclose(strips, hat_displacement(x), rtol=1e-14)
    shift = 0.5 * (node[:, None] + node[None, :]).ravel()
    hats = hat_displacement(x[:, None] - shift) @ np.outer(weight, weight).ravel() / 4.0
    np.testing.assert_allclose(hats, hat_galerkin(x), rtol=1e-14)


@pytest.mark.parametrize("function", [strip_displacement, hat_displacement, hat_galerkin])
def test_even_in_the_offset_and_of_the_offsets_shape(function):
    x = np.array([[0.0, 0.3, 1.0], [2.7, 40.0, 1e5]])
    assert function(x).shape == x.shape
    np.testing.assert_array_equal(function(-x), function(x))
    assert np.ndim(function(3)) == 0


def test_galerkin_matrix_is_positive_definite_for_pressures_without_resultant():
    """The energy of a self-balanced pressure is positive: -L_g is positive on sum(p) = 0."""
    n = 60
    matrix = -hat_galerkin(np.subtract.outer(np.arange(n), np.arange(n)))
    balanced = np.linalg.qr(np.column_stack([np.ones(n), np.eye(n)[:, 1:]]))[0][:, 1:]
    assert np.linalg.eigvalsh(balanced.T @ matrix @ balanced).min() > 0.02
