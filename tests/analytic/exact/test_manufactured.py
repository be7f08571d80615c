"""Manufactured rough contacts against quadrature, Hertz's contact, and the numerical operators."""

from dataclasses import replace

import numpy as np
import pytest
from hats import solved
from layer_stresses import layer_field
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

from analytic.exact.hertz import hertz_extremes, hertz_from_peak_pressure, hertz_stress
from analytic.exact.manufactured import ManufacturedContact, PressurePatch, random_patches
from analytic.grid import HatGrid
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.stress.points import stress_at

STEEL, SOFT = Material(207e9, 0.3), Material(70e9, 0.33)
ROUGH = ManufacturedContact(random_patches(1, 4, 1e-4, 2e9), STEEL, STEEL, friction=0.2)
LAYERS = {
    "bonded": LayeredBody(STEEL, 5e-5, "bonded"),
    "frictionless": LayeredBody(STEEL, 5e-5, "frictionless"),
    "coating": LayeredBody(STEEL, 5e-5, SOFT),
}


def on_layer(name: str) -> ManufacturedContact:
    return replace(ROUGH, roller=None, layer=LAYERS[name])


def hats(contact: ManufacturedContact, pitch: float) -> tuple[HatGrid, np.ndarray]:
    """A grid over the contact, and hats next to its pressures."""
    grid = HatGrid.within(-1.1e-4, 1.1e-4, pitch)
    return grid, grid.hat_integrals(contact.pressure) / grid.weights


def test_load_and_peak_are_those_of_the_pressure():
    for patch in ROUGH.patches:
        angles = np.linspace(0.0, np.pi, 4001)
        pressure = patch.pressure(patch.centre + patch.half_width * np.cos(angles))
        load = np.pi / 4000 * np.sum(pressure * np.sin(angles)) * patch.half_width
        assert patch.load == pytest.approx(load, rel=1e-6)
        assert patch.peak == pytest.approx(pressure.max(), rel=1e-6)
    assert max(p.peak for p in ROUGH.patches) == ROUGH.peak_pressure <= 2e9


def test_the_displacement_is_the_integral_of_the_logarithm():
    def integral(x: float) -> float:
        total = 0.0
        for patch in ROUGH.patches:
            s = (x - patch.centre) / patch.half_width

            def part(angle: float, patch: PressurePatch = patch, s: float = s) -> float:
                t = np.cos(angle)
                return np.sin(angle) ** 2 * patch.shape(t) * np.log(abs(s - t))

            points = [np.arccos(s)] if abs(s) < 1.0 else None
            value = quad(part, 0.0, np.pi, points=points, epsabs=0.0, epsrel=1e-11, limit=300)[0]
            total += patch.half_width * value + patch.load * np.log(patch.half_width)
        return -2.0 / (np.pi * ROUGH.modulus) * total

    x = np.array([-1.3e-4, -0.9e-4, -0.3e-4, 0.0, 0.5e-4, 0.8e-4, 1.2e-4])
    off = ROUGH.displacement(x) - [integral(place) for place in x]
    assert np.ptp(off) < 1e-10 * np.ptp(ROUGH.displacement(x))


def test_the_gap_is_closed_where_it_presses_and_open_elsewhere():
    x = np.linspace(-2e-4, 2e-4, 40001)
    gap, pressure = ROUGH.loaded_gap(x), ROUGH.pressure(x)
    edges = np.array([patch.edges for patch in ROUGH.patches]).ravel()
    away = np.abs(x[:, None] - edges).min(axis=1) > 1e-8  # nearer the gap is rounding
    assert np.all(gap[pressure > 0.0] == 0.0) and np.all(gap[away & (pressure == 0.0)] > 0.0)


def test_a_spline_through_the_gap_converges_at_its_full_order():
    """The order is 4: four continuous derivatives, at the edges too."""
    fine = np.linspace(*ROUGH.ends, 5003)
    grids = (np.linspace(-1.5e-4, 1.5e-4, count) for count in (1001, 2001, 4001))
    errors = [np.abs(CubicSpline(x, ROUGH.gap(x))(fine) - ROUGH.gap(fine)).max() for x in grids]
    assert np.all(np.log2(np.array(errors[:-1]) / errors[1:]) > 3.7)
    assert errors[-1] < 1e-6 * np.ptp(ROUGH.gap(fine))


