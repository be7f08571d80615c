"""Layered surfaces under hats: coefficients, contact of a cylinder, thin and thick limits."""

import json

import numpy as np
import pytest
from hats import of_narrow_hats, solved
from scipy.linalg import toeplitz
from scipy.special import zeta

from analytic.exact.layers import TABLE
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody, normal_compliance
from analytic.layers.operator import LayeredSurface, TangentialLayer
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane

CASES = json.loads(TABLE.read_text())["cases"]
LAYER = Material(210e9, 0.3)
RIGID = ["bonded", "frictionless"]
SUBSTRATES = [Material(1e15, 0.2), Material(1e12, 0.45), Material(3e9, 0.0), Material(1e6, 0.4)]


def named(value):
    return f"{value.youngs_modulus:g} Pa" if isinstance(value, Material) else str(value)


def summed_symbol(cycles, pitch, body):
    """sum over all j of h C(k + 2 pi j/h) sinc^4: one by one to where the layer is a half-plane."""
    beyond = 2 + int(3.6 * pitch / body.thickness)
    alias = cycles[:, None] + np.arange(1 - beyond, beyond)
    waves = normal_compliance(body, 2.0 * np.pi * np.abs(alias) / pitch)
    rest = zeta(5.0, beyond + cycles) + zeta(5.0, beyond - cycles)
    rest *= (np.sin(np.pi * cycles) / np.pi) ** 4 * pitch**2
    rest /= np.pi * body.material.plane_strain_modulus
    return pitch * np.sum(np.sinc(alias) ** 4 * waves, axis=1) + rest


