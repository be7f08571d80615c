"""Smooth line contact against high-precision values, quadrature and its own limits."""

import numpy as np
import pytest
from scenes import reference
from scipy.integrate import trapezoid
from scipy.optimize import minimize

from analytic.exact.hertz import (
    HertzContact,
    hertz_extremes,
    hertz_from_load,
    hertz_from_peak_pressure,
    hertz_stress,
)

REFERENCE = reference("a_hertz_field")
UNIT = HertzContact(1.0, 1.0, np.pi / 2.0, 1.0, 2.0)
POINTS = REFERENCE["points"] + REFERENCE["surface_points"]


def column(name: str) -> np.ndarray:
    return np.array([float(row[name]) for row in POINTS])


@pytest.mark.parametrize("name", ["sx", "sz", "txz", "sy_nu03", "tau1", "von_mises_nu03"])
def test_reference_field(name):
    """Within 1e-6 of an edge the quoted points are no doubles, and the rounding of x shows."""
    x, z, friction = column("x_over_a"), column("z_over_a"), column("mu")
    stress = hertz_stress(UNIT, x, z, friction)
    of_nu = {"sy_nu03": stress.sy, "von_mises_nu03": stress.von_mises}
    value = of_nu[name](0.3) if name in of_nu else getattr(stress, name)
    error = np.abs(value - column(name))
    assert len(error) == 207
    at_edge = np.abs(np.abs(x) - 1.0) < 2e-6
    assert error[at_edge].max() < 1e-13
    assert error[~at_edge].max() < 3e-15


@pytest.mark.parametrize("mu", ["0", "0.1", "0.3"])
def test_reference_extremes(mu):
    expected, extremes = REFERENCE["maxima"][mu], hertz_extremes(UNIT, float(mu))
    for name, extremum, sign in (
        ("tau1_interior", extremes.tau1, 1.0),
        ("txz_most_positive", extremes.txz_max, 1.0),
        ("txz_most_negative_minus", extremes.txz_min, -1.0),
    ):
        assert sign * extremum.value == pytest.approx(float(expected[name]["value"]), rel=4e-15)
        assert extremum.x == pytest.approx(float(expected[name]["x_over_a"]), abs=1e-10)
        assert extremum.z == pytest.approx(float(expected[name]["z_over_a"]), abs=1e-10)


def test_friction_brings_the_largest_shear_to_the_surface():
    """It rises with mu; from about mu = 0.37 on mu p0 at the surface exceeds all below."""
    depths = [hertz_extremes(UNIT, mu).tau1.z for mu in (0.0, 0.1, 0.2, 0.36, 0.38)]
    assert np.all(np.diff(depths) < 0.0) and depths[-2] > 0.1 and depths[-1] == 0.0
    extremes = hertz_extremes(UNIT, 0.5)
    assert (extremes.tau1.value, extremes.tau1.z) == (0.5, 0.0)
    assert (extremes.txz_min.value, extremes.txz_min.z) == (-0.5, 0.0)
    below = minimize(
        lambda point: -hertz_stress(UNIT, point[0], point[1], 0.5).txz,
        (-0.86, 1.0),
        method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-16},
    )
    assert extremes.txz_max.value == pytest.approx(-below.fun, rel=1e-14)
    assert (extremes.txz_max.x, extremes.txz_max.z) == pytest.approx(tuple(below.x), abs=1e-6)


def test_extremes_mirror_when_the_sliding_reverses():
    there, back = hertz_extremes(UNIT, 0.2), hertz_extremes(UNIT, -0.2)
    assert back.tau1.value == pytest.approx(there.tau1.value, rel=1e-14)
    assert back.tau1.x == pytest.approx(-there.tau1.x, abs=1e-10)
    assert back.txz_max.value == pytest.approx(-there.txz_min.value, rel=1e-14)


def test_extremes_exceed_the_field_everywhere():
    x, z = np.linspace(-2.0, 2.0, 401), np.linspace(0.0, 2.0, 201)[:, None]
    for friction in (0.0, 0.05, 0.2, 0.36, 0.4, 1.0):
        stress, extremes = hertz_stress(UNIT, x, z, friction), hertz_extremes(UNIT, friction)
        for field, value in (
            (stress.tau1, extremes.tau1.value),
            (stress.txz, extremes.txz_max.value),
            (-stress.txz, -extremes.txz_min.value),
        ):
            assert value - 2e-4 < field.max() < value + 1e-15


def test_frictionless_shear_in_closed_form():
    assert UNIT.tau1_max == pytest.approx(0.30028310600077760789, rel=1e-15)
    assert UNIT.tau1_max_depth == pytest.approx(0.786151377757423286, rel=1e-15)


