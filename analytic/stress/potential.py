"""The complex potential of a loaded line away from its elements: expansions and their translation.

    w   x + i z [pitches]          I(w) = (1/pi) int p(t)/(w - t) dt        I' = dI/dw
    M_k  moments int p(t) (t - c)^k dt about a centre c on the surface

With tension positive, z into the body, p in compression and q = p acting in +x,

    sx, sz = Im I + z Re I', Im I - z Re I'      txz = -z Im I'      sx under q = -2 Re I + z Im I'

(Johnson 1985, section 2.5). Away from the load I = (1/pi) sum_k M_k / (w - c)^(k+1). I and z I'
are right to rounding of the largest of the four stresses; a far smaller component may cancel.

Translation. A box of half-width b about c has, in u = (w - c)/b, for the load inside and far out

    outer  I = 1/(pi b) sum_k M_k / u^(k+1)        inner  I = 1/(pi b) sum_l L_l u^l

with M_k the load's moments over b^k. Both kinds of coefficients are real, and boxes that are halved
again and again share their matrices (Greengard and Rokhlin 1987, lemmas 2.3 to 2.5, on a line).
"""

from collections.abc import Iterable
from functools import cache

import numpy as np
from scipy.special import comb

# Distances [pitches] from which that many terms of even moments leave less than 1e-17.
NEAREST_FAR = 4
_BLOCK = 2**13  # points at a time, whose arrays stay in the cache
FAR_TERMS = ((4, 14), (16, 7), (128, 4), (512, 3))


def hat_moments(count: int) -> np.ndarray:
    """M_0 … of a unit hat about its own centre (count,), in pitches: odd ones vanish."""
    order = np.arange(count)
    return np.where(order % 2 == 0, 2.0 / ((order + 1.0) * (order + 2.0)), 0.0)


def hat_potential(x: np.ndarray, z: np.ndarray, terms: int, out: np.ndarray) -> None:
    """Fill `out` with Re I, Im I, z Re I', z Im I' (4, levels, columns) of a unit hat at 0.

    On x (columns,) and z (levels,) in pitches; from the first `terms` > 2 even moments. With
    v = 1/w, s = v^2, m = 2 Re s and n = |s|^2 any power obeys s^2 = m s - n, so that the sums of
    real coefficients over powers of s are divided by that to first order:

        I = v (p0 + p1 s)      I' = s (d0 + d1 s)      v s = m v - |s| conj(v)

    with p0 … d1 real: three times fewer products than with complex powers.
    """
    value = hat_moments(2 * terms)[::2] / np.pi
    slope = -value * (2.0 * np.arange(terms) + 1.0)
    step = max(1, _BLOCK // len(x))
    for start in range(0, len(z), step):
        rows = slice(start, start + step)
        _fill(x, z[rows, None], value, slope, out[:, rows])


def _fill(
    x: np.ndarray, z: np.ndarray, value: np.ndarray, slope: np.ndarray, derivatives: np.ndarray
) -> None:
    size = 1.0 / (x**2 + z**2)  # |s|
    right, down = x * size, -z * size  # Re v, Im v
    work = down * down
    work *= 2.0
    turn = size - work  # Re s
    norm = size * size
    twice = turn + turn  # m

    first, second = _divided(value, twice, norm, work)
    np.subtract(twice, size, out=work)
    work *= second
    work += first
    np.multiply(work, right, out=derivatives[0])
    size += twice
    size *= second
    size += first
    np.multiply(size, down, out=derivatives[1])

    first, second = _divided(slope, twice, norm, work)
    # d0 s + d1 s^2 = (d0 + m d1) s - n d1
    twice *= second
    first += twice
    first *= z
    second *= norm
    second *= z
    turn *= first
    np.subtract(turn, second, out=derivatives[2])
    right *= down
    right *= 2.0  # Im s
    np.multiply(right, first, out=derivatives[3])


def _divided(
    coefficients: np.ndarray, twice: np.ndarray, norm: np.ndarray, work: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Real b0, b1 of sum c_k s^k = b0 + b1 s, where s^2 = `twice` s - `norm`.
    From three coefficients on, by b_k = c_k + `twice` b_(k+1) - `norm` b_(k+2) and, to end with,
    b0 = c_0 - `norm` b_2; `work` is written over."""
    *lower, before, last = coefficients
    second = twice * last
    second += before
    first = norm * -last
    first += lower[-1]
    for coefficient in lower[-2::-1]:
        np.multiply(twice, second, out=work)
        first += work
        first, second = second, first
        first *= norm
        np.subtract(coefficient, first, out=first)
    return first, second


def stresses(potential: np.ndarray, derivative: np.ndarray) -> np.ndarray:
    """sx, sz, txz under p and sx under q (4, …) from I and z I'."""
    even, turn = derivative.real, derivative.imag
    return np.array(
        [potential.imag + even, potential.imag - even, -turn, turn - 2.0 * potential.real]
    )


# Coefficients of an expansion: of boxes of `analytic.stress.tree` the rest is below 1e-15 of it.
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
def nodes_to_outer(count: int) -> np.ndarray:
    """Values at the `count` nodes of a box to its outer coefficients (ORDER, count), in pitches."""
    place = (np.arange(count) - 0.5 * (count - 1)) / (0.5 * count)
    moments = hat_moments(ORDER) * (0.5 * count) ** -_K.astype(float)
    powers = place[:, None] ** _K
    return np.array([powers[:, k::-1] @ (comb(k, _K[: k + 1]) * moments[: k + 1]) for k in _K])


def polynomial(
    coefficients: Iterable[float | np.ndarray], u: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """sum c_k u^k and its derivative by Horner's rule, from the highest coefficient down."""
    value, slope = np.zeros_like(u), np.zeros_like(u)
    for coefficient in coefficients:
        slope *= u
        slope += value
        value *= u
        value += coefficient
    return value, slope


_RUN = 32  # powers at a time


def power_series(coefficients: np.ndarray, u: np.ndarray) -> np.ndarray:
    """sum c_k u^k and its derivative (2, n) at complex u (n,), |u| <= 1, for hundreds of
    coefficients: by runs of powers, in fewer steps than by Horner's rule."""
    slopes = np.roll(coefficients * np.arange(len(coefficients)), -1)
    both = np.pad([coefficients, slopes], ((0, 0), (0, -len(slopes) % _RUN)))
    powers = np.vander(u, _RUN, increasing=True).T.copy()
    whole, total = powers[-1] * u, np.zeros((2, len(u)), dtype=complex)
    for start in range(both.shape[1] - _RUN, -1, -_RUN):
        total *= whole
        total += (both[:, start : start + _RUN] @ powers.view(float)).view(complex)
    return total


def _power(base: float, exponent: np.ndarray) -> np.ndarray:
    """base^exponent, zero for negative exponents."""
    return np.where(exponent >= 0, base ** np.maximum(exponent, 0), 0.0)


def hat_series(w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """I and I' (n,) of a unit hat at 0, at w (n,) in pitches, |w| >= NEAREST_FAR."""
    value, slope = np.empty_like(w), np.empty_like(w)
    tier = np.digitize(np.abs(w), [start for start, _ in FAR_TERMS[1:]])
    for index, (_, terms) in enumerate(FAR_TERMS):
        here = tier == index
        if here.any():
            v = 1.0 / w[here]
            moments = hat_moments(2 * terms)[::2] / np.pi
            total, change = polynomial(moments[::-1], v * v)
            value[here], slope[here] = v * total, -v * v * (total + 2.0 * v * v * change)
    return value, slope
