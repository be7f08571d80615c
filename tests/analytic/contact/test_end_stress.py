"""Stresses that hats leave out next to the ends of contact, against Hertz's sliding contact."""

import numpy as np
import pytest
from hats import pressed

from analytic.contact.end_stress import REACH, end_stress
from analytic.exact.hertz import hertz_from_load, hertz_stress
from analytic.grid import HatGrid, roller_gap
from analytic.stress.points import stress_at

HERTZ = hertz_from_load(1.0, 1.0, 4.0 / np.pi)  # a half-width of 1
P0 = HERTZ.peak_pressure


def solved(elements, offset=0.0, gap=None):
    grid = HatGrid.within(-1.5 + offset, 1.5, 1.0 / elements)
    return grid, pressed(grid, HERTZ.combined_modulus, gap or roller_gap(1.0), load=1.0)


def errors(elements, depth, friction=0.5, offset=0.0):
    """Largest of tau1 within three pitches of an end, of the hats and with what they leave out,
    over friction p0; the very end aside."""
    grid, solution = solved(elements, offset)
    h = grid.pitch
    places = np.arange(0.1, 3.0, 0.1) * h
    x, z = np.concatenate([-1.0 + places, 1.0 - places]), depth * h
    hats = stress_at(grid.x, solution.pressure, friction, x, z)
    ends = end_stress(grid.x, solution.pressure, solution.gap)
    both = hats.plus(1.0, ends.stress(friction, x, z))
    exact = hertz_stress(HERTZ, x, z, friction).tau1
    return [np.abs(stress.tau1 - exact).max() / (friction * P0) for stress in (hats, both)]


@pytest.mark.parametrize("offset", [0.0, 0.013, 0.029])
@pytest.mark.parametrize(("elements", "most"), [(10.0, 4e-3), (20.0, 2e-3), (80.0, 1e-3)])
def test_the_surface_bears_friction_times_the_peak_up_to_the_ends(elements, most, offset):
    hats, both = errors(elements, 0.0, offset=offset)
    assert both < most < 0.2 * hats


@pytest.mark.parametrize("depth", [0.1, 0.5, 1.0])
def test_below_the_surface_too(depth):
    hats, both = errors(19.325, depth)
    assert both < 0.15 * hats


def test_the_ends_are_where_force_and_moment_ask_for_them():
    grid, solution = solved(20.0, 0.013)
    [patch] = end_stress(grid.x, solution.pressure, solution.gap).patches
    assert np.abs(np.array(patch.ends) - [-1.0, 1.0]).max() < 0.02 * grid.pitch
    assert 0.5 * np.pi * patch.half * patch.series[0] == pytest.approx(1.0, rel=2e-5)


def test_nothing_is_left_out_far_from_the_ends():
    grid, solution = solved(40.0)
    change = end_stress(grid.x, solution.pressure, solution.gap)
    reach = REACH * grid.pitch
    assert not change.parts([0.0, 1.0 + 1.01 * reach, 1.0], [0.0, 0.0, 1.01 * reach]).any()
    # where it is cut off it is next to nothing
    assert np.abs(change.parts(1.0 - 0.99 * reach, 0.0)).max() < 2e-4 * P0


def test_a_mirrored_contact_has_the_mirrored_stresses():
    def tilted(x):
        return 0.5 * x**2 + 0.02 * np.sin(3.0 * x + 0.4)

    grid, solution = solved(30.0, gap=tilted)
    one = end_stress(grid.x, solution.pressure, solution.gap)
    other = end_stress(-grid.x[::-1], solution.pressure[::-1], solution.gap[::-1])
    x, z = np.array([-0.95, -0.7, 0.8, 0.97]), np.array([0.0, 0.01, 0.0, 0.02])
    there, back = one.parts(x, z), other.parts(-x, z)
    signs = np.array([1.0, 1.0, -1.0, -1.0])[:, None]
    np.testing.assert_allclose(back, signs * there, atol=1e-9 * P0)


def test_few_nodes_and_steep_ends_keep_their_hats():
    grid, solution = solved(5.0)
    assert end_stress(grid.x, solution.pressure, solution.gap).patches == ()

    def with_step(x):  # whose corner presses next to the right end
        return 0.5 * x**2 - 0.02 * np.exp(-(((x - 0.75) / 0.08) ** 2))

    grid, solution = solved(20.0, gap=with_step)
    assert end_stress(grid.x, solution.pressure, solution.gap).patches == ()
    grid, solution = solved(160.0, gap=with_step)
    assert len(end_stress(grid.x, solution.pressure, solution.gap).patches) > 0
