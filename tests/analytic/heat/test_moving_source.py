"""Jaeger's moving band, and any moving flux by transforms."""

import numpy as np
import pytest
from moving_band import band_maximum, band_mean, band_surface
from scenes import reference
from scipy.integrate import quad
from scipy.interpolate import CubicSpline
from scipy.special import k0e

from analytic.heat.moving_source import HeatedSurface
from analytic.material import ThermalMaterial

JAEGER = reference("h_heat")["jaeger"]
UNIT = ThermalMaterial(1.0, 1.0, 1.0)
X = np.arange(-300, 301) / 100.0
HAT = np.maximum(1.0 - np.abs(X), 0.0)


@pytest.mark.parametrize("row", JAEGER, ids=lambda row: f"Pe {row['Pe_Vl_over_2kappa']}")
def test_moving_band(row):
    peclet = float(row["Pe_Vl_over_2kappa"])
    for name, value in row.items():
        if name.startswith("kT_over_ql_at_x_"):
            rise = band_surface(float(name.rpartition("_")[2]), peclet)
            assert rise == pytest.approx(float(value), rel=1e-13)
    largest, place = band_maximum(peclet)
    assert largest == pytest.approx(float(row["max_kT_over_ql"]), rel=1e-13)
    assert place == pytest.approx(float(row["x_max_over_l"]), abs=1e-12)
    assert band_mean(peclet) == pytest.approx(float(row["mean_kT_over_ql"]), rel=1e-13)
    fast = 2.0 / np.sqrt(np.pi * peclet)  # conduction in one dimension while it passes (Jaeger)
    assert largest / fast == pytest.approx(float(row["max_over_high_Pe_formula"]), rel=1e-11)
    mean = band_mean(peclet) / (2.0 / 3.0 * fast)
    assert mean == pytest.approx(float(row["mean_over_high_Pe_formula"]), rel=1e-11)


@pytest.mark.parametrize("peclet", [0.1, 1.0, 10.0, 100.0])
def test_transforms_find_the_maximum_of_a_band(peclet):
    """Its ends on nodes, where the flux falls over one pitch each way."""
    half = 4000
    x = np.arange(-half - 3, half + 4) / half
    flux = np.where(np.abs(x) < 1.0, 1.0, np.where(np.abs(x) < 1.0 + 0.5 / half, 0.5, 0.0))
    flux[np.isclose(np.abs(x), 1.0)] = 0.5
    surface = HeatedSurface(UNIT, len(x), 1.0 / half, -2.0 * peclet)
    rise = CubicSpline(x, surface.rise(flux))
    places = [place for place in rise.derivative().roots(extrapolate=False) if place < -0.01]
    largest = max(float(rise(place)) for place in places)
    assert largest == pytest.approx(band_maximum(peclet)[0], rel=1e-6)


def line_source(x, z, peclet):
    """Rise by a hat of half-width 1, by adaptive quadrature."""

    def kernel(s):
        distance = np.hypot(x - s, z)
        along = np.sign(peclet) * (x - s)
        return (
            (1 - abs(s)) * np.exp(-abs(peclet) * (along + distance)) * k0e(abs(peclet) * distance)
        )

    points = sorted({0.0, float(np.clip(x, -1, 1))})
    return quad(kernel, -1, 1, points=points, epsabs=1e-14, epsrel=1e-12, limit=400)[0] / np.pi


@pytest.mark.parametrize("peclet", [1e-3, 0.1, -0.1, 10.0, 1000.0])
def test_any_flux(peclet):
    rise = HeatedSurface(UNIT, len(X), 0.01, -2.0 * peclet).rise(HAT)
    for i in (0, 200, 280, 300, 310, 350, 500):
        assert rise[i] == pytest.approx(line_source(X[i], 0.0, peclet), abs=1e-12)


@pytest.mark.parametrize("depth", [1e-5, 1e-3, 0.1, 1.0])
def test_below_the_surface(depth):
    (rise,) = HeatedSurface(UNIT, len(X), 0.01, -10.0).field(HAT, [depth])
    for i in (150, 250, 300, 320):
        assert rise[i] == pytest.approx(line_source(X[i], depth, 5.0), abs=1e-11)


def test_reversed_motion_mirrors():
    flux = np.random.default_rng(0).uniform(size=90)
    forth, back = (HeatedSurface(UNIT, 90, 0.1, v) for v in (3.0, -3.0))
    assert forth.rise(flux) == pytest.approx(back.rise(flux[::-1])[::-1], rel=1e-12)


def test_slow_motion_is_a_datum_for_rest():
    """A slow source is one at rest with its datum at 4 kappa / (V e^gamma)."""
    speed, flux = 1e-7, np.array([0.0, 1.0, 2.0, 0.5, 0.0])
    reach = 4.0 / (speed * np.exp(np.euler_gamma))
    slow = HeatedSurface(UNIT, 5, 0.5, speed).rise(flux)
    rest = HeatedSurface(UNIT, 5, 0.5, 0.0, reach).rise(flux)
    assert slow == pytest.approx(rest, rel=1e-6)
    with pytest.raises(ValueError, match="reach"):
        HeatedSurface(UNIT, 5, 0.5, 0.0)
    edges = np.array([3.0, 1.0])  # a band's, seen from x = 2
    steady = edges * (1.0 + np.log(reach / edges)) @ [1.0, -1.0] / np.pi
    assert band_surface(2.0, 0.5 * speed) == pytest.approx(steady, rel=1e-6)


def test_heat_balance_behind_a_source():
    """Heat that enters is carried away: V rho c int T dz = q l far behind."""
    x = np.arange(0, 1200) / 50.0
    flux = np.maximum(1.0 - np.abs(x - 22.0), 0.0)
    surface = HeatedSurface(UNIT, len(x), 0.02, -20.0)
    points, weights = np.polynomial.legendre.leggauss(24)
    depths = 4.0 * (1.0 + points)
    field = surface.field(flux, depths)
    assert 20.0 * 4.0 * weights @ field[:, 200] == pytest.approx(1.0, rel=1e-3)
