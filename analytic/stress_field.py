"""Whole fields of stress under a line of pressure elements, layer by layer by convolution.

On a level z the stress is the convolution of the nodal pressures with one element's stress, so
a zero-padded real FFT sums all elements at all points of the level at once. The field may be
sampled finer than the nodes stand: the elements keep their pitch, the pressures are spaced out
with zeros between. Four kernels a level serve every friction coefficient.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.optimize import brentq

from analytic.plane_stress import PlaneStress
from analytic.stress import Element, check_element, uniform_pitch
from analytic.stress_elements import FrictionStress, hat_at, strip_between
from analytic.threads import for_each

_BLOCK = 2**15  # values of one kernel at a time


@dataclass(frozen=True)
class StressField:
    """Stresses [Pa] of shape (len(z), len(x)) on levels `z` (k,) and columns `x` (m,) [m]."""

    x: np.ndarray
    z: np.ndarray
    stress: PlaneStress


@dataclass(frozen=True)
class FrictionField:
    """A field for every friction: `stress.at(friction)` [Pa] of shape (len(z), len(x))."""

    x: np.ndarray
    z: np.ndarray
    stress: FrictionStress

    def at(self, friction: float) -> StressField:
        """The field under p and q = friction * p in +x."""
        return StressField(self.x, self.z, self.stress.at(friction))


def stress_field(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int = 1,
    element: Element = "hat",
) -> StressField:
    """Stresses on the levels z (k,) [m], ascending from z >= 0, and on the grid within x_range.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] positive in compression. The grid
    contains the nodes' places and divides each pitch into `subdivisions`, within and beyond the
    nodes' extent. On z = 0, sz = -p and txz = -friction p exactly.

    Raises ValueError for input out of these bounds, for a window without a grid point, and for
    strips whose ends, where sx under q is infinite, fall on points of the surface.
    """
    field = friction_field(x_nodes, pressure, x_range, z, subdivisions, element)
    return field.at(friction)


def friction_field(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int = 1,
    element: Element = "hat",
    stride: int = 1,
) -> FrictionField:
    """`stress_field` for every friction at once; of the grid's points every `stride`-th is kept."""
    pitch = uniform_pitch(x_nodes, pressure)
    check_element(element)
    z = np.asarray(z, dtype=float)
    _check_levels(z)
    for name, number in (("subdivisions", subdivisions), ("stride", stride)):
        if number < 1 or number != int(number):
            raise ValueError(f"{name} must be a whole number from 1, not {number}")
    if element == "strip" and z[0] == 0.0 and subdivisions % 2 == 0:
        raise ValueError(
            "uniform strips have no finite sx at their ends on the surface: take z > 0, "
            "an odd number of subdivisions, or hats"
        )
    first, last = _window(x_range, x_nodes[0], pitch / subdivisions)
    x = x_nodes[0] + np.arange(first, last + 1, stride) * (pitch / subdivisions)
    parts = np.zeros((4, len(z), len(x)))
    loaded = np.flatnonzero(pressure)
    if len(loaded):
        source = np.zeros((loaded[-1] - loaded[0]) * subdivisions + 1)
        source[::subdivisions] = pressure[loaded[0] : loaded[-1] + 1]
        first -= loaded[0] * subdivisions
        last -= loaded[0] * subdivisions
        offsets = np.arange(first - len(source) + 1, last + 1)
        _convolve(source, offsets, z / pitch, subdivisions, element, stride, parts)
        if z[0] == 0.0:
            surface = _surface_pressure(source, offsets, subdivisions, element)
            parts[:2, 0] = -surface[::stride]
    return FrictionField(x, z, FrictionStress(PlaneStress(*parts[:3]), parts[3]))


def graded_depths(depth: float, count: int, first: float) -> np.ndarray:
    """`count` levels from 0 to `depth` [m], the first at `first` [m], growing by a fixed ratio.

    Raises ValueError where equal steps already exceed `depth`: 0 < first <= depth/(count - 1).
    """
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


def _convolve(
    source: np.ndarray,
    offsets: np.ndarray,
    depths: np.ndarray,
    subdivisions: int,
    element: Element,
    stride: int,
    parts: np.ndarray,
) -> None:
    """Fill `parts` (4, levels, points): sx, sz, txz under p, sx under q.

    `offsets` from the first source to the last point, in grid steps; `depths` in pitches.
    The kernel has just these offsets, so of the circular convolution only values that no
    wrapped one reaches are taken.
    """
    size = next_fast_len(len(offsets), real=True)
    spectrum = rfft(source, size)
    points = slice(len(source) - 1, len(offsets), stride)
    levels = max(1, _BLOCK // size)

    def convolve(block: slice) -> None:
        for row, kernel in enumerate(_kernels(offsets, depths[block], subdivisions, element)):
            convolution = irfft(rfft(kernel, size) * spectrum, size)
            parts[row, block] = convolution[:, points]

    for_each(convolve, (slice(i, i + levels) for i in range(0, len(depths), levels)))


def _kernels(
    offsets: np.ndarray, depths: np.ndarray, subdivisions: int, element: Element
) -> list[np.ndarray]:
    """The element's four unit stresses (levels, offsets), each offset's distance taken once."""
    distance = np.abs(offsets)
    nearest = int(distance.min())
    x = np.arange(nearest, int(distance.max()) + 1) / subdivisions
    x, z = np.broadcast_arrays(x, depths[:, None])
    unit = hat_at(x, z) if element == "hat" else strip_between(x + 0.5, x, x - 0.5, z)
    place, side = distance - nearest, np.sign(offsets)
    even, odd = (unit.normal.sx, unit.normal.sz), (unit.normal.txz, unit.traction_sx)
    return [part[:, place] for part in even] + [part[:, place] * side for part in odd]


def _surface_pressure(
    source: np.ndarray, offsets: np.ndarray, subdivisions: int, element: Element
) -> np.ndarray:
    """The elements' own pressure at the points [Pa], a strip's end counting half to it."""
    near = np.arange(-subdivisions, subdivisions + 1) / subdivisions
    shape = 1.0 - np.abs(near) if element == "hat" else 0.5 + 0.5 * np.sign(0.5 - np.abs(near))
    spread = np.convolve(source, shape)
    place = offsets[len(source) - 1 :] + subdivisions
    inside = (place >= 0) & (place < len(spread))
    return np.where(inside, spread[np.where(inside, place, 0)], 0.0)


def _window(x_range: tuple[float, float], origin: float, step: float) -> tuple[int, int]:
    """First and last step of the grid from `origin` within `x_range`, ends included."""
    low, high = ((bound - origin) / step for bound in x_range)
    first, last = int(np.ceil(low - 1e-6)), int(np.floor(high + 1e-6))
    if last < first:
        raise ValueError(
            f"no point of the grid of {step:g} m lies between {x_range[0]:g} and {x_range[1]:g} m"
        )
    return first, last


def _check_levels(z: np.ndarray) -> None:
    if z.ndim != 1 or len(z) == 0 or not np.all(np.isfinite(z)):
        raise ValueError("z must be one-dimensional, finite and not empty")
    if z[0] < 0.0 or np.any(np.diff(z) <= 0.0):
        raise ValueError("z must ascend strictly from z >= 0, into the body")
