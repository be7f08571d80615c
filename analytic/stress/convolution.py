"""Convolution of loads on a line with one element's stresses, level by level.

Of the potential I of one element (`analytic.stress.potential`) Im I and z Re I' are even along the
surface, Re I and z Im I' odd. The transform of a real sequence that is even plus odd about 0 has
those of the two as real and imaginary part: two transforms a level give the spectra of all four
stresses. On a window beside the load each stress is transformed by itself and keeps its own digits.

    S  grid points that the load spans      N  length of the circular convolution
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from analytic.numerics import for_each
from analytic.stress.elements import FrictionStress, unit_stress
from analytic.stress.potential import FAR_TERMS, NEAREST_FAR, Element, element_potential

# Of sx, sz, txz under p and of sx under q on a run of the levels, each (levels, N/2 + 1), for
# `turns` of the load's spectrum
Spectra = Callable[[slice], tuple[np.ndarray, ...]]
MIRRORED = (1.0, 1.0, 1j, 1j)
_STARTS = [start for start, _ in FAR_TERMS]


@dataclass(frozen=True)
class CircularConvolution:
    """A circular convolution, long enough that no wrapped value reaches the points read.

    length   N
    source   where the first source stands
    points   the values wanted
    spectra  of the element's stresses
    turns    factors of the load's spectrum: i where a purely imaginary one is given as a real one
    """

    length: int
    source: int
    points: slice | np.ndarray
    spectra: Spectra
    turns: tuple[complex, complex, complex, complex] = (1.0, 1.0, 1.0, 1.0)


@dataclass(frozen=True)
class StressGrid:
    """Where stresses are wanted, and under which element.

    x, z          columns (m,) and levels (k,) [m]
    pitch         of the nodes [m], divided into `subdivisions` steps
    first, last   columns, counted in steps from the first node; every `stride`-th counts
    """

    x: np.ndarray
    z: np.ndarray
    pitch: float
    subdivisions: int
    first: int
    last: int
    stride: int
    element: Element


def free_convolution(grid: StressGrid, sources: int, start: int) -> CircularConvolution:
    """For a line of `sources` = S grid points, the first of them `start` steps from the node 0."""
    depths, subdivisions, stride = grid.z / grid.pitch, grid.subdivisions, grid.stride
    first, last, element = grid.first - start, grid.last - start, grid.element
    low, high = first - sources + 1, last
    if low <= 0 <= high:
        reach = max(-low, high)
        size = next_fast_len(2 * reach + 1, real=True)
        source = max(0, -first)
        points = slice(first + source, last + source + 1, stride)
        halves = half_line(depths, reach, subdivisions, element)

        def around(block: slice) -> tuple[np.ndarray, ...]:
            return mirrored_spectra(halves(block), size)

        return CircularConvolution(size, source, points, around, MIRRORED)
    offsets = np.arange(low, high + 1) / subdivisions
    size = next_fast_len(len(offsets), real=True)

    def beside(block: slice) -> tuple[np.ndarray, ...]:
        unit = unit_stress(*np.broadcast_arrays(offsets, depths[block, None]), element)
        return tuple(rfft(kernel, size) for kernel in unit.parts)

    return CircularConvolution(size, 0, slice(sources - 1, len(offsets), stride), beside)


def half_line(
    depths: np.ndarray, reach: int, subdivisions: int, element: Element
) -> Callable[[slice], np.ndarray]:
    """Re I, Im I, z Re I', z Im I' of a unit element at the offsets 0 … reach, by levels.

    (4, levels, reach + 1).
    """
    x = np.arange(reach + 1) / subdivisions
    # Next to the element stand few points, with the slowest formulas: all such levels at once.
    shallow = int(np.searchsorted(depths, NEAREST_FAR))
    close = x[: NEAREST_FAR * subdivisions]
    near = as_potential(unit_stress(*np.broadcast_arrays(close, depths[:shallow, None]), element))

    def halves(block: slice) -> np.ndarray:
        first, last, _ = block.indices(len(depths))
        found = np.empty((4, last - first, reach + 1))
        far = max(0, shallow - first)
        # A level that is deep itself is far from the element throughout.
        reached = [start for start, _ in FAR_TERMS if start <= depths[first]]
        for (start, terms), end in zip(FAR_TERMS, [*_STARTS[1:], np.inf], strict=True):
            if end in reached:
                continue
            low = 0 if start in reached else start * subdivisions
            run = slice(low, int(min(end * subdivisions, reach + 1)))
            if run.start < run.stop:
                element_potential(x[run], depths[first:last], element, terms, found[:, :, run])
        if far:
            found[:, :far, : len(close)] = near[:, first:last]
            if first + far < last:
                rest = depths[first + far : last]
                terms = FAR_TERMS[0][1]
                element_potential(close, rest, element, terms, found[:, far:, : len(close)])
        return found

    return halves


def mirrored_spectra(halves: np.ndarray, size: int) -> tuple[np.ndarray, ...]:
    """Spectra, for the turns MIRRORED, of an element on a closed line of `size` >= 2 reach points.

    From Re I, Im I, z Re I', z Im I' (4, levels, reach + 1) on its right.
    """
    _, levels, count = halves.shape
    whole = np.empty((2, levels, size))
    whole[:, :, count : size - count + 1] = 0.0
    _mirror(halves[1], halves[0], whole[0])
    _mirror(halves[2], halves[3], whole[1])
    upper, lower = rfft(whole)
    return (
        upper.real + lower.real,
        upper.real - lower.real,
        -lower.imag,
        lower.imag - 2.0 * upper.imag,
    )


def as_potential(unit: FrictionStress) -> np.ndarray:
    """Re I, Im I, z Re I', z Im I' (4, …) of these stresses."""
    sx, sz, txz, sx_traction = unit.parts
    return np.array([-0.5 * (sx_traction + txz), 0.5 * (sx + sz), 0.5 * (sx - sz), -txz])


def _mirror(even: np.ndarray, odd: np.ndarray, whole: np.ndarray) -> None:
    """Write their sum at the offsets 0 … and at -1, -2, …, which stand at the end."""
    reach = even.shape[1] - 1
    np.add(even, odd, out=whole[:, : reach + 1])
    np.subtract(even[:, :0:-1], odd[:, :0:-1], out=whole[:, whole.shape[1] - reach :])


_BLOCK = 2**15  # values of one kernel at a time, which stay in the cache


def convolve(source: np.ndarray, circular: CircularConvolution, parts: np.ndarray) -> None:
    """Fill `parts` (4, levels, points), sx, sz, txz under p and sx under q, for a `source` (S,)
    [Pa], one a grid step."""
    placed = np.zeros(circular.length)
    placed[circular.source : circular.source + len(source)] = source
    spectrum = rfft(placed)
    turned = [spectrum if turn == 1.0 else turn * spectrum for turn in circular.turns]
    levels = parts.shape[1]
    step = max(1, _BLOCK // circular.length)

    def fill(block: slice) -> None:
        for row, kernel in enumerate(circular.spectra(block)):
            stress = irfft(kernel * turned[row], circular.length, overwrite_x=True)
            parts[row, block] = stress[:, circular.points]

    for_each(fill, (slice(i, min(i + step, levels)) for i in range(0, levels, step)))


def on_grid(load: np.ndarray, subdivisions: int) -> tuple[np.ndarray, int]:
    """A load (n,) with zeros between its nodes, from the first one loaded to the last, and the
    step of the first."""
    loaded = np.flatnonzero(load)
    if len(loaded) == 0:
        return np.zeros(0), 0
    low, high = loaded[0], loaded[-1]
    source = np.zeros((high - low) * subdivisions + 1)
    source[::subdivisions] = load[low : high + 1]
    return source, low * subdivisions


def surface_load(
    source: np.ndarray, places: np.ndarray, subdivisions: int, element: Element
) -> np.ndarray:
    """The elements' own load at places on the grid [Pa], a strip's end counting half to it."""
    near = np.arange(-subdivisions, subdivisions + 1) / subdivisions
    shape = 1.0 - np.abs(near) if element == "hat" else 0.5 + 0.5 * np.sign(0.5 - np.abs(near))
    if len(source) == 0:
        return np.zeros(len(places))
    spread = np.convolve(source, shape)
    place = places + subdivisions
    inside = (place >= 0) & (place < len(spread))
    return np.where(inside, spread[np.where(inside, place, 0)], 0.0)
