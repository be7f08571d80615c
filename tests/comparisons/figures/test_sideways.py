"""A movement that is known is found, and what no movement explains is left."""

import numpy as np
import pytest

from analytic.grid import HatGrid
from comparisons.figures.sideways import relative_l2, sideways_shift

GRID = HatGrid(1e-7, -1500, 1400)
PLACES = np.random.default_rng(5).uniform(-100e-6, 100e-6, 25)  # of asperities [m]
WIDTH = 1.2e-6  # of their contacts [m], half


def asperities(places: np.ndarray, width: float = WIDTH) -> np.ndarray:
    """Elliptic pressures (n,) [Pa] on the grid, the highest of them in the middle."""
    over_width = (GRID.x[:, None] - places) / width
    return (1e9 - 3e12 * np.abs(places)) @ np.sqrt(np.maximum(1.0 - over_width.T**2, 0.0).T).T


@pytest.mark.parametrize("shift", [0.0, 0.31e-6, -2.77e-6])
@pytest.mark.parametrize("stretch", [0.0, 0.004, -0.021])
def test_a_known_movement_is_found(shift: float, stretch: float):
    pressure, moved = asperities(PLACES), asperities(PLACES + shift + stretch * PLACES)
    fit = sideways_shift(GRID, pressure, moved)
    assert fit.shift == pytest.approx(shift, abs=0.02e-6)
    assert fit.stretch == pytest.approx(stretch, abs=2e-4)
    # by the loads of the asperities, as their pressures are made
    mean = np.average(np.abs(shift + stretch * PLACES), weights=1e9 - 3e12 * np.abs(PLACES))
    assert fit.mean == pytest.approx(mean, abs=0.02e-6)
    assert fit.left < 0.05
    if abs(shift) > WIDTH:
        assert relative_l2(pressure, moved) > 1.0


def test_what_differs_in_height_is_left():
    pressure, higher = asperities(PLACES), 1.25 * asperities(PLACES)
    fit = sideways_shift(GRID, pressure, higher)
    assert fit.left == pytest.approx(0.2, abs=1e-3)
    assert abs(fit.shift) < 1e-9 and abs(fit.stretch) < 1e-4


def test_equal_pressures_are_not_moved():
    fit = sideways_shift(GRID, asperities(PLACES), asperities(PLACES))
    assert fit.left == 0.0 and fit.mean < 1e-12
