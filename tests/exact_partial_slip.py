"""Cylinder under a tangential load below the limit of friction: stick zone, slip, energy lost.

    q   traction on the body towards +x [Pa]     P, Q   normal and tangential load [N/m]
    a, p0, E*   Hertz's contact                  mu     friction      l = Q / (mu P), 0 <= l < 1
    s   bulk stress of the body along x [Pa], applied with Q; its strain is s / E', alike bodies
        having E' = 2 E*
    c, e   half-width and middle of the stick zone [m]

Of alike bodies (Cattaneo 1938, Mindlin 1949; e by Nowell and Hills 1987, Int. J. Mech. Sci. 29,
355-365, valid while the stick zone stays inside, s <= 4 mu p0 (1 - c/a)):

    q = mu p0 [sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - (x - e)^2/c^2)],  c = a sqrt(1 - l),
    e = s a/(4 mu p0).

Without bulk stress the roller's displacement D follows from dD/dQ, which is that of bonded surfaces
|x| < c, (2/(pi E*)) ln(2 L/c) for a datum L. Against surfaces that stick all over it is ahead by

    D - D_stick = (mu P/(pi E*)) [l + (1 - l) ln(1 - l)],

and a cycle between Q and -Q, whose branches are D doubled in both directions (Masing's rule), loses

    W = 4 Q D - 8 int D dQ = (2 (mu P)^2/(pi E*)) [2 l - l^2 + 2 (1 - l) ln(1 - l)],

(2/3) (mu P)^2 l^3/(pi E*) for small l: Mindlin and Deresiewicz' cycle (1953) in plane strain. The
largest tension is at the trailing edge, x = -a: 2 mu p0 sqrt(l), of which sliding leaves 2 mu p0.
Beyond the stick zone the integral of q/(x - t) is pi mu p0 sqrt(x^2 - c^2)/a with the sign of x.
The surfaces slip there by s, in a cycle between Q and -Q by as much to both sides of the middle,

    s = (mu p0/(a E*)) [|x| sqrt(x^2 - c^2) - c^2 arcosh(|x|/c)],   sx = -p - (2 mu p0/a) sgn(x)
        sqrt(x^2 - c^2).

Unlike bodies that are pressed alone stick for |x| < c, and every form that is pressed on has the
same c/a as a flat punch (Spence 1975, J. Elasticity 5, 297-319). Where tractions do not act back on
the pressure (Goodman 1962) that is K'(c/a)/K(c/a) = beta/mu, K' of the complementary modulus: the
quotient of int q/(x - t) dt and int p/(x - t) dt under the punch maps the body on a rectangle, 2 mu
by beta, whose corners are the ends of the zones."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import ellipkm1

from analytic.exact.hertz import HertzContact


@dataclass(frozen=True)
class SlippingContact:
    """Alike bodies: Hertz's contact under `share` l of the load that makes it slide."""

    hertz: HertzContact
    friction: float
    share: float
    bulk_stress: float = 0.0  # of the body [Pa]

    @property
    def stick_half_width(self) -> float:
        """c [m]."""
        return self.hertz.half_width * (1.0 - self.share) ** 0.5

    @property
    def offset(self) -> float:
        """e [m]."""
        limit = self.friction * self.hertz.peak_pressure
        return 0.25 * self.bulk_stress * self.hertz.half_width / limit

    def traction(self, x: ArrayLike) -> np.ndarray:
        """q [Pa] at x [m]."""
        a, c = self.hertz.half_width, self.stick_half_width
        whole, held = (
            np.sqrt(np.maximum(half**2 - (np.asarray(x) - middle) ** 2, 0.0))
            for half, middle in ((a, 0.0), (c, self.offset))
        )
        return self.friction * self.hertz.peak_pressure / a * (whole - held)

    def slip(self, x: ArrayLike) -> np.ndarray:
        """s [m] at x [m] of the contact, without bulk stress."""
        c, far = self.stick_half_width, np.abs(x)
        far = np.maximum(far, c)
        unit = self.friction * self.hertz.peak_pressure
        unit /= self.hertz.half_width * self.hertz.combined_modulus
        return unit * (far * np.sqrt(far**2 - c**2) - c**2 * np.arccosh(far / c))

    def surface_stress(self, x: ArrayLike) -> np.ndarray:
        """sx [Pa] at x [m] of the contact, without bulk stress."""
        a, x = self.hertz.half_width, np.asarray(x)
        beyond = np.sqrt(np.maximum(x**2 - self.stick_half_width**2, 0.0))
        pulled = 2.0 * self.friction * self.hertz.peak_pressure / a * np.sign(x) * beyond
        return -self.hertz.pressure(x) - pulled

    @property
    def beyond_stick(self) -> float:
        """D - D_stick [m], without bulk stress."""
        slipped = self.share + (1.0 - self.share) * np.log1p(-self.share)
        return float(self._unit / self._limit * slipped)

    @property
    def energy_of_cycle(self) -> float:
        """W [J/m], without bulk stress."""
        left = 1.0 - self.share
        return float(2.0 * self._unit * (1.0 - left**2 + 2.0 * left * np.log(left)))

    @property
    def edge_tension(self) -> float:
        """Largest sx of the surface [Pa], at x = -a; of a bulk stress of 0."""
        return 2.0 * self.friction * self.hertz.peak_pressure * self.share**0.5

    @property
    def _limit(self) -> float:
        return self.friction * self.hertz.load_per_length

    @property
    def _unit(self) -> float:
        """(mu P)^2/(pi E*) [J/m]."""
        return self._limit**2 / (np.pi * self.hertz.combined_modulus)


def pressed_stick_ratio(dundurs_beta: float, friction: float) -> float:
    """c/a of unlike bodies under a normal load that has grown from nothing, by Goodman's theory."""
    wanted = np.log(abs(dundurs_beta) / friction)

    def excess(logarithm: float) -> float:
        k = np.exp(logarithm)
        # scipy's ellipkm1(p) is K at the parameter m = 1 - p
        return np.log(ellipkm1(k**2) / ellipkm1((1.0 - k) * (1.0 + k))) - wanted

    return float(np.exp(brentq(excess, -300.0, -1e-15)))
