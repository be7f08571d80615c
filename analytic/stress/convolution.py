"""Convolution of loads on a line with one hat's stresses, level by level.

Of the potential I of one hat (`analytic.stress.potential`) Im I and z Re I' are even along the
surface, Re I and z Im I' odd. The transform of a real sequence that is even plus odd about 0 has
those of the two as real and imaginary part: two transforms a level give all four, two over i.

    S  grid points that the load spans      N  length of the circular convolution
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from analytic.numerics import for_each
from analytic.stress.elements import hat_at
from analytic.stress.potential import FAR_TERMS, NEAREST_FAR, hat_potential

_STARTS = [start for start, _ in FAR_TERMS]
_BLOCK = 2**15  # values of one kernel at a time, which stay in the cache


@dataclass(frozen=True)
class StressGrid:
    """Points at which stresses are wanted."""

    x: np.ndarray  # (m,) [m] columns
    z: np.ndarray  # (k,) [m] levels
    pitch: float  # of the nodes [m], divided into `subdivisions` steps
    subdivisions: int
    first: int  # column, counted in steps from the first node; every `stride`-th counts
    last: int
    stride: int


def convolve(source: np.ndarray, start: int, grid: StressGrid, parts: np.ndarray) -> None:
    """Fill `parts` (4, levels, columns), sx, sz, txz under p and sx under q, for a `source` (S,)
    [Pa], one a grid step, the first of them `start` steps from the node 0."""
    first, last = grid.first - start, grid.last - start
    reach = max(len(source) - 1 - first, last)  # no wrapped value reaches the points read
    fold = grid.stride & -grid.stride
    size = fold * next_fast_len(-(-(2 * reach + fold) // fold), real=True)
    place = max(0, -first)
    place += -(first + place) % fold
    points = slice((first + place) // fold, (last + place) // fold + 1, grid.stride // fold)
    placed = np.zeros(size)
    placed[place : place + len(source)] = source
    spectrum = rfft(placed) / fold
    turned = (spectrum, spectrum, 1j * spectrum, 1j * spectrum)
    halves = half_line(grid.z / grid.pitch, reach, grid.subdivisions)
    levels, step = parts.shape[1], max(1, _BLOCK // size)

    def fill(block: slice) -> None:
        for row, kernel in enumerate(mirrored_spectra(halves(block), size)):
            stress = irfft(_folded(kernel * turned[row], fold), size // fold, overwrite_x=True)
            parts[row, block] = stress[:, points]

    for_each(fill, (slice(i, min(i + step, levels)) for i in range(0, levels, step)))


def _folded(spectra: np.ndarray, fold: int) -> np.ndarray:
    """Times `fold`, 1 or even, the spectra of every such member of real sequences; from theirs."""
    if fold == 1:
        return spectra
    count, ring = len(spectra), 2 * (spectra.shape[1] - 1) // fold
    ways = spectra[:, :-1], spectra[:, :0:-1]  # up from no wave, and down from the shortest
    up, down = (way.reshape(count, -1, ring)[:, :, : ring // 2 + 1].sum(axis=1) for way in ways)
    return up + down.conj()


def half_line(depths: np.ndarray, reach: int, subdivisions: int) -> Callable[[slice], np.ndarray]:
    """Re I, Im I, z Re I', z Im I' (4, levels, reach + 1) of a unit hat, by levels."""
    x = np.arange(reach + 1) / subdivisions
    # Next to the element stand few points, with the slowest formulas: all such levels at once.
    shallow = int(np.searchsorted(depths, NEAREST_FAR))
    close = x[: NEAREST_FAR * subdivisions]
    unit = hat_at(*np.broadcast_arrays(close, depths[:shallow, None]))
    sx, sz, txz, sx_traction = unit.parts
    near = np.array([-0.5 * (sx_traction + txz), 0.5 * (sx + sz), 0.5 * (sx - sz), -txz])

    def halves(block: slice) -> np.ndarray:
        first, last, _ = block.indices(len(depths))
        kernel = np.empty((4, last - first, reach + 1))
        far = max(0, shallow - first)
        # A level that is deep itself is far from the element throughout.
        reached = [start for start, _ in FAR_TERMS if start <= depths[first]]
        for (start, terms), end in zip(FAR_TERMS, [*_STARTS[1:], np.inf], strict=True):
            if end in reached:
                continue
            low = 0 if start in reached else start * subdivisions
            run = slice(low, int(min(end * subdivisions, reach + 1)))
            if run.start < run.stop:
                hat_potential(x[run], depths[first:last], terms, kernel[:, :, run])
        if far:
            kernel[:, :far, : len(close)] = near[:, first:last]
            if first + far < last:
                rest = depths[first + far : last]
                terms = FAR_TERMS[0][1]
                hat_potential(close, rest, terms, kernel[:, far:, : len(close)])
        return kernel

    return halves


def mirrored_spectra(halves: np.ndarray, size: int) -> tuple[np.ndarray, ...]:
    """Spectra of a hat's stresses, those of txz under p and of sx under q over i, on a ring of
    `size` >= 2 reach. From Re I, Im I, z Re I', z Im I' (4, levels, reach + 1) on the right."""
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


def _mirror(even: np.ndarray, odd: np.ndarray, whole: np.ndarray) -> None:
    """Write their sum at the offsets 0 … and at -1, -2, …, which stand at the end."""
    reach = even.shape[1] - 1
    np.add(even, odd, out=whole[:, : reach + 1])
    np.subtract(even[:, :0:-1], odd[:, :0:-1], out=whole[:, whole.shape[1] - reach :])


def on_grid(load: np.ndarray, subdivisions: int) -> tuple[np.ndarray, int]:
    """A load (n,) with zeros between its nodes, from the first one loaded on, and its step."""
    loaded = np.flatnonzero(load)
    if len(loaded) == 0:
        return np.zeros(0), 0
    low, high = loaded[0], loaded[-1]
    source = np.zeros((high - low) * subdivisions + 1)
    source[::subdivisions] = load[low : high + 1]
    return source, low * subdivisions


def surface_load(source: np.ndarray, places: np.ndarray, subdivisions: int) -> np.ndarray:
    """The hats' own load at points of the grid [Pa]."""
    near = np.arange(-subdivisions, subdivisions + 1) / subdivisions
    if len(source) == 0:
        return np.zeros(len(places))
    spread = np.convolve(source, 1.0 - np.abs(near))
    place = places + subdivisions
    inside = (place >= 0) & (place < len(spread))
    return np.where(inside, spread[np.where(inside, place, 0)], 0.0)
