"""Thermal stresses in a half-plane that passes a steady source of heat, in plane strain.

The potential of displacement of the temperature T0 e^{-mz} at a wave number, and Airy's function
that frees the surface (Boley and Weiner, Theory of Thermal Stresses, 1960, ch. 3, 9), give with

    w  wave number > 0 [rad/m]       m  sqrt(w^2 + i w V/kappa), d = m - w
    T0 transform of the surface's T  C  E alpha / (1 - nu) [Pa/K]

    sz  = C T0/(m + w) w^2 e^{-wz} (z - D),     D = (1 - e^{-dz}) / d
    txz = i C T0/(m + w) w e^{-wz} (m D - w z)
    sx  = -C T - sz + 2 C T0 w/(m + w) e^{-wz}

T rises from the temperature without stresses, sy = nu (sx + sz) - E alpha T. A source at rest,
m = w, leaves no stress in the plane, whatever the flux: its temperature is harmonic.

For long waves the last term is that of kappa/V times the conjugate of the flux, which falls only
like 1/x: the FFT's ring of these is taken off in closed form. What is left falls like x^(-3/2).
"""

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

from analytic.heat.moving_source import HeatedSurface
from analytic.material import Material
from analytic.numerics import for_each
from analytic.stress_state import StressState

# Length of the FFT's ring over the line's, and over kappa/V: stresses are right to 3e-3 of the top
RING, LAYERS = 32, 200.0


def thermal_stress(
    surface: HeatedSurface, flux: np.ndarray, depths: np.ndarray, body: Material, expansion: float
) -> StressState:
    """Stresses (m, n) [Pa] at depths (m,) [m] below nodes with fluxes (n,) [W/m^2]; alpha [1/K]."""
    pitch, depths = surface.pitch, np.asarray(depths, dtype=float)
    stress = np.zeros((3, len(depths), len(flux)))
    if surface.velocity == 0.0:
        return StressState(*stress)
    constant = body.youngs_modulus * expansion / (1.0 - body.poissons_ratio)
    material, layer = surface.material, surface.material.diffusivity / surface.velocity
    least = max(RING * len(flux), int(LAYERS * abs(layer) / pitch))
    ring = next_fast_len(least, real=True)
    w = 2.0 * np.pi * rfftfreq(ring, pitch)[1:]
    m = np.sqrt(w**2 + 1j * w / layer)
    d = 1j * w / layer / (m + w)
    hats = rfft(flux, ring)[1:] * np.sinc(0.5 * w * pitch / np.pi) ** 2
    common = constant * hats / (material.conductivity * m * (m + w))
    x = pitch * np.arange(len(flux))
    heat, turn, length = flux.sum() * pitch, 2.0 * np.pi / (ring * pitch), ring * pitch
    away = x - (flux @ x / flux.sum() if heat else 0.0)

    def back(spectrum: np.ndarray) -> np.ndarray:
        return irfft(np.append(0.0, spectrum), ring)[: len(flux)]

    def at(row: int) -> None:
        z = depths[row]
        decay, reach = w * np.exp(-w * z) * common, -np.expm1(-d * z) / d
        rest = 2.0 * back(decay)
        # of the conjugate of a line of flux, and of all its like in the ring
        angle, rise = 0.5 * turn * away, min(0.5 * turn * z, 300.0)
        below = np.pi * (away**2 + z**2), length * (np.sin(angle) ** 2 + np.sinh(rise) ** 2)
        near = np.hypot(away, z) > 1e-9 * length
        tail = away / np.where(near, below[0], np.inf)
        tail -= 0.5 * np.sin(2.0 * angle) / np.where(near, below[1], np.inf)
        rest += 2.0 * constant * heat * layer / material.conductivity * tail
        sz = back(decay * w * (z - reach))
        sx = rest - sz - constant * surface.rise(flux, float(z))
        stress[:, row] = sx, sz, back(1j * decay * (m * reach - w * z))

    for_each(at, range(len(depths)))
    return StressState(*stress)
