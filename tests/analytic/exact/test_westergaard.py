"""Sinusoidal contact against high-precision values, quadrature and its limits."""

import numpy as np
import pytest
from exact_stresses import westergaard_gap
from scenes import reference
from scipy.integrate import quad

from analytic.exact.hertz import hertz_from_load
from analytic.exact.westergaard import WestergaardContact, westergaard_from_mean_pressure

CASES = reference("d_westergaard")["cases"]


def unit(share: float, wavelength: float = 1.0) -> WestergaardContact:
    """p* = 1 under `share` of it."""
    return westergaard_from_mean_pressure(share, wavelength, 1.0 / np.pi, wavelength)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["pbar_over_pstar"])
def test_reference_values(case):
    value = {key: float(v) for key, v in case.items() if key != "profile"}
    contact, half_width = unit(value["pbar_over_pstar"]), value["half_width_over_lambda"]
    assert contact.closing_pressure == pytest.approx(1.0, rel=1e-15)
    assert contact.half_width == pytest.approx(half_width, rel=1e-15)
    assert contact.peak_pressure == pytest.approx(value["peak_p_over_pstar"], rel=1e-15)
    valley = np.pi * westergaard_gap(contact, 0.5)
    assert np.pi * contact.mean_gap == pytest.approx(value["mean_gap_over_Delta"], rel=2e-15)
    assert valley == pytest.approx(value["valley_gap_over_Delta"], rel=3e-15)
    assert len(case["profile"]) == 6
    for row in case["profile"]:
        x, expected = float(row["x_over_lambda"]), float(row["p_over_pstar"])
        # next to the edge the rounding of the quoted x shows
        assert contact.pressure(x) == pytest.approx(expected, rel=1e-15 / (1.0 - x / half_width))


@pytest.mark.parametrize("share", [1e-6, 0.05, 0.5, 0.749, 0.751, 0.95, 0.9999])
def test_mean_gap_is_the_average_of_the_gap(share):
    contact = unit(share)
    a = contact.half_width

    def opening(u):  # from the edge on, where the gap opens as a power 3/2
        return westergaard_gap(contact, a + (0.5 - a) * u**2) * 2.0 * u

    total, _ = quad(opening, 0, 1, epsabs=0, epsrel=1e-12)
    assert contact.mean_gap == pytest.approx((1.0 - 2.0 * a) * total, rel=1e-10, abs=0)


@pytest.mark.parametrize("open_share", [1e-3, 1e-6, 1e-9])
def test_mean_gap_keeps_its_digits_where_it_closes(open_share):
    near = unit(1.0 - open_share)
    exact = 1.0 - near.mean_pressure
    expected = exact**2 / 2.0 + exact**3 / 6.0 + exact**4 / 12.0 + exact**5 / 20.0
    assert np.pi * near.mean_gap == pytest.approx(expected, rel=1e-11, abs=0)


def test_light_load_is_hertz():
    """Radius lambda^2/(4 pi^2 A); what is left falls like the load, that is like (a/lambda)^2."""
    errors = []
    for share in (1e-4, 1e-6, 1e-8):
        contact = unit(share)
        hertz = hertz_from_load(share, np.pi / (4.0 * np.pi**2), 1.0)
        places = np.array([0.0, 0.3, 0.9, 0.999]) * hertz.half_width
        errors.append(np.abs(contact.pressure(places) / hertz.pressure(places) - 1.0).max())
        assert contact.half_width / hertz.half_width == pytest.approx(1.0, abs=share)
    assert np.diff(np.log10(errors)) == pytest.approx([-2.0, -2.0], abs=0.05)


def test_full_contact():
    contact = unit(1.5)
    assert contact.full and contact.half_width == 0.5 and contact.mean_gap == 0.0
    x = np.linspace(-1.0, 1.0, 21)
    assert contact.pressure(x) == pytest.approx(1.5 + np.cos(2.0 * np.pi * x), abs=1e-15)
    assert contact.peak_pressure == pytest.approx(2.5)
    assert not westergaard_gap(contact, x).any()


def test_partial_contact_passes_into_full_contact():
    x = np.linspace(-0.5, 0.5, 41)
    below, at = unit(1.0 - 1e-13), unit(1.0)
    assert not below.full and at.full
    assert below.pressure(x) == pytest.approx(at.pressure(x), abs=1e-6)


@pytest.mark.parametrize("below", [1e-3, 1e-6, 1e-9])
def test_pressure_keeps_its_digits_beside_the_last_gap(below):
    """p = 2 sin y sqrt(sin^2 y - sin^2 y_e), y, y_e = pi/2 - psi the distances of point and edge
    to the valley."""
    contact = unit(1.0 - below)
    valley = np.pi * (0.5 - contact.half_width)
    for share in (1.3, 7.0):
        x = 0.5 - share * (0.5 - contact.half_width)
        y = np.pi * (0.5 - x)
        rise = np.sin(y - valley) * np.sin(y + valley)
        expected = 2.0 * np.sin(y) * np.sqrt(rise)
        assert contact.pressure(x) == pytest.approx(expected, rel=1e-14, abs=0.0)


def test_units_do_not_matter():
    small = westergaard_from_mean_pressure(0.3 * 2.0**30, 2.0**-20, 2.0**-30, 2.0**40 / np.pi)
    large = westergaard_from_mean_pressure(0.3, 1.0, 2.0**-10, 2.0**10 / np.pi)
    assert small.half_width == large.half_width * 2.0**-20
    assert small.mean_gap == large.mean_gap * 2.0**-20
    assert small.pressure(2.0**-23) == large.pressure(0.125) * 2.0**30


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="amplitude must be positive"):
        westergaard_from_mean_pressure(1.0, 1.0, 0.0, 1.0)
