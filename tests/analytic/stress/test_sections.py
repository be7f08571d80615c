"""Sections: where their places stand, what they hold, and their turned axes."""

import numpy as np
import pytest
from scipy.integrate import trapezoid

from analytic.exact.hertz import hertz_from_peak_pressure, hertz_stress
from analytic.stress.points import depth_profile, section, stress_at

NAMES = ("sx", "sz", "txz")
UNIT = hertz_from_peak_pressure(1.0, 1.0, 2.0)
NODES = np.linspace(-1.0, 1.0, 401)
PRESSURE = UNIT.pressure(NODES)


def test_axis_of_the_smooth_contact():
    """Bailey and Sayles 1991, figure 5a: values of equations (6a) to (6c) in p0."""
    depths = [0.0, 0.02, 0.06, 0.1, 0.5, 1.0, 2.0]
    found = depth_profile(NODES, PRESSURE, 0.0, 0.0, depths)
    np.testing.assert_array_equal(found.z, depths)
    np.testing.assert_array_equal(found.x, 0.0)
    sx = [-1.0, -0.96060, -0.88539, -0.81494, -0.34164, -0.12132, -0.02492]
    sz = [-1.0, -0.99980, -0.99820, -0.99504, -0.89443, -0.70711, -0.44721]
    np.testing.assert_allclose(found.stress.sx, sx, atol=2e-4)
    np.testing.assert_allclose(found.stress.sz, sz, atol=2e-4)
    np.testing.assert_allclose(found.stress.tau1[-3:], [0.27639, 0.29289, 0.21115], atol=2e-4)


def test_shear_through_the_edge_of_the_contact():
    """Figure 11b: x = +a, friction 0 and 0.1."""
    depths = [0.1, 0.2, 0.4, 0.8]
    for friction, tau1 in (
        (0.0, [0.16247, 0.20027, 0.23085, 0.23768]),
        (0.1, [0.21567, 0.24437, 0.26446, 0.25968]),
    ):
        found = depth_profile(NODES, PRESSURE, friction, 1.0, depths)
        np.testing.assert_allclose(found.stress.tau1, tau1, atol=2e-4)


@pytest.mark.parametrize("periodic", [False, True])
def test_places_and_values_of_a_section(periodic):
    extra = 0.1 * np.cos(NODES)
    given = {"traction": extra, "periodic": periodic}
    found = section(NODES, PRESSURE, 0.2, (-0.5, 0.0), (1.0, 2.0), 31, **given)
    assert (found.x[0], found.z[0], found.x[-1], found.z[-1]) == (-0.5, 0.0, 1.0, 2.0)
    np.testing.assert_allclose(np.diff(found.along), 2.5 / 30.0, rtol=1e-12)
    np.testing.assert_allclose(found.x, -0.5 + 0.6 * found.along, atol=1e-15)
    np.testing.assert_allclose(found.z, 0.8 * found.along, atol=1e-15)
    direct = stress_at(NODES, PRESSURE, 0.2, found.x, found.z, **given)
    down = depth_profile(NODES, PRESSURE, 0.2, found.x[10], found.z[[10]], **given)
    for name in NAMES:
        np.testing.assert_array_equal(getattr(found.stress, name), getattr(direct, name))
        assert getattr(down.stress, name)[0] == pytest.approx(getattr(direct, name)[10], abs=1e-13)


def test_axes_along_a_section():
    """Along x nothing turns; down, sx and sz change places; invariants stay."""
    flat = section(NODES, PRESSURE, 0.3, (-1.5, 0.4), (1.5, 0.4))
    turned = flat.turned()
    for name in NAMES:
        np.testing.assert_array_equal(getattr(turned, name), getattr(flat.stress, name))
    down = depth_profile(NODES, PRESSURE, 0.3, 0.6, np.linspace(0.0, 2.0, 9))
    turned = down.turned()
    np.testing.assert_array_equal(turned.sx, down.stress.sz)
    np.testing.assert_array_equal(turned.sz, down.stress.sx)
    np.testing.assert_array_equal(turned.txz, -down.stress.txz)
    slant = section(NODES, PRESSURE, 0.3, (-1.0, 0.1), (1.0, 1.7))
    turned, given = slant.turned(), slant.stress
    np.testing.assert_allclose(turned.sx + turned.sz, given.sx + given.sz, atol=1e-15)
    np.testing.assert_allclose(turned.tau1, given.tau1, atol=1e-15)


def test_two_slanted_sections_carry_the_load_between_them():
    """A wedge under the contact is in equilibrium: tractions on its sides against p and q."""
    corner = (0.3, 1.5)
    force = np.zeros(2)
    for start, stop in (((-2.0, 0.0), corner), (corner, (2.5, 0.0))):
        cut = section(NODES, PRESSURE, 0.25, start, stop, 4001)
        turned, (c, s) = cut.turned(), cut.direction
        along, across = (trapezoid(part, cut.along) for part in (turned.txz, turned.sz))
        force += along * np.array([c, s]) + across * np.array([-s, c])
    load = PRESSURE.sum() * (NODES[1] - NODES[0])
    np.testing.assert_allclose(force, [-0.25 * load, -load], rtol=1e-5)


def test_sections_of_nothing_are_refused():
    with pytest.raises(ValueError, match="two different ends"):
        section(NODES, PRESSURE, 0.0, (0.0, 1.0), (0.0, 1.0))
    with pytest.raises(ValueError, match="at least 2 places"):
        section(NODES, PRESSURE, 0.0, (0.0, 1.0), (1.0, 1.0), 1)
    with pytest.raises(ValueError, match="not empty"):
        depth_profile(NODES, PRESSURE, 0.0, 0.0, [])
    with pytest.raises(ValueError, match="z must not be negative"):
        depth_profile(NODES, PRESSURE, 0.0, 0.0, [-1.0])


def test_section_of_the_exact_contact():
    slant = section(NODES, PRESSURE, 0.1, (-0.3, 0.05), (1.4, 1.0), 60)
    exact = hertz_stress(UNIT, slant.x, slant.z, 0.1)
    for name in NAMES:
        assert np.abs(getattr(slant.stress, name) - getattr(exact, name)).max() < 3e-4
