"""Fields by convolution against the direct sum, and the levels they stand on; accuracy at depths
below the sampling interval (Bailey and Sayles 1991, figure 5b).

Hertz's pressure, sampled at pitch h, against the exact stresses at 0.01 h to 3 h below points
anywhere on |x| < 0.9 a. Joined linearly it keeps its accuracy at every depth and x. Held over
uniform strips it is as accurate on the axes of the elements only; between them the error is of
first order in h, and with friction it grows without bound towards the strips' ends.
"""

from collections.abc import Callable

import numpy as np
import pytest
from strips import stress_of_strips

from analytic.exact.hertz import hertz_from_peak_pressure, hertz_stress
from analytic.stress.field import friction_field, graded_depths
from analytic.stress.points import stress_at

PITCH = 2.0**-7
NODES = (np.arange(150) - 60.0) * PITCH
PRESSURE = np.maximum(np.random.default_rng(2).standard_normal(150) + 0.3, 0.0)
LEVELS = np.array([0.0, 1e-12, 1e-4, 2e-3, 0.03, 0.4, 5.0])


def worst(field, friction: float, nodes, pressure) -> float:
    """Largest difference to the direct sum, relative to the largest stress or pressure."""
    x, z = np.meshgrid(field.x, field.z)
    direct = stress_at(nodes, pressure, friction, x, z).parts
    apart = np.abs(field.at(friction).stress.parts - direct).max()
    return apart / max(np.abs(direct).max(), np.abs(pressure).max())


@pytest.mark.parametrize(
    ("x_range", "subdivisions"),
    [
        ((-3.0, 3.0), 1),  # wider than the nodes
        ((0.1, 0.2), 1),  # within them
        ((-0.6, 0.9), 2),
        ((-0.1, 0.1), 5),
        ((2.0, 4.0), 1),  # beside them
        ((-4.0, -1.0), 4),
        ((0.0, 0.0), 1),  # one column
        ((-1.0, 1.5), 3),
        ((1.0, 2.0), 3),
        # kernels that hold both sides of an element, and those of windows beside all of the load
        ((-0.3, 0.4), 1),
        ((-0.4, 9.0), 1),
        ((-30.0, 0.2), 1),
        ((1.0, 1.3), 1),
        ((40.0, 41.0), 1),
        ((-9.0, -0.469), 1),
    ],
)
def test_field_equals_direct_sum(x_range, subdivisions):
    field = friction_field(NODES, PRESSURE, x_range, LEVELS, subdivisions)
    for friction in (0.0, 0.35):
        assert worst(field, friction, NODES, PRESSURE) < 2e-14


def test_field_on_a_grid_of_rounded_places():
    """Places of the grid are rounded to 1e-14 of a pitch; near the surface that shows as 1e-13."""
    nodes = 0.7 + np.arange(150) * 1e-2
    field = friction_field(nodes, PRESSURE, (0.0, 3.0), LEVELS, 2)
    assert worst(field, 0.35, nodes, PRESSURE) < 1e-12


def test_grid_holds_the_nodes_and_stays_in_the_window():
    field = friction_field(NODES, PRESSURE, (-0.3, 1.0), LEVELS, 3).at(0.0)
    assert field.x[0] >= -0.3 and field.x[0] - PITCH / 3.0 < -0.3
    assert field.x[-1] <= 1.0 and field.x[-1] + PITCH / 3.0 > 1.0
    np.testing.assert_allclose(np.diff(field.x), PITCH / 3.0, rtol=1e-12)
    inside = NODES[(NODES >= -0.3) & (NODES <= 1.0)]
    assert np.abs(field.x[:, None] - inside).min(axis=0).max() < 1e-15
    assert field.stress.sx.shape == (len(LEVELS), len(field.x))


def test_surface_carries_pressure_and_traction_exactly():
    field = friction_field(NODES, PRESSURE, (-2.0, 2.0), LEVELS, 1).at(0.25)
    expected = np.zeros(len(field.x))
    expected[np.searchsorted(field.x, NODES)] = PRESSURE
    np.testing.assert_array_equal(field.stress.sz[0], -expected)
    np.testing.assert_array_equal(field.stress.txz[0], -0.25 * expected)
    finer = friction_field(NODES, PRESSURE, (-0.4, 0.6), LEVELS, 4).at(0.25)
    between = np.interp(finer.x, NODES, PRESSURE)
    np.testing.assert_allclose(finer.stress.sz[0], -between, rtol=0.0, atol=1e-15)
    without = friction_field(NODES, PRESSURE, (-0.4, 0.6), LEVELS, 4).at(0.0)
    np.testing.assert_array_equal(without.stress.sx[0], without.stress.sz[0])
    np.testing.assert_array_equal(without.stress.txz[0], 0.0)


def test_no_pressure_no_stress():
    field = friction_field(NODES, np.zeros(150), (-1.0, 1.0), LEVELS).at(0.2)
    assert not np.any(field.stress.sx) and not np.any(field.stress.txz)


def test_deep_level_far_from_the_load_keeps_its_digits():
    """On a level by itself the sum is relative to that level's own stresses, not to p."""
    field = friction_field(NODES, PRESSURE, (-1.0, 1.0), np.array([1e4])).at(0.3)
    direct = stress_at(NODES, PRESSURE, 0.3, field.x, 1e4)
    np.testing.assert_allclose(field.stress.sz[0], direct.sz, rtol=1e-12)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"z": np.array([])}, "not empty"),
        ({"z": np.array([-1.0, 0.0])}, "ascend strictly from z >= 0"),
        ({"subdivisions": 0}, "whole number from 1"),
        ({"x_range": (0.001, 0.002)}, "no point of the grid"),
    ],
)
def test_what_makes_no_field_is_refused(changed, said):
    options = {"x_range": (-1.0, 1.0), "z": LEVELS, "subdivisions": 1} | changed
    with pytest.raises(ValueError, match=said):
        friction_field(NODES, PRESSURE, **options).at(0.0)


