"""Lines that repeat without end: Westergaard's exact stresses, sums of images, seams."""

import numpy as np
import pytest
from exact_stresses import westergaard_stress

from analytic.exact.westergaard import westergaard_from_half_width
from analytic.stress.field import friction_field, stress_field
from analytic.stress.maxima import stress_maxima
from analytic.stress.periodic import DEEP
from analytic.stress.points import friction_stress_at, stress_at

NAMES = ("sx", "sz", "txz")


def period(count: int, length: float) -> np.ndarray:
    return np.arange(count) * (length / count)


def parts(stress) -> np.ndarray:
    return np.array([stress.normal.sx, stress.normal.sz, stress.normal.txz, stress.traction_sx])


def wave(x: np.ndarray, z: np.ndarray, number: float) -> np.ndarray:
    """Under p = cos kx: Johnson 1985, section 13.2; under q the harmonic potential's parts."""
    fade, turn = np.exp(-number * z), number * z
    return fade * np.array(
        [
            -(1.0 - turn) * np.cos(number * x),
            -(1.0 + turn) * np.cos(number * x),
            -turn * np.sin(number * x),
            -(2.0 - turn) * np.sin(number * x),
        ]
    )


@pytest.mark.parametrize("waves", [1, 3])
def test_hats_on_a_cosine_approach_the_exact_stresses_by_the_square_of_the_pitch(rng, waves):
    """Order 2 on both sides, at all depths from a hundredth of the pitch to half a period."""
    length, counts = 2.5, (64, 128, 256)
    number = 2.0 * np.pi * waves / length
    x, z = rng.uniform(-3.0, 4.0, 120), 10.0 ** rng.uniform(-4.0, 0.1, 120)
    errors = []
    for count in counts:
        nodes = period(count, length)
        found = parts(friction_stress_at(nodes, np.cos(number * nodes), x, z, periodic=True))
        errors.append(np.sqrt(np.mean((found - wave(x, z, number)) ** 2, axis=1)))
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    # Between nodes near the surface the logarithm of the tent's corner costs a little.
    assert order.min() > 1.9 and order.max() < 2.1
    assert np.max(errors[-1]) < 2e-4 * waves**2


@pytest.mark.parametrize("element", ["hat", "strip"])
def test_one_wave_is_exact_but_for_the_elements_own_factor(rng, element):
    """Below the pitch's reach a sampled cosine is the cosine times sinc or its square."""
    count, length, number = 16, 1.0, 2.0 * np.pi
    nodes = period(count, length)
    x, z = rng.uniform(-1.0, 1.0, 60), rng.uniform(0.4, 1.5, 60)
    found = parts(friction_stress_at(nodes, np.cos(number * nodes), x, z, element, periodic=True))
    factor = np.sinc(1.0 / count) ** (2 if element == "hat" else 1)
    # The next alias has 15 waves, and e^(-2 pi 15 0.4) is 4e-17.
    np.testing.assert_allclose(found, factor * wave(x, z, number), rtol=0.0, atol=3e-15)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_partial_contact_of_a_wavy_surface(rng, friction):
    """The square-root edges limit the order to 3/2 away from them."""
    contact = westergaard_from_half_width(0.2, 1.0, 1e-2, 1.0)
    x, z = rng.uniform(-0.5, 0.5, 80), rng.uniform(0.05, 1.0, 80)
    exact = westergaard_stress(contact, x, z, friction)
    scale, half = contact.peak_pressure, contact.half_width
    worst = []
    for count in (200, 800):
        nodes = period(count, 1.0)
        inside = np.abs((nodes + 0.5) % 1.0 - 0.5)
        s, sine = np.sin(np.pi * half), np.sin(np.pi * inside)
        shape = np.sqrt(np.maximum(s**2 - sine**2, 0.0))
        pressure = 2.0 * contact.closing_pressure * np.cos(np.pi * inside) * shape
        found = stress_at(nodes, pressure, friction, x, z, periodic=True)
        worst.append(max(np.abs(getattr(found, n) - getattr(exact, n)).max() for n in NAMES))
    assert worst[1] < 3e-4 * scale
    assert 1.3 < np.log(worst[0] / worst[1]) / np.log(4.0) < 1.8


@pytest.mark.parametrize("element", ["hat", "strip"])
@pytest.mark.parametrize("count", [2, 5, 16])
def test_sum_of_images(rng, element, count):
    """What J images on either side leave out falls like 1/(J + 1/2), which is extrapolated away."""
    nodes, load = 0.3 + period(count, 0.75), rng.uniform(-1.0, 1.0, count)
    middle = nodes.mean()
    x = middle + rng.uniform(-0.37, 0.37, 40)
    z = 10.0 ** rng.uniform(-5.0, 0.0, 40)
    periodic = parts(friction_stress_at(nodes, load, x, z, element, periodic=True))
    sums = []
    for images in (80, 160):
        shift = np.arange(-images, images + 1)[:, None] * 0.75
        many = (nodes + shift).ravel(), np.tile(load, 2 * images + 1)
        sums.append(parts(friction_stress_at(*many, x, z, element)))
    assert np.abs(sums[1] - periodic).max() < 0.02
    extrapolated = (160.5 * sums[1] - 80.5 * sums[0]) / 80.0
    np.testing.assert_allclose(extrapolated, periodic, rtol=0.0, atol=5e-6)