def test_axis_without_friction():
    """Figure 5 of Bailey and Sayles 1991, exact values, and their equations (6a) to (6c)."""
    depth = np.array([0.02, 0.06, 0.1, 0.5, 1.0, 2.0])
    stress = hertz_stress(UNIT, 0.0, depth)
    printed = [-0.96060, -0.88539, -0.81494, -0.34164, -0.12132, -0.02492]
    np.testing.assert_allclose(stress.sx, printed, atol=5e-6)
    printed = [-0.99980, -0.99820, -0.99504, -0.89443, -0.70711, -0.44721]
    np.testing.assert_allclose(stress.sz, printed, atol=5e-6)
    root = np.sqrt(1.0 + depth**2)
    np.testing.assert_allclose(stress.sx, 2 * depth - (1 + 2 * depth**2) / root, rtol=1e-13)
    np.testing.assert_allclose(stress.sz, -1.0 / root, rtol=1e-15)
    np.testing.assert_allclose(stress.tau1, depth - depth**2 / root, rtol=1e-13)
    np.testing.assert_array_equal(stress.txz, 0.0)


def test_depth_below_the_edge():
    """Figure 11b of Bailey and Sayles 1991, exact values."""
    depth = np.array([0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8])
    for friction, expected in (
        (0.0, [0.06398, 0.12630, 0.16247, 0.20027, 0.21991, 0.23085, 0.23665, 0.23909, 0.23768]),
        (0.1, [0.14023, 0.18745, 0.21567, 0.24437, 0.25805, 0.26446, 0.26660, 0.26598, 0.25968]),
    ):
        tau1 = hertz_stress(UNIT, 1.0, depth, friction).tau1
        np.testing.assert_allclose(tau1, expected, atol=5.1e-6)


def smith_and_liu(x: np.ndarray, z: np.ndarray, friction: float) -> dict[str, np.ndarray]:
    """Stresses of the unit contact at z > 0 as Smith and Liu 1953 give them, by two functions of
    the point, psi and its twin, of k1, k2 = (1 + x)^2 + z^2, (1 - x)^2 + z^2."""
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
    return {name: -(normal[name] + friction * tangential[name]) / np.pi for name in normal}


@pytest.mark.parametrize("friction", [0.0, 0.1, 1.0 / 3.0, -0.8])
def test_closed_forms_of_smith_and_liu(friction):
    rng = np.random.default_rng(5)
    x, z = rng.uniform(-3.0, 3.0, 500), rng.uniform(0.05, 3.0, 500)
    stress = hertz_stress(UNIT, x, z, friction)
    for name, expected in smith_and_liu(x, z, friction).items():
        # their sums lose digits: 1e-12 of the peak pressure is theirs
        np.testing.assert_allclose(getattr(stress, name), expected, atol=1e-12)


def test_largest_tension_stands_at_the_trailing_edge():
    """2 mu p0, the figure that surface cracks are judged by."""
    x, z = np.linspace(-4.0, 4.0, 8001), np.array([[0.0], [1e-3], [0.1], [1.0]])
    for friction in (0.1, 0.6):
        sx = hertz_stress(UNIT, x, z, friction).sx
        row, column = np.unravel_index(np.argmax(sx), sx.shape)
        assert (row, x[column]) == (0, pytest.approx(-1.0))
        assert sx.max() == pytest.approx(2.0 * friction, rel=1e-12)


def test_surface():
    x = np.array([-7.0, -1.0, -0.99, -0.3, 0.0, 0.6, 1.0, 1.0 + 1e-9, 4.0])
    stress = hertz_stress(UNIT, x, 0.0, 0.25)
    np.testing.assert_allclose(stress.sz, -UNIT.pressure(x), rtol=1e-15, atol=0.0)
    np.testing.assert_allclose(stress.txz, -0.25 * UNIT.pressure(x), rtol=1e-15, atol=0.0)
    outside = np.sign(x) * np.sqrt(np.maximum((np.abs(x) - 1) * (np.abs(x) + 1), 0.0))
    expected = -UNIT.pressure(x) - 0.5 * (x - outside)
    np.testing.assert_allclose(stress.sx, expected, rtol=1e-13)
    inside = np.abs(x) < 1.0
    np.testing.assert_allclose(stress.tau1[inside], 0.25, rtol=1e-15)


def test_field_is_continuous_onto_the_surface_and_the_edge():
    """sqrt(z/a) is the largest change that a depth z can make, and makes at the edge."""
    x = np.array([-1.0, -0.5, 0.0, 0.999999, 1.0, 1.000001, 2.0])
    for z in (1e-9, 1e-12, 1e-15):
        there, below = hertz_stress(UNIT, x, 0.0, 0.3), hertz_stress(UNIT, x, z, 0.3)
        assert np.abs(there.parts - below.parts).max() < 2.5 * np.sqrt(z)


