"""Surface displacement of an elastic half-plane under one element of pressure.

Dimensionless integrals of the logarithm over an element, with lengths in pitches h and the
element centred at 0:

    hat       p (1-|s|) on |s| < 1                L_h(x) = int (1-|s|) ln|x-s| ds
    galerkin  a hat weighed with a hat at x       L_g(x) = int (1-|t-x|) L_h(t) dt

Each element carries the load p h, so all tend to ln|x|. The displacement into the body
under the peak pressure p (positive in compression) is

    u(x) = -(2/(pi E')) p h [L(x/h) - L(datum/h)],   E' = E/(1-nu^2),

and int phi_i u dx = h u with L = L_g for the hat phi_i of the pitch h. A half-plane under a net
load has no displacement at infinity: only differences mean anything, hence the datum.
(Johnson 1985, eq. 5.20-5.24, for the hat.)

The closed form of L_g is a difference of x^k ln|x| that cancels like x^-k. Away from the element it
is summed from the even moments mu of the cubic spline that two hats make instead,

    L(x) = ln|x| - sum_m mu_2m / (2m x^2m),

right to a few units of the last place near the element (3e-15 at whole offsets), then to rounding.
"""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import xlogy

# Offsets from which moments are summed: there those after the 48th add up to less than 1e-18, and
# from the second on those after the 9th.
_JOIN, _FAR = 3.0, 24.0
_TERMS, _FEWER_TERMS = 48, 9
_EVEN = 2.0 * np.arange(1, _TERMS + 1)
_MOMENTS = (2.0 ** (_EVEN + 5.0) - 8.0) / (
    _EVEN * (_EVEN + 1.0) * (_EVEN + 2.0) * (_EVEN + 3.0) * (_EVEN + 4.0)
)  # mu_2m / 2m


def hat_galerkin(offset: ArrayLike) -> np.ndarray:
    """L_g at `offset` [pitches], any shape: the displacement of a hat weighed with another hat.
    Fourth difference of x^4 ln|x| / 24, less 25/12: the integral of ln against the cubic spline
    that two hats make. Whole offsets are accurate to 3e-15 relative; between them, below 3, the
    absolute error stays below 1e-14."""
    x = np.abs(np.asarray(offset, dtype=float))
    value, near, far = np.empty_like(x), x < _JOIN, x >= _FAR
    if near.any():
        value[near] = _closed(x[near])
    for part, terms in ((far, _FEWER_TERMS), (~near & ~far, _TERMS)):
        if part.any():
            step = x[part] ** -2.0
            rest = np.zeros_like(step)
            for moment in _MOMENTS[terms - 1 :: -1]:
                rest = (rest + moment) * step
            value[part] = np.log(x[part]) - rest
    return value


def _closed(x: np.ndarray) -> np.ndarray:
    """L_g below _JOIN; lengths in the unit c = x + 1, which costs ln c, keep the summands small."""
    unit, total = x + 1.0, np.zeros_like(x)
    for weight, shift in ((1.0, 2.0), (-4.0, 1.0), (6.0, 0.0), (-4.0, -1.0), (1.0, -2.0)):
        y = x + shift
        total += weight * xlogy(y**4, np.abs(y) / unit)
    return total / 24.0 + np.log(unit) - 25.0 / 12.0


def at_whole_offsets(count: int) -> np.ndarray:
    """L_g at 0, 1, … `count` - 1 pitches (count,); near ones cached."""
    near = _near()[:count]
    return np.concatenate((near, hat_galerkin(np.arange(len(near), count, dtype=float))))


@cache
def _near() -> np.ndarray:
    return hat_galerkin(np.arange(_FAR))
