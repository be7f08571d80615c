"""Stresses under a line of elements that repeats itself without end, at any points.

Near the surface the three periods about a point are summed as a free line is; all others reach it
in one inner expansion (`stress_translations`), whose lattice sums are values of Riemann's zeta
function. A quarter of a period down a few waves of the load are all that is left of it:

    I = -i [P_0 + 2 sum_{k>0} P_k e^(i k w)],   P_k the load's Fourier coefficients, k in 2 pi / L,

so a pressure p0 cos kx gives sx, sz = -p0 (1 -+ kz) e^(-kz) cos kx, txz = -p0 kz e^(-kz) sin kx
(Westergaard 1939; Johnson 1985, section 13.2).

The mean. A uniform pressure leaves sx of a half-plane open: any uniform sx keeps its surface free.
Here it is what the images add up to, summed from the middle outwards: the mean pressure makes
sx = sz = -P_0, and a mean traction makes txz = -Q_0 and no sx. For another state far below add a
uniform stress to sx: (1 - nu/(1 - nu)) P_0 where the body may not widen (plane strain), P_0 where
it is free to.

Nomenclature: L period [m], R = L/2, u = (w - middle)/R.
"""

import numpy as np
from scipy.special import comb, zetac

from analytic.stress.line import line_stress
from analytic.stress.multipoles import far_moments
from analytic.stress.potential import Element, stresses
from analytic.stress.translations import ORDER

DEEP = 0.25  # periods: below, the waves alone
_WAVES = 25  # exp(-2 pi 0.25 * 25) is 1e-17


def periodic_stress(
    nodes: np.ndarray,
    load: np.ndarray,
    pitch: float,
    x: np.ndarray,
    z: np.ndarray,
    element: Element,
) -> np.ndarray:
    """sx, sz, txz under p = `load` and sx under q = `load` (4, m) [Pa], at x, z (m,) [m].

    The nodes (n,) [m] and `load` (n,) [Pa] are one period of n pitches.
    """
    period = len(nodes) * pitch
    middle = 0.5 * (nodes[0] + nodes[-1])
    x = x - period * np.round((x - middle) / period)
    parts = np.empty((4, len(x)))
    deep = z > DEEP * period
    if deep.any():
        w = _complex(x[deep] - nodes[0], z[deep])
        parts[:, deep] = _waves(load, 2.0 * np.pi / period, w, element)
    shallow = ~deep
    if shallow.any():
        x, z = x[shallow], z[shallow]
        three = np.concatenate([nodes - period, nodes, nodes + period])
        parts[:, shallow] = line_stress(three, np.tile(load, 3), pitch, x, z, element)
        half = 0.5 * period
        outer = far_moments(nodes - middle, load, pitch, half, element)[:ORDER]
        u = _complex((x - middle) / half, z / half)
        parts[:, shallow] += stresses(*images(outer, u)) / np.pi
    return parts


def images(outer: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """pi I and pi z I' of all periods but the three about u, from the moments over R^k of one."""
    inner = _lattice() @ np.pad(outer, (0, ORDER - len(outer)))
    value, slope = np.zeros_like(u), np.zeros_like(u)
    for coefficient in inner[::-1]:
        slope *= u
        slope += value
        value *= u
        value += coefficient
    slope *= u.imag
    return value, slope


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


def _complex(real: np.ndarray, imaginary: np.ndarray) -> np.ndarray:
    number = np.empty(len(real), dtype=complex)
    number.real, number.imag = real, imaginary
    return number
