"""Whole fields of stress under a line of pressure elements, layer by layer by convolution.

On a level z the stress is the convolution of the nodal pressures with one element's stress, so
a zero-padded real FFT sums all elements at all points of the level at once. Where the field is
finer than the nodes, the pressures are spaced out with zeros between.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from analytic.stress.convolution import StressGrid, convolve, on_grid, surface_load
from analytic.stress.elements import FrictionStress, uniform_pitch
from analytic.stress_state import StressState


@dataclass(frozen=True)
class StressField:
    """Stresses [Pa] of shape (len(z), len(x)) on levels `z` (k,) and columns `x` (m,) [m]."""

    x: np.ndarray
    z: np.ndarray
    stress: StressState


@dataclass(frozen=True)
class FrictionField:
    """A field for every friction: `stress.at(friction)` [Pa] of shape (len(z), len(x))."""

    x: np.ndarray
    z: np.ndarray
    stress: FrictionStress

    def at(self, friction: float) -> StressField:
        """The field under p and q = friction * p in +x."""
        return StressField(self.x, self.z, self.stress.at(friction))


def friction_field(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int = 1,
    stride: int = 1,
) -> FrictionField:
    """Stresses on the levels z (k,) [m], ascending from z >= 0, and on the grid within x_range.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] positive in compression. The grid
    contains the nodes and divides each pitch into `subdivisions`, within and beyond the
    nodes' extent; every `stride`-th of its points counts. On z = 0, sz = -p and txz = -q exactly.
    Each level is right to rounding of the largest stress at its depth.

    Raises ValueError for input out of these bounds, and for a window without a grid point.
    """
    load = np.array(pressure, dtype=float)
    grid = _grid(x_nodes, load, x_range, z, subdivisions, stride)
    parts = np.zeros((4, len(grid.z), len(grid.x)))
    source, start = on_grid(load, grid.subdivisions)
    if source.size:
        convolve(source, start, grid, parts)
    if grid.z[0] == 0.0:
        places = np.arange(grid.first - start, grid.last - start + 1, grid.stride)
        parts[:2, 0] = -surface_load(source, places, grid.subdivisions)
    return FrictionField(grid.x, grid.z, FrictionStress.of(parts))


def _grid(
    x_nodes: np.ndarray,
    load: np.ndarray,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int,
    stride: int,
) -> StressGrid:
    pitch = uniform_pitch(x_nodes, load)
    z = np.asarray(z, dtype=float)
    if z.ndim != 1 or len(z) == 0 or not np.all(np.isfinite(z)):
        raise ValueError("z must be one-dimensional, finite and not empty")
    if z[0] < 0.0 or np.any(np.diff(z) <= 0.0):
        raise ValueError("z must ascend strictly from z >= 0, into the body")
    for name, number in (("subdivisions", subdivisions), ("stride", stride)):
        if number < 1 or number != int(number):
            raise ValueError(f"{name} must be a whole number from 1, not {number}")
    step = pitch / subdivisions
    low, high = ((bound - x_nodes[0]) / step for bound in x_range)
    first, last = int(np.ceil(low - 1e-6)), int(np.floor(high + 1e-6))
    if last < first:
        raise ValueError(
            f"no point of the grid of {step:g} m lies between {x_range[0]:g} and {x_range[1]:g} m"
        )
    x = x_nodes[0] + np.arange(first, last + 1, stride) * step
    return StressGrid(x, z, pitch, subdivisions, first, last, stride)


def graded_depths(depth: float, count: int, first: float) -> np.ndarray:
    """`count` levels from 0 to `depth` [m], the first at `first` [m], growing by a fixed ratio.
    Raises ValueError where equal steps already exceed `depth`: 0 < first <= depth/(count - 1)."""
    intervals = count - 1
    if count < 3:
        raise ValueError(f"count must be at least 3, not {count}")
    if not 0.0 < first * intervals <= depth * (1.0 + 1e-12):
        raise ValueError(
            f"first must be above 0 and at most {depth / intervals:g} m, not {first:g} m"
        )
    order = np.arange(intervals)

    def excess(log_ratio: float) -> float:
        return np.log(first / depth * np.sum(np.exp(log_ratio * order)))

    # The last step alone may not exceed the depth, which bounds the ratio.
    bound = np.log(depth / first) / (intervals - 1)
    log_ratio = brentq(excess, 0.0, bound, xtol=1e-15) if excess(0.0) < 0.0 else 0.0
    levels = np.concatenate([[0.0], np.cumsum(np.exp(log_ratio * order))])
    return depth * levels / levels[-1]
