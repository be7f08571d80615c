"""Stresses of a hat away from it: the point loads' stresses, summed over the hat's moments.

A point load P spread as P phi(s) ds makes, with X = x - s and k = 1/(X^2 + z^2)^2 (Flamant;
Johnson 1985, section 2.2 and 2.3),

    sz, txz, sx = -(2/pi) int phi (z^3, X z^2, X^2 z) k ds,  sx under q = -(2/pi) int phi X^3 k ds.

Expanding k in s/r gives Gegenbauer polynomials of order 2 in cos(angle to the surface),

    k = r^-4 sum_n U_n s^n,   U_n = C_n(x/r) / r^n,   r^2 = x^2 + z^2,

so the moments mu_n = int phi s^n ds turn every integral into a sum in which the next term is
smaller by 1/r^2, and nothing cancels in front of the factors z^3, z^2, z, x.
"""

import numpy as np

# Distances [pitches] from which the terms up to that number leave less than 1e-17 of the sum.
_TERMS = ((3.0, 40), (6.0, 24), (16.0, 17), (128.0, 10), (2048.0, 6))
NEAREST = _TERMS[0][0]
_ORDER = np.arange(0, 44)
_MOMENTS = np.where(_ORDER % 2 == 0, 2.0 / ((_ORDER + 1.0) * (_ORDER + 2.0)), 0.0)


def hat_multipoles(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz under unit p and sx under unit q (4, n), x and z (n,) in pitches.

    Holds where x^2 + z^2 >= NEAREST^2.
    """
    parts = np.empty((4, *x.shape))
    tier = np.digitize(np.hypot(x, z), [start for start, _ in _TERMS[1:]])
    for index, (_, terms) in enumerate(_TERMS):
        here = tier == index
        if here.all():
            return _sum_of_moments(x, z, terms)
        if here.any():
            parts[:, here] = _sum_of_moments(x[here], z[here], terms)
    return parts


def _sum_of_moments(x: np.ndarray, z: np.ndarray, terms: int) -> np.ndarray:
    """The integrals of phi s^j k, j = 0 … 3, from the first `terms` polynomials, combined."""
    inverse = 1.0 / (x**2 + z**2)
    cosine = x * inverse
    moments = np.zeros((4, *x.shape))
    before, now = np.zeros_like(x), np.ones_like(x)
    for n in range(terms):
        for power in range(n % 2, 4, 2):
            moments[power] += _MOMENTS[n + power] * now
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
