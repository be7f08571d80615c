"""Sinusoidal surface pressed against a flat one without friction: partial and full contact.

    flat      ------------------------        g0(x) = A (1 - cos 2 psi),   psi = pi x/lambda
                 _         _
    wavy       _/ \\_     _/ \\_   crest at x = 0; contact on |x| < a and once a wavelength
              /     \\___/     \\

Nomenclature: lambda wavelength [m], A amplitude [m], half of peak to valley, E* combined modulus
[Pa], pm mean pressure [Pa], p* the mean pressure that closes the last gap [Pa], a half-width [m],
psi_a = pi a/lambda, S = sin psi_a, eta = pi z/lambda, theta = psi + i eta.

    p* = pi E* A/lambda,     pm = p* S^2                       (Westergaard 1939)
    p = 2 p* cos psi sqrt(S^2 - sin^2 psi),  peak 2 p* S       (Johnson 1985, section 13.2)
    p = pm + p* cos 2 psi,  peak pm + p*       once pm >= p*

Outside the contact sin psi = S cosh tau, and the gap's slope, (4 p*/E*) cos psi S sinh tau,
integrates to

    g = 2 A S^2 (sinh tau cosh tau - tau),  its mean  A (1 - r + r ln r),  r = S^2.

The stresses follow from the periodic potential of the pressure as those of `exact.hertz` do,

    I = (1/lambda) int p(t) cot(pi (w - t)/lambda) dt = 2 p* cos theta (sin theta - s),
    dI/dtheta = -2 p* (sin theta - s) (1 - sin theta (sin theta - s))/s,
    s = sqrt(sin^2 theta - S^2),

and with W = sin theta/S and W - s/S = B - i A' both parts of Im I have one sign.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analytic.numerics import check_positive, points_below, sinh_minus_argument
from analytic.stress_state import StressState

# Depth pi z/lambda from which nothing of the wave is left and its hyperbolic functions overflow.
_DEEP = 300.0
_SERIES = 0.25  # open fraction 1 - r below which the mean gap is summed


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

    def gap(self, x: ArrayLike) -> np.ndarray:
        """Separation of the deformed surfaces [m] at x [m] from a crest."""
        x = self._folded(x)
        if self.full:
            return np.zeros_like(x)
        depth = np.sqrt(np.maximum(self._beyond(x), 0.0))
        sine = self._sine
        tau = np.arcsinh(depth / sine)
        near = 0.5 * sine**2 * sinh_minus_argument(2.0 * np.minimum(tau, 1.0))
        far = depth * np.hypot(depth, sine) - sine**2 * tau
        return 2.0 * self.amplitude * np.where(tau < 1.0, near, far)

    @property
    def _sine(self) -> float:
        """S."""
        return np.sin(np.pi * self.half_width / self.wavelength)

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

    Raises ValueError unless all four are positive.
    """
    check_positive(
        mean_pressure=mean_pressure,
        wavelength=wavelength,
        amplitude=amplitude,
        combined_modulus=combined_modulus,
    )
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


def westergaard_from_half_width(
    half_width: float, wavelength: float, amplitude: float, combined_modulus: float
) -> WestergaardContact:
    """Contact of half-width a [m] < lambda/2: pm = p* sin^2(pi a/lambda).

    Raises ValueError unless all four are positive and the contact is partial.
    """
    check_positive(
        half_width=half_width,
        wavelength=wavelength,
        amplitude=amplitude,
        combined_modulus=combined_modulus,
    )
    if not half_width < 0.5 * wavelength:
        raise ValueError(
            f"half_width must be below half the wavelength, {0.5 * wavelength:g}, "
            f"not {half_width:g}: full contact has no one load"
        )
    closing = np.pi * combined_modulus * amplitude / wavelength
    sine = np.sin(np.pi * half_width / wavelength)
    return WestergaardContact(
        wavelength,
        amplitude,
        combined_modulus,
        float(closing * sine**2),
        half_width,
        float(2.0 * closing * sine),
    )


