"""Sums over the aliases of a wave on a grid, as hats see them, however many are wanted.

    sum over |j| < J of sinc^4(c + j) F(|c + j|),   c cycles per pitch, 0 <= c <= 1/2

sinc^4(c + j) is (sin pi c/pi)^4 / (c + j)^4. The nearest aliases are added one by one. What the
others bring is, but for the sine, an even function of c without a singularity as near as
they are: it is found at a few c and interpolated in c^2. There the aliases are taken in ranges
that double, by Gauss's rule for sums of equal steps (discrete Chebyshev polynomials), so the cost
grows with log J. F has to be analytic in a sector about the positive axis.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.polynomial import chebyshev
from scipy.linalg import eigh_tridiagonal

_NEAREST = 4  # aliases added one by one
_CYCLES = 10  # values of c^2 that the others are interpolated from
_RULE = 16  # points that stand for the aliases of one range

Wave = Callable[[np.ndarray], np.ndarray]


def rounded_up(beyond: int) -> int:
    """The next J that whole ranges reach to."""
    rounded = _NEAREST
    while rounded < beyond:
        rounded *= 2
    return rounded


def alias_sum(wave: Wave, cycles: np.ndarray, beyond: int) -> np.ndarray:
    """The sum above for F = `wave` and J = `beyond` from `rounded_up`, shaped as `cycles` (n,)."""
    total = np.zeros(len(cycles))
    for alias in range(1 - _NEAREST, _NEAREST):
        seen = cycles + alias
        total += np.sinc(seen) ** 4 * wave(np.abs(seen))
    if beyond == _NEAREST:
        return total
    power = (np.sin(np.pi * cycles) / np.pi) ** 4
    return total + power * _farther(wave, cycles, beyond)


def _farther(wave: Wave, cycles: np.ndarray, beyond: int) -> np.ndarray:
    """sum over J > |j| >= _NEAREST of F (c + j)^-4, by interpolation."""
    place = np.cos(np.pi * (np.arange(_CYCLES) + 0.5) / _CYCLES)  # 8 c^2 - 1
    few = np.sqrt(0.125 * (1.0 + place))[:, None]
    values = np.zeros(_CYCLES)
    first = _NEAREST
    while first < beyond:
        steps, weights = _rule(first)
        right, left = first + steps + few, first + steps - few
        values += (wave(right) * right**-4.0 + wave(left) * left**-4.0) @ weights
        first *= 2
    series = chebyshev.chebfit(place, values, _CYCLES - 1)
    return chebyshev.chebval(8.0 * cycles**2 - 1.0, series)


@cache
def _rule(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights for sums over 0 … count - 1, of every polynomial of degree < 2 _RULE."""
    if count <= _RULE:
        return np.arange(float(count)), np.ones(count)
    k = np.arange(1.0, _RULE)
    beside = 0.5 * k * np.sqrt((1.0 - (k / count) ** 2) / (4.0 * k**2 - 1.0))  # over count
    places, vectors = eigh_tridiagonal(np.zeros(_RULE), beside)
    return 0.5 * (count - 1.0) + count * places, count * vectors[0] ** 2
