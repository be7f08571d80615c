"""Punch with rounded corners against high-precision values, quadrature, limits and the solver."""

import numpy as np
import pytest
from hats import pressed
from scenes import reference

from analytic.contact.patches import contact_patches
from analytic.exact.hertz import hertz_from_load
from analytic.exact.rounded_punch import RoundedPunch, rounded_punch_from_half_width
from analytic.grid import HatGrid

CASES = reference("f_rounded_punch_and_sliding")["rounded_punch"]

GAUSS, WEIGHT = np.polynomial.legendre.leggauss(300)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["b_over_a"])
def test_reference_values(case):
    value = {key: float(v) for key, v in case.items() if key != "profile"}
    b, load = value["b_over_a"], value["P_R_over_Estar_a2"]
    punch = rounded_punch_from_half_width(1.0, b, 1.0, 1.0)
    assert punch.load_per_length == pytest.approx(load, rel=2e-15)
    assert punch.peak_pressure == pytest.approx(value["peak_p_R_over_Estar_a"], rel=3e-14)
    peak_x = punch.half_flat + punch._peak_beyond_flat
    assert peak_x == pytest.approx(value["peak_x_over_a"], abs=1e-8)
    x = np.array([float(row["x_over_a"]) for row in case["profile"]])
    expected = np.array([float(row["p_R_over_Estar_a"]) for row in case["profile"]])
    assert len(x) == 8
    np.testing.assert_allclose(punch.pressure(x), expected, rtol=5e-15)
    np.testing.assert_array_equal(punch.pressure(-x), punch.pressure(x))
    mean = np.array([float(row["p_over_pmean"]) for row in case["profile"]])
    assert expected / mean == pytest.approx(0.5 * load, rel=1e-14)


def summed_punches(punch: RoundedPunch, x: float) -> float:
    """Flat punches of growing width, int (dP/dc)/(pi sqrt(c^2 - x^2)) dc, in v = sqrt(c^2 - x^2).

    The integrand arctan(sqrt(c^2 - b^2)/b) is of one sign: nothing cancels at any size.
    """
    b, e = punch.half_flat, punch.corner_chord
    below = (b - x) * (b + x)
    start, stop = np.sqrt(max(below, 0.0)), np.sqrt(e**2 + below)
    u = 0.5 * (1.0 + GAUSS)
    span = (e**2 / (stop + start)) if below > 0.0 else stop
    rise = span * u**6  # v - start, whose square root is not smooth, nor its arctangent far away
    square = rise * (rise + 2.0 * start) + max(-below, 0.0)
    total = np.sum(0.5 * WEIGHT * np.arctan2(np.sqrt(square), b) * 6.0 * u**5) * span
    return punch.combined_modulus / (np.pi * punch.corner_radius) * total


@pytest.mark.parametrize("chord", [1e-12, 1e-8, 1e-4, 1e-2, 0.3, 1.0, 5.0, 100.0, 1e5, 1e9])
def test_pressure_is_the_sum_of_flat_punches(chord):
    """From corners that barely touch to a flat that hardly matters."""
    punch = RoundedPunch(1.0, 1.0, 1.0, 1.0, float(np.hypot(1.0, chord)), chord)
    rng = np.random.default_rng(8)
    a = punch.half_width
    near = 1.0 - 10.0 ** rng.uniform(-13.0, -0.1, 20)
    places = np.concatenate([[0.0, 1.0], near, rng.uniform(0.0, 1.0, 10), rng.uniform(1, a, 20)])
    for x in places:
        if x >= 1.0 and chord**2 - (x - 1.0) * (x + 1.0) < 1e-3 * chord**2:
            continue  # next to the edge the rounding of x decides
        pressure = float(punch.pressure(x))
        assert pressure == pytest.approx(summed_punches(punch, x), rel=1e-12, abs=0.0), x


@pytest.mark.parametrize("half_width", [1.0 + 1e-9, 1.001, 1.5, 30.0, 1e6])
def test_load_is_the_sum_of_flat_punches(half_width):
    punch = rounded_punch_from_half_width(half_width, 1.0, 1.0, 1.0)
    e, u = punch.corner_chord, 0.5 * (1.0 + GAUSS)
    load = 0.5 * e**2 * np.sum(0.5 * WEIGHT * 2.0 * u * np.arctan2(e * u, 1.0))
    assert load == pytest.approx(punch.load_per_length, rel=1e-12, abs=0)


def test_no_flat_is_hertz():
    hertz = hertz_from_load(3.85e6, 8.2e-3, 113.7e9)
    a = hertz.half_width
    punch = rounded_punch_from_half_width(a, 0.0, 8.2e-3, 113.7e9)
    assert punch.load_per_length == pytest.approx(hertz.load_per_length, rel=1e-14)
    assert punch.peak_pressure == pytest.approx(hertz.peak_pressure, rel=1e-15)
    assert punch.half_flat + punch._peak_beyond_flat == 0.0
    x = a * np.linspace(-1.19, 1.19, 49)
    np.testing.assert_allclose(punch.pressure(x), hertz.pressure(x), rtol=1e-13)
    hardly = rounded_punch_from_half_width(a, 1e-12 * a, 8.2e-3, 113.7e9)
    np.testing.assert_allclose(hardly.pressure(x), hertz.pressure(x), rtol=1e-9)


