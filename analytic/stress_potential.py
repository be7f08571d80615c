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
    x: np.ndarray, z: np.ndarray, element: Element, terms: int
) -> tuple[np.ndarray, np.ndarray]:
    """I and z I' (levels, columns) of a unit element at 0, on x (columns,) and z (levels,).

    In pitches; from the first `terms` even moments.
    """
    value = element_moments(element, 2 * terms)[::2] / np.pi
    slope = -value * (2.0 * np.arange(terms) + 1.0)
    inverse = np.empty((len(z), len(x)), dtype=complex)
    square = 1.0 / (x**2 + z[:, None] ** 2)
    np.multiply(x, square, out=inverse.real)
    np.multiply(-z[:, None], square, out=inverse.imag)
    square = inverse * inverse
    potential, derivative = square * value[-1], square * slope[-1]
    for order in range(terms - 2, 0, -1):
        potential += value[order]
        potential *= square
        derivative += slope[order]
        derivative *= square
    potential += value[0]
    potential *= inverse
    derivative += slope[0]
    square *= z[:, None]
    derivative *= square
    return potential, derivative


def stresses(potential: np.ndarray, derivative: np.ndarray) -> np.ndarray:
    """sx, sz, txz under p and sx under q (4, …) from I and z I'."""
    even, turn = derivative.real, derivative.imag
    return np.array(
        [potential.imag + even, potential.imag - even, -turn, turn - 2.0 * potential.real]
    )
