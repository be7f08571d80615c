"""The periodic half-plane: its images, Westergaard's contact, full contact, coarser grids."""

import numpy as np
import pytest
from hats import of_narrow_hats, solved
from scenes import reference
from scipy.linalg import circulant
from scipy.special import zeta
from strips import PeriodicStrips, StripHalfPlane

from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane, hat_aliases

WESTERGAARD = reference("d_westergaard")
PITCH, MODULUS = 0.7e-6, 115e9
COUNTS = (128, 256, 512, 1024, 2048)


@pytest.fixture(scope="module")
def waves():
    """Errors of peak, half-width, mean and valley gap (loads, counts, 4).

    Half-width by the first moment int p cos 2 psi / int p = 1 - (sin^2 psi_a)/2, which a grid
    resolves better than the number of its nodes that touch.
    """
    errors = np.empty((len(WESTERGAARD["cases"]), len(COUNTS), 4))
    for row, case in enumerate(WESTERGAARD["cases"]):
        expected = {key: float(value) for key, value in case.items() if key != "profile"}
        for column, count in enumerate(COUNTS):
            grid = HatGrid(1.0 / count, 0, count - 1)
            wave = grid.hat_integrals(lambda x: 1.0 - np.cos(2.0 * np.pi * x))
            load = expected["pbar_over_pstar"] * np.pi
            operator = PeriodicHalfPlane(count, grid.pitch, 1.0)
            solution = solved(operator, wave, load=load)
            width = grid.pitch * np.count_nonzero(solution.pressure)
            touching = 2.0 * expected["half_width_over_lambda"]
            assert width == pytest.approx(touching, abs=1.5 * grid.pitch)
            share = np.cos(2.0 * np.pi * grid.x) @ solution.pressure / np.sum(solution.pressure)
            share *= np.sinc(1.0 / count) ** 2  # of hats
            half_width = np.arcsin(np.sqrt(2.0 * (1.0 - share))) / np.pi
            errors[row, column] = (
                np.max(solution.pressure) / np.pi / expected["peak_p_over_pstar"] - 1.0,
                half_width / expected["half_width_over_lambda"] - 1.0,
                np.mean(solution.gap) - expected["mean_gap_over_Delta"],
                solution.gap[count // 2] - expected["valley_gap_over_Delta"],
            )
    return np.abs(errors)


@pytest.mark.parametrize(
    ("quantity", "ceiling"),
    [(0, 3e-5), (1, 5e-5), (2, 2e-6), (3, 3e-6)],
    ids=["peak", "half-width", "mean gap", "valley gap"],
)
def test_partial_contact_of_a_wave_converges_to_westergaard(waves, quantity, ceiling):
    """The order is 2; where the edge falls between two nodes scatters single steps."""
    worst = waves[:, :, quantity].max(axis=0)
    order = -np.polyfit(np.log(COUNTS), np.log(worst), 1)[0]
    assert 1.75 < order < 2.35
    assert worst[-1] < ceiling


def test_symbol_is_the_sum_over_aliases():
    """Summed one by one to 20000."""
    cycles = np.array([1e-6, 0.01, 0.2, 0.37, 0.5])
    alias = cycles[:, None] + np.arange(-20000, 20001)
    summed = np.sum(np.sinc(alias) ** 4 / np.abs(alias), axis=1)
    assert hat_aliases(cycles) == pytest.approx(summed, rel=1e-14)


@pytest.mark.parametrize("kind", [PeriodicHalfPlane, PeriodicStrips])
@pytest.mark.parametrize("count", [8, 9])
def test_coefficients_are_those_of_the_half_plane_and_all_its_images(kind, count):
    """Loads of zero sum: the images of elements i and 0 differ like 1/j^2 and 1/j^4."""
    images = 4000
    alone = HalfPlane if kind is PeriodicHalfPlane else StripHalfPlane
    free = alone(count * (images + 1), PITCH, MODULUS).column
    offset = np.abs(np.arange(count)[:, None] + count * np.arange(-images, images + 1))
    padded = free[np.minimum(offset, len(free) - 1)]
    summed = np.sum(padded - padded[:1], axis=1)
    # beyond: ln(j^2 L^2 - x^2) - ln(j^2 L^2) = -x^2/(j L)^2 - ...
    beyond = (np.arange(count) / count) ** 2 * zeta(2.0, images + 1.0)
    summed += 2.0 * PITCH**2 / (np.pi * MODULUS) * beyond
    column = kind(count, PITCH, MODULUS).column
    expected = summed - summed[:1]
    assert column - column[0] == pytest.approx(expected, abs=1e-11 * np.ptp(expected))


@pytest.mark.parametrize("count", [1, 2, 3, 50, 129])
def test_operator_is_positive_definite_and_its_preconditioner_the_inverse(count):
    operator = PeriodicHalfPlane(count, PITCH, MODULUS)
    columns = np.eye(count)
    matrix = np.array([operator.apply(column) for column in columns]).T
    np.testing.assert_allclose(matrix, circulant(operator.column), rtol=1e-12)
    np.testing.assert_allclose(matrix, matrix.T, rtol=1e-12)
    assert np.linalg.eigvalsh(matrix).min() > 0.0
    inverse = np.array([operator.precondition(column) for column in matrix.T]).T
    np.testing.assert_allclose(inverse, columns, rtol=0.0, atol=1e-12)


def test_mean_pressure_has_the_compliance_of_the_longest_wave():
    count = 30
    operator = PeriodicHalfPlane(count, PITCH, MODULUS)
    period = count * PITCH
    mean = operator.apply(np.ones(count)) / PITCH
    assert mean == pytest.approx(np.full(count, period / (np.pi * MODULUS)), rel=1e-12)


def test_coarsened_operator_agrees_on_coarse_hats_around_the_circle():
    """A coarse hat is 1/2, 1, 1/2 of fine ones, its middle at every odd node."""
    fine, refine = PeriodicHalfPlane(16, PITCH, MODULUS), of_narrow_hats(16, around=True)
    coarse = fine.coarser
    expected = refine.T @ circulant(fine.column) @ refine
    assert circulant(coarse.column) == pytest.approx(expected, rel=1e-12)
    assert coarse.coarser.coarser is None
    assert PeriodicHalfPlane(9, PITCH, MODULUS).coarser is None


def test_full_contact_has_the_exact_wave():
    """p = pm + pi E* A/lambda cos: its Fourier coefficient but for the hats' own aliases,
    c^5 zeta(5), and its nodal values but for the hats' width, of second order."""
    wavelength, amplitude, mean = 1e-3, 2e-7, 1.5
    closing = np.pi * MODULUS * amplitude / wavelength
    nodal = []
    for count in (16, 32, 64, 128):
        grid = HatGrid(wavelength / count, 0, count - 1)
        cosine = np.cos(2.0 * np.pi * grid.x / wavelength)
        averaged = np.sinc(1.0 / count) ** 2 * grid.pitch * cosine  # of the wave over each hat
        operator = PeriodicHalfPlane(count, grid.pitch, MODULUS)
        load = mean * closing * wavelength
        solution = solved(operator, -amplitude * averaged, load=load)
        assert np.all(solution.pressure > 0.0)
        wave = 2.0 / count * np.sinc(1.0 / count) ** 2 * (cosine @ solution.pressure) / closing
        assert 1.0 - wave == pytest.approx(2.0 * zeta(5.0) / count**5, rel=6.0 / count, abs=1e-11)
        nodal.append(np.max(np.abs(solution.pressure / closing - mean - cosine)))
    orders = np.log2(np.array(nodal[:-1]) / nodal[1:])
    assert np.all((orders > 1.98) & (orders < 2.02))
    assert nodal[-1] < 2.5e-4


def test_light_load_on_a_long_period_is_the_free_contact():
    """Half-width 1/100 of the period: images change the contact by (pi a/L)^2 and less."""
    count, radius = 2000, 1.0
    grid = HatGrid(1.0 / count, -count // 2, count // 2 - 1)
    gap = grid.hat_integrals(lambda x: (1.0 - np.cos(2.0 * np.pi * x)) / (4.0 * np.pi**2 * radius))
    load = np.pi * 0.01**2 / 4.0
    around = solved(PeriodicHalfPlane(count, grid.pitch, 1.0), gap, load=load)
    free = solved(HalfPlane(count, grid.pitch, 1.0), gap, load=load)
    assert np.max(around.pressure) == pytest.approx(np.max(free.pressure), rel=2e-3)
    assert np.max(around.pressure) != pytest.approx(np.max(free.pressure), rel=1e-5)
