"""A surface that is heated at one moment: half-space, and slab with an insulated far face.

    y   depth [m]                     kappa  diffusivity [m^2/s]
    L   thickness of the slab [m]     tau    kappa t / L^2
    T   rise above the start [K]      q      flux into the surface [W/m^2], k conductivity [W/(m K)]

Half-space: T = T0 erfc(y / (2 sqrt(kappa t))) after a step of the surface to T0, and
T = (2 q / k) sqrt(kappa t) ierfc(y / (2 sqrt(kappa t))) under a flux from t = 0 (Carslaw and
Jaeger 1959, sections 2.4 and 2.9). Slab: images of these at 2 n L below tau = 0.3, the cosine
series from there on (sections 3.4 and 3.8); either to rounding."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erfc, erfcx

from analytic.material import ThermalMaterial

_SHORT = 0.3  # tau up to which images are summed; from there on the series
_IMAGES, _TERMS = 7, 7  # to rounding on their side of it


def step_half_space(depth: ArrayLike, time: ArrayLike, diffusivity: float) -> np.ndarray:
    """T / T0 at depths [m] and times [s] > 0 after a step of the surface's temperature."""
    return erfc(_similarity(depth, time, diffusivity))


def step_slab(
    depth: ArrayLike, time: ArrayLike, thickness: float, diffusivity: float
) -> np.ndarray:
    """T / T0 in a slab whose far face is insulated, at 0 <= depth <= `thickness` [m]."""
    place, tau = _of_slab(depth, time, thickness, diffusivity)
    root = 2.0 * np.sqrt(tau)
    n = np.arange(_IMAGES)
    images = (-1.0) ** n * (erfc((2.0 * n + place) / root) + erfc((2.0 * n + 2.0 - place) / root))
    m = (np.arange(_TERMS) + 0.5) * np.pi
    series = 2.0 / m * np.exp(-(m**2) * tau) * np.sin(m * place)
    return np.where(tau[..., 0] < _SHORT, images.sum(-1), 1.0 - series.sum(-1))


def flux_half_space(
    depth: ArrayLike, time: ArrayLike, flux: float, material: ThermalMaterial
) -> np.ndarray:
    """T [K] under a constant flux [W/m^2] since t = 0."""
    kappa = material.diffusivity
    length = 2.0 * np.sqrt(kappa * np.asarray(time, dtype=float))
    return flux / material.conductivity * length * _ierfc(_similarity(depth, time, kappa))


def flux_slab(
    depth: ArrayLike, time: ArrayLike, thickness: float, flux: float, material: ThermalMaterial
) -> np.ndarray:
    """T [K] in a slab whose far face is insulated."""
    place, tau = _of_slab(depth, time, thickness, material.diffusivity)
    root = 2.0 * np.sqrt(tau)
    n = np.arange(_IMAGES)
    images = root * (_ierfc((2.0 * n + place) / root) + _ierfc((2.0 * n + 2.0 - place) / root))
    up, m = 1.0 - place, (np.arange(_TERMS) + 1.0) * np.pi
    series = 2.0 * np.cos(m) / m**2 * np.exp(-(m**2) * tau) * np.cos(m * up)
    slow = tau[..., 0] + (3.0 * up[..., 0] ** 2 - 1.0) / 6.0 - series.sum(-1)
    rise = np.where(tau[..., 0] < _SHORT, images.sum(-1), slow)
    return flux * thickness / material.conductivity * rise


def pulse(
    depth: ArrayLike,
    time: ArrayLike,
    duration: float,
    flux: float,
    material: ThermalMaterial,
    thickness: float | None = None,
) -> np.ndarray:
    """T [K] under a flux [W/m^2] that ends after `duration` [s]: f(t) - f(t - duration).

    thickness  [m] of a slab with an insulated far face; None: half-space
    """
    depth, time = np.broadcast_arrays(depth, np.asarray(time, dtype=float))

    def since(moment: np.ndarray) -> np.ndarray:
        if thickness is None:
            return flux_half_space(depth, moment, flux, material)
        return flux_slab(depth, moment, thickness, flux, material)

    after = time > duration
    return since(time) - np.where(after, since(np.where(after, time - duration, 1.0)), 0.0)


def _similarity(depth: ArrayLike, time: ArrayLike, diffusivity: float) -> np.ndarray:
    return np.asarray(depth) / (2.0 * np.sqrt(diffusivity * np.asarray(time, dtype=float)))


def _of_slab(
    depth: ArrayLike, time: ArrayLike, thickness: float, diffusivity: float
) -> tuple[np.ndarray, np.ndarray]:
    """y/L and tau, with a last axis for the terms of a sum."""
    place = np.asarray(depth, dtype=float) / thickness
    tau = diffusivity * np.asarray(time, dtype=float) / thickness**2
    place, tau = np.broadcast_arrays(place, tau)
    return place[..., None], tau[..., None]


def _ierfc(x: np.ndarray) -> np.ndarray:
    """exp(-x^2) / sqrt(pi) - x erfc(x), the integral of erfc from x on."""
    return np.exp(-(x**2)) * (1.0 / np.sqrt(np.pi) - x * erfcx(x))
