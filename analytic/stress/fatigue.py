"""Parameters of fretting fatigue by which cracks are expected at a surface.

    s    largest stress along the surface [Pa]        q   traction [Pa]       d   slip amplitude [m]

Ruiz, Boddington and Chen (1984, Exp. Mech. 24, 208-217) take s q d, as Nowell and Hills (1990, Wear
136, 329-343) use it; Smith, Watson and Topper (1970) the largest normal stress times the amplitude
of normal strain on the plane, of all that cross the surface upright to x-z, where that is largest
(Szolwinski and Farris 1996)."""

import numpy as np

from analytic.material import Material
from analytic.stress_state import StressState

PLANES = 180  # half a turn


def ruiz(sx: np.ndarray, traction: np.ndarray, amplitude: np.ndarray) -> np.ndarray:
    """s q d (k,) [Pa^2 m], 0 in compression."""
    return np.maximum(sx, 0.0) * np.abs(traction) * amplitude


def smith_watson_topper(one: StressState, other: StressState, material: Material) -> np.ndarray:
    """The parameter (k,) [Pa] of a cycle between two states of stress (k,) in plane strain."""
    angle = np.pi * np.arange(PLANES)[:, None] / PLANES
    c, s = np.cos(angle), np.sin(angle)
    normal = [c**2 * at.sx + s**2 * at.sz + 2.0 * s * c * at.txz for at in (one, other)]
    modulus, nu = material.youngs_modulus, material.poissons_ratio
    strains = [
        (1.0 + nu) * (n - nu * (at.sx + at.sz)) / modulus
        for n, at in zip(normal, (one, other), strict=True)
    ]
    largest = np.maximum(np.maximum(*normal), 0.0)
    return np.max(largest * 0.5 * np.abs(strains[0] - strains[1]), axis=0)