def test_graded_depths_grow_by_one_ratio():
    levels = graded_depths(2e-3, 40, 1e-6)
    assert (len(levels), levels[0], levels[-1]) == (40, 0.0, 2e-3)
    steps = np.diff(levels)
    assert steps[0] == pytest.approx(1e-6, rel=1e-9)
    ratio = steps[1:] / steps[:-1]
    assert ratio.min() > 1.0
    np.testing.assert_allclose(ratio, ratio[0], rtol=1e-9)
    np.testing.assert_allclose(graded_depths(1.0, 11, 0.1), np.linspace(0.0, 1.0, 11), atol=1e-15)


@pytest.mark.parametrize(
    ("count", "first", "said"),
    [(11, 0.11, r"at most 0\.1 m"), (11, 0.0, "first must be"), (2, 0.1, "count must be")],
)
def test_what_makes_no_graded_depths_is_refused(count, first, said):
    with pytest.raises(ValueError, match=said):
        graded_depths(1.0, count, first)


@pytest.mark.parametrize("stride", [2, 3, 7])
def test_a_stride_keeps_some_of_the_same_points(stride):
    every = friction_field(NODES, PRESSURE, (-0.9, 1.3), LEVELS, 2)
    some = friction_field(NODES, PRESSURE, (-0.9, 1.3), LEVELS, 2, stride=stride)
    assert np.array_equal(some.x, every.x[::stride])
    assert np.array_equal(some.at(0.2).stress.sx, every.at(0.2).stress.sx[:, ::stride])


UNIT = hertz_from_peak_pressure(1.0, 1.0, 2.0)
DEPTHS = np.array([0.01, 0.03, 0.1, 0.3, 1.0, 3.0])  # pitches
ANYWHERE = np.random.default_rng(11).uniform(-0.9, 0.9, 300)


def errors(
    count: int, friction: float, stress_of: Callable, x: np.ndarray, depths=DEPTHS
) -> np.ndarray:
    """Largest error of sx, sz and txz on each depth [p0], `count` pitches a half-width."""
    nodes = np.arange(-count, count + 1) / count
    x, z = np.meshgrid(x, np.asarray(depths) / count)
    stress = stress_of(nodes, UNIT.pressure(nodes), friction, x, z)
    exact = hertz_stress(UNIT, x, z, friction)
    return np.abs(stress.parts - exact.parts).max(axis=(0, 2))


def axes(count: int, between: bool) -> np.ndarray:
    """Places of nodes, or half-way between two."""
    last = int(0.9 * count)
    return (np.arange(-last, last) + 0.5 * between) / count


# Largest errors by depth [p0], a third above what was measured
HATS_AT_100 = {
    0.0: [2.1e-4, 2.1e-4, 2.1e-4, 2.3e-4, 4.0e-4, 6.8e-4],
    0.1: [4.3e-4, 4.3e-4, 4.3e-4, 4.4e-4, 6.5e-4, 9.3e-4],
}


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_hats_are_accurate_at_any_depth_and_place(friction):
    error = errors(100, friction, stress_at, ANYWHERE)
    assert np.all(error < HATS_AT_100[friction])
    # no worse next to the surface than three pitches below it
    assert error[0] < error[-1]


# On each depth: the square of the pitch, beside which the pressure's square-root edges radiate
# stresses of power 3/2 under traction, and of 5/2 under pressure, as the depth goes with the pitch.
ORDERS = {0.0: [2.0, 2.0, 2.0, 2.05, 2.2, 2.3], 0.1: [1.55, 1.55, 1.57, 1.6, 1.65, 1.75]}


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_error_of_hats_falls_by_the_square_of_the_pitch_or_with_friction_by_three_halves(friction):
    counts = 200 * 2 ** np.arange(5)
    worst = [errors(count, friction, stress_at, ANYWHERE) for count in counts]
    order = -np.polyfit(np.log(counts), np.log(worst), 1)[0]
    assert order == pytest.approx(ORDERS[friction], abs=0.1)


def test_strips_are_accurate_on_their_axes_just_below_the_surface():
    """Without friction to a few 1e-4 at a hundredth of the pitch, as the published figure."""
    on_axes = errors(100, 0.0, stress_of_strips, axes(100, between=False), DEPTHS[:1])
    anywhere = errors(100, 0.0, stress_of_strips, ANYWHERE, DEPTHS[:1])
    assert on_axes < 1e-3
    assert anywhere > 20.0 * on_axes


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_strips_between_their_axes_err_by_the_first_power_of_the_pitch(friction):
    between = [
        errors(n, friction, stress_of_strips, axes(n, True), DEPTHS[:3]) for n in (50, 100, 200)
    ]
    order = np.log2(np.array(between[:-1]) / between[1:])
    assert order == pytest.approx(np.ones((2, 3)), abs=0.05)
    hats = errors(200, friction, stress_at, axes(200, True), DEPTHS[:3])
    assert np.all(between[-1] > 20.0 * hats)


def test_three_pitches_down_elements_do_not_differ():
    for friction in (0.0, 0.1):
        hats, strips = (
            errors(100, friction, stress_of, ANYWHERE, [3.0, 10.0])
            for stress_of in (stress_at, stress_of_strips)
        )
        np.testing.assert_allclose(strips, hats, rtol=0.4)
        assert hats.max() < 1e-3
