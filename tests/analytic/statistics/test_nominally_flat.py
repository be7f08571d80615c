"""Integrals over Gaussian heights against 30 digits; what follows of rough planes."""

import numpy as np
import pytest
from rough_planes import nominally_flat
from scenes import reference
from scipy.integrate import quad

from analytic.statistics.nominally_flat import Summits, persson_fraction, tail_integral

REFERENCE = reference("g_greenwood")
SUMMITS = Summits(density=3e9, radius=20e-6, deviation=0.4e-6)


@pytest.mark.parametrize("n", [0.0, 0.5, 1.0, 1.5, 2.0, 2.5])
def test_integrals_have_the_digits_of_the_reference(n):
    h = [float(row["h"]) for row in REFERENCE["Fn"]]
    expected = [float(row[f"F_{n:g}"]) for row in REFERENCE["Fn"]]
    assert tail_integral(n, h) == pytest.approx(expected, rel=1e-13)


def test_far_tail_is_the_asymptotic_series():
    """F_n = phi(h) Gamma(n+1) h^-(n+1) (1 - (n+1)(n+2)/(2 h^2) + …), to h = 37 and underflow."""
    h, n = 37.0, 1.5
    phi = np.exp(-0.5 * h**2) / np.sqrt(2.0 * np.pi)
    terms = [1.0, -3.5 * 2.5 / 2.0, 5.5 * 4.5 * 3.5 * 2.5 / 8.0]
    series = sum(term / h ** (2 * k) for k, term in enumerate(terms))
    gamma = 0.75 * np.sqrt(np.pi)
    assert tail_integral(n, h) == pytest.approx(phi * gamma / h**2.5 * series, rel=2e-6)
    assert tail_integral(n, 60.0) == 0.0


def test_deep_overlap_is_the_moment_of_a_normal_variable():
    assert tail_integral(2.0, -500.0) == pytest.approx(500.0**2 + 1.0, rel=1e-13)
    assert tail_integral(1.0, [[-5e3], [-1e4]]) == pytest.approx(np.array([[5e3], [1e4]]))


def test_derivative_lowers_the_order():
    h, step = np.linspace(-12.0, 8.0, 41), 1e-4
    slope = (tail_integral(1.5, h + step) - tail_integral(1.5, h - step)) / (2.0 * step)
    assert slope == pytest.approx(-1.5 * tail_integral(0.5, h), rel=1e-7)


@pytest.mark.parametrize("row", REFERENCE["GW_flat"], ids=lambda row: row["h"])
def test_plane_of_the_reference(row):
    h, s = float(row["h"]), SUMMITS
    unit = s.density * 1e11 * np.sqrt(s.radius) * s.deviation**1.5
    load = float(row["P_over_A_eta_Eprime_beta12_sigma32"]) * unit
    area = float(row["Areal_over_A_eta_pi_beta_sigma"]) * np.pi * s.density * s.radius * s.deviation
    assert nominally_flat(s, 1e11, h) == pytest.approx((load, area), rel=1e-13)
    ratio = load / area / (1e11 * np.sqrt(s.deviation / s.radius))
    assert ratio == pytest.approx(float(row["mean_real_pressure"]), rel=1e-13)


def test_one_summit_after_the_other_gives_the_same_load():
    """Hertz's load of a sphere, over the heights, by another quadrature."""
    h, s, modulus = 1.3, SUMMITS, 2e11
    load = quad(
        lambda z: 4.0 / 3.0 * modulus * np.sqrt(s.radius) * (s.deviation * (z - h)) ** 1.5
        * np.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi), h, 12.0, epsabs=0.0, epsrel=1e-10,
    )[0]  # fmt: skip
    assert nominally_flat(s, modulus, h)[0] == pytest.approx(s.density * load, rel=1e-8)


def test_persson_closes_all_gaps_in_the_end():
    assert persson_fraction(1e12, 1e11, 0.1) == pytest.approx(1.0)
    light = persson_fraction(1e6, 1e11, 0.1)
    assert light == pytest.approx(np.sqrt(8.0 / np.pi) * 1e6 / 1e10, rel=1e-6)


def test_summits_must_be_there():
    with pytest.raises(ValueError, match="density must be positive"):
        Summits(density=0.0, radius=1e-5, deviation=1e-7)
