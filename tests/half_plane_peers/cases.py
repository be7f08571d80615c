"""The contact problems on which half-plane codes are compared: one surface for all discretisations.

Nodes stand at x_i = i h, 0 <= i < n, and L = n h = 1, E* = 1. Hats take the gap averaged over
each hat, strips and points take it at the nodes. All peers solve a periodic line. For the cylinder,
whose line is unbounded, they are given a gap that makes up for the neighbouring periods:

    g0_periodic = g0 + (K_free - K_periodic) * p_Hertz

has Hertz's pressure as its exact solution, on the same nodes and without a padded transform.

    n   nodes              E*  combined modulus [Pa]     a   half-width [m]
    h   pitch [m]          L   length or period [m]      P   load per length [N/m]
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.exact.hertz import HertzContact, hertz_from_peak_pressure
from analytic.exact.westergaard import westergaard_from_mean_pressure
from analytic.operators.periodic import PeriodicHalfPlane
from analytic.surface.synthetic import self_affine

CONTACT_SHARE = 0.1  # share of the nodes of a rough line
HALF_WIDTH = 0.25  # a/L of the smooth cases
HEIGHT = 0.01  # peak pressure of the cylinder over E*, amplitude of the sinusoid over L
HURST, RMS_SLOPE = 0.8, 0.05
SHORTEST = 16  # pitches in the shortest wave: what is resolved is the surface, not its samples
REFINED = 8  # nodes of the expected pressures to one of the case
_CHEBYSHEV = 64  # points that integrate Hertz's pressure against a kernel smooth over a length a


@dataclass(frozen=True)
class LineCase:
    """One problem at one size.

    periodic      whether this project solves a periodic line, as the peers always do
    load, pitch   P [N/m] and h [m]
    gaps          (n,) g0 at the nodes [m]
    hat_averages  (n,) g0 averaged over each hat [m]
    heights       (n,) -g0 at the nodes of the periodic line that the peers solve [m]
    expected      (REFINED n,) reference pressures [Pa], exact or of that many hats
    """

    periodic: bool
    load: float
    pitch: float
    gaps: np.ndarray
    hat_averages: np.ndarray
    heights: np.ndarray
    expected: np.ndarray

    @property
    def count(self) -> int:
        return len(self.gaps)


def cylinder(count: int) -> LineCase:
    """Hertz: half of the nodes in contact, on an unbounded line."""
    pitch = 1.0 / count
    x = np.arange(count) * pitch - 0.5
    hertz = hertz_from_peak_pressure(HEIGHT, 0.5 * HALF_WIDTH / HEIGHT, 1.0)
    gaps = x**2 / (2.0 * hertz.radius)
    fine = np.arange(REFINED * count) * (pitch / REFINED) - 0.5
    return LineCase(
        periodic=False,
        load=hertz.load_per_length,
        pitch=pitch,
        gaps=gaps,
        hat_averages=gaps + pitch**2 / (12.0 * hertz.radius),
        heights=-(gaps + _periodic_correction(hertz, x)),
        expected=hertz.pressure(fine),
    )


def _periodic_correction(hertz: HertzContact, x: np.ndarray) -> np.ndarray:
    """(K_free - K_periodic) * p_Hertz [m] at x; K = -2/(pi E*) times ln|x| and ln|sin(pi x)/pi|."""
    angle = np.arange(1, _CHEBYSHEV + 1) * np.pi / (_CHEBYSHEV + 1)
    total = hertz.half_width * hertz.peak_pressure * np.pi / (_CHEBYSHEV + 1)
    moved = np.zeros_like(x)
    for place, share in zip(hertz.half_width * np.cos(angle), np.sin(angle) ** 2, strict=True):
        moved += total * share * np.log(np.abs(np.sinc(x - place)))
    return 2.0 / (np.pi * hertz.combined_modulus) * moved


def sinusoid(count: int) -> LineCase:
    """Westergaard: one wave, half of it in contact."""
    pitch = 1.0 / count
    mean_pressure = np.pi * HEIGHT * np.sin(np.pi * HALF_WIDTH) ** 2
    exact = westergaard_from_mean_pressure(mean_pressure, 1.0, HEIGHT, 1.0)
    wave = HEIGHT * np.cos(2.0 * np.pi * np.arange(count) * pitch)
    return LineCase(
        periodic=True,
        load=exact.load_per_wavelength,
        pitch=pitch,
        gaps=-wave,
        hat_averages=-wave * np.sinc(pitch) ** 2,
        heights=wave,
        expected=exact.pressure(np.arange(REFINED * count) * (pitch / REFINED)),
    )


def rough(count: int, seed: int) -> LineCase:
    """Self-affine line with a tenth of it in contact; the shortest wave has SHORTEST pitches."""
    waves = rough_waves(count, seed, SHORTEST / count)
    load = load_for_share(count, waves)
    heights = sampled(waves, count)
    return LineCase(
        periodic=True,
        load=load,
        pitch=1.0 / count,
        gaps=-heights,
        hat_averages=hat_averages(waves, count),
        heights=heights,
        expected=_solved(waves, REFINED * count, load).pressure,
    )


@lru_cache(maxsize=8)
def rough_waves(count: int, seed: int, shortest: float) -> np.ndarray:
    """Coefficients of the waves k = 0 to n/2 of a self-affine line of unit length [m]."""
    kind = {"hurst": HURST, "rms_slope": RMS_SLOPE, "shortest_wavelength": shortest}
    profile = self_affine(samples=count + 1, length=1.0, seed=seed, **kind)
    return np.fft.rfft(profile.height[:-1]) / count


def sampled(waves: np.ndarray, count: int) -> np.ndarray:
    """Heights (count,) [m] of these waves; `count` resolves the shortest one."""
    return np.fft.irfft(waves * count, count)


def hat_averages(waves: np.ndarray, count: int) -> np.ndarray:
    """Gaps -z averaged over `count` hats, (count,) [m]: a hat's transform is sinc^2."""
    return -sampled(waves * np.sinc(np.arange(len(waves)) / count) ** 2, count)


def load_for_share(count: int, waves: np.ndarray) -> float:
    """P [N/m] that brings CONTACT_SHARE of `count` nodes in contact, to a node or so."""
    low, high = 1e-3 * RMS_SLOPE, RMS_SLOPE
    for _ in range(14):
        middle = np.sqrt(low * high)
        share = np.mean(_solved(waves, count, middle).pressure > 0.0)
        low, high = (middle, high) if share < CONTACT_SHARE else (low, middle)
    return float(np.sqrt(low * high))


def _solved(waves: np.ndarray, count: int, load: float) -> ContactSolution:
    pitch = 1.0 / count
    operator, gap = PeriodicHalfPlane(count, pitch, 1.0), pitch * hat_averages(waves, count)
    return solve_contact(operator, gap, np.full(count, pitch), Constraints(load=load))