def westergaard_stress(
    contact: WestergaardContact,
    x: ArrayLike,
    z: ArrayLike,
    friction: float = 0.0,
    mean_sx: float | None = None,
) -> StressState:
    """Stresses [Pa] at x, z [m] (broadcast together), z >= 0, under p and q = friction p in +x.

    mean_sx  average of sx over a wavelength [Pa], the same at every depth, which the loads leave
             open; default -pm, the sum of the line loads' own fields. A body that cannot
             stretch sideways has -pm nu/(1 - nu).

    Errors are of the order of rounding times the largest of the pressure's potential and its
    gradient times z at the point. At the very edge, as in `hertz_stress`, the limit from the
    surface is taken. Raises ValueError for z < 0.
    """
    x, z = points_below(x, z)
    wave = np.fmod(np.abs(x), contact.wavelength)
    side = np.copysign(1.0, x) * np.where(wave > 0.5 * contact.wavelength, -1.0, 1.0)
    place = np.minimum(wave, contact.wavelength - wave)
    eta = np.pi * z / contact.wavelength
    potential, stretch = (_full if contact.full else _partial)(contact, place, eta)
    along, across = stretch.real, stretch.imag * side
    sx, sz, txz = potential.imag + along, potential.imag - along, -across
    sx_traction = side * (stretch.imag - 2.0 * potential.real)
    offset = 0.0 if mean_sx is None else mean_sx + contact.mean_pressure
    return StressState(
        sx=sx + friction * sx_traction + offset,
        sz=sz + friction * txz,
        txz=txz + friction * sx,
    )


def _full(
    contact: WestergaardContact, x: np.ndarray, eta: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """I = -i (pm + p* exp 2 i theta) and z I' [Pa]."""
    wave = contact.closing_pressure * np.exp(2.0 * (1j * np.pi * x / contact.wavelength - eta))
    return -1j * (contact.mean_pressure + wave), 2.0 * eta * wave


def _partial(
    contact: WestergaardContact, x: np.ndarray, eta: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """I and z I' [Pa] at 0 <= x <= lambda/2."""
    unit, a, sine = np.pi / contact.wavelength, contact.half_width, contact._sine
    depth, half = np.minimum(eta, _DEEP), 0.5 * contact.wavelength
    # The cosine as a sine of the distance to the valley: next to it only that is exact.
    sin_psi, cos_psi = np.sin(unit * x), np.sin(unit * (half - x))
    middle, beyond = 0.5 * unit * (x + a), 0.5 * unit * (x - a)
    rise = 2.0 * sin_psi * np.sinh(0.5 * depth) ** 2  # sin psi (cosh eta - 1)
    right = (2.0 * np.sin(beyond) * np.cos(middle) + rise) / sine
    left = (2.0 * np.sin(middle) * np.cos(beyond) + rise) / sine
    real, imaginary = sin_psi * np.cosh(depth) / sine, cos_psi * np.sinh(depth) / sine
    root = np.sqrt(right + 1j * imaginary) * np.sqrt(left + 1j * imaginary)
    m = root.imag
    n = np.where(m > 0.0, real * imaginary / np.where(m > 0.0, m, 1.0), root.real)
    edge = (m == 0.0) & (n == 0.0)
    square = (real + n) ** 2 + (imaginary + m) ** 2
    shape = (real + n - 1j * (imaginary + m)) / square
    cosine = cos_psi * np.cosh(depth) - 1j * sin_psi * np.sinh(depth)
    scale = 2.0 * contact.closing_pressure
    root, place = n + 1j * m, real + 1j * imaginary
    # 1 - sin theta (sin theta - s), near the surface as sin theta s + cos^2 theta: there it may be
    # small, while deep below those two are large.
    shallow = depth < 1.0
    factor = np.where(
        shallow,
        sine**2 * place * root + np.where(shallow, cosine, 0.0) ** 2,
        1.0 - sine**2 * place * shape,
    )
    slope = shape / np.where(edge, 1.0, root) * factor
    return scale * sine * cosine * shape, -scale * eta * slope
