"""Thermal stresses of a half-plane: the equations of elasticity, a free surface, and scaling."""

import numpy as np
import pytest

from analytic.heat.moving_source import HeatedSurface
from analytic.heat.thermal_stress import thermal_stress
from analytic.material import Material, ThermalMaterial

STEEL, ALPHA = Material(210e9, 0.3), 12e-6
THERMAL = ThermalMaterial(46.0, 7850.0, 460.0)
HALF = 100e-6
CONSTANT = STEEL.youngs_modulus * ALPHA / (1.0 - STEEL.poissons_ratio)


def surface(peclet, count=801, half=HALF):
    velocity = -peclet * 2.0 * THERMAL.diffusivity / half
    return HeatedSurface(THERMAL, count, 8.0 * half / (count - 1), velocity)


def bump(count=801):
    """A smooth flux on the inner quarter."""
    x = np.linspace(-4.0, 4.0, count)
    return 1e8 * np.clip(1.0 - x**2, 0.0, None) ** 3


def stresses(peclet, depths, **options):
    one, flux = surface(peclet, **options), bump(options.get("count", 801))
    return thermal_stress(one, flux, depths, STEEL, ALPHA).parts


@pytest.mark.parametrize("peclet", [0.3, 3.0, 30.0, -3.0])
def test_equations_of_elasticity(peclet):
    """Differences of second order on a grid of equal spacing: equilibrium along and across the
    surface, and compatibility, laplacian (sx + sz) = -C laplacian T. No traction at the surface:
    these have no other solution that dies off."""
    one, flux = surface(peclet), bump()
    h = one.pitch
    z = h * np.arange(10, 61)
    sx, sz, txz = stresses(peclet, z)
    temperature = one.field(flux, z)

    def along(field):
        return (field[1:-1, 2:] - field[1:-1, :-2]) / (2.0 * h)

    def down(field):
        return (field[2:, 1:-1] - field[:-2, 1:-1]) / (2.0 * h)

    def laplacian(field):
        inner = field[1:-1, 1:-1]
        beside = field[2:, 1:-1] + field[:-2, 1:-1] + field[1:-1, 2:] + field[1:-1, :-2]
        return (beside - 4.0 * inner) / h**2

    for one_side, other in ((along(sx), down(txz)), (along(txz), down(sz))):
        scale = np.abs(one_side).max()
        assert one_side + other == pytest.approx(0.0, abs=0.01 * scale)
    bend = CONSTANT * laplacian(temperature)
    assert laplacian(sx + sz) == pytest.approx(-bend, abs=0.01 * np.abs(bend).max())
    _, sz, txz = stresses(peclet, [0.0])
    assert np.abs([sz, txz]).max() < 1e-12 * CONSTANT * one.rise(flux).max()


def test_a_source_at_rest_leaves_no_stress_in_the_plane():
    """Its temperature is harmonic; slow sources come near, by a logarithm."""
    one = HeatedSurface(THERMAL, 801, 1e-6, 0.0, reach=1e-2)
    assert not np.any(thermal_stress(one, bump(), [0.0, HALF], STEEL, ALPHA).parts)
    largest = [
        np.abs(stresses(p, [0.0])).max() / (CONSTANT * surface(p).rise(bump()).max())
        for p in (0.3, 0.1, 0.03, 0.01)
    ]
    assert np.all(np.diff(largest) < 0.0) and largest[-1] < 0.5 * largest[0]


def test_a_fast_source_holds_what_it_heats():
    """A thin layer cannot expand along the surface: sx = -C T there."""
    one = surface(3000.0, count=6401)
    sx = stresses(3000.0, [0.0], count=6401)[0, 0]
    held = -CONSTANT * one.rise(bump(6401))
    assert sx == pytest.approx(held, abs=0.02 * np.abs(held).max())
    slow = -CONSTANT * surface(3.0).rise(bump())
    assert np.abs(stresses(3.0, [0.0])[0, 0] - slow).max() > 0.1 * np.abs(slow).max()


def test_scaling_and_mirror():
    depths = HALF * np.array([0.0, 0.2, 1.0])
    stress = stresses(3.0, depths)
    larger = stresses(3.0, 10.0 * depths, half=10.0 * HALF)
    assert larger == pytest.approx(10.0 * stress, abs=1e-9 * np.abs(larger).max())
    sx, sz, txz = stresses(-3.0, depths)[..., ::-1]
    assert np.array([sx, sz, -txz]) == pytest.approx(stress, abs=1e-9 * np.abs(stress).max())
    twice = thermal_stress(surface(3.0), 2.0 * bump(), depths, STEEL, 3.0 * ALPHA)
    assert twice.sx == pytest.approx(6.0 * stress[0], rel=1e-12)


@pytest.mark.parametrize("peclet", [0.05, 0.5, 5.0, 100.0])
def test_the_ring_is_long_enough(peclet, monkeypatch):
    depths = HALF * np.array([0.0, 0.1, 1.0])
    stress = stresses(peclet, depths)
    monkeypatch.setattr("analytic.heat.thermal_stress.RING", 128)
    monkeypatch.setattr("analytic.heat.thermal_stress.LAYERS", 400.0)
    assert np.abs(stress - stresses(peclet, depths)).max() < 3e-3 * np.abs(stress).max()
