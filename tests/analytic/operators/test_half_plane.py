"""The half-plane's surface compliance: coefficients, application by FFT, positive definiteness."""

import numpy as np
import pytest
from exact_stresses import hat_displacement
from hats import of_narrow_hats
from numpy.polynomial.legendre import leggauss
from scipy.linalg import toeplitz
from strips import StripHalfPlane

from analytic.operators.half_plane import HalfPlane, SumOfConvolutions
from analytic.operators.periodic import PeriodicHalfPlane

PITCH, MODULUS = 0.7e-6, 115e9


@pytest.mark.parametrize("count", [1, 2, 5, 64, 257])
def test_application_by_fft_is_the_toeplitz_product(count):
    operator = HalfPlane(count, PITCH, MODULUS)
    pressure = np.random.default_rng(3).standard_normal(count)
    dense = toeplitz(operator.column) @ pressure
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
    assert operator.column == pytest.approx(np.array(column), rel=1e-6)


def test_strips_are_the_influence_coefficients_of_webster_and_sayles():
    """Deflection at the middle of each strip under unit pressure on one (Johnson, eq. 2.30a)."""
    operator = StripHalfPlane(5, PITCH, MODULUS)
    points, weights = leggauss(60)
    for offset in range(1, 5):
        source = 0.5 * points * PITCH
        log = np.log(np.abs(offset * PITCH - source) / operator.datum)
        deflection = -2.0 / (np.pi * MODULUS) * np.sum(0.5 * PITCH * weights * log)
        assert operator.column[offset] == pytest.approx(PITCH * deflection, rel=1e-12)


@pytest.mark.parametrize("kind", [HalfPlane, StripHalfPlane])
@pytest.mark.parametrize("count", [3, 50, 400])
def test_operator_and_preconditioner_are_positive_definite(count, kind):
    operator = kind(count, PITCH, MODULUS)
    columns = np.eye(count)
    approximate_inverse = np.array([operator.precondition(column) for column in columns])
    asymmetry = np.abs(approximate_inverse - approximate_inverse.T).max()
    assert asymmetry < 1e-14 * np.abs(approximate_inverse).max()
    assert np.linalg.eigvalsh(toeplitz(operator.column)).min() > 0.0
    assert np.linalg.eigvalsh(approximate_inverse).min() > 0.0


def test_coarsened_operator_agrees_on_coarse_hats():
    """A coarse hat is 1/2, 1, 1/2 of fine ones, and so is the operator between them."""
    fine, refine = HalfPlane(15, PITCH, MODULUS), of_narrow_hats(15)
    expected = refine.T @ toeplitz(fine.column) @ refine
    assert toeplitz(fine.coarser.column) == pytest.approx(expected, rel=1e-11)


def test_a_base_sinks_in_proportion_to_the_load():
    """Whatever the pressures are, and no further up than where the half-plane stands."""
    plain = HalfPlane(50, PITCH, MODULUS)
    compliance = 3.0 / MODULUS
    on_base = plain.on_base(compliance)
    pressure = np.random.default_rng(6).standard_normal(50)
    sunk = PITCH * compliance * PITCH * pressure.sum()
    moved = on_base.apply(pressure) - plain.apply(pressure)
    assert moved == pytest.approx(np.full(50, sunk), rel=1e-10)
    assert plain.on_base(-compliance).datum == plain.datum
    far = plain.on_base(1e6 * compliance)
    assert np.isfinite(far.datum) and np.isfinite(far.column).all()


@pytest.mark.parametrize("periodic", [False, True])
def test_sum_of_convolutions_is_one_body_of_the_combined_modulus(periodic):
    kind = PeriodicHalfPlane if periodic else HalfPlane
    both = SumOfConvolutions(kind(600, PITCH, 70e9), kind(600, PITCH, 210e9))
    combined = kind(600, PITCH, 1.0 / (1.0 / 70e9 + 1.0 / 210e9))
    values = np.random.default_rng(8).uniform(size=600)
    assert both.apply(values) == pytest.approx(combined.apply(values), rel=1e-12)
    inverse = combined.precondition(values)
    assert both.precondition(values) == pytest.approx(inverse, abs=1e-11 * np.abs(inverse).max())
    coarse, alone = both.coarser, combined.coarser
    assert coarse.apply(values[:300]) == pytest.approx(alone.apply(values[:300]), rel=1e-12)
    assert coarse is both.coarser


def test_bodies_with_other_elements_are_not_added():
    with pytest.raises(ValueError, match="the same elements"):
        SumOfConvolutions(HalfPlane(20, PITCH, 70e9), HalfPlane(21, PITCH, 70e9))


def test_a_row_that_closes_over_the_end_of_a_period_is_solved_for_directly():
    operator = PeriodicHalfPlane(200, PITCH, MODULUS)
    nodes = np.flatnonzero(np.abs(np.arange(200) - 100) > 30)
    right = np.random.default_rng(10).normal(size=(len(nodes), 2))
    assert len(nodes) < 200 and nodes[0] == 0 and nodes[-1] == 199
    matrix = operator.block(nodes)
    assert matrix == pytest.approx(toeplitz(operator.column)[np.ix_(nodes, nodes)], rel=1e-9)
    assert operator.solve(nodes, matrix @ right) == pytest.approx(right, abs=1e-10)


@pytest.mark.parametrize("span", [1500, 2000, 4096])
def test_a_stretch_of_the_line_has_the_same_compliance(span):
    operator = HalfPlane(8000, PITCH, MODULUS)
    stretch = operator.cropped(span)
    assert span <= stretch.count <= 0.75 * 8000
    pressure = np.random.default_rng(11).uniform(size=stretch.count)
    line = np.zeros(8000)
    line[700 : 700 + stretch.count] = pressure
    expected = operator.apply(line)[700 : 700 + stretch.count]
    assert stretch.apply(pressure) == pytest.approx(expected, rel=1e-12)
    assert operator.cropped(span) is stretch
