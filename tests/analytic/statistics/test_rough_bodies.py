"""Rough sphere against reference digits, rough cylinder against another discretisation; limits."""

from dataclasses import replace

import numpy as np
import pytest
from rough_planes import nominally_flat
from scenes import reference
from scipy.optimize import root

from analytic.exact.hertz import hertz_from_load
from analytic.operators.half_plane import HalfPlane
from analytic.statistics import rough_bodies
from analytic.statistics.nominally_flat import Summits, tail_integral
from analytic.statistics.rough_bodies import bearing_of, rough_contact, rough_cylinder

SPHERES = reference("g_greenwood")["GT"]
SUMMITS = Summits(density=5e8, radius=200e-6, deviation=0.5e-6)
MODULUS, RADIUS = 115e9, 10e-3


@pytest.mark.parametrize("row", SPHERES, ids=lambda row: f"T={row['T']:g} m={row['mu']:g}")
def test_sphere_has_the_digits_of_the_reference(row):
    contact = rough_contact("sphere", row["T"], row["mu"])
    figures = {
        "d_star": contact.d,
        "p0_star": contact.pressure[0],
        "aHertz_star": contact.smooth[0],
        "p0Hertz_star": contact.smooth[1],
        "a_eff_star_A": contact.effective_width,
        "mean_real_pressure_over_Eprime_sqrt_sigma_beta": contact.mean_real_pressure,
    }
    real = np.sum(2.0 * np.pi * contact.rho * contact.steps * tail_integral(1.0, contact.h))
    assert real == pytest.approx(float(row["int_2pi_rho_F1"]), rel=1e-8)
    assert figures == {name: pytest.approx(float(row[name]), rel=1e-8) for name in figures}


