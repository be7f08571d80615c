"""Whole fields of stress under a line of pressure elements, layer by layer by convolution.

On a level z the stress is the convolution of the nodal pressures with one element's stress, so
a zero-padded real FFT sums all elements at all points of the level at once. The field may be
sampled finer than the nodes stand: the elements keep their pitch, the pressures are spaced out
with zeros between. Four kernels a level serve every friction coefficient and every load.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, rfft
from scipy.optimize import brentq

from analytic.plane_stress import PlaneStress
from analytic.stress_elements import FrictionStress
from analytic.stress_grid import check_element, uniform_pitch
from analytic.stress_kernels import Circle, circle
from analytic.stress_potential import Element
from analytic.stress_ring import ring
from analytic.threads import for_each

_BLOCK = 2**15  # values of one kernel at a time, which stay in the cache


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
    *,
    traction: np.ndarray | None = None,
    periodic: bool = False,
) -> StressField:
    """Stresses on the levels z (k,) [m], ascending from z >= 0, and on the grid within x_range.

    x_nodes (n,) [m] uniform and ascending, pressure (n,) [Pa] positive in compression. The
    traction in +x is friction * pressure + traction, with `traction` (n,) [Pa] nodal values of
    any sign. The grid contains the nodes' places and divides each pitch into `subdivisions`,
    within and beyond the nodes' extent. On z = 0, sz = -p and txz = -q exactly. Each level is
    right to rounding of its own largest stress.

    With `periodic` the nodes are one period of n pitches, repeated without end; what the mean
    pressure then does to sx is told in `stress_periodic`.

    Raises ValueError for input out of these bounds, for a window without a grid point, and for
    strips whose ends, where sx under q is infinite, fall on points of the surface.
    """
    loads = [pressure] if traction is None else [pressure, traction]
    x, z, stresses = _fields(x_nodes, loads, x_range, z, subdivisions, element, 1, periodic)
    stress = stresses[0].at(friction, *stresses[1:])
    return StressField(x, z, stress)


def friction_field(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int = 1,
    element: Element = "hat",
    stride: int = 1,
    *,
    periodic: bool = False,
) -> FrictionField:
    """`stress_field` for every friction at once; of the grid's points every `stride`-th is kept."""
    x, z, (stress,) = _fields(
        x_nodes, [pressure], x_range, z, subdivisions, element, stride, periodic
    )
    return FrictionField(x, z, stress)


def _fields(
    x_nodes: np.ndarray,
    loads: list[np.ndarray],
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int,
    element: Element,
    stride: int,
    periodic: bool,
) -> tuple[np.ndarray, np.ndarray, list[FrictionStress]]:
    """The places x and z, and the stresses of each load as a pressure."""
    for load in loads:
        pitch = uniform_pitch(x_nodes, load)
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
    parts = np.zeros((len(loads), 4, len(z), len(x)))
    sources, start = _on_grid(np.array(loads), subdivisions, whole=periodic)
    if sources.size:
        window = (sources.shape[1], first - start, last - start, stride)
        make = ring if periodic else circle
        _convolve(sources, make(z / pitch, *window, subdivisions, element), len(z), parts)
        if z[0] == 0.0:
            places = np.arange(first - start, last - start + 1, stride)
            for load, part in zip(sources, parts, strict=True):
                part[:2, 0] = -_surface_load(load, places, subdivisions, element, periodic)
    return x, z, [FrictionStress(PlaneStress(*part[:3]), part[3]) for part in parts]


def _on_grid(loads: np.ndarray, subdivisions: int, whole: bool) -> tuple[np.ndarray, int]:
    """Loads (k, n) with zeros between their nodes, from the first one loaded, and its step.

    Idle ends are left out, and all if nothing is loaded, unless the `whole` line is wanted.
    """
    loaded = np.flatnonzero(loads.any(axis=0))
    if len(loaded) == 0:
        return np.zeros((len(loads), 0)), 0
    low, high = (0, loads.shape[1]) if whole else (loaded[0], loaded[-1] + 1)
    count = (high - low) * subdivisions if whole else (high - 1 - low) * subdivisions + 1
    sources = np.zeros((len(loads), count))
    sources[:, ::subdivisions] = loads[:, low:high]
    return sources, low * subdivisions


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


def _convolve(sources: np.ndarray, round_line: Circle, levels: int, parts: np.ndarray) -> None:
    """Fill `parts` (loads, 4, levels, points): sx, sz, txz under p, sx under q, of each load.

    `sources` (loads, S) [Pa], a value a step of the grid.
    """
    placed = np.zeros((len(sources), round_line.length))
    placed[:, round_line.source : round_line.source + sources.shape[1]] = sources
    spectrum = rfft(placed)
    step = max(1, _BLOCK // round_line.length)

    def convolve(block: slice) -> None:
        for row, kernel in enumerate(round_line.spectra(block)):
            for load, values in enumerate(spectrum):
                stress = irfft(kernel * (round_line.turns[row] * values), round_line.length)
                parts[load, row, block] = stress[:, round_line.points]

    for_each(convolve, (slice(i, min(i + step, levels)) for i in range(0, levels, step)))


def _surface_load(
    source: np.ndarray, places: np.ndarray, subdivisions: int, element: Element, periodic: bool
) -> np.ndarray:
    """The elements' own load at places on the grid [Pa], a strip's end counting half to it."""
    near = np.arange(-subdivisions, subdivisions + 1) / subdivisions
    shape = 1.0 - np.abs(near) if element == "hat" else 0.5 + 0.5 * np.sign(0.5 - np.abs(near))
    if periodic:
        source = np.pad(source, subdivisions, mode="wrap")
        places = places % (len(source) - 2 * subdivisions) + subdivisions
    spread = np.convolve(source, shape)
    place = places + subdivisions
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
