"""Division of the heat of friction between two bodies.

The heat q = mu p V of a sliding contact goes into both. Where they touch both surfaces have one
temperature, which fixes the flux f into the first at every node; the rest enters the second:

    (C1 f)_i = (C2 (q - f))_i   at contacting nodes i,      f = 0 at the others,

C1 and C2 the rises above a common bulk temperature by hats of flux (`HeatedSurface`). Equal bodies
that pass the contact alike take half each; so do, in the ratio of their conductivities, bodies of
equal V / kappa; fast ones in the ratio of k sqrt(V / kappa).

Older rules give all of the contact one fraction: Blok's, by which the largest temperatures of both
are equal, Jaeger's, the mean ones, and Seireg's (ch. 5), by conductivities of bulk and surface
layer.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, rfft, rfftfreq

from analytic.contact.coupled import krylov_step
from analytic.heat.moving_source import HeatedSurface

TOLERANCE = 1e-10  # error of the flux, in the 2-norm, over the heat
PASSES = 8  # of GMRES; rough contacts of bodies as unlike as steel and a polymer take up to 2


@dataclass(frozen=True)
class HeatPartition:
    """Heat that a contact brings into both bodies."""

    flux: np.ndarray  # (n,) [W/m^2] into the first
    first: np.ndarray  # (n,) [K] rise of its surface above its bulk temperature
    second: np.ndarray  # the same of the other
    fraction: float  # of the heat that enters the first


def divided(first: HeatedSurface, second: HeatedSurface, heat: np.ndarray) -> HeatPartition:
    """The partition of `heat` (n,) [W/m^2], which is positive at contacting nodes and 0 elsewhere.
    Raises ArithmeticError where the solution does not settle."""
    nodes = np.flatnonzero(heat > 0.0)
    inverse = 1.0 / (_symbol(first) + _symbol(second))
    flux = np.zeros(len(heat))

    def spread(values: np.ndarray) -> np.ndarray:
        line = np.zeros(len(heat))
        line[nodes] = values
        return line

    def conditioned(rise: np.ndarray) -> np.ndarray:
        return irfft(rfft(spread(rise), 2 * len(heat)) * inverse)[nodes]

    def applied(values: np.ndarray) -> np.ndarray:
        line = spread(values)
        return conditioned((first.rise(line) + second.rise(line))[nodes])

    goal = TOLERANCE * float(np.linalg.norm(heat))
    for _ in range(PASSES):
        left = conditioned((second.rise(heat - flux) - first.rise(flux))[nodes])
        step, error = krylov_step(applied, left, goal)
        flux[nodes] += step
        if error <= goal:
            break
    else:
        raise ArithmeticError(
            f"the partition of the heat is found to {error / goal:.1e} of its goal"
        )
    rises = first.rise(flux), second.rise(heat - flux)
    return HeatPartition(flux, *rises, float(flux.sum() / heat.sum()))


def _symbol(surface: HeatedSurface) -> np.ndarray:
    """Transform of the rise by hats on a ring of 2 n nodes: 1 / (k sqrt(w^2 + i w V / kappa)) at
    the wave number w [rad/m]; that of the longest wave but one for the mean."""
    wave = 2.0 * np.pi * rfftfreq(2 * surface.count, surface.pitch)
    wave[0] = 0.5 * wave[1]
    material = surface.material
    root = np.sqrt(wave**2 + 1j * wave * surface.velocity / material.diffusivity)
    return np.sinc(0.5 * wave * surface.pitch / np.pi) ** 2 / (material.conductivity * root)


def one_fraction(
    first: HeatedSurface, second: HeatedSurface, heat: np.ndarray, of: Callable = np.max
) -> float:
    """Fraction of the heat that enters the first where it is one for the whole contact, and `of`
    both rises there is equal: np.max is Blok's rule, np.mean Jaeger's."""
    one, other = (of(body.rise(heat)[heat > 0.0]) for body in (first, second))
    return float(other / (one + other))


def layered_fraction(first: tuple[float, float], second: tuple[float, float]) -> float:
    """Seireg's fraction of the heat that enters the first of two bodies, each given by the
    conductivities [W/(m K)] of its bulk and its surface layer:

        (1/k2 + 1/kl2) / (1/k1 + 1/kl1 + 1/k2 + 1/kl2)

    The formula is lost in the text that we have; this is the simplest with its stated limits:
    k1/(k1 + k2) for layers that conduct far better than the bulk, kl1/(kl1 + kl2) for such that
    conduct far worse, 1/2 for like bodies. It knows neither speed nor thickness.
    """
    one, other = (sum(1.0 / k for k in body) for body in (first, second))
    return other / (one + other)
