"""Stresses under a line of elements that repeats itself without end: at points, and as a kernel.

Near the surface the three periods about a point are summed as a free line is; all others reach it
in one inner expansion, whose lattice sums are values of Riemann's zeta function. A quarter of a
period down a few waves of the load are all that is left of it:

    I = -i [P_0 + 2 sum_{k>0} P_k e^(i k w)],   P_k the load's Fourier coefficients, k in 2 pi / L,

so a pressure p0 cos kx gives sx, sz = -p0 (1 -+ kz) e^(-kz) cos kx, txz = -p0 kz e^(-kz) sin kx
(Westergaard 1939; Johnson 1985, section 13.2).

Kernels of a field, one period long. From one step of the grid downwards the spectrum is known: with
f waves a period, and their aliases f + a N on a grid of N points, each wave of the element brings

    sx, sz, txz = (kz - 1, -kz - 1, i kz) e^(-kz)      sx under q = i (2 - kz) e^(-kz)

times its shape factor, k > 0; those of -k are the conjugates. Closer to the surface, where aliases
fade slowly, the kernel comes from the element, its two next images and the inner expansion.

The mean leaves sx open: any uniform sx keeps the surface free. Here it is the sum over the images,
from the middle outwards: the mean pressure makes sx = sz = -P_0, a mean traction txz = -Q_0 and no
sx. Add to sx (1 - nu/(1 - nu)) P_0 where the body may not widen, P_0 where it is free to.

Nomenclature: L period [m], R = L/2, u = (w - middle)/R.
"""

import numpy as np
from scipy.special import comb, zetac

from analytic.stress.convolution import (
    MIRRORED,
    CircularConvolution,
    StressGrid,
    half_line,
    mirrored_spectra,
)
from analytic.stress.potential import (
    ORDER,
    Element,
    element_moments,
    far_moments,
    polynomial,
    stresses,
)
from analytic.stress.tree import LoadedLine, line_stress

DEEP = 0.25  # periods: below, the waves alone
_WAVES = 25  # exp(-2 pi 0.25 * 25) is 1e-17


