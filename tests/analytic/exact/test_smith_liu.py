"""Smooth sliding contact against the closed forms of Smith and Liu 1953, as they give them.

With k1, k2 = (b + x)^2 + z^2, (b - x)^2 + z^2 and half-width b they write all six stresses by two
functions of the point, psi and its twin; x, z as here, tension positive, traction in +x.
"""

import numpy as np
import pytest

from analytic.exact.hertz import HertzContact, hertz_extremes, hertz_stress

HERTZ = HertzContact(0.4e-3, 1.4e9, 0.4e-3 * 1.4e9 * np.pi / 2.0, 1.0, 1.0)
NAMES = ("sx", "sz", "txz")


def smith_and_liu(x: np.ndarray, z: np.ndarray, friction: float) -> dict[str, np.ndarray]:
    """Stresses over the peak pressure; lengths in half-widths, z > 0."""
    k1, k2 = (1.0 + x) ** 2 + z**2, (1.0 - x) ** 2 + z**2
    root = np.sqrt(k2 / k1)
    under = root * np.sqrt(2.0 * root + (k1 + k2 - 4.0) / k1)
    psi, twin = np.pi / k1 * (1.0 - root) / under, np.pi / k1 * (1.0 + root) / under
    normal = {
        "sx": z * ((1.0 + 2.0 * z**2 + 2.0 * x**2) * twin - 2.0 * np.pi - 3.0 * x * psi),
        "sz": z * (twin - x * psi),
        "txz": z**2 * psi,
    }
    tangential = {
        "sx": (2.0 * x**2 - 2.0 - 3.0 * z**2) * psi
        + 2.0 * np.pi * x
        + 2.0 * (1.0 - x**2 - z**2) * x * twin,
        "sz": z**2 * psi,
        "txz": (1.0 + 2.0 * x**2 + 2.0 * z**2) * z * twin - 2.0 * np.pi * z - 3.0 * x * z * psi,
    }
    return {k: -(normal[k] + friction * tangential[k]) / np.pi for k in NAMES}


@pytest.mark.parametrize("friction", [0.0, 0.1, 1.0 / 3.0, -0.8])
def test_field(friction):
    rng = np.random.default_rng(5)
    x, z = rng.uniform(-3.0, 3.0, 500), rng.uniform(0.05, 3.0, 500)
    a, p0 = HERTZ.half_width, HERTZ.peak_pressure
    expected, found = smith_and_liu(x, z, friction), hertz_stress(HERTZ, a * x, a * z, friction)
    for name in NAMES:
        # their sums lose digits: 1e-12 of the peak pressure is theirs
        np.testing.assert_allclose(getattr(found, name) / p0, expected[name], atol=1e-12)


@pytest.mark.parametrize("friction", [0.0, 0.2, 0.5])
def test_surface(friction):
    """sx/p0 = -sqrt(1 - x^2) - 2 mu x in the contact, -2 mu (x - sqrt(x^2 - 1)) right of it."""
    x = np.array([-5.0, -1.5, -1.0, -0.6, 0.0, 0.28, 0.8, 1.0, 1.25, 3.0])
    inside = np.abs(x) <= 1.0
    root = np.sqrt(np.abs(1.0 - x**2))
    sx = np.where(inside, -root - 2.0 * friction * x, -2.0 * friction * (x - np.copysign(root, x)))
    stress = hertz_stress(HERTZ, HERTZ.half_width * x, 0.0, friction)
    np.testing.assert_allclose(stress.sx / HERTZ.peak_pressure, sx, atol=1e-15)
    pressure = np.where(inside, root, 0.0)
    np.testing.assert_allclose(stress.sz / HERTZ.peak_pressure, -pressure, atol=1e-15)
    np.testing.assert_allclose(stress.txz / HERTZ.peak_pressure, -friction * pressure, atol=1e-15)


def test_largest_tension_stands_at_the_trailing_edge():
    """2 mu p0, the figure that surface cracks are judged by."""
    x = np.linspace(-4.0, 4.0, 8001) * HERTZ.half_width
    z = np.array([[0.0], [1e-3], [0.1], [1.0]]) * HERTZ.half_width
    for friction in (0.1, 0.6):
        sx = hertz_stress(HERTZ, x, z, friction).sx
        row, column = np.unravel_index(np.argmax(sx), sx.shape)
        assert (row, x[column]) == (0, pytest.approx(-HERTZ.half_width))
        assert sx.max() == pytest.approx(2.0 * friction * HERTZ.peak_pressure, rel=1e-12)


def test_friction_brings_the_largest_shear_to_the_surface():
    """It rises with mu; from about mu = 0.37 on mu p0 at the surface exceeds all below."""
    depths = [hertz_extremes(HERTZ, mu).tau1.z / HERTZ.half_width for mu in (0.0, 0.1, 0.2, 0.36)]
    assert np.all(np.diff(depths) < 0.0) and depths[-1] > 0.1
    for friction in (0.38, 0.5):
        found = hertz_extremes(HERTZ, friction).tau1
        assert found.z == 0.0
        assert found.value == pytest.approx(friction * HERTZ.peak_pressure, rel=1e-15)