def test_sharp_corners_are_the_flat_punch():
    """P/(pi sqrt(a^2 - x^2)); the difference falls like (e/b)^2."""
    x, errors = np.array([0.0, 0.3, 0.6, 0.8]), []
    for chord in (1e-1, 1e-2, 1e-3):
        punch = rounded_punch_from_half_width(float(np.hypot(1.0, chord)), 1.0, 1.0, 1.0)
        flat = punch.load_per_length / (np.pi * np.sqrt((1.0 - x) * (1.0 + x)))
        errors.append(np.abs(punch.pressure(x) / flat - 1.0).max())
    assert np.diff(np.log10(errors)) == pytest.approx([-2.0, -2.0], abs=0.05)


@pytest.mark.parametrize("chord", [1e-6, 1e-2, 0.5, 3.0, 1e3])
def test_peak_is_the_highest_pressure(chord):
    punch = RoundedPunch(1.0, 1.0, 1.0, 1.0, float(np.hypot(1.0, chord)), chord)
    assert 1.0 <= punch.half_flat + punch._peak_beyond_flat < punch.half_width
    x = np.linspace(1.0, punch.half_width, 20001)
    highest = punch.pressure(x).max()
    assert highest <= punch.peak_pressure * (1.0 + 1e-14)
    # its position is no better resolved than x itself when the corner is small
    assert highest == pytest.approx(punch.peak_pressure, rel=1e-7)


def test_units_do_not_matter():
    here = rounded_punch_from_half_width(1.3, 1.0, 1.0, 1.0)
    there = rounded_punch_from_half_width(1.3 * 2.0**-10, 2.0**-10, 2.0**-10, 2.0**30)
    assert there.load_per_length == pytest.approx(here.load_per_length * 2.0**20, rel=1e-15)
    assert there.peak_pressure == pytest.approx(here.peak_pressure * 2.0**30, rel=1e-15)


@pytest.mark.parametrize(
    ("half_width", "half_flat", "wrong"),
    [(0.0, 1.0, "half_width"), (1.0, -1.0, "half_flat"), (1.0, 1.0, "half_flat")],
)
def test_what_makes_no_sense_is_refused(half_width, half_flat, wrong):
    with pytest.raises(ValueError, match=f"{wrong} must be"):
        rounded_punch_from_half_width(half_width, half_flat, 1.0, 1.0)


def solved(punch: RoundedPunch, elements: int, offset: float):
    """Solution on `elements` hats over |x| < 1.5 a, the punch `offset` pitches off a node."""
    reach = 1.5 * punch.half_width
    grid = HatGrid.within(-reach, reach, 2.0 * reach / elements)
    shift = offset * grid.pitch
    modulus, load = punch.combined_modulus, punch.load_per_length
    knots = np.array([-punch.half_flat, punch.half_flat]) + shift
    return grid.x - shift, pressed(grid, modulus, lambda x: punch.gap(x - shift), knots, load=load)


@pytest.mark.parametrize("flat", [0.3, 0.6, 0.9])
def test_solver_converges_to_the_exact_pressure(flat):
    """Orders: 2 in the peak, 1 in L2 as at any square-root edge; the edges to 0.05 of a pitch.

    Errors averaged over where the edges fall between two nodes; levels by the corner's width.
    """
    punch = rounded_punch_from_half_width(1e-3, flat * 1e-3, 0.1, 110e9)
    errors = []
    for refinement in (1, 2, 4):
        elements = refinement * round(150.0 / (1.0 - flat))
        pairs = []
        for offset in (0.0, 0.25, 0.5, 0.75):
            x, solution = solved(punch, elements, offset)
            exact = punch.pressure(x)
            patches = contact_patches(x, solution.pressure, solution.gap)
            assert len(patches) == 1
            shift = patches[0] / punch.half_width - np.array([-1.0, 1.0])
            assert np.abs(shift).max() < 0.05 * 3.0 / elements
            peak = abs(solution.pressure.max() / punch.peak_pressure - 1.0)
            pairs.append((peak, np.sum((solution.pressure - exact) ** 2) / np.sum(exact**2)))
        peak, square = np.mean(pairs, axis=0)
        errors.append((peak, np.sqrt(square)))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:])).mean(axis=0)
    assert orders[0] == pytest.approx(2.0, abs=0.2)
    assert orders[1] == pytest.approx(1.0, abs=0.05)
    assert errors[-1][0] < 1e-4 and errors[-1][1] < 5e-3
