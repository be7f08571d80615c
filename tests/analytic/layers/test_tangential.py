"""Normal displacement under sliding traction: half-planes, waves, strain in the layer, symmetry."""

import numpy as np
import pytest
from hats import of_narrow_hats, solved
from layer_stresses import BASES, LAYER, coupling_compliance
from scipy.linalg import toeplitz

from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface, TangentialLayer
from analytic.operators.tangential import CoupledPair, coupled_half_planes, hat_sign


@pytest.mark.parametrize("pitch", [1e-6, 0.01, 1.0, 10.0])
def test_on_a_half_plane_of_its_own_material_it_is_the_half_plane(pitch):
    count, nu = 201, LAYER.poissons_ratio
    column = TangentialLayer(count, pitch, LayeredBody(LAYER, 1.0, LAYER)).column
    beta = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
    expected = beta * pitch**2 / LAYER.plane_strain_modulus * hat_sign(np.arange(count))
    assert column == pytest.approx(expected, abs=1e-14 * np.abs(expected).max())


@pytest.mark.parametrize("pitch", [1e-4, 0.1, 1.0, 10.0, 1e4, 1e6])
@pytest.mark.parametrize("base", BASES)
def test_coefficients_are_the_integral_over_all_waves(wave_rule, base, pitch):
    body = LayeredBody(LAYER, 1.0, BASES[base])
    coefficients = TangentialLayer(60, pitch, body).column
    scale = pitch**2 / LAYER.shear_modulus
    for offset in (1, 2, 20):
        k, weights = wave_rule(pitch, offset)
        values = coupling_compliance(body, k) * np.sin(k * pitch * offset)
        expected = -(pitch**2) / np.pi * np.sum(weights * values)
        assert coefficients[offset] == pytest.approx(expected, rel=1e-10, abs=1e-11 * scale)
    assert coefficients[0] == 0.0


def test_net_traction_on_a_sliding_layer_lifts_one_side():
    """sx = -+Q/2t on the two sides makes them t nu (sx)/(2G) thinner and thicker."""
    pitch, nu = 0.3, LAYER.poissons_ratio
    far = TangentialLayer(200, pitch, LayeredBody(LAYER, 1.0, "frictionless")).column[-1]
    # plane strain with sz = 0: e_z = -nu sx/(2G), and the surface rises where sx < 0
    assert far == pytest.approx(-nu * pitch**2 / (4.0 * LAYER.shear_modulus), rel=1e-12)


@pytest.mark.parametrize("base", BASES)
def test_operator_does_no_work_and_coarsens(base):
    body = LayeredBody(LAYER, 1.0, BASES[base])
    fine = TangentialLayer(32, 0.2, body)
    matrix = np.array([fine.apply(column) for column in np.eye(32)]).T
    scale = np.abs(matrix).max()
    assert matrix == pytest.approx(-matrix.T, abs=1e-14 * scale)
    coarse, refine = fine.coarser, of_narrow_hats(32)
    coarsened = np.array([coarse.apply(column) for column in np.eye(16)]).T
    expected = refine.T @ matrix @ refine
    inner = slice(15)  # the last coarse hat overhangs
    assert coarsened[inner, inner] == pytest.approx(expected[inner, inner], abs=2e-13 * scale)
    full = toeplitz(fine.column, -fine.column)
    assert matrix == pytest.approx(full, abs=1e-13 * scale)


@pytest.mark.parametrize("base", ["bonded", "stiffer"])
def test_sliding_contact_on_a_thick_layer_shifts_as_on_a_half_plane(base):
    """A cylinder with q = 0.5 p: t/a = 500 and the half-plane, pressures moved alike."""
    half_width, friction, nu = 2e-3, 0.5, LAYER.poissons_ratio
    body = LayeredBody(LAYER, 1.0, BASES[base])
    pitch = half_width / 60.0
    grid = HatGrid.within(-1.5 * half_width, 1.5 * half_width, pitch)
    modulus, count = LAYER.plane_strain_modulus, grid.count
    beta = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
    load = 0.25 * np.pi * modulus * half_width**2
    gap = grid.hat_integrals(roller_gap(1.0))
    normal, tangential = LayeredSurface(count, pitch, body), TangentialLayer(count, pitch, body)
    pairs = (
        CoupledPair(normal, tangential, friction),
        coupled_half_planes(count, pitch, modulus, friction * beta),
    )
    solutions = [solved(pair, gap, load=load) for pair in pairs]
    peak = np.max(solutions[1].pressure)
    assert solutions[0].pressure == pytest.approx(solutions[1].pressure, abs=1e-2 * peak)
    shifts = [grid.x @ s.pressure / np.sum(s.pressure) for s in solutions]
    assert shifts[0] == pytest.approx(shifts[1], rel=0.02)
    assert abs(shifts[1]) > 0.02 * half_width