def by_hats(cylinder, load, pitch):
    """Peak pressure [Pa], real length [m] and effective half-width [m] by hat pressures and the
    half-plane's Galerkin operator, in SI, by scipy's root finder."""
    count = 2 * int(0.95 * cylinder.rho[-1] / pitch) + 1
    x = pitch * (np.arange(count) - count // 2)
    dense = HalfPlane(count, pitch, MODULUS).block(np.arange(count)) / pitch
    deviation = SUMMITS.deviation

    def unbalanced(unknown):
        height, h = unknown[-1], unknown[:-1]
        pressure, _ = nominally_flat(SUMMITS, MODULUS, h)
        sunk = dense @ pressure + x**2 / (2.0 * RADIUS)
        excess = np.log(pitch * pressure.sum() / load)
        return np.append(h - height - sunk / deviation, excess)

    def jacobian(unknown):
        slope = -1.5 * nominally_flat(SUMMITS, MODULUS, 0.0)[0] / tail_integral(1.5, 0.0)
        slope = slope * tail_integral(0.5, unknown[:-1])
        total = nominally_flat(SUMMITS, MODULUS, unknown[:-1])[0].sum()
        block = np.eye(count) - dense * slope / deviation
        return np.block([[block, -np.ones((count, 1))], [slope[None] / total, np.zeros((1, 1))]])

    near = np.interp(np.abs(x), cylinder.rho, cylinder.h)
    start = np.append(near + 0.05, 0.0)
    result = root(unbalanced, start, jac=jacobian, tol=1e-13)
    assert result.success, result.message
    h = result.x[:-1]
    pressure, area = nominally_flat(SUMMITS, MODULUS, h)
    width = 0.75 * np.pi * np.sum(np.abs(x) * pressure) / pressure.sum()
    return np.array([pressure.max(), pitch * area.sum(), width])


@pytest.mark.parametrize("load", [1e4, 1e6])
def test_cylinder_against_hats_on_halved_pitches(load):
    """Second order, and Richardson's extrapolation meets the spectral solution."""
    cylinder = rough_cylinder(load, RADIUS, MODULUS, SUMMITS)
    real_length = load / cylinder.mean_real_pressure
    expected = [cylinder.pressure[0], real_length, cylinder.effective_width]
    pitch = np.sqrt(2.0 * RADIUS * SUMMITS.deviation) / 4.0
    coarse, middle, fine = (by_hats(cylinder, load, pitch / 2**k) for k in range(3))
    order = np.log2((coarse - middle) / (middle - fine))
    assert order == pytest.approx(2.0, abs=0.15)
    extrapolated = fine + (fine - middle) / 3.0
    assert extrapolated == pytest.approx(expected, rel=2e-5)


@pytest.mark.parametrize(("load", "bearing"), [(1e-3, 40.0), (1.0, 0.3), (300.0, 4.0)])
def test_more_nodes_change_nothing(monkeypatch, load, bearing):
    contact = rough_contact("cylinder", load, bearing)
    monkeypatch.setitem(rough_bodies.NODES, "cylinder", 160)
    finer = rough_contact("cylinder", load, bearing)
    for name in ("d", "effective_width", "mean_real_pressure"):
        assert getattr(contact, name) == pytest.approx(getattr(finer, name), rel=1e-9)


def test_heavy_load_is_hertz():
    """The rim beyond the smooth contact is as wide as the gap there opens: a^-4/3 of a, T^-2/3."""
    off = []
    for load in (1e2, 1e3, 1e4):
        contact = rough_contact("cylinder", load, 10.0)
        width, peak = contact.smooth
        off.append([contact.effective_width / width - 1.0, 1.0 - contact.pressure[0] / peak])
    assert np.all(np.array(off) > 0.0) and off[-1][0] < 1e-3 and off[-1][1] < 1e-3
    rates = np.log10(np.array(off)[:-1] / off[1:])
    assert 2.0 / 3.0 < rates[1, 0] < rates[0, 0] < 0.85 and rates[1, 1] > 2.0 / 3.0


def test_light_load_is_a_rigid_roller_on_a_rough_plane():
    """Nothing sinks: p = m F_3/2(h0 + rho^2), of Greenwood and Williamson's plane."""
    contact = rough_contact("cylinder", 1e-7, 4.0)
    expected = 4.0 * tail_integral(1.5, contact.h[0] + contact.rho**2)
    bearing = contact.pressure > 1e-6 * contact.pressure[0]
    assert contact.pressure[bearing] == pytest.approx(expected[bearing], rel=1e-5)


def test_figures_in_si():
    cylinder = rough_cylinder(1e6, RADIUS, MODULUS, SUMMITS)
    assert 2.0 * np.sum(cylinder.steps * cylinder.pressure) == pytest.approx(1e6, rel=1e-9)
    hertz = hertz_from_load(1e6, RADIUS, MODULUS)
    assert cylinder.smooth == pytest.approx((hertz.half_width, hertz.peak_pressure), rel=1e-12)


def test_any_scale_of_length_and_pressure_is_the_same():
    one = rough_cylinder(1e6, RADIUS, MODULUS, SUMMITS)
    small = Summits(SUMMITS.density * 1e6, SUMMITS.radius / 1e3, SUMMITS.deviation / 1e3)
    other = rough_cylinder(1e6 * 1e-3 * 7.0, RADIUS / 1e3, 7.0 * MODULUS, small)
    assert other.effective_width == pytest.approx(one.effective_width / 1e3, rel=1e-10)
    assert other.mean_real_pressure == pytest.approx(7.0 * one.mean_real_pressure, rel=1e-10)


def test_too_smooth_and_wrong_loads_are_refused():
    with pytest.raises(ValueError, match="the roughness hardly shows"):
        rough_contact("cylinder", 1e9, 1.0)
    with pytest.raises(ValueError, match="load must be positive"):
        rough_contact("cylinder", 0.0, 1.0)


def test_the_separation_has_the_datum_that_it_says():
    """h - d at the centre is the sink there, -(2/pi) integral p* ln rho drho."""
    contact = rough_contact("cylinder", 3.0, 4.0)
    logarithm = np.log(np.maximum(contact.rho, 1e-300))
    sink = -2.0 / np.pi * np.sum(contact.steps * contact.pressure * logarithm)
    assert contact.h[0] - contact.d == pytest.approx(sink, abs=1e-3)


def real_pressure_on_sphere(load, **changes):
    """Mean real pressure over E* on a rough sphere under a load T."""
    summits = replace(SUMMITS, **changes)
    contact = rough_contact("sphere", load, bearing_of(summits, RADIUS))
    return contact.mean_real_pressure * np.sqrt(summits.deviation / summits.radius)


@pytest.mark.parametrize(
    ("changes", "factor"), [({}, 1.79), ({"density": 940e6}, 1.62), ({"deviation": 0.94e-6}, 1.62)]
)
def test_load_hardly_moves_the_mean_real_pressure(changes, factor):
    """Three decades of load (Seireg 1998, fig. 4.5); a smooth sphere's grows by 10."""
    heavy, light = (real_pressure_on_sphere(load, **changes) for load in (100.0, 0.1))
    assert heavy / light == pytest.approx(factor, abs=0.005)


@pytest.mark.parametrize(
    "changes", [{"deviation": 0.75e-6}, {"density": 350e6}, {"radius": 140e-6}]
)
def test_rougher_fewer_and_sharper_summits_bear_by_more_pressure(changes):
    """And so by less area, against the words of Seireg's third conclusion."""
    load = 10.0 * (SUMMITS.deviation / changes.get("deviation", SUMMITS.deviation)) ** 1.5
    assert real_pressure_on_sphere(load, **changes) > 1.02 * real_pressure_on_sphere(10.0)
