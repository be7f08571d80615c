"""Accuracy at depths below the sampling interval (Bailey and Sayles 1991, figure 5b).

Hertz's pressure, sampled at pitch h, against the exact stresses at 0.01 h to 3 h below places
anywhere on |x| < 0.9 a. Joined linearly it keeps its accuracy at every depth and place. Held over
uniform strips it is as accurate on the axes of the elements only; between them the error is of
first order in h, and with friction it grows without bound towards the strips' ends.
"""

import numpy as np
import pytest

from analytic.exact.hertz import hertz_from_peak_pressure, hertz_stress
from analytic.stress.points import stress_at

UNIT = hertz_from_peak_pressure(1.0, 1.0, 2.0)
DEPTHS = np.array([0.01, 0.03, 0.1, 0.3, 1.0, 3.0])  # pitches
ANYWHERE = np.random.default_rng(11).uniform(-0.9, 0.9, 300)


def errors(count: int, friction: float, element: str, x: np.ndarray, depths=DEPTHS) -> np.ndarray:
    """Largest error of sx, sz and txz on each depth [p0], `count` pitches a half-width."""
    nodes = np.arange(-count, count + 1) / count
    x, z = np.meshgrid(x, np.asarray(depths) / count)
    stress = stress_at(nodes, UNIT.pressure(nodes), friction, x, z, element)
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
    error = errors(100, friction, "hat", ANYWHERE)
    assert np.all(error < HATS_AT_100[friction])
    # no worse next to the surface than three pitches below it
    assert error[0] < error[-1]


# On each depth: the square of the pitch, beside which the pressure's square-root edges radiate
# stresses of power 3/2 under traction, and of 5/2 under pressure, as the depth goes with the pitch.
ORDERS = {0.0: [2.0, 2.0, 2.0, 2.05, 2.2, 2.3], 0.1: [1.55, 1.55, 1.57, 1.6, 1.65, 1.75]}


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_error_of_hats_falls_by_the_square_of_the_pitch_or_with_friction_by_three_halves(friction):
    counts = 200 * 2 ** np.arange(5)
    worst = [errors(count, friction, "hat", ANYWHERE) for count in counts]
    order = -np.polyfit(np.log(counts), np.log(worst), 1)[0]
    assert order == pytest.approx(ORDERS[friction], abs=0.1)


def test_strips_are_accurate_on_their_axes_just_below_the_surface():
    """Without friction to a few 1e-4 at a hundredth of the pitch, as the published figure."""
    on_axes = errors(100, 0.0, "strip", axes(100, between=False), DEPTHS[:1])
    anywhere = errors(100, 0.0, "strip", ANYWHERE, DEPTHS[:1])
    assert on_axes < 1e-3
    assert anywhere > 20.0 * on_axes


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_strips_between_their_axes_err_by_the_first_power_of_the_pitch(friction):
    between = [errors(n, friction, "strip", axes(n, True), DEPTHS[:3]) for n in (50, 100, 200)]
    order = np.log2(np.array(between[:-1]) / between[1:])
    assert order == pytest.approx(np.ones((2, 3)), abs=0.05)
    hats = errors(200, friction, "hat", axes(200, True), DEPTHS[:3])
    assert np.all(between[-1] > 20.0 * hats)


def test_only_strips_spike_at_their_ends_under_friction():
    """Each decade towards a strip's end adds as much again; the hats' error stays."""
    depths = 10.0 ** -np.arange(3.0, 12.0)
    ends = axes(100, between=True)
    strips = errors(100, 0.1, "strip", ends, depths)
    steps = np.diff(strips)
    assert np.all(steps > 0.0)
    np.testing.assert_allclose(steps[2:], steps[2], rtol=1e-3)
    hats = errors(100, 0.1, "hat", ends, depths)
    assert np.ptp(hats) < 1e-2 * hats[0]


def test_three_pitches_down_elements_do_not_differ():
    for friction in (0.0, 0.1):
        hats, strips = (errors(100, friction, e, ANYWHERE, [3.0, 10.0]) for e in ("hat", "strip"))
        np.testing.assert_allclose(strips, hats, rtol=0.4)
        assert hats.max() < 1e-3