def periodic_stress(line: LoadedLine, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """`line_stress` of a line that is one period of n pitches."""
    nodes, load, pitch, element = line.nodes, line.load, line.pitch, line.element
    period = len(nodes) * pitch
    middle = 0.5 * (nodes[0] + nodes[-1])
    x = x - period * np.round((x - middle) / period)
    parts = np.empty((4, len(x)))
    deep = z > DEEP * period
    if deep.any():
        w = x[deep] - nodes[0] + 1j * z[deep]
        parts[:, deep] = _waves(load, 2.0 * np.pi / period, w, element)
    shallow = ~deep
    if shallow.any():
        x, z = x[shallow], z[shallow]
        three = np.concatenate([nodes - period, nodes, nodes + period])
        parts[:, shallow] = line_stress(LoadedLine(three, np.tile(load, 3), pitch, element), x, z)
        half = 0.5 * period
        outer = far_moments(nodes - middle, load, pitch, half, element)[:ORDER]
        u = (x - middle) / half + 1j * (z / half)
        parts[:, shallow] += stresses(*images(outer, u)) / np.pi
    return parts


def images(outer: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """pi I and pi z I' of all periods but the three about u, from the moments over R^k of one."""
    inner = _lattice() @ np.pad(outer, (0, ORDER - len(outer)))
    value, slope = polynomial(inner[::-1], u)
    return value, slope * u.imag


def shape_factor(waves: np.ndarray, element: Element) -> np.ndarray:
    """Fourier transform of an element over its area, by waves per pitch."""
    return np.sinc(waves) ** (2 if element == "hat" else 1)


def _lattice() -> np.ndarray:
    """Outer coefficients to inner ones, summed over boxes at every distance of two and more.

    Odd powers of the distance cancel between left and right; the even ones sum to zeta.
    """
    order = np.arange(ORDER)
    total = order[:, None] + order
    power = total + 1
    even = power % 2 == 0
    sums = np.where(even, 2.0 * zetac(np.where(even, power, 2)) * 0.5**power, 0.0)
    return (-1.0) ** (order + 1) * comb(total, order) * sums


def _waves(load: np.ndarray, number: float, w: np.ndarray, element: Element) -> np.ndarray:
    """The stresses from the first waves of the load; `number` 2 pi / L, w from the first node."""
    order = np.arange(_WAVES)
    spectrum = np.fft.fft(load)[order % len(load)] / len(load)
    spectrum *= shape_factor(order / len(load), element)
    factor = -2.0j * spectrum
    factor[0] *= 0.5
    base = np.exp(1j * number * w)
    value, slope = np.zeros_like(w), np.zeros_like(w)
    for k in order[::-1]:
        value *= base
        value += factor[k]
        slope *= base
        slope += 1j * number * k * factor[k]
    return stresses(value, w.imag * slope)


_FADED = 44.0  # e^-44 (1 + 44) is 4e-18
_SHALLOW = 1.0  # grid steps: levels above are summed over images


def periodic_convolution(grid: StressGrid, sources: int, start: int) -> CircularConvolution:
    """`free_convolution` for `sources` grid points that are one period."""
    depths, subdivisions, element = grid.z / grid.pitch, grid.subdivisions, grid.element
    shallow = int(np.searchsorted(depths, _SHALLOW / subdivisions))

    def spectra(block: slice) -> tuple[np.ndarray, ...]:
        middle = min(max(shallow, block.start), block.stop)
        kernels = (
            (_by_images, depths[block.start : middle]),
            (_by_waves, depths[middle : block.stop]),
        )
        parts = [make(z, sources, subdivisions, element) for make, z in kernels if len(z)]
        return tuple(np.concatenate(rows) for rows in zip(*parts, strict=True))

    points = np.arange(grid.first - start, grid.last - start + 1, grid.stride) % sources
    return CircularConvolution(sources, 0, points, spectra, MIRRORED)


def _by_waves(
    depths: np.ndarray, size: int, subdivisions: int, element: Element
) -> tuple[np.ndarray, ...]:
    """From the spectrum of the element on depths of a grid step and more."""
    spectra = np.zeros((4, len(depths), size // 2 + 1))
    base = np.arange(size // 2 + 1)
    aliases = int(_FADED / (2.0 * np.pi * depths[0] * subdivisions)) + 1
    for alias in range(-aliases, aliases + 1):
        waves = (base + alias * size) * (subdivisions / size)
        decay = 2.0 * np.pi * np.abs(waves) * depths[:, None]
        amount = np.exp(-decay) * (subdivisions * shape_factor(waves, element))
        slope = decay * amount
        side = np.sign(waves)
        spectra[0] += slope - amount
        spectra[1] -= slope + amount
        spectra[2] += side * slope
        spectra[3] += side * (2.0 * amount - slope)
    return tuple(spectra)


def _by_images(
    depths: np.ndarray, size: int, subdivisions: int, element: Element
) -> tuple[np.ndarray, ...]:
    """From the element, the images next to it and the expansion of the others."""
    reach = size // 2
    alone = half_line(depths, size + reach, subdivisions, element)(slice(None))
    here, right = alone[:, :, : reach + 1], alone[:, :, size:]
    # The image at +L stands `size - offset` to the right: Re I and Im I' are odd.
    left = alone[:, :, size - reach : size + 1][:, :, ::-1]
    left = left * np.array([-1.0, 1.0, 1.0, -1.0])[:, None, None]
    half = 0.5 * size / subdivisions
    outer = element_moments(element, ORDER) * half ** -np.arange(ORDER, dtype=float)
    u = (np.arange(reach + 1) / subdivisions + 1j * depths[:, None]) / half
    potential, derivative = np.array(images(outer, u)) / (np.pi * half)
    rest = np.array([potential.real, potential.imag, derivative.real, derivative.imag])
    return mirrored_spectra(here + right + left + rest, size)
