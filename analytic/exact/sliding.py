"""Cylinder that slides on a half-plane of another material: pressure and traction coupled.

    -------- +x: traction q = mu p on the half-plane, which the cylinder drags along
     \\    /   cylinder of radius R, apex at x = 0
    --\\__/--  contact on -b < x < c
         z into the half-plane

Nomenclature: mu friction coefficient, beta Dundurs' constant with the cylinder as first body,
E* combined modulus [Pa], R radius of relative curvature [m], P load per length [N/m], h half of
the contact's length [m], n = arctan(beta mu)/pi, f = 1/2 + n, r = 1/2 - n the exponents at the
leading edge c and at the trailing edge -b.

The traction presses the surface in front of it down and raises it behind: the displacement into
the body has the slope (2 beta/E*) q besides the pressure's, so that

    (1/pi) int p(t)/(x - t) dt - beta mu p(x) = E* x/(2 R)     (Johnson 1985, section 7.2)

is solved, with p bounded at both edges, by

    p = (E*/2R) cos(pi n) (c - x)^f (x + b)^r,   c = 2 r h,   b = 2 f h,
    P = pi E* h^2 (1 - 4 n^2)/(4 R),   peak at x = -4 n h, centre of the contact at x = -2 n h.

The contact moves against the traction for beta mu > 0; it mirrors when the sliding reverses or
when the stiffer body is the half-plane. beta mu = 0 is Hertz's contact."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from analytic.numerics import check_positive


@dataclass(frozen=True)
class SlidingContact:
    """A sliding cylinder: `radius` R [m], `combined_modulus` E* [Pa], `load_per_length` P [N/m],
    `friction` mu, `dundurs_beta`, `half_width` h [m], half of the contact's length."""

    radius: float
    combined_modulus: float
    load_per_length: float
    friction: float
    dundurs_beta: float
    half_width: float

    @property
    def exponent_shift(self) -> float:
        """n = arctan(beta mu)/pi: 1/2 + n is the exponent at the leading edge."""
        return float(np.arctan(self.dundurs_beta * self.friction) / np.pi)

    @property
    def edges(self) -> tuple[float, float]:
        """-b and c [m]."""
        n = self.exponent_shift
        return -(1.0 + 2.0 * n) * self.half_width, (1.0 - 2.0 * n) * self.half_width

    @property
    def peak_position(self) -> float:
        """x [m] of the largest pressure."""
        return -4.0 * self.exponent_shift * self.half_width

    @property
    def peak_pressure(self) -> float:
        """Largest pressure [Pa]: (E* h/R) cos(pi n) f^f r^r."""
        n = self.exponent_shift
        front, rear = 0.5 + n, 0.5 - n
        return float(2.0 * self._scale * front**front * rear**rear)

    @property
    def load_position(self) -> float:
        """x [m] of the resultant of the pressure: -8 n h/3."""
        return -8.0 / 3.0 * self.exponent_shift * self.half_width

    def pressure(self, x: ArrayLike) -> np.ndarray:
        """Pressure [Pa] at x [m] from the apex, zero outside the contact."""
        x, n = np.asarray(x, dtype=float), self.exponent_shift
        left, right = self.edges
        front = np.maximum((right - x) / self.half_width, 0.0)
        rear = np.maximum((x - left) / self.half_width, 0.0)
        return self._scale * front ** (0.5 + n) * rear ** (0.5 - n)

    @property
    def _scale(self) -> float:
        """(E* h/2R) cos(pi n) [Pa]."""
        cosine = 1.0 / np.hypot(1.0, self.dundurs_beta * self.friction)
        return self.combined_modulus * self.half_width / (2.0 * self.radius) * cosine


def sliding_from_load(
    load_per_length: float,
    radius: float,
    combined_modulus: float,
    friction: float,
    dundurs_beta: float,
) -> SlidingContact:
    """Contact under P [N/m] with R [m], E* [Pa], mu and beta, either of the latter of any sign.
    Raises ValueError unless P, R and E* are positive and mu and beta finite."""
    check_positive(
        load_per_length=load_per_length, radius=radius, combined_modulus=combined_modulus
    )
    if not (np.isfinite(friction) and np.isfinite(dundurs_beta)):
        raise ValueError("friction and dundurs_beta must be finite")
    n = np.arctan(dundurs_beta * friction) / np.pi
    area = 4.0 * load_per_length * radius / (np.pi * combined_modulus)
    half_width = np.sqrt(area / ((1.0 - 2.0 * n) * (1.0 + 2.0 * n)))
    return SlidingContact(
        radius, combined_modulus, load_per_length, friction, dundurs_beta, float(half_width)
    )
