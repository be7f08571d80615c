"""Convolution of loads on a line with the elements' kernels, level by level."""

import numpy as np
from scipy.fft import irfft, rfft

from analytic.stress.kernels import Circle
from analytic.stress.potential import Element
from analytic.threads import for_each

_BLOCK = 2**15  # values of one kernel at a time, which stay in the cache

# For each stress wanted, kernels, the number of the load that each acts on and its factor, added.
Products = tuple[tuple[tuple[int, int, float], ...], ...]
_SX, _SZ, _TXZ, _SX_TRACTION = range(4)
# sx, sz, txz under the first load as p, and sx under it as q
EACH: Products = tuple(((kernel, 0, 1.0),) for kernel in (_SX, _SZ, _TXZ, _SX_TRACTION))
_UNDER_BOTH = ((_SX, _SX_TRACTION), (_SZ, _TXZ), (_TXZ, _SX))


def mixed(load: int, factor: float) -> Products:
    """sx, sz, txz under the first load as p and `factor` times the one numbered `load` as q."""
    return tuple(((under_p, 0, 1.0), (under_q, load, factor)) for under_p, under_q in _UNDER_BOTH)


def convolve(sources: np.ndarray, closed: Circle, products: Products, parts: np.ndarray) -> None:
    """Fill `parts` (products, levels, points) under `sources` (loads, S) [Pa], one a grid step."""
    placed = np.zeros((len(sources), closed.length))
    placed[:, closed.source : closed.source + sources.shape[1]] = sources
    spectra = rfft(placed)
    levels = parts.shape[1]
    step = max(1, _BLOCK // closed.length)

    def fill(block: slice) -> None:
        kernels = closed.spectra(block)
        for row, sum_of in enumerate(products):
            total = None
            for load, spectrum in enumerate(spectra):
                acting = [(kernel, factor) for kernel, at, factor in sum_of if at == load]
                if acting:
                    product = _added(kernels, closed.turns, acting)
                    product *= spectrum
                    total = product if total is None else np.add(total, product, out=total)
            stress = irfft(total, closed.length, overwrite_x=True)
            parts[row, block] = stress[:, closed.points]

    for_each(fill, (slice(i, min(i + step, levels)) for i in range(0, levels, step)))


def _added(
    kernels: tuple[np.ndarray, ...],
    turns: tuple[complex, ...],
    acting: list[tuple[int, float]],
) -> np.ndarray:
    """Sum of factor times turn times kernel over `acting`; real kernels fill the two parts."""
    if any(np.iscomplexobj(kernels[kernel]) for kernel, _ in acting):
        return sum(kernels[kernel] * (factor * turns[kernel]) for kernel, factor in acting)
    total = np.empty(kernels[0].shape, dtype=complex)
    for turn, part in ((1.0, total.real), (1j, total.imag)):
        here = [(kernels[kernel], factor) for kernel, factor in acting if turns[kernel] == turn]
        if not here:
            part[...] = 0.0
        for order, (kernel, factor) in enumerate(here):
            if order:
                part += factor * kernel
            else:
                np.multiply(kernel, factor, out=part)
    return total


def on_grid(loads: np.ndarray, subdivisions: int, whole: bool) -> tuple[np.ndarray, int]:
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


def surface_load(
    source: np.ndarray, places: np.ndarray, subdivisions: int, element: Element, periodic: bool
) -> np.ndarray:
    """The elements' own load at places on the grid [Pa], a strip's end counting half to it."""
    near = np.arange(-subdivisions, subdivisions + 1) / subdivisions
    shape = 1.0 - np.abs(near) if element == "hat" else 0.5 + 0.5 * np.sign(0.5 - np.abs(near))
    if periodic:
        source = np.pad(source, subdivisions, mode="wrap")
        places = places % (len(source) - 2 * subdivisions) + subdivisions
    if len(source) == 0:
        return np.zeros(len(places))
    spread = np.convolve(source, shape)
    place = places + subdivisions
    inside = (place >= 0) & (place < len(spread))
    return np.where(inside, spread[np.where(inside, place, 0)], 0.0)
