"""Ends and curve of the smooth pressure behind hats, on Hertz's contact and on others."""

import numpy as np
import pytest
from hats import pressed
from scipy.optimize import brentq

from analytic.contact.smooth_pressure import contact_ends, curves_between, nodal_values
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid

HERTZ = hertz_from_peak_pressure(1.0, 0.5, 1.0)  # half-width 1


def parabola(x):
    return x**2


def contact(grid, gap=parabola):
    return pressed(grid, 1.0, gap, load=HERTZ.load_per_length)


def equal(per_half):
    return HatGrid(1.0 / per_half, -int(1.6 * per_half) + 1, int(1.6 * per_half) - 1)


def ends_of(grid, gap=parabola):
    """Ends [m] of a single patch."""
    solution = contact(grid, gap)
    _, [ends] = contact_ends(grid.x, solution.pressure, solution.gap)
    return ends


@pytest.mark.parametrize("elements", [12.0, 20.0])
@pytest.mark.parametrize("fraction", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_ends_are_found_wherever_they_lie_between_nodes(elements, fraction):
    grid = equal(elements + fraction)
    assert np.abs(ends_of(grid) - [-1.0, 1.0]).max() < 0.2 * grid.pitch


def test_the_curve_of_nodal_values_is_closer_to_the_pressure_than_the_hats():
    grid = equal(20.5)
    solution = contact(grid)
    nodes, ends = contact_ends(grid.x, solution.pressure, solution.gap)
    held = slice(nodes[0, 0] + 2, nodes[0, 1] - 1)
    x, nodal = grid.x, nodal_values(solution.pressure)
    alone = np.zeros(len(x[held]), dtype=int)
    curve = curves_between(ends, x[held], nodal[held], alone)
    at = np.linspace(-0.999, 0.999, 4001)
    exact, found = HERTZ.pressure(at), curve(at, np.zeros(4001, dtype=int))
    by_hats = np.interp(at, x, solution.pressure)
    assert np.linalg.norm(found - exact) < 0.55 * np.linalg.norm(by_hats - exact)
    assert abs(found.max() - 1.0) < 2e-4
    assert np.array_equal(curve(np.array([-1.2, 1.2]), np.zeros(2, dtype=int)), np.zeros(2))
    # beside others each patch has the curve that it has alone
    both = np.concatenate([ends, ends + 3.0])
    twice = np.concatenate([x[held], x[held] + 3.0]), np.tile(nodal[held], 2)
    curve = curves_between(both, *twice, np.concatenate([alone, alone + 1]))
    np.testing.assert_allclose(curve(at + 3.0, np.ones(4001, dtype=int)), found, atol=1e-12)


def test_a_mirrored_contact_has_mirrored_ends():
    def lopsided(x):
        return (x - 0.123) ** 2 - 0.02 * np.sin(9.0 * x)

    there = ends_of(HatGrid(0.025, -59, 67), lopsided)
    back = ends_of(HatGrid(0.025, -67, 59), lambda x: lopsided(-x))
    assert there == pytest.approx(-back[::-1], abs=1e-7)


def test_nodal_values_undo_the_overshoot_of_hats_on_a_parabola():
    pitch = 0.1
    x = pitch * np.arange(-4, 5)
    wanted = 3.0 - 2.0 * x + 1.5 * x**2
    values = nodal_values(wanted - 3.0 * pitch**2 / 12.0)
    assert values[1:-1] == pytest.approx(wanted[1:-1], rel=1e-13)


def test_all_ends_at_once_are_those_of_a_search_one_by_one(rng):
    """The same equation for each end alone, by quadrature and brentq."""
    grid, gap = HatGrid(0.9, 0, 399), np.zeros(400)
    for start in range(0, 400, 40):  # open, then in contact
        depth = np.minimum(np.arange(20), np.arange(20)[::-1]) + rng.uniform(0.0, 1.0)
        gap[start : start + 20] = depth**1.5 * (1.0 + 0.02 * depth)
    nodes, ends = contact_ends(grid.x, np.where(gap > 0.0, 0.0, 1.0), gap)
    assert len(nodes) == 10
    for node, place, side in [
        *zip(nodes[:, 0], ends[:, 0], [-1] * 10, strict=True),
        *zip(nodes[:-1, 1], ends[:-1, 1], [1] * 9, strict=True),
    ]:
        near = np.sort(node + side * np.arange(2, 5))
        some = HatGrid(grid.pitch, *near[[0, -1]])

        def mismatch(end, near=near, some=some, side=side):
            powers = (lambda x, p=p: np.maximum(side * (x - end), 0.0) ** p for p in (1.5, 2.5))
            rows = [some.hat_integrals(power, np.array([end])) for power in powers]
            return np.linalg.det(np.array([*rows, gap[near]]))

        assert place == pytest.approx(brentq(mismatch, place - 0.05, place + 0.05), abs=1e-4)