@pytest.mark.parametrize("pitch", [1e-3, 0.03, 0.5, 4.0, 10.0])
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.4999])
@pytest.mark.parametrize("base", RIGID)
def test_coefficients_are_the_limit_of_long_periods(base, nu, pitch):
    """Sums over waves and aliases, against ln|x| with a turned integral (units of t)."""
    body, count = LayeredBody(Material(1.0, nu), 1.0, base), 700
    length = 2 * int(count + 50.0 / pitch)
    symbol = summed_symbol(np.arange(length // 2 + 1) / length, pitch, body)
    summed = np.fft.irfft(symbol, length)[:count]
    column = LayeredSurface(count, pitch, body).column
    assert column == pytest.approx(summed, abs=3e-14 * pitch**2)


@pytest.mark.parametrize("ratio", [1e3, 1e6])
@pytest.mark.parametrize("base", RIGID + SUBSTRATES, ids=named)
def test_operators_on_thin_layers_are_finite_and_positive(base, ratio):
    body, count = LayeredBody(LAYER, 1.0, base), 128
    ones = np.cos(3.0 * np.arange(count))
    assert ones @ LayeredSurface(count, ratio, body).apply(ones) > 0.0
    assert np.all(np.isfinite(TangentialLayer(count, ratio, body).column))


@pytest.mark.parametrize("pitch", [1e-6, 1e-3, 0.4, 10.0, 1e4, 1e6])
@pytest.mark.parametrize("base", RIGID + SUBSTRATES, ids=named)
def test_coefficients_are_the_integral_over_all_waves(wave_rule, base, pitch):
    """Differences to the first."""
    body = LayeredBody(LAYER, 1.0, base)
    coefficients = LayeredSurface(3000, pitch, body).column
    for offset in (1, 2, 20):
        k, weights = wave_rule(pitch, offset)
        turn = -2.0 * np.sin(0.5 * k * pitch * offset) ** 2
        expected = pitch**2 / np.pi * np.sum(weights * normal_compliance(body, k) * turn)
        assert coefficients[offset] - coefficients[0] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("pitch", [1e-6, 1e-2, 1.0, 10.0])
def test_on_a_half_plane_of_its_own_material_it_is_the_half_plane(pitch):
    body = LayeredBody(LAYER, 1.0, LAYER)
    free = LayeredSurface(3000, pitch, body, datum=7.0)
    expected = HalfPlane(3000, pitch, LAYER.plane_strain_modulus, datum=7.0).column
    assert free.column == pytest.approx(expected, abs=2e-15 * np.abs(expected).max())


@pytest.mark.parametrize("base", [*RIGID, SUBSTRATES[1]], ids=named)
def test_under_a_grid_far_narrower_than_the_layer_it_is_a_half_plane_but_for_a_constant(base):
    body, half_plane = LayeredBody(LAYER, 1.0, base), LAYER.plane_strain_modulus
    for pitch, bound in ((1e-6, 2e-7), (1e-5, 2e-5)):
        column = LayeredSurface(500, pitch, body).column
        expected = HalfPlane(500, pitch, half_plane).column
        shift = column - expected
        assert np.ptp(shift) < bound * np.ptp(expected)
        assert np.ptp(shift) > 1e-3 * bound * np.ptp(expected)


@pytest.mark.parametrize("pitch", [1e-6, 1e-2, 1.0, 10.0])
@pytest.mark.parametrize("base", RIGID + SUBSTRATES, ids=named)
def test_operator_and_preconditioner_are_positive_definite(base, pitch):
    count = 90
    operator = LayeredSurface(count, pitch, LayeredBody(LAYER, 1.0, base))
    matrix = toeplitz(operator.column)
    columns = np.eye(count)
    applied = np.array([operator.apply(column) for column in columns]).T
    assert np.abs(applied - matrix).max() <= 1e-13 * np.abs(matrix).max()
    inverse = np.array([operator.precondition(column) for column in columns])
    assert np.abs(inverse - inverse.T).max() <= 1e-13 * np.abs(inverse).max()
    assert np.linalg.eigvalsh(matrix).min() > 0.0
    assert np.linalg.eigvalsh(inverse).min() > 0.0


@pytest.mark.parametrize("base", [*RIGID, SUBSTRATES[1], SUBSTRATES[2]], ids=named)
def test_coarsened_operators_agree_on_coarse_hats(base):
    body = LayeredBody(LAYER, 1.0, base)
    fine, refine = LayeredSurface(31, 0.1, body), of_narrow_hats(31)
    expected = refine.T @ toeplitz(fine.column) @ refine
    scale = np.abs(expected).max()
    assert toeplitz(fine.coarser.column) == pytest.approx(expected, abs=1e-13 * scale)


def pressed(body, half_width, count, **limits):
    """A cylinder of R = 1 m on `count` elements over 2.5 half-widths; pressures, and the grid."""
    pitch = 2.5 * half_width / count
    grid = HatGrid.within(-1.25 * half_width, 1.25 * half_width, pitch)
    operator = LayeredSurface(grid.count, pitch, body)
    gap = grid.hat_integrals(roller_gap(1.0))
    return solved(operator, gap, **limits), grid


@pytest.mark.parametrize("case", CASES, ids=lambda c: f"{c['base']}-{c['nu']}-{c['a_over_t']}")
def test_contact_of_a_cylinder(case):
    """Peak and second moment at the load of the reference, of second order; the profile.

    The second moment gives the half-width better than the number of nodes that touch.
    """
    nu = 0.3 if case["nu"] == "any" else float(case["nu"])
    body = LayeredBody(Material(1.0 - nu**2, nu), 1.0, case["base"])  # E' = 1, t = 1
    half_width, peak = float(case["a_over_t"]), float(case["p0_R_over_Eprime_t"])
    load, counts = float(case["P_R_over_Eprime_t2"]), (128, 512, 2048)
    errors = []
    for count in counts:
        solution, grid = pressed(body, half_width, count, load=load)
        errors.append(abs(np.max(solution.pressure) / peak - 1.0))
        touching = grid.pitch * np.count_nonzero(solution.pressure)
        assert touching == pytest.approx(2.0 * half_width, abs=1.5 * grid.pitch)
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert 1.9 < order < 2.2
    assert errors[-1] < 5e-7
    for place, expected in case["profile"].items():
        value = np.interp(float(place) * half_width, grid.x, solution.pressure) / peak
        assert value == pytest.approx(float(expected), abs=3e-7)


@pytest.mark.parametrize("base", RIGID)
def test_thick_layer_is_hertz(base):
    """a/t = 1e-3: the base changes the pressure by (a/t)^2."""
    body, half_width = LayeredBody(LAYER, 1.0, base), 1e-3
    modulus = LAYER.plane_strain_modulus
    solution, _ = pressed(body, half_width, 2048, load=0.25 * np.pi * modulus * half_width**2)
    assert np.max(solution.pressure) == pytest.approx(0.5 * modulus * half_width, rel=2e-6)


def load_at(body, half_width, approach):
    """Load under a cylinder of R = 1 m pressed in by `approach`, 1024 elements."""
    return pressed(body, half_width, 1024, approach=approach)[0].load


def test_thin_layer_on_a_frictionless_base_is_a_bed_of_springs():
    """P = (2/3) E' a^3/(R t) at d = a^2/2R: the slopes of K(w) at 0 vanish up to the fourth."""
    body = LayeredBody(LAYER, 1.0, "frictionless")
    for half_width, bound in ((25.0, 6e-6), (100.0, 1e-6)):
        load = load_at(body, half_width, 0.5 * half_width**2)
        springs = 2.0 / 3.0 * LAYER.plane_strain_modulus * half_width**3
        assert load == pytest.approx(springs, rel=bound)


def test_thin_bonded_layer_tends_to_a_bed_of_springs():
    """P as on a frictionless base, with M = E (1-nu)/((1+nu)(1-2nu)), but for (t/a)^2."""
    body, nu = LayeredBody(LAYER, 1.0, "bonded"), LAYER.poissons_ratio
    modulus = LAYER.youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    lacking = [
        1.0 - load_at(body, a, 0.5 * a**2) / (2.0 / 3.0 * modulus * a**3) for a in (20.0, 80.0)
    ]
    assert 0.0 < lacking[1] < 3e-5
    assert 1.75 < np.log(lacking[0] / lacking[1]) / np.log(4.0) < 2.1


def test_thin_incompressible_layer_is_far_stiffer():
    """P = (16/15) E a^5/(24 R t^3) at d = a^2/6R and nu = 1/2, but for (t/a)^2."""
    body = LayeredBody(Material(1.0, 0.5 - 1e-12), 1.0, "bonded")
    excess = [
        load_at(body, a, a**2 / 6.0) / (16.0 / 15.0 * a**5 / 24.0) - 1.0 for a in (40.0, 160.0)
    ]
    assert 0.0 < excess[1] < 1e-3
    assert 1.85 < np.log(excess[0] / excess[1]) / np.log(4.0) < 2.1


def test_approach_counts_from_the_base_and_not_from_the_grid():
    body = LayeredBody(LAYER, 1.0, "bonded")
    approaches = []
    for window in (1.0, 2.0):
        grid = HatGrid.within(-0.3 * window, 0.3 * window, 1.0 / 512)
        operator = LayeredSurface(grid.count, grid.pitch, body)
        gap = grid.hat_integrals(roller_gap(1.0))
        load = 0.01 * LAYER.plane_strain_modulus
        approaches.append(solved(operator, gap, load=load).approach)
    assert approaches[0] == pytest.approx(approaches[1], rel=1e-11)


@pytest.mark.parametrize("base", [*RIGID, SUBSTRATES[1], SUBSTRATES[2]], ids=named)
@pytest.mark.parametrize("half_width", [1e-3, 1.0, 50.0])
def test_finer_grids_cost_few_more_applications(base, half_width):
    """A dozen or so a grid, however fine."""
    body = LayeredBody(LAYER, 1.0, base)
    modulus = 2.0 * half_width / normal_compliance(body, 1.0 / half_width)
    spent = [
        pressed(body, half_width, count, load=0.3 * modulus * half_width**2)[0].iterations
        for count in (512, 8192)
    ]
    assert spent[1]["applications"] - spent[0]["applications"] < 4 * 20


def test_lengths_and_moduli_scale():
    operator = LayeredSurface(50, 0.02, LayeredBody(LAYER, 1.0, "bonded"))
    soft = Material(1e-3 * LAYER.youngs_modulus, LAYER.poissons_ratio)
    scaled = LayeredSurface(50, 0.02e-6, LayeredBody(soft, 1e-6, "bonded"))
    assert scaled.column * 1e12 / 1e3 == pytest.approx(operator.column, rel=1e-12)
