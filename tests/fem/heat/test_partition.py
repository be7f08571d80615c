"""Partition of frictional heat: symmetry, one dimension, fast limits, Jaeger's kernels."""

from functools import cache

import numpy as np
import pytest
from heat_loads import OPEN, UNIT, flux_load, steady
from moving_band import band_surface

from analytic.heat.moving_source import HeatedSurface
from analytic.heat.partition import divided
from analytic.material import ThermalMaterial
from fem.body.surface import values_at
from fem.heat.body import thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.heat.partition import FrictionalHeat
from meshes.build import build_block
from meshes.thermal_layer import thermal_spec

HELD = Surroundings("held", "held")
X = np.linspace(-1.0, 1.0, 41)
EVEN = np.ones(41)


@cache
def half_plane(velocity, conductivity=1.0, capacity=1.0, surroundings=OPEN, size=0.1):
    material = ThermalMaterial(conductivity, capacity, 1.0)
    length = material.diffusivity / velocity if velocity else np.inf
    spec = thermal_spec([[-1.0, 1.0]], size, half_width=10.0, depth=10.0, length=length)
    return Conduction(thermal_body(build_block(spec), material), velocity, surroundings)


@pytest.mark.parametrize("conductivity", [1.0, 3.0, 1000.0])
def test_bodies_at_rest_of_one_shape(conductivity):
    """q_1 = k_1 / (k_1 + k_2) Q everywhere, whatever Q."""
    pair = half_plane(0.0, surroundings=HELD), half_plane(0.0, conductivity, surroundings=HELD)
    heat = 1.0 + 0.5 * np.sin(3.0 * X)
    heated = FrictionalHeat(pair, X).steady(heat)
    assert heated.share == pytest.approx(1.0 / (1.0 + conductivity), rel=1e-9)
    assert heated.flux[0] == pytest.approx(heat / (1.0 + conductivity), rel=1e-7)
    assert heated.flux.sum(axis=0) == pytest.approx(heat, rel=1e-13)


@pytest.mark.parametrize("velocity", [0.2, 20.0, 2000.0])
def test_equal_bodies_that_move_alike_share_equally(velocity):
    heated = FrictionalHeat((half_plane(velocity), half_plane(velocity)), X).steady(EVEN)
    assert heated.share == pytest.approx(0.5, rel=1e-9)


def test_equal_bodies_that_move_against_each_other_share_equally():
    heated = FrictionalHeat((half_plane(200.0), half_plane(-200.0)), X).steady(EVEN)
    assert heated.share == pytest.approx(0.5, rel=1e-3)
    assert heated.flux[0] == pytest.approx(heated.flux[1, ::-1], abs=2e-2 * heated.flux.max())


@pytest.mark.parametrize(("conductivity", "capacity"), [(4.0, 1.0), (1.0, 4.0), (2.0, 2.0)])
def test_fast_bodies_that_move_alike_share_by_effusivity(conductivity, capacity):
    """Blok's fast limit: heat flows at right angles to the surface only."""
    pair = half_plane(200.0), half_plane(200.0, conductivity, capacity)
    heated = FrictionalHeat(pair, X).steady(EVEN)
    assert heated.share == pytest.approx(1.0 / (1.0 + np.sqrt(conductivity * capacity)), rel=1e-3)


def by_kernels(peclet, conductivity, count):
    """Flux into body 1 on `count` strips of the band, temperatures equal in their middles."""
    x = (np.arange(count) + 0.5) * 2.0 / count - 1.0
    first, second = (
        band_surface(np.sign(number) * (x[:, None] - x) * count, abs(number) / count) / (count * k)
        for number, k in zip(peclet, (1.0, conductivity), strict=True)
    )
    return x, np.linalg.solve(first + second, second @ np.ones(count))


@pytest.mark.parametrize(
    ("peclet", "conductivity"), [((0.5, 50.0), 1.0), ((0.5, 5.0), 3.0), ((2.0, -2.0), 1.0)]
)
def test_unlike_bodies_by_jaeger_s_kernels(peclet, conductivity):
    """A source that moves towards +x with Peclet number Pe has material that moves with -2 Pe."""
    velocity = -2.0 * np.array(peclet) * (1.0, conductivity)
    pair = half_plane(velocity[0]), half_plane(velocity[1], conductivity)
    heated = FrictionalHeat(pair, X).steady(EVEN)
    x, flux = by_kernels(peclet, conductivity, 400)
    assert heated.share == pytest.approx(flux.mean(), abs=2e-3)
    inside = np.abs(heated.x) < 0.7
    exact = np.interp(heated.x, x, flux)
    assert heated.flux[0][inside] == pytest.approx(exact[inside], abs=1e-2)


