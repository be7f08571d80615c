"""Surface displacement of an elastic half-plane under one element of pressure.

Dimensionless integrals of the logarithm over an element, with lengths in pitches h and the
element centred at 0:

    strip     p on |s| < 1/2                      L_u(x) = int ln|x-s| ds
    hat       p (1-|s|) on |s| < 1                L_h(x) = int (1-|s|) ln|x-s| ds
    galerkin  a hat weighed with a hat at x       L_g(x) = int (1-|t-x|) L_h(t) dt

Each element carries the load p h, so all tend to ln|x|. The displacement into the body
under the peak pressure p (positive in compression) is

    u(x) = -(2/(pi E')) p h [L(x/h) - L(datum/h)],   E' = E/(1-nu^2),

and int phi_i u dx = h u with L = L_g for the hat phi_i of the pitch h. A half-plane under a net
load has no displacement at infinity: only differences mean anything, hence the datum.
(Johnson 1985, eq. 2.30 and 5.20-5.24, for strip and hat.)

Closed forms are differences of x^k ln|x| that cancel like x^-k. Away from the element the
integrals are summed from the element's even moments mu instead,

    L(x) = ln|x| - sum_m mu_2m / (2m x^2m),

right to a few units of the last place near the element (3e-15 at whole offsets), then to rounding.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import xlogy

_Curve = Callable[[np.ndarray], np.ndarray]

_SERIES_TERMS, _SERIES_TERMS_FAR, _FAR = 48, 9, 8.0
_EVEN = 2.0 * np.arange(1, _SERIES_TERMS + 1)


@dataclass(frozen=True)
class _Far:
    """Even moments mu_2, mu_4, … of an element, and the offset from which they are summed.

    There the terms after the 48th add up to less than 1e-18, and beyond eight times that
    offset so do those after the 9th.
    """

    moments: np.ndarray
    join: float

    def log_mean(self, x: np.ndarray) -> np.ndarray:
        """ln x - sum_m mu_2m / (2m x^2m) for x >= join."""
        coefficients, total = self.moments / _EVEN, np.empty_like(x)
        far = x >= _FAR * self.join
        for part, terms in ((far, _SERIES_TERMS_FAR), (~far, _SERIES_TERMS)):
            if not part.any():
                continue
            step = x[part] ** -2.0
            value = np.zeros_like(step)
            for coefficient in coefficients[terms - 1 :: -1]:
                value = (value + coefficient) * step
            total[part] = value
        return np.log(x) - total


_STRIP = _Far(0.5**_EVEN / (_EVEN + 1.0), join=1.0)
_SPLINE = _Far(
    (2.0 ** (_EVEN + 5.0) - 8.0) / ((_EVEN + 1.0) * (_EVEN + 2.0) * (_EVEN + 3.0) * (_EVEN + 4.0)),
    join=3.0,
)


def strip_displacement(offset: ArrayLike) -> np.ndarray:
    """L_u at `offset` [pitches], any shape: a uniform pressure one pitch wide."""

    def closed(x: np.ndarray) -> np.ndarray:
        return xlogy(x + 0.5, x + 0.5) - xlogy(x - 0.5, abs(x - 0.5)) - 1.0

    return _joined(offset, closed, _STRIP)


def hat_galerkin(offset: ArrayLike) -> np.ndarray:
    """L_g at `offset` [pitches], any shape: the displacement of a hat weighed with another hat.

    Fourth difference of x^4 ln|x| / 24, less 25/12: the integral of ln against the cubic spline
    that two hats make. Whole offsets are accurate to 3e-15 relative; between them, below 3, the
    absolute error stays below 1e-14.
    """

    def closed(x: np.ndarray) -> np.ndarray:
        return _scaled_difference(x, (1.0, -4.0, 6.0, -4.0, 1.0)) - 25.0 / 12.0

    return _joined(offset, closed, _SPLINE)


def at_whole_offsets(kernel: _Curve, count: int) -> np.ndarray:
    """`kernel`, one of this module, at 0, 1, … `count` - 1 pitches (count,); near ones cached."""
    near = _near(kernel)[:count]
    return np.concatenate((near, kernel(np.arange(len(near), count, dtype=float))))


@cache
def _near(kernel: _Curve) -> np.ndarray:
    return kernel(np.arange(_FAR * _SPLINE.join))


def _joined(offset: ArrayLike, closed: _Curve, element: _Far) -> np.ndarray:
    """`closed` below |offset| = `join` and the element's moments from there on."""
    x = np.abs(np.asarray(offset, dtype=float))
    value = np.empty_like(x)
    near = x < element.join
    value[near] = closed(x[near])
    value[~near] = element.log_mean(x[~near])
    return value


def _scaled_difference(x: np.ndarray, weights: tuple[float, ...]) -> np.ndarray:
    """The central difference of y^k ln|y| / k! of order k = len(weights) - 1 at x >= 0.

    The difference of y^k / k! is 1, so lengths may be taken in any unit c at the price of
    adding ln c: c = x + 1 keeps the summands small.
    """
    order = len(weights) - 1
    factorial = np.prod(np.arange(1.0, order + 1.0))
    unit = x + 1.0
    total = np.zeros_like(x)
    for weight, shift in zip(weights, np.arange(order, -1, -1) - order / 2.0, strict=True):
        y = x + shift
        total += weight * xlogy(y**order, abs(y) / unit)
    return total / factorial + np.log(unit)
