"""The complex potential that all stresses under a loaded line derive from, away from its elements.

    w   x + i z [pitches]          I(w) = (1/pi) int p(t)/(w - t) dt        I' = dI/dw
    M_k  moments int p(t) (t - c)^k dt about a centre c on the surface

With tension positive, z into the body, p in compression and q = p acting in +x,

    sx, sz = Im I + z Re I', Im I - z Re I'      txz = -z Im I'      sx under q = -2 Re I + z Im I'

(Johnson 1985, section 2.5, written for the potential of the traction's resultant). Away from the
load I = (1/pi) sum_k M_k / (w - c)^(k+1). Taken as complex numbers I and z I' are right to rounding
of the largest of the four stresses at a point; a component far smaller than that one may cancel.
"""

from typing import Literal

import numpy as np

Element = Literal["hat", "strip"]

# Distances [pitches] from which that many terms of even moments leave less than 1e-17.
NEAREST_FAR = 4
_BLOCK = 2**13  # points at a time, whose arrays stay in the cache
FAR_TERMS = ((4, 14), (16, 7), (128, 4), (512, 3))


def element_moments(element: Element, count: int) -> np.ndarray:
    """M_0 … of unit hat or strip about its own centre (count,), in pitches: odd ones vanish."""
    order = np.arange(count)
    if element == "hat":
        even = 2.0 / ((order + 1.0) * (order + 2.0))
    else:
        even = 0.5**order / (order + 1.0)
    return np.where(order % 2 == 0, even, 0.0)


def element_potential(
    x: np.ndarray, z: np.ndarray, element: Element, terms: int, out: np.ndarray | None = None
) -> np.ndarray:
    """Re I, Im I, z Re I', z Im I' (4, levels, columns) of a unit element at 0.

    On x (columns,) and z (levels,) in pitches; from the first `terms` > 2 even moments; into `out`
    if it is given. With v = 1/w, s = v^2, m = 2 Re s and n = |s|^2 any power obeys s^2 = m s - n,
    so that the sums of real coefficients over powers of s are divided by that to first order:

        I = v (p0 + p1 s)      I' = s (d0 + d1 s)      v s = m v - |s| conj(v)

    with p0 … d1 real: three times fewer products than with complex powers.
    """
    value = element_moments(element, 2 * terms)[::2] / np.pi
    slope = -value * (2.0 * np.arange(terms) + 1.0)
    found = np.empty((4, len(z), len(x))) if out is None else out
    step = max(1, _BLOCK // len(x))
    for start in range(0, len(z), step):
        rows = slice(start, start + step)
        _fill(x, z[rows, None], value, slope, found[:, rows])
    return found


def _fill(
    x: np.ndarray, z: np.ndarray, value: np.ndarray, slope: np.ndarray, found: np.ndarray
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
    np.multiply(work, right, out=found[0])
    size += twice
    size *= second
    size += first
    np.multiply(size, down, out=found[1])

    first, second = _divided(slope, twice, norm, work)
    # d0 s + d1 s^2 = (d0 + m d1) s - n d1
    twice *= second
    first += twice
    first *= z
    second *= norm
    second *= z
    turn *= first
    np.subtract(turn, second, out=found[2])
    right *= down
    right *= 2.0  # Im s
    np.multiply(right, first, out=found[3])


def _divided(
    coefficients: np.ndarray, twice: np.ndarray, norm: np.ndarray, work: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Real b0, b1 of sum c_k s^k = b0 + b1 s, where s^2 = `twice` s - `norm`.

    From three coefficients on, by b_k = c_k + `twice` b_(k+1) - `norm` b_(k+2) and, to end with,
    b0 = c_0 - `norm` b_2; `work` is written over.
    """
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
