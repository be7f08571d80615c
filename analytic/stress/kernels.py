"""One element's stresses on the offsets of a grid, transformed for a convolution level by level.

Of the potential I of one element (`stress_potential`) Im I and z Re I' are even along the surface,
Re I and z Im I' odd. A real sequence that is even plus odd about 0 has the even part's transform as
its real part and the odd one's as its imaginary part: two transforms a level give the spectra of
all four stresses. On a window beside the load, where nothing is even or odd, each stress is
transformed by itself from values that hold their own digits.

    S  grid points that the load spans      N  length of the circular convolution
    offset  of a point from a source [grid steps], `first - S + 1` to `last`
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.fft import next_fast_len, rfft

from analytic.stress.elements import FrictionStress, hat_at, strip_between
from analytic.stress.potential import FAR_TERMS, NEAREST_FAR, Element, element_potential

# Of sx, sz, txz under p and of sx under q on a run of the levels, each (levels, N/2 + 1), for
# `turns` of the load's spectrum
Spectra = Callable[[slice], tuple[np.ndarray, ...]]
MIRRORED = (1.0, 1.0, 1j, 1j)
_STARTS = [start for start, _ in FAR_TERMS]


@dataclass(frozen=True)
class Circle:
    """A circular convolution that no wrapped value reaches where it is read.

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


def circle(
    depths: np.ndarray,
    sources: int,
    first: int,
    last: int,
    stride: int,
    subdivisions: int,
    element: Element,
) -> Circle:
    """For `sources` = S and every `stride`-th point from `first` to `last`.

    Points are counted in grid steps from the first source; `depths` of the levels in pitches.
    """
    low, high = first - sources + 1, last
    if low <= 0 <= high:
        reach = max(-low, high)
        size = next_fast_len(2 * reach + 1, real=True)
        start = max(0, -first)
        points = slice(first + start, last + start + 1, stride)
        halves = half_line(depths, reach, subdivisions, element)

        def around(block: slice) -> tuple[np.ndarray, ...]:
            return mirrored_spectra(halves(block), size)

        return Circle(size, start, points, around, MIRRORED)
    offsets = np.arange(low, high + 1) / subdivisions
    size = next_fast_len(len(offsets), real=True)

    def beside(block: slice) -> tuple[np.ndarray, ...]:
        unit = unit_stress(*np.broadcast_arrays(offsets, depths[block, None]), element)
        normal = unit.normal
        kernels = (normal.sx, normal.sz, normal.txz, unit.traction_sx)
        return tuple(rfft(kernel, size) for kernel in kernels)

    return Circle(size, 0, slice(sources - 1, len(offsets), stride), beside)


def unit_stress(x: np.ndarray, z: np.ndarray, element: Element) -> FrictionStress:
    """Of a unit element at 0, by x and z in pitches."""
    return hat_at(x, z) if element == "hat" else strip_between(x + 0.5, x, x - 0.5, z)


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
    """Spectra, for the turns MIRRORED, of an element on a circle of `size` >= 2 reach points.

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
    normal = unit.normal
    return np.array(
        [
            -0.5 * (unit.traction_sx + normal.txz),
            0.5 * (normal.sx + normal.sz),
            0.5 * (normal.sx - normal.sz),
            -normal.txz,
        ]
    )


def _mirror(even: np.ndarray, odd: np.ndarray, whole: np.ndarray) -> None:
    """Write their sum at the offsets 0 … and at -1, -2, …, which stand at the circle's end."""
    reach = even.shape[1] - 1
    np.add(even, odd, out=whole[:, : reach + 1])
    np.subtract(even[:, :0:-1], odd[:, :0:-1], out=whole[:, whole.shape[1] - reach :])