def test_a_period_more_changes_nothing(rng):
    nodes, load = period(32, 1.0), rng.uniform(0.0, 1.0, 32)
    x, z = rng.uniform(-0.4, 0.4, 200), 10.0 ** rng.uniform(-6.0, 0.3, 200)
    base = parts(friction_stress_at(nodes, load, x, z, periodic=True))
    away = parts(friction_stress_at(nodes, load, x + 3.0, z, periodic=True))
    assert np.abs(away - base).max() < 1e-11
    twice = parts(friction_stress_at(period(64, 2.0), np.tile(load, 2), x, z, periodic=True))
    assert np.abs(twice - base).max() < 1e-13


@pytest.mark.parametrize("element", ["hat", "strip"])
@pytest.mark.parametrize("count", [2, 3, 64])
def test_no_seam_where_the_waves_take_over(rng, element, count):
    nodes, load = period(count, 1.0), rng.uniform(0.0, 1.0, count)
    x = np.linspace(-0.7, 0.9, 57)
    above, below = (
        parts(friction_stress_at(nodes, load, x, DEEP * factor, element, periodic=True))
        for factor in (1.0 - 1e-15, 1.0 + 1e-15)
    )
    assert np.abs(above - below).max() < 1e-14


def test_far_below_only_the_mean_is_left(rng):
    """sx = sz = -P under pressure; txz = -Q and no sx under a traction."""
    nodes, load = period(10, 1.0), rng.uniform(0.0, 1.0, 10)
    extra = rng.uniform(-1.0, 1.0, 10)
    deep = stress_at(nodes, load, 0.2, [0.1, 0.6], 9.0, traction=extra, periodic=True)
    np.testing.assert_allclose(deep.sx, -load.mean(), rtol=1e-13)
    np.testing.assert_allclose(deep.sz, -load.mean(), rtol=1e-13)
    np.testing.assert_allclose(deep.txz, -0.2 * load.mean() - extra.mean(), rtol=1e-12)


def test_uniform_pressure_is_uniform_from_the_surface_down(rng):
    x, z = rng.uniform(-1.0, 1.0, 100), 10.0 ** rng.uniform(-8.0, 1.0, 100)
    found = parts(friction_stress_at(period(24, 0.5), np.full(24, 2.0), x, z, periodic=True))
    expected = np.array([-2.0, -2.0, 0.0, 0.0])[:, None]
    np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), atol=2e-13)


LEVELS = np.array([0.0, 1e-12, 1e-3, 0.2, 0.99, 1.01, 3.0, 40.0, 3e3])


@pytest.mark.parametrize("element", ["hat", "strip"])
@pytest.mark.parametrize(("count", "subdivisions"), [(2, 1), (5, 1), (16, 3), (64, 1), (128, 5)])
def test_field_equals_the_points(rng, element, count, subdivisions):
    """Windows shorter and longer than the period, levels on either side of every method."""
    pitch = 2.0**-5
    nodes, load = 0.25 + pitch * np.arange(count), rng.uniform(-1.0, 1.0, count)
    length = count * pitch
    for window in ((0.25, 0.25 + 0.4 * length), (0.25 - 0.8 * length, 0.25 + 1.7 * length)):
        field = friction_field(
            nodes, load, window, LEVELS * pitch, subdivisions, element, periodic=True
        )
        x, z = np.meshgrid(field.x, field.z)
        points = friction_stress_at(nodes, load, x, z, element, periodic=True)
        # A place between nodes is rounded to 1e-14 of a pitch, which sx under q sees.
        assert np.abs(parts(field.stress) - parts(points)).max() < 5e-13


def test_field_of_many_levels_in_blocks_and_strides(rng):
    nodes, load = period(500, 1.0), rng.uniform(0.0, 1.0, 500)
    levels = np.linspace(0.0, 0.6, 200)
    every = friction_field(nodes, load, (0.1, 1.3), levels, 2, periodic=True)
    some = friction_field(nodes, load, (0.1, 1.3), levels, 2, stride=7, periodic=True)
    assert np.array_equal(some.stress.traction_sx, every.stress.traction_sx[:, ::7])
    for row in (0, 1, 2, 90, 199):
        alone = friction_field(nodes, load, (0.1, 1.3), levels[row : row + 1], 2, periodic=True)
        assert np.abs(parts(every.stress)[:, row] - parts(alone.stress)[:, 0]).max() < 2e-15


def test_surface_of_a_periodic_field_carries_its_load(rng):
    nodes, load = period(20, 1.0), rng.uniform(0.0, 1.0, 20)
    extra = rng.uniform(-1.0, 1.0, 20)
    field = stress_field(nodes, load, 0.1, (-0.5, 1.45), np.zeros(1), traction=extra, periodic=True)
    index = np.arange(-10, 30) % 20
    np.testing.assert_array_equal(field.stress.sz[0], -load[index])
    np.testing.assert_allclose(
        field.stress.txz[0], -0.1 * load[index] - extra[index], rtol=0.0, atol=1e-15
    )
    finer = stress_field(nodes, load, 0.0, (0.0, 2.0), np.zeros(1), 4, periodic=True)
    closed = np.interp(finer.x % 1.0, [*nodes, 1.0], [*load, load[0]])
    np.testing.assert_allclose(finer.stress.sz[0], -closed, rtol=0.0, atol=1e-14)


def test_largest_shear_of_a_wave():
    """tau1 = p0 kz e^(-kz) is largest at kz = 1, everywhere along x."""
    nodes = period(128, 1.0)
    load = 1.0 + np.cos(2.0 * np.pi * nodes)
    field = stress_field(nodes, load, 0.0, (0.2, 0.9), np.linspace(0.0, 0.4, 21), periodic=True)
    found = stress_maxima(nodes, load, 0.0, field, 0.3, periodic=True).tau1
    assert found.value == pytest.approx(np.exp(-1.0), rel=4e-4)
    assert found.z == pytest.approx(0.5 / np.pi, rel=1e-2)
