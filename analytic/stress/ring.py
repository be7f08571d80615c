"""The kernels of a field that repeats itself: one period is the circle of the convolution.

From one step of the grid downwards a kernel's spectrum is known: with f waves a period, and their
aliases f + a N on a grid of N points, each wave of the element (`stress_periodic`) brings

    sx, sz, txz = (kz - 1, -kz - 1, i kz) e^(-kz)      sx under q = i (2 - kz) e^(-kz)

times its shape factor, k > 0; those of -k are the conjugates. Closer to the surface the aliases
fade slowly. There the kernel is taken from the element and its two next images, and the rest of
the images in their expansion.
"""

import numpy as np

from analytic.stress.kernels import MIRRORED, Circle, half_line, mirrored_spectra
from analytic.stress.periodic import images, shape_factor
from analytic.stress.potential import Element, element_moments
from analytic.stress.translations import ORDER

_FADED = 44.0  # e^-44 (1 + 44) is 4e-18
_SHALLOW = 1.0  # grid steps: levels above are summed over images


def ring(
    depths: np.ndarray,
    sources: int,
    first: int,
    last: int,
    stride: int,
    subdivisions: int,
    element: Element,
) -> Circle:
    """`stress_kernels.circle` for `sources` grid points that are one period."""
    shallow = int(np.searchsorted(depths, _SHALLOW / subdivisions))

    def spectra(block: slice) -> tuple[np.ndarray, ...]:
        middle = min(max(shallow, block.start), block.stop)
        parts = [
            kernel(depths[levels], sources, subdivisions, element)
            for kernel, levels in (
                (_by_images, slice(block.start, middle)),
                (_by_waves, slice(middle, block.stop)),
            )
            if levels.start < levels.stop
        ]
        return tuple(np.concatenate(rows) for rows in zip(*parts, strict=True))

    points = np.arange(first, last + 1, stride) % sources
    return Circle(sources, 0, points, spectra, MIRRORED)


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
