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

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analytic.numerics import check_positive

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
