"""Expansions of the potential about centres on the surface, and their translation by matrices.

A box of half-width b about c, in u = (w - c)/b, has for the load inside and far outside of it

    outer  I = 1/(pi b) sum_k M_k / u^(k+1)        inner  I = 1/(pi b) sum_l L_l u^l

with M_k the load's moments over b^k (`stress_potential`). Loads and centres stand on the surface,
so both kinds of coefficients are real, and boxes that are halved again and again share their
matrices. (Greengard and Rokhlin 1987, lemmas 2.3 to 2.5, on a line.)
"""

from functools import cache

import numpy as np
from scipy.special import comb

from analytic.stress.potential import Element, element_moments

# Coefficients kept: with the boxes of `stress_tree` the rest is less than 1e-15 of the load.
ORDER = 56
_K = np.arange(ORDER)


@cache
def outer_to_parent(side: int) -> np.ndarray:
    """Outer coefficients of a half, `side` -1 or 1 of the box's centre, to those of the box."""
    return comb(_K[:, None], _K) * _power(0.5 * side, _K[:, None] - _K) * 0.5**_K


@cache
def inner_to_child(side: int) -> np.ndarray:
    """Inner coefficients of a box to those of its half on `side` -1 or 1."""
    return 0.5 * comb(_K, _K[:, None]) * _power(0.5 * side, _K - _K[:, None]) * 0.5 ** _K[:, None]


@cache
def outer_to_inner(boxes: int) -> np.ndarray:
    """Outer coefficients to the inner ones of a box of the same size, so many boxes to its left."""
    total = _K[:, None] + _K
    return (-1.0) ** (_K + 1) * comb(total, _K) * (2.0 * boxes) ** -(total + 1.0)


@cache
def nodes_to_outer(count: int, element: Element) -> np.ndarray:
    """Values at the `count` nodes of a box to its outer coefficients (ORDER, count), in pitches."""
    place = (np.arange(count) - 0.5 * (count - 1)) / (0.5 * count)
    moments = element_moments(element, ORDER) * (0.5 * count) ** -_K.astype(float)
    powers = place[:, None] ** _K
    return np.array([powers[:, k::-1] @ (comb(k, _K[: k + 1]) * moments[: k + 1]) for k in _K])


def _power(base: float, exponent: np.ndarray) -> np.ndarray:
    """base^exponent, zero for negative exponents."""
    return np.where(exponent >= 0, base ** np.maximum(exponent, 0), 0.0)
