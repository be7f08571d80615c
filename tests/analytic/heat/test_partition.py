"""The division of heat between two bodies."""

from functools import partial

import numpy as np
import pytest

from analytic.heat.moving_source import HeatedSurface
from analytic.heat.partition import divided, layered_fraction, one_fraction
from analytic.material import ThermalMaterial

STEEL = ThermalMaterial(46.0, 7850.0, 460.0)
COPPER = ThermalMaterial(400.0, 8900.0, 385.0)
POLYMER = ThermalMaterial(0.25, 2200.0, 1000.0)
HALF_WIDTH, COUNT = 5e-4, 601
X = np.linspace(-1.2, 1.2, COUNT)
PITCH = (X[1] - X[0]) * HALF_WIDTH
RIPPLE = 1.0 + 0.9 * np.cos(2.0 * np.pi * X / 0.11)
HEAT = 4e8 * np.sqrt(np.maximum(1.0 - X**2, 0.0)) * np.where(RIPPLE > 0.4, RIPPLE, 0.0)


def surface(material, velocity):
    return HeatedSurface(material, COUNT, PITCH, velocity, reach=8e-3)


def test_equal_bodies_share_evenly():
    one = surface(STEEL, -2.0)
    heat = divided(one, surface(STEEL, -2.0), HEAT)
    assert heat.fraction == pytest.approx(0.5, rel=1e-9)
    assert heat.flux == pytest.approx(0.5 * HEAT, abs=1e-8 * HEAT.max())


@pytest.mark.parametrize("other", [COPPER, POLYMER])
def test_bodies_of_equal_peclet_number_share_by_conductivity(other):
    speeds = 1.0, other.diffusivity / STEEL.diffusivity
    heat = divided(surface(STEEL, speeds[0]), surface(other, speeds[1]), HEAT)
    exact = STEEL.conductivity / (STEEL.conductivity + other.conductivity)
    assert heat.fraction == pytest.approx(exact, rel=1e-8)
    assert heat.flux == pytest.approx(exact * HEAT, abs=1e-6 * HEAT.max())


def test_fast_unlike_bodies_share_by_effusivity_and_speed():
    speeds = 2e3, 5e2
    heat = divided(surface(STEEL, speeds[0]), surface(COPPER, speeds[1]), HEAT)
    effusive = [np.sqrt(m.conductivity * m.density * m.specific_heat) for m in (STEEL, COPPER)]
    sizes = np.multiply(effusive, np.sqrt(speeds))
    assert heat.fraction == pytest.approx(sizes[0] / sum(sizes), rel=2e-3)


@pytest.mark.parametrize(("other", "velocity"), [(STEEL, 0.0), (COPPER, 0.0), (POLYMER, 30.0)])
def test_both_surfaces_have_one_temperature_where_they_touch(other, velocity):
    first, second = surface(STEEL, -1.0), surface(other, velocity)
    heat = divided(first, second, HEAT)
    touch = HEAT > 0.0
    assert heat.first[touch] == pytest.approx(heat.second[touch], abs=1e-5)
    assert np.all(heat.flux[~touch] == 0.0)
    assert heat.first == pytest.approx(first.rise(heat.flux))
    assert heat.second == pytest.approx(second.rise(HEAT - heat.flux))
    assert np.ptp(heat.first[~touch] - heat.second[~touch]) > 0.1  # not so in the gaps


def test_dense_solution():
    first, second = surface(STEEL, -1.0), surface(POLYMER, 0.0)
    nodes = np.flatnonzero(HEAT > 0.0)
    columns = np.array([first.rise(unit) + second.rise(unit) for unit in np.eye(COUNT)[nodes]]).T[
        nodes
    ]
    flux = np.linalg.solve(columns, second.rise(HEAT)[nodes])
    share = divided(first, second, HEAT).flux[nodes]
    assert share == pytest.approx(flux, abs=1e-7 * HEAT.max())


def test_rules_of_one_fraction():
    """Exact for like bodies; a moving body takes more than one at rest."""
    first, second = surface(STEEL, -1.0), surface(STEEL, 0.0)
    fraction = divided(first, second, HEAT).fraction
    for rule in (partial(one_fraction, of=np.max), partial(one_fraction, of=np.mean)):
        assert rule(first, surface(STEEL, -1.0), HEAT) == pytest.approx(0.5)
        assert rule(first, second, HEAT) == pytest.approx(fraction, abs=0.06)
        assert rule(second, first, HEAT) == pytest.approx(1.0 - rule(first, second, HEAT))
    assert fraction > 0.8


def test_layers_have_the_stated_limits():
    assert layered_fraction((46.0, 1e9), (400.0, 1e9)) == pytest.approx(46.0 / 446.0, rel=1e-6)
    assert layered_fraction((46.0, 1e-6), (400.0, 3e-6)) == pytest.approx(0.25, rel=1e-6)
    assert layered_fraction((46.0, 0.2), (46.0, 0.2)) == 0.5