@pytest.mark.parametrize("distance", [3.0, 40.0, 1e3, 1e6])
@pytest.mark.parametrize("slope", [1e-15, 1e-6, 0.03, 0.8, 30.0, 1e6])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_each_component_relatively_far_away(distance, slope, side):
    """Gauss-Chebyshev quadrature of the point loads' stresses: terms of one sign, no cancellation.

    sz falls to 1e-57 p0 here. The traction's sx is singled out by an excessive friction.
    """
    order = np.arange(1, 31) * np.pi / 31.0
    at, weight = np.cos(order), np.pi / 31.0 * np.sin(order) ** 2
    x = side * distance / np.hypot(1.0, slope)
    z = distance * slope / np.hypot(1.0, slope)
    along = x - at
    kernel = 2.0 / np.pi * weight / (along**2 + z**2) ** 2
    stress = hertz_stress(UNIT, x, z)
    assert stress.sx == pytest.approx(-np.sum(kernel * along**2) * z, rel=1e-13)
    assert stress.sz == pytest.approx(-np.sum(kernel) * z**3, rel=1e-13)
    across = np.sum(kernel * along) * z**2
    lost = 1e-15 * np.sum(kernel * np.abs(along)) * z**2
    assert stress.txz == pytest.approx(-across, rel=1e-13, abs=lost)
    friction = 1e12
    expected = -np.sum(kernel * (along**2 * z + friction * along**3))
    lost = 1e-15 * friction * np.sum(kernel * np.abs(along) ** 3)
    assert hertz_stress(UNIT, x, z, friction).sx == pytest.approx(expected, rel=1e-13, abs=lost)


def test_symmetry_superposition_and_units():
    rng = np.random.default_rng(4)
    x, z = rng.uniform(-3.0, 3.0, 200), rng.uniform(0.0, 3.0, 200)
    right, left = hertz_stress(UNIT, x, z, 0.3), hertz_stress(UNIT, -x, z, -0.3)
    np.testing.assert_array_equal(left.sx, right.sx)
    np.testing.assert_array_equal(left.sz, right.sz)
    np.testing.assert_array_equal(left.txz, -right.txz)

    none, one, two = (hertz_stress(UNIT, x, z, mu).parts for mu in (0.0, 0.3, 0.6))
    np.testing.assert_allclose(one, 0.5 * (none + two), rtol=1e-13, atol=1e-16)

    big = HertzContact(2.0**-12, 2.0**30, 1.0, 1.0, 1.0)
    scaled = hertz_stress(big, x * 2.0**-12, z * 2.0**-12, 0.3)
    np.testing.assert_array_equal(scaled.sx, right.sx * 2.0**30)
    extremes, unit = hertz_extremes(big, 0.3), hertz_extremes(UNIT, 0.3)
    assert extremes.tau1.value == unit.tau1.value * 2.0**30
    assert extremes.txz_min.z == unit.txz_min.z * 2.0**-12


def test_any_level_carries_the_load():
    """The resultant of sz over a level is -P and that of txz is -friction P."""
    x = np.sinh(np.linspace(-20.0, 20.0, 40001))
    for depth in (0.1, 1.0, 20.0):
        stress = hertz_stress(UNIT, x, depth, 0.4)
        assert trapezoid(stress.sz, x) == pytest.approx(-UNIT.load_per_length, rel=1e-6)
        assert trapezoid(stress.txz, x) == pytest.approx(-0.4 * np.pi / 2.0, rel=1e-6)


def test_dimensions_by_load_and_by_pressure_agree():
    """Equations (4) and (5) of Bailey and Sayles 1991 on a steel pair."""
    by_load = hertz_from_load(3.85e6, 8.2e-3, 113.7e9)
    assert by_load.half_width == pytest.approx(np.sqrt(4 * 3.85e6 * 8.2e-3 / (np.pi * 113.7e9)))
    assert by_load.peak_pressure == pytest.approx(np.sqrt(3.85e6 * 113.7e9 / (np.pi * 8.2e-3)))
    by_pressure = hertz_from_peak_pressure(by_load.peak_pressure, 8.2e-3, 113.7e9)
    for name in ("half_width", "load_per_length", "peak_pressure"):
        assert getattr(by_pressure, name) == pytest.approx(getattr(by_load, name), rel=1e-14)
    x = np.cos(np.linspace(0.0, np.pi, 4001)) * by_load.half_width
    assert -trapezoid(by_load.pressure(x), x) == pytest.approx(3.85e6, rel=1e-6)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_what_is_not_positive_is_refused(bad):
    with pytest.raises(ValueError, match="radius must be positive"):
        hertz_from_load(1.0, bad, 1.0)
    with pytest.raises(ValueError, match="peak_pressure must be positive"):
        hertz_from_peak_pressure(bad, 1.0, 1.0)


def test_a_point_above_the_surface_is_refused():
    with pytest.raises(ValueError, match="z must not be negative"):
        hertz_stress(UNIT, 0.0, -1e-9)
