"""Stresses of one strip and of one hat against high-precision values; their scalars."""

import numpy as np
import pytest
from exact_stresses import hat_stress, strip_stress
from scenes import reference

from analytic.stress_state import StressState

STRIP = reference("b_uniform_strip")["points"]
HAT = reference("hat_stress")["points"]


def numbers(rows: list[dict], name: str) -> np.ndarray:
    return np.array([float(row[name]) for row in rows])


@pytest.mark.parametrize("load", ["normal", "tangential"])
@pytest.mark.parametrize("component", ["sx", "sz", "txz"])
def test_strip_reference_values_each_to_rounding(load, component):
    """Bailey and Sayles' equations (1) and (2), from 1e-12 to 1e6 half-widths, each component.

    One value, -1.27e-60, is written as 0 in the table: hence the absolute bound.
    """
    unit = strip_stress(numbers(STRIP, "x_over_a"), numbers(STRIP, "z_over_a"), 1.0)
    stress = unit.normal if load == "normal" else unit.traction
    expected = numbers([row[load] for row in STRIP], component)
    assert len(expected) == 33
    np.testing.assert_allclose(getattr(stress, component), expected, rtol=2e-15, atol=2e-60)


@pytest.mark.parametrize("component", ["sx", "sz", "txz", "sx_traction"])
def test_hat_reference_values(component):
    """To rounding of the largest stress everywhere, and of each component near the surface.

    Close below the hat the sx that is left between -p and -sz is a hundredth of what cancels.
    """
    x, z = numbers(HAT, "x_over_pitch"), numbers(HAT, "z_over_pitch")
    columns = [numbers(HAT, name) for name in ("sx", "sz", "txz", "sx_traction")]
    row = ["sx", "sz", "txz", "sx_traction"].index(component)
    stress, expected = hat_stress(x, z, 1.0).parts[row], columns[row]
    assert len(expected) == 64
    assert np.all(np.abs(stress - expected) <= 1e-14 * np.max(np.abs(columns), axis=0))
    shallow = (z < 1e-2) & (np.hypot(x, z) < 4.0)
    np.testing.assert_allclose(stress[shallow], expected[shallow], rtol=1e-14)


def test_hat_closed_form_and_moments_meet():
    """The tiers of the moments too: each joins the next within the rounding of the sum."""
    angle = np.linspace(0.0, np.pi, 41)
    for radius in (4.0, 16.0, 128.0, 512.0):
        inside, outside = (
            np.array(hat_stress(r * np.cos(angle), r * np.sin(angle), 1.0).parts)
            for r in (np.nextafter(radius, 0.0) * (1.0 - 1e-15), radius * (1.0 + 1e-15))
        )
        scale = 1.0 / radius
        assert np.abs(inside - outside).max() < 2e-14 * scale


def test_point_load_far_away():
    """Half-width 1/2 carries one unit; corrections are of the order 1/r^2."""
    for x, z in ((1e7, 1e-3), (-1e7, 1e7), (1.0, 1e7)):
        square = (x * x + z * z) ** 2
        point = -2.0 / np.pi / square * np.array([x * x * z, z**3, x * z * z, x**3])
        atol = 0.0 if abs(x) > 1.0 else 1e-13 / abs(z)
        np.testing.assert_allclose(strip_stress(x, z, 0.5).parts, point, rtol=1e-12, atol=atol)
        hat = hat_stress(x, z, 1.0).parts
        np.testing.assert_allclose(hat, point, rtol=0.0, atol=1e-13 * np.abs(point).max())


def test_surface_of_a_hat_is_its_own_load():
    x = np.array([-3.0, -1.0, -0.75, 0.0, 0.5, 1.0, 8.0])
    unit = hat_stress(x, 0.0, 1.0)
    hat = np.maximum(1.0 - np.abs(x), 0.0)
    np.testing.assert_array_equal(unit.normal.sz, -hat)
    np.testing.assert_array_equal(unit.normal.sx, -hat)
    np.testing.assert_array_equal(unit.traction.txz, -hat)
    np.testing.assert_array_equal(unit.normal.txz, 0.0)
    assert np.isfinite(unit.traction_sx).all()


def test_surface_of_a_strip_is_its_own_load_and_half_of_it_at_the_ends():
    x = np.array([-2.0, -0.5, 0.0, 0.3, 0.5, 0.6])
    unit = strip_stress(x, 0.0, 0.5)
    load = np.array([0.0, 0.5, 1.0, 1.0, 0.5, 0.0])
    np.testing.assert_array_equal(unit.normal.sz, -load)
    np.testing.assert_array_equal(unit.normal.sx, -load)
    np.testing.assert_array_equal(unit.traction_sx[[1, 4]], [np.inf, -np.inf])


def test_strip_has_a_logarithmic_spike_where_the_hat_is_bounded():
    """Each decade towards the end of a strip adds (2/pi) ln 10 to its sx under q."""
    z = 10.0 ** -np.arange(2.0, 13.0)
    strip, hat = strip_stress(0.5, z, 0.5).traction_sx, hat_stress(1.0, z, 1.0).traction_sx
    np.testing.assert_allclose(np.diff(strip), -2.0 / np.pi * np.log(10.0), rtol=2e-2)
    np.testing.assert_allclose(np.diff(strip)[4:], -2.0 / np.pi * np.log(10.0), rtol=1e-6)
    assert np.abs(hat - hat_stress(1.0, 0.0, 1.0).traction_sx).max() < 0.05
    assert np.abs(hat[-1] - hat_stress(1.0, 0.0, 1.0).traction_sx) < 1e-11


def tensors(stress: StressState, poissons_ratio: float) -> np.ndarray:
    (sx, sz, txz), none = stress.parts, np.zeros(stress.sx.size)
    sy = poissons_ratio * (sx + sz)
    return np.array([[sx, txz, none], [txz, sz, none], [none, none, sy]]).transpose(2, 0, 1)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.4999])
def test_scalars_of_random_tensors(nu):
    rng = np.random.default_rng(11)
    stress = StressState(*rng.standard_normal((3, 50)) * 1e9)
    tensor = tensors(stress, nu)
    in_plane = np.linalg.eigvalsh(tensor[:, :2, :2])
    largest = 0.5 * (in_plane[:, 1] - in_plane[:, 0])
    np.testing.assert_allclose(stress.tau1, largest, rtol=0, atol=1e-5)
    np.testing.assert_allclose(stress.sy(nu), tensor[:, 2, 2], rtol=1e-14)
    deviator = tensor - np.trace(tensor, axis1=1, axis2=2)[:, None, None] / 3.0 * np.eye(3)
    expected = np.sqrt(1.5 * np.sum(deviator**2, axis=(1, 2)))
    np.testing.assert_allclose(stress.von_mises(nu), expected, rtol=1e-13)


def test_shapes_must_agree():
    with pytest.raises(ValueError, match="equal shape"):
        StressState(np.zeros(3), np.zeros(3), np.zeros(2))
