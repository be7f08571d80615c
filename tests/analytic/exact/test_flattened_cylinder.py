"""The capped cylinder in closed form: its limits, its equations, and the contact solver on it."""

from itertools import pairwise

import numpy as np
import pytest
from exact_stresses import flowed_volume, largest_overlap
from hats import pressed
from scipy.integrate import quad

from analytic.exact.flattened_cylinder import FlattenedCylinder, flattened_cylinder
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap

LOAD, RADIUS, MODULUS = 1e6, 8e-3, 115e9
HERTZ = hertz_from_load(LOAD, RADIUS, MODULUS)
OFFSETS = np.arange(0.03, 1.0, 0.06)  # of a node, of the contact's edge
SHARES = [0.97, 0.9, 0.75]  # of Hertz' peak pressure


def exact(share: float) -> FlattenedCylinder:
    return flattened_cylinder(LOAD, RADIUS, MODULUS, share * HERTZ.peak_pressure)


@pytest.mark.parametrize("share", SHARES)
def test_pressure_carries_the_load_and_meets_the_hardness(share):
    cylinder = exact(share)
    outer = quad(cylinder.pressure, cylinder.flowed, cylinder.contact, epsabs=0.0, epsrel=1e-10)[0]
    assert 2.0 * (outer + cylinder.hardness * cylinder.flowed) == pytest.approx(LOAD, rel=1e-9)
    edge = cylinder.flowed * (1.0 + 1e-14)
    assert cylinder.pressure(edge) == pytest.approx(cylinder.hardness, rel=1e-6)
    assert cylinder.pressure([0.0, cylinder.contact, -2.0 * cylinder.contact]).tolist() == [
        cylinder.hardness,
        0.0,
        0.0,
    ]


@pytest.mark.parametrize("share", SHARES)
def test_gap_is_closed_where_ground_is_elastic_and_overlaps_where_it_flowed(share):
    """Its slope x/R - 2/(pi E*) int p/(x - s) ds, by Cauchy's weight from the pressure alone."""
    cylinder = exact(share)
    b, c = cylinder.contact, cylinder.flowed

    ends = [-b, -c, c, b]

    def slope(x: float) -> float:
        total = 0.0
        for start, stop in pairwise(ends):
            if start < x < stop:
                total -= quad(cylinder.pressure, start, stop, weight="cauchy", wvar=x)[0]
            else:
                total += quad(lambda s: cylinder.pressure(s) / (x - s), start, stop)[0]
        return x / RADIUS - 2.0 * total / (np.pi * MODULUS)

    steep = b / RADIUS
    for x in c + (b - c) * np.array([0.1, 0.5, 0.9]):
        assert slope(x) == pytest.approx(0.0, abs=2e-6 * steep)
    node, weight = np.polynomial.legendre.leggauss(12)
    near = 0.5 * (1.0 + node)  # x = c (1 - near^2): the slope is a root at c
    x, dx = c * (1.0 - near**2), c * near * weight
    slopes = np.array([slope(place) for place in x])
    assert np.all(slopes > 0.0)
    assert slopes @ dx == pytest.approx(largest_overlap(cylinder), rel=1e-5)
    assert 2.0 * (x * slopes) @ dx == pytest.approx(flowed_volume(cylinder), rel=1e-5)


def test_a_hardness_just_below_the_peak_leaves_hertz():
    cylinder = exact(1.0 - 1e-9)
    assert cylinder.contact == pytest.approx(HERTZ.half_width, rel=1e-8)
    assert cylinder.flowed < 1e-3 * cylinder.contact
    x = np.linspace(-1.2, 1.2, 49) * HERTZ.half_width
    assert cylinder.pressure(x) == pytest.approx(HERTZ.pressure(x), abs=1e-4 * HERTZ.peak_pressure)


def test_a_soft_body_carries_the_hardness_over_the_whole_width():
    cylinder = exact(0.3)
    assert cylinder.contact == pytest.approx(LOAD / (2.0 * cylinder.hardness), rel=1e-4)
    assert cylinder.flowed == pytest.approx(cylinder.contact, rel=1e-6)


@pytest.mark.parametrize("share", [1.0 + 1e-12, 2.0, -0.5])
def test_nothing_flows_at_a_hardness_above_the_peak(share):
    with pytest.raises(ValueError, match="nothing flows"):
        exact(share)


def solver_errors(cylinder: FlattenedCylinder, count: float) -> tuple[float, float]:
    """Relative errors of the volume of the overlap and of the pressure (L2); hats in b."""
    pitch, reach = cylinder.contact / count, 1.5 * cylinder.contact
    grid = HatGrid.within(-reach, reach, pitch)
    solution = pressed(grid, MODULUS, roller_gap(RADIUS), load=LOAD, hardness=cylinder.hardness)
    volume = pitch * np.maximum(-solution.gap, 0.0)[solution.pressure > 0.0].sum()
    wanted = cylinder.pressure(grid.x)
    return (
        volume / flowed_volume(cylinder) - 1.0,
        np.linalg.norm(solution.pressure - wanted) / np.linalg.norm(wanted),
    )


@pytest.mark.parametrize("share", SHARES)
def test_contact_solver_finds_the_volume_at_second_order_and_the_pressure_at_first(share):
    """Root mean square over places of the edges between nodes; the pressure's slope is infinite
    at c."""
    cylinder = exact(share)
    counts = np.array([40, 160, 640])
    errors = [
        np.sqrt(np.mean([np.square(solver_errors(cylinder, n + o)) for o in OFFSETS], axis=0))
        for n in counts
    ]
    volume, pressure = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert volume == pytest.approx(2.0, abs=0.35) and errors[-1][0] < 3e-5
    assert pressure == pytest.approx(1.0, abs=0.2) and errors[-1][1] < 2e-3
