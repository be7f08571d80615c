"""Stresses away from a hat or a line of them: point loads' stresses, summed over the moments.

A point load P spread as P phi(s) ds makes, with X = x - s and k = 1/(X^2 + z^2)^2 (Flamant;
Johnson 1985, section 2.2 and 2.3),

    sz, txz, sx = -(2/pi) int phi (z^3, X z^2, X^2 z) k ds,  sx under q = -(2/pi) int phi X^3 k ds.

Expanding k in s/r gives Gegenbauer polynomials of order 2 in cos(angle to the surface),

    k = r^-4 sum_n U_n s^n,   U_n = C_n(x/r) / r^n,   r^2 = x^2 + z^2,

so the moments mu_n = int phi s^n ds turn every integral into a sum in which the next term is
smaller by 1/r^2, and nothing cancels in front of the factors z^3, z^2, z, x.
"""

from math import comb

import numpy as np

from analytic.stress.potential import Element, element_moments

# Distances [half-widths of the load] from which the terms up to that number leave less than 1e-17
# of the sum. A hat's moments fall faster than a line's, and need fewer.
_HAT_TERMS = ((3.0, 40), (6.0, 24), (16.0, 17), (128.0, 10), (2048.0, 6))
_LINE_TERMS = ((2.0, 72), (3.0, 46), (6.0, 28), (16.0, 19), (128.0, 11), (2048.0, 7))
NEAREST, FARTHER = _HAT_TERMS[0][0], _LINE_TERMS[0][0]
_HAT_MOMENTS = element_moments("hat", _HAT_TERMS[0][1] + 4)


def hat_multipoles(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz under unit p and sx under unit q (4, n), x and z (n,) in pitches.

    Holds where x^2 + z^2 >= NEAREST^2.
    """
    return _in_tiers(x, z, _HAT_MOMENTS, _HAT_TERMS)


def line_multipoles(x: np.ndarray, z: np.ndarray, moments: np.ndarray) -> np.ndarray:
    """The same of a load with these `far_moments`, lengths in its half-widths from its middle.

    Holds where x^2 + z^2 >= FARTHER^2.
    """
    return _in_tiers(x, z, moments, _LINE_TERMS)


def far_moments(
    places: np.ndarray, load: np.ndarray, pitch: float, half: float, element: Element
) -> np.ndarray:
    """Moments for `line_multipoles` of nodal loads [Pa] at places from the load's middle [m].

    `half` is the half-width of the load [m], feet of the hats included.
    """
    count = _LINE_TERMS[0][1] + 4
    powers = np.empty(count)
    values, ratio = load * (pitch / half), places / half
    for order in range(count):
        powers[order] = values.sum()
        values = values * ratio
    own = element_moments(element, count) * (pitch / half) ** np.arange(count)
    return np.array(
        [sum(comb(k, j) * own[j] * powers[k - j] for j in range(0, k + 1, 2)) for k in range(count)]
    )


def _in_tiers(
    x: np.ndarray, z: np.ndarray, moments: np.ndarray, tiers: tuple[tuple[float, int], ...]
) -> np.ndarray:
    parts = np.empty((4, *x.shape))
    tier = np.digitize(np.hypot(x, z), [start for start, _ in tiers[1:]])
    for index, (_, terms) in enumerate(tiers):
        here = tier == index
        if here.all():
            return _sum_of_moments(x, z, moments, terms)
        if here.any():
            parts[:, here] = _sum_of_moments(x[here], z[here], moments, terms)
    return parts


def _sum_of_moments(x: np.ndarray, z: np.ndarray, given: np.ndarray, terms: int) -> np.ndarray:
    """The integrals of phi s^j k, j = 0 … 3, from the first `terms` polynomials, combined."""
    inverse = 1.0 / (x**2 + z**2)
    cosine = x * inverse
    moments = np.zeros((4, *x.shape))
    before, now = np.zeros_like(x), np.ones_like(x)
    for n in range(terms):
        for power in range(4):
            if given[n + power] != 0.0:
                moments[power] += given[n + power] * now
        ahead = 2.0 * (n + 2.0) * cosine * now - (n + 3.0) * inverse * before
        before, now = now, ahead / (n + 1.0)
    zeroth, first, second, third = moments
    factor = -2.0 / np.pi * inverse**2
    return factor * np.stack(
        [
            z * (x * (x * zeroth - 2.0 * first) + second),
            z**3 * zeroth,
            z**2 * (x * zeroth - first),
            x * (x * (x * zeroth - 3.0 * first) + 3.0 * second) - third,
        ]
    )