@cache
def rough(count):
    """Nodes, a heat of nine patches, linear between 201 of them, and which cells touch."""
    coarse = np.linspace(-1.0, 1.0, 201)
    wave = np.cos(9.0 * np.pi * coarse) + 0.4 * np.cos(5.0 * coarse + 1.0) - 0.2
    x = np.linspace(-1.0, 1.0, count)
    heat = np.interp(x, coarse, np.maximum(0.0, wave))
    return x, heat, heat[1:] + heat[:-1] > 0.0


def under_patches(velocity):
    x, _, contact = rough(201)
    ends = np.flatnonzero(np.diff(np.pad(contact.astype(int), 1)))
    law = {"length": UNIT.diffusivity / velocity, "layers": 1.0}
    patches = np.column_stack([x[ends[::2]], x[ends[1::2]]])
    spec = thermal_spec(patches, 0.01, half_width=10.0, depth=10.0, **law)
    return Conduction(thermal_body(build_block(spec), UNIT), velocity, OPEN)


@pytest.mark.parametrize("velocity", [1.0, -40.0, 400.0])
def test_a_rough_flux_by_transforms(velocity):
    """The surface's temperature at all nodes, by the half-plane's moving-source kernel."""
    x, flux, _ = rough(201)
    exact = HeatedSurface(UNIT, 201, 0.01, velocity).rise(flux)
    conduction = under_patches(velocity)
    body = conduction.body
    temperature = steady(conduction, flux_load(body, x, flux))
    rise = values_at(body.surface, x) @ temperature[body.surface.point]
    assert rise == pytest.approx(exact, abs=1.5e-3 * exact.max())


def test_a_rough_partition_by_transforms():
    """Fluxes at nodes alone end a node before the patches do: an error of order 1 in the pitch."""
    x, heat, contact = rough(201)
    heated = FrictionalHeat((under_patches(1.0), under_patches(-40.0)), x, contact).steady(heat)
    shares, flash = [], []
    for count in (401, 801):
        surfaces = (HeatedSurface(UNIT, count, 2.0 / (count - 1), v) for v in (1.0, -40.0))
        by_nodes = divided(*surfaces, rough(count)[1])
        shares.append(by_nodes.fraction)
        flash.append(by_nodes.first.max())
    assert heated.share == pytest.approx(2.0 * shares[1] - shares[0], rel=1e-3)
    assert heated.temperature[0].max() == pytest.approx(flash[1], rel=1.5e-3)


def test_temperatures_are_equal_in_contact_and_not_beside_it():
    contact = (np.abs(X[:-1] + 0.6) < 0.31) | (np.abs(X[:-1] - 0.6) < 0.31)
    pair = half_plane(1.0, size=0.05), half_plane(-20.0, 2.0)
    system = FrictionalHeat(pair, X, contact)
    heat = np.where(np.isin(X, system.x), 1.0, 0.0)
    heated = system.steady(heat)
    places = np.column_stack([0.5 * (X[1:] + X[:-1]), np.zeros(40)])
    sides = zip(pair, heated.temperature, strict=True)
    first, second = (side.body.at(places, rise) for side, rise in sides)
    apart = np.abs(first - second)
    inner = np.all([np.roll(contact, k) for k in range(-3, 4)], axis=0)
    assert apart[inner].max() < 0.005 * np.ptp(first)
    assert apart[~contact].max() > 0.2 * np.ptp(first)


def test_what_is_refused():
    pair = half_plane(20.0), half_plane(20.0)
    with pytest.raises(ValueError, match="no part of the surfaces"):
        FrictionalHeat(pair, X, np.zeros(40, dtype=bool))
    with pytest.raises(ValueError, match="finer than the nodes of both surfaces"):
        FrictionalHeat(pair, np.linspace(-1.0, 1.0, 2001))
