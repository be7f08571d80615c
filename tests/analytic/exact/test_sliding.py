"""Sliding with coupling against high-precision values, its integral equation, and Hertz."""

from fractions import Fraction

import numpy as np
import pytest
from scenes import reference
from scipy.integrate import quad

from analytic.exact.hertz import hertz_from_load
from analytic.exact.sliding import sliding_from_load

CASES = reference("f_rounded_punch_and_sliding")["sliding_cylinder"]


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"beta {case['beta']}, mu {case['mu']}")
def test_reference_values(case):
    """Half-plane below, cylinder sliding in +x: the contact moves to -x."""
    value = {k: float(v) for k, v in case.items() if not isinstance(v, list) and k != "beta"}
    beta = float(Fraction(case["beta"]))
    contact = sliding_from_load(value["P_R_over_Estar_ahalf2"], 1.0, 1.0, value["mu"], beta)
    assert contact.half_width == pytest.approx(1.0, rel=3e-16)
    assert contact.exponent_shift == pytest.approx(value["eta"], rel=1e-15)
    left, right = contact.edges
    assert left == pytest.approx(-value["b_trailing_over_ahalf"], rel=1e-15)
    assert right == pytest.approx(value["c_leading_over_ahalf"], rel=1e-15)
    assert 0.5 * (left + right) == pytest.approx(value["centre_shift_over_ahalf"], rel=1e-14)
    assert contact.peak_pressure == pytest.approx(value["peak_p_R_over_Estar_ahalf"], rel=1e-15)
    assert contact.peak_position == pytest.approx(value["peak_x_over_ahalf"], rel=1e-15)
    assert contact.load_position == pytest.approx(value["load_line_x_over_ahalf"], rel=1e-15)
    hertz = hertz_from_load(contact.load_per_length, 1.0, 1.0)
    wider = contact.half_width / hertz.half_width
    assert wider == pytest.approx(value["ahalf_over_aHertz_same_load"], rel=1e-15)
    higher = contact.peak_pressure / hertz.peak_pressure
    assert higher == pytest.approx(value["peak_over_p0Hertz_same_load"], rel=1e-15)
    xi = np.array([float(row["xi"]) for row in case["profile_about_contact_centre"]])
    expected = [float(row["p_R_over_Estar_ahalf"]) for row in case["profile_about_contact_centre"]]
    assert len(xi) == 5
    np.testing.assert_allclose(contact.pressure(0.5 * (left + right) + xi), expected, rtol=3e-15)


@pytest.mark.parametrize("product", [0.0, 0.02, -0.15, 0.5, -2.0])
def test_integral_equation_and_load(product):
    contact = sliding_from_load(0.7, 2.0, 3.0, 2.0 * product, 0.5)
    left, right = contact.edges
    for share in (0.1, 0.35, 0.5, 0.8):
        x = left + share * (right - left)
        principal, _ = quad(contact.pressure, left, right, weight="cauchy", wvar=x, limit=400)
        slope = -principal / np.pi - product * contact.pressure(x)
        assert slope == pytest.approx(3.0 * x / 4.0, abs=1e-6)
    load, _ = quad(contact.pressure, left, right, limit=400)
    moment, _ = quad(lambda x: x * contact.pressure(x), left, right, limit=400)
    assert load == pytest.approx(0.7, rel=1e-8)
    assert moment / load == pytest.approx(contact.load_position, abs=1e-8)


def test_without_coupling_it_is_hertz():
    hertz = hertz_from_load(3.0e5, 8e-3, 110e9)
    a = hertz.half_width
    x = a * np.linspace(-3.0, 3.0, 61)
    for friction, beta in ((0.0, 0.3), (0.3, 0.0)):
        contact = sliding_from_load(3.0e5, 8e-3, 110e9, friction, beta)
        assert contact.edges == pytest.approx((-a, a), rel=1e-15)
        assert contact.peak_pressure == pytest.approx(hertz.peak_pressure, rel=1e-15)
        inside = np.abs(x) < 0.99 * a
        np.testing.assert_allclose(
            contact.pressure(x)[inside], hertz.pressure(x)[inside], rtol=1e-13
        )


def test_it_mirrors_when_the_sliding_reverses_or_the_bodies_change_places():
    here = sliding_from_load(1.0, 1.0, 1.0, 0.4, 0.3)
    x = np.linspace(-2.5, 2.5, 41)
    for friction, beta in ((-0.4, 0.3), (0.4, -0.3)):
        there = sliding_from_load(1.0, 1.0, 1.0, friction, beta)
        assert there.edges == (-here.edges[1], -here.edges[0])
        np.testing.assert_allclose(there.pressure(-x), here.pressure(x), rtol=1e-14)


@pytest.mark.parametrize(("radius", "friction"), [(0.0, 0.1), (1.0, np.nan)])
def test_what_makes_no_sense_is_refused(radius, friction):
    with pytest.raises(ValueError, match="must be"):
        sliding_from_load(1.0, radius, 1.0, friction, 0.1)
