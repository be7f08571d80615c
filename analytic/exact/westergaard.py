"""Sinusoidal surface pressed against a flat one without friction: partial and full contact.

    flat      ------------------------        g0(x) = A (1 - cos 2 psi),   psi = pi x/lambda
                 _         _
    wavy       _/ \\_     _/ \\_   crest at x = 0; contact on |x| < a and once a wavelength
              /     \\___/     \\

Nomenclature: lambda wavelength [m], A amplitude [m], half of peak to valley, E* combined modulus
[Pa], pm mean pressure [Pa], p* the mean pressure that closes the last gap [Pa], a half-width [m],
S = sin(pi a/lambda).

    p* = pi E* A/lambda,     pm = p* S^2                       (Westergaard 1939)
    p = 2 p* cos psi sqrt(S^2 - sin^2 psi),  peak 2 p* S       (Johnson 1985, section 13.2)
    p = pm + p* cos 2 psi,  peak pm + p*       once pm >= p*
    mean gap A (1 - r + r ln r),  r = S^2"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import minimize

from analytic.numerics import check_positive, points_below
from analytic.stress.elements import FrictionStress
from analytic.stress.periodic import held_along
from analytic.stress.potential import stresses
from analytic.stress_state import Extremum, StressState

_SERIES = 0.25  # open fraction 1 - r below which the mean gap is summed


@dataclass(frozen=True)
class FlatContact:
    """Flat bodies under a `peak_pressure` [Pa] that is the same everywhere, on one period, twice
    `half_width` [m]: what a periodic surface without its waves is. `load_per_length` [N/m] of a
    period, `combined_modulus` [Pa]."""

    half_width: float
    peak_pressure: float
    combined_modulus: float

    @property
    def load_per_length(self) -> float:
        return 2.0 * self.half_width * self.peak_pressure

    def pressure(self, x: ArrayLike) -> np.ndarray:
        """[Pa] at x [m]."""
        return np.full(np.shape(x), self.peak_pressure)


@dataclass(frozen=True)
class WestergaardContact:
    """A wavy contact: `wavelength` lambda [m], `amplitude` A [m], half of peak to valley,
    `combined_modulus` E* [Pa], `mean_pressure` pm [Pa], `half_width` a [m] of each of the
    patches (lambda/2 in full contact), `peak_pressure` [Pa] at the crests."""

    wavelength: float
    amplitude: float
    combined_modulus: float
    mean_pressure: float
    half_width: float
    peak_pressure: float

    @property
    def closing_pressure(self) -> float:
        """Mean pressure from which the contact is full [Pa]: p* = pi E* A/lambda."""
        return np.pi * self.combined_modulus * self.amplitude / self.wavelength

    @property
    def full(self) -> bool:
        """Whether the surfaces touch everywhere."""
        return self.mean_pressure >= self.closing_pressure

    @property
    def load_per_wavelength(self) -> float:
        """pm lambda [N/m]."""
        return self.mean_pressure * self.wavelength

    @property
    def mean_gap(self) -> float:
        """Separation averaged over a wavelength [m]: A (1 - r + r ln r), r = pm/p*."""
        if self.full:
            return 0.0
        ratio = self.mean_pressure / self.closing_pressure
        gap = (self.closing_pressure - self.mean_pressure) / self.closing_pressure
        if gap > _SERIES:
            return float(self.amplitude * (gap + ratio * np.log(ratio)))
        order = np.arange(40.0, 1.0, -1.0)
        return float(self.amplitude * np.sum(gap**order / (order * (order - 1.0))))

    def pressure(self, x: ArrayLike) -> np.ndarray:
        """Pressure [Pa] at x [m] from a crest, zero where the surfaces are apart."""
        x, unit = self._folded(x), np.pi / self.wavelength
        if self.full:
            return self.mean_pressure + self.closing_pressure * np.cos(2.0 * unit * x)
        cosine = np.sin(unit * (0.5 * self.wavelength - x))
        return 2.0 * self.closing_pressure * cosine * np.sqrt(np.maximum(-self._beyond(x), 0.0))

    def _folded(self, x: ArrayLike) -> np.ndarray:
        """Distance to the nearest crest [m]."""
        x = np.fmod(np.abs(np.asarray(x, dtype=float)), self.wavelength)
        return np.minimum(x, self.wavelength - x)

    def _beyond(self, x: np.ndarray) -> np.ndarray:
        """sin^2 psi - S^2 at `_folded` x, from the distances to the edge and to the valley."""
        unit, half, a = np.pi / self.wavelength, 0.5 * self.wavelength, self.half_width
        return np.sin(unit * (x - a)) * np.sin(unit * np.minimum(x + a, (half - x) + (half - a)))


def westergaard_from_mean_pressure(
    mean_pressure: float, wavelength: float, amplitude: float, combined_modulus: float
) -> WestergaardContact:
    """Contact under pm [Pa] of a wave of lambda [m] and A [m] with E* [Pa]; full from pm = p* on.
    Raises ValueError unless all four are positive."""
    check_positive(mean_pressure=mean_pressure, wavelength=wavelength)
    check_positive(amplitude=amplitude, combined_modulus=combined_modulus)
    closing = np.pi * combined_modulus * amplitude / wavelength
    if mean_pressure >= closing:
        half_width, peak = 0.5 * wavelength, mean_pressure + closing
    else:
        angle = np.arctan2(np.sqrt(mean_pressure), np.sqrt(closing - mean_pressure))
        half_width = float(angle * wavelength / np.pi)
        peak = float(2.0 * np.sqrt(mean_pressure) * np.sqrt(closing))
    return WestergaardContact(
        wavelength, amplitude, combined_modulus, mean_pressure, half_width, peak
    )


def westergaard_stress(
    contact: WestergaardContact,
    x: ArrayLike,
    z: ArrayLike,
    poissons_ratio: float,
    friction: float = 0.0,
) -> StressState:
    """Stresses [Pa] at x from a crest, z >= 0 [m] (broadcast together), under p and q = friction p
    in +x, of a body that does not stretch along x on average. With w = sin psi, psi of the complex
    point x + iz, and R = sqrt(w - S) sqrt(w + S), the surface's p is the real part of

        G = 2i pm cos psi/(w + R),   in full contact G = pm + p* e^(2i psi),

    which is analytic below the surface and tends to pm; Westergaard's Z is -G. Raises ValueError
    for z < 0."""
    x, z = points_below(x, z)
    unit, mean = np.pi / contact.wavelength, contact.mean_pressure
    psi = unit * (np.fmod(x, contact.wavelength) + 1j * z)
    if contact.full:
        wave = contact.closing_pressure * np.exp(2j * psi)
        value, slope = mean + wave, 2j * wave
    else:
        # the strip of half a wavelength on either side of a crest is the half-plane of w
        psi = psi - np.pi * np.round(psi.real / np.pi)
        sine, edge = np.sin(psi), np.sqrt(mean / contact.closing_pressure)
        root = np.sqrt(sine - edge) * np.sqrt(sine + edge)
        value = 2j * mean * np.cos(psi) / (sine + root)
        bend = np.where(root == 0.0, 0.0, np.cos(psi) ** 2 / np.where(root == 0.0, 1.0, root))
        slope = -2j * mean / (sine + root) * (sine + bend)
    parts = stresses(-1j * value, -1j * unit * z * slope)
    return FrictionStress.of(parts, held_along(mean, poissons_ratio)).at(friction)


def westergaard_extremes(
    contact: WestergaardContact, poissons_ratio: float, friction: float = 0.0
) -> dict[str, Extremum]:
    """Largest `tau1` and |`txz`| [Pa] down to a wavelength, and their positions."""
    x = np.linspace(-0.5, 0.5, 241) * contact.wavelength
    z = np.concatenate([[0.0], np.geomspace(1e-4, 1.0, 160)]) * contact.wavelength
    state, extremes = westergaard_stress(contact, x, z[:, None], poissons_ratio, friction), {}
    for name, size in (("tau1", lambda s: s.tau1), ("txz", lambda s: np.abs(s.txz))):
        row, column = np.unravel_index(np.argmax(size(state)), state.sx.shape)
        unit = size(state)[row, column] or 1.0

        def fallen(place: np.ndarray, size: Callable = size, unit: float = unit) -> float:
            below = contact.wavelength * place[0], contact.wavelength * max(place[1], 0.0)
            there = westergaard_stress(contact, *below, poissons_ratio, friction)
            return -float(size(there)) / unit

        start = np.array([x[column], z[row]]) / contact.wavelength
        best = minimize(
            fallen, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-14}
        )
        place = contact.wavelength * np.array([best.x[0], max(best.x[1], 0.0)])
        extremes[name] = Extremum(-best.fun * unit, float(place[0]), float(place[1]))
    return extremes