def test_one_patch_of_constant_shape_is_hertz():
    hertz = hertz_from_peak_pressure(1e9, 8e-3, ROUGH.modulus)
    patch = PressurePatch(0.0, hertz.half_width, (1e9,))
    one = ManufacturedContact((patch,), STEEL, STEEL, None, 0.3)
    assert one.load == pytest.approx(hertz.load_per_length, rel=1e-15)
    x, z = np.array([0.0, 0.3, 2.0]) * hertz.half_width, np.array([[0.1], [0.7]]) * 1e-4
    stress, expected = one.stress(x, z), hertz_stress(hertz, x, z, 0.3)
    np.testing.assert_allclose(stress.parts, expected.parts, rtol=1e-12)
    off = one.gap(x) - x**2 / (2.0 * hertz.radius)
    assert np.ptp(off) < 1e-14 * hertz.radius
    extremes = hertz_extremes(hertz, 0.3)
    top = one.extremes(2.0 * hertz.half_width)
    assert top["tau1"].value == pytest.approx(extremes.tau1.value, rel=1e-13)
    assert top["tau1"].z == pytest.approx(extremes.tau1.z, rel=1e-6)
    largest = max(extremes.txz_max.value, -extremes.txz_min.value)
    assert top["txz"].value == pytest.approx(largest, rel=1e-13)


def test_stresses_are_those_of_many_hats():
    grid, pressure = hats(ROUGH, 2e-8)
    x, z = np.array([0.0, 2e-5, -7e-5]), np.array([1e-5, 3e-6, 2e-5])
    expected, stress = stress_at(grid.x, pressure, 0.2, x, z), ROUGH.stress(x, z)
    np.testing.assert_allclose(stress.parts, expected.parts, atol=1e4)


@pytest.mark.parametrize("name", LAYERS)
def test_layers_displace_and_are_stressed_as_under_hats(name):
    contact, errors = on_layer(name), []
    for pitch in (2e-7, 1e-7):
        grid, pressure = hats(contact, pitch)
        compliance = LayeredSurface(grid.count, grid.pitch, LAYERS[name])
        off = compliance.apply(pressure) / grid.weights - contact.displacement(grid.x)
        errors.append(np.std(off) / np.std(contact.displacement(grid.x)))
    assert errors[1] < 2e-4 and errors[1] < 0.7 * errors[0]  # the hats at the edges leave it
    field = layer_field(LAYERS[name], grid.x, pressure, (-1e-4, 1e-4), np.array([1e-5, 4e-5]))
    place = [500, 900]
    stress = contact.stress(field.x[place], field.z[:, None])
    expected = field.at(0.2).stress.parts[..., place]
    np.testing.assert_allclose(stress.parts, expected, atol=2e-5 * 2e9)


@pytest.mark.parametrize("name", [None, *LAYERS])
def test_the_contact_solver_finds_the_pressures(name):
    contact = ROUGH if name is None else on_layer(name)
    errors = []
    for pitch in (1e-6, 5e-7, 2.5e-7):
        grid, pressure = hats(contact, pitch)
        operator = (
            HalfPlane(grid.count, pitch, contact.modulus)
            if name is None
            else LayeredSurface(grid.count, pitch, LAYERS[name])
        )
        gap = grid.hat_integrals(contact.gap)
        solution = solved(operator, gap, load=contact.load)
        errors.append(np.linalg.norm(solution.pressure - pressure) / np.linalg.norm(pressure))
    assert errors[2] < 0.35 * errors[0] and errors[2] < 0.02


def test_random_patches_depend_on_the_seed_alone():
    assert random_patches(3, 5, 1e-4, 1e9) == random_patches(3, 5, 1e-4, 1e9)
    assert random_patches(4, 5, 1e-4, 1e9) != random_patches(3, 5, 1e-4, 1e9)
    patches = random_patches(3, 5, 1e-4, 1e9)
    ends = patches[0].edges[0], patches[-1].edges[1]
    assert len(patches) == 5 and ends == pytest.approx((-1e-4, 1e-4), rel=1e-12)


def test_what_is_no_contact_is_refused():
    one, other = PressurePatch(0.0, 1.0, (1.0,)), PressurePatch(1.5, 1.0, (1.0,))
    with pytest.raises(ValueError, match="apart"):
        ManufacturedContact((one, other), STEEL)
    with pytest.raises(ValueError, match="positive"):
        ManufacturedContact((replace(one, coefficients=(1.0, 1.0)),), STEEL)
    with pytest.raises(ValueError, match="extent"):
        on_layer("bonded").displacement(np.array([1e-3]))
