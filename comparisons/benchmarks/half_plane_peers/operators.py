"""Exact displacements of pressures on a line of unit length, E* = 1, for each discretisation.

Written anew, by other formulas than those of `analytic`, so that what is measured with them does
not rest on the code that is measured.

    point  closed line: every wave k of the grid sinks by p/(pi k)
    strip  uniform over a pitch, displacement at its middle
    hat    linear between nodes, displacement averaged over a hat

On a closed line the elements see every wave with its aliases k + j n; on a free one the kernel is
-(2/pi) ln|x|, integrated over the element by Gauss quadrature, next to it in closed form. The
constant of the displacement is arbitrary.
"""

from functools import lru_cache

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

_ALIASES = 60  # summed one by one; the others by their integral, or half their first
_GAUSS = 24  # points in each pitch: 1e-16 from a pitch's distance on
_NEAR = 4  # pitches within which the logarithm is integrated in closed form


def displacements(pressure: np.ndarray, element: str, closed: bool) -> np.ndarray:
    """u (n,) [m] at the nodes, or averaged over hats, of pressures (n,) [Pa]."""
    count = len(pressure)
    if closed:
        return irfft(rfft(pressure) * _symbol(count, element), count)
    length = next_fast_len(2 * count, real=True)
    return irfft(rfft(pressure, length) * _transfer(count, length, element), length)[:count]


@lru_cache(maxsize=6)
def _symbol(count: int, element: str) -> np.ndarray:
    """Eigenvalues of the closed line's circulant, 0 for the mean."""
    cycles = np.arange(1, count // 2 + 1) / count
    seen = {"hat": _hat_aliases, "strip": _strip_aliases, "point": np.reciprocal}[element](cycles)
    return np.concatenate(([0.0], seen / (np.pi * count)))


def _hat_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc^4(c + j)/|c + j|; the tail by the midpoint rule and its correction."""
    total = sum(np.abs(cycles + j) ** -5.0 for j in range(_ALIASES, -_ALIASES - 1, -1))
    for edge in (_ALIASES + 0.5 + cycles, _ALIASES + 0.5 - cycles):
        total += edge**-4.0 / 4.0 - 5.0 * edge**-6.0 / 24.0
    return (np.sin(np.pi * cycles) / np.pi) ** 4 * total


def _strip_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc(c + j)/|c + j|: signs alternate, the tail is Boole's summation."""
    total = np.zeros_like(cycles)
    for j in range(_ALIASES - 1, -_ALIASES, -1):
        total += (-1.0) ** j / ((cycles + j) * np.abs(cycles + j))
    for first, sign in ((_ALIASES + cycles, 1.0), (_ALIASES - cycles, -1.0)):
        tail = 0.5 * first**-2.0 + 0.5 * first**-3.0 - 0.5 * first**-5.0 + 1.5 * first**-7.0
        total += sign * (-1.0) ** _ALIASES * tail
    return np.sin(np.pi * cycles) / np.pi * total


@lru_cache(maxsize=6)
def _transfer(count: int, length: int, element: str) -> np.ndarray:
    """Transform of the circulant that holds the free line's Toeplitz matrix."""
    distance = np.arange(count, dtype=float)
    order, shape = {"hat": (4, _cubic_spline), "strip": (1, np.ones_like)}[element]
    pieces = np.arange(-order / 2, order / 2)
    point, weight = np.polynomial.legendre.leggauss(_GAUSS)
    column = np.zeros(count)
    for place in pieces[:, None] + 0.5 * (1.0 + point):
        for t, share in zip(place, 0.5 * weight * shape(place), strict=True):
            column += share * np.log(np.abs(distance - t))
    near = distance[:_NEAR, None] + np.arange(-order / 2, order / 2 + 1)
    differences = {4: (1, -4, 6, -4, 1), 1: (-1, 1)}[order]
    column[:_NEAR] = _log_integral(near, order) @ np.array(differences)
    circulant = np.zeros(length)
    circulant[:count] = column
    circulant[length - count + 1 :] = column[:0:-1]
    return rfft(circulant) * (-2.0 / (np.pi * count))


def _cubic_spline(t: np.ndarray) -> np.ndarray:
    """Two hats convolved."""
    t = np.abs(t)
    return np.where(t < 1.0, 2.0 / 3.0 - t**2 + 0.5 * t**3, (2.0 - t) ** 3 / 6.0)


def _log_integral(x: np.ndarray, order: int) -> np.ndarray:
    """ln|x| integrated `order` times, 1 or 4, but for a polynomial that differences do not see."""
    log = np.log(np.abs(np.where(x == 0.0, 1.0, x)))
    return x * (log - 1.0) if order == 1 else x**4 * (log - 25.0 / 12.0) / 24.0
