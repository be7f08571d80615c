"""Stresses below a pressure that repeats: against its waves, and its limits."""

import numpy as np
import pytest

from analytic.grid import HatGrid
from analytic.stress.periodic import ImageStress, held_along
from analytic.stress.points import friction_stress_at

PERIOD, NU = 2.3e-3, 0.3


def below(grid: HatGrid, pressure: np.ndarray, x: np.ndarray, z: np.ndarray):
    near = friction_stress_at(grid.unfolded_x, grid.unfolded(pressure), x, z)
    return np.array(near.plus(ImageStress(grid, pressure).parts(x, z)).parts)


def by_waves(grid: HatGrid, pressure: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz under p and sx under q = p: each wave p cos qx falls like e^-qz (Johnson 1985,
    section 13.2). A hat passes a wave of order m by sinc^2(m/n)."""
    order = np.arange(1, 40 * grid.count)
    k = 2.0 * np.pi * order / PERIOD
    share = np.exp(-1j * np.outer(k, grid.x)) @ pressure / grid.count
    share = 2.0 * share * np.sinc(order / grid.count) ** 2
    wave = share[:, None] * np.exp(1j * np.outer(k, x) - np.outer(k, z))
    depth, mean = np.outer(k, z), pressure.mean()
    sx, sz = -((1.0 - depth) * wave).real, -((1.0 + depth) * wave).real
    sums = sx.sum(0) - mean, sz.sum(0) - mean
    return np.array(
        [*sums, (1j * depth * wave).real.sum(0), (1j * (2.0 - depth) * wave).real.sum(0)]
    )


@pytest.mark.parametrize(("count", "off"), [(16, 1e-7), (64, 4e-10)])
def test_every_wave_falls_as_it_must(count, off):
    """To the fourth power of the pitch: what hats are, as forces, on the farther periods."""
    random = np.random.default_rng(1)
    grid, pressure = HatGrid.around(PERIOD, count), random.random(count)
    x = PERIOD * np.append(random.uniform(-0.5, 0.5, 30), [-0.5, 0.5, 0.0])
    z = PERIOD * np.append(random.uniform(0.05, 1.5, 30), [0.2, 0.2, 6.0])
    error = np.abs(below(grid, pressure, x, z) - by_waves(grid, pressure, x, z)).max()
    assert 1e-4 * off < error < off
    both = below(grid, pressure, x[30:32], z[30:32])  # the two ends of a period are one point
    assert both[:, 0] == pytest.approx(both[:, 1], abs=off)


def test_no_strain_along_the_surface_far_below():
    """sx = nu/(1 - nu) sz there: e_x = ((1 - nu) sx - nu sz) (1 + nu)/E is 0."""
    mean = 2.0e9
    assert held_along(mean, NU) - mean == pytest.approx(-NU / (1.0 - NU) * mean, rel=1e-15)
    assert held_along(mean, 0.0) == mean
