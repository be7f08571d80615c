"""The half-plane's surface compliance: coefficients, application by FFT, positive definiteness."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.linalg import toeplitz

from analytic.elements import hat_displacement
from analytic.operators import HalfPlane, SumOfBodies

PITCH, MODULUS = 0.7e-6, 115e9


@pytest.mark.parametrize("count", [1, 2, 5, 64, 257])
def test_application_by_fft_is_the_toeplitz_product(count):
    operator = HalfPlane(count, PITCH, MODULUS)
    pressure = np.random.default_rng(3).standard_normal(count)
    dense = toeplitz(operator.coefficients) @ pressure
    assert operator.apply(pressure) == pytest.approx(dense, rel=1e-12, abs=1e-12 * abs(dense).max())


def test_coefficients_are_the_averages_of_the_displacement_under_a_hat():
    """Gauss integration of hat times exact displacement, interval by interval."""
    operator = HalfPlane(6, PITCH, MODULUS)
    points, weights = leggauss(80)
    share = 0.5 * (points + 1.0)
    column = []
    for offset in range(6):
        total = 0.0
        for side in (-1.0, 1.0):
            displacement = -hat_displacement(offset + side * share) - np.log(PITCH / operator.datum)
            total += np.sum(0.5 * weights * (1.0 - share) * displacement)
        column.append(2.0 * PITCH**2 / (np.pi * MODULUS) * total)
    assert operator.coefficients == pytest.approx(np.array(column), rel=1e-6)


def test_strips_are_the_influence_coefficients_of_webster_and_sayles():
    """Deflection at the middle of each strip under unit pressure on one (Johnson, eq. 2.30a)."""
    operator = HalfPlane(5, PITCH, MODULUS, element="strip")
    points, weights = leggauss(60)
    for offset in range(1, 5):
        source = 0.5 * points * PITCH
        log = np.log(np.abs(offset * PITCH - source) / operator.datum)
        deflection = -2.0 / (np.pi * MODULUS) * np.sum(0.5 * PITCH * weights * log)
        assert operator.coefficients[offset] == pytest.approx(PITCH * deflection, rel=1e-12)


@pytest.mark.parametrize("element", ["hat", "strip"])
@pytest.mark.parametrize("count", [3, 50, 400])
def test_operator_and_preconditioner_are_positive_definite(count, element):
    operator = HalfPlane(count, PITCH, MODULUS, element=element)
    columns = np.eye(count)
    approximate_inverse = np.array([operator.precondition(column) for column in columns])
    asymmetry = np.abs(approximate_inverse - approximate_inverse.T).max()
    assert asymmetry < 1e-14 * np.abs(approximate_inverse).max()
    assert np.linalg.eigvalsh(toeplitz(operator.coefficients)).min() > 0.0
    assert np.linalg.eigvalsh(approximate_inverse).min() > 0.0


def test_coarsened_operator_agrees_on_coarse_hats():
    """A coarse hat is 1/2, 1, 1/2 of fine ones, and so is the operator between them."""
    fine = HalfPlane(15, PITCH, MODULUS)
    coarse = fine.coarsened()
    refine = np.zeros((15, 7))
    for j in range(7):
        refine[2 * j : 2 * j + 3, j] = 0.5, 1.0, 0.5
    expected = refine.T @ toeplitz(fine.coefficients) @ refine
    assert toeplitz(coarse.coefficients) == pytest.approx(expected, rel=1e-11)


def test_sum_of_bodies_is_the_half_plane_of_the_combined_modulus():
    both = SumOfBodies(HalfPlane(40, PITCH, 70e9), HalfPlane(40, PITCH, 210e9))
    combined = HalfPlane(40, PITCH, 1.0 / (1.0 / 70e9 + 1.0 / 210e9))
    pressure = np.linspace(0.0, 1e9, 40)
    assert both.apply(pressure) == pytest.approx(combined.apply(pressure), rel=1e-13)
    scaled = SumOfBodies(HalfPlane(40, PITCH, 210e9), factors=(4.0,))
    assert scaled.apply(pressure) == pytest.approx(combined.apply(pressure), rel=1e-13)
