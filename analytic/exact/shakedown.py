"""Elastic shakedown of a line contact that rolls and slides over a half-plane again and again.

After the first passes residual stresses may be left under which nothing flows any more. In plane
strain, the same for every x along the surface, they are a stress r(z) along the surface and one
across the plane. By Melan's theorem the body shakes down where some r(z) keeps, at every depth and
all the time, the sum of both stresses within the yield surface; each point under a moving contact
meets the stresses of all x. With the principal shear in the plane (Tresca's criterion, the stress
across the plane being kept between the two others by its own residual stress) the limit is

    k/p0 = max over z of min over r of max over x of sqrt(((sx + r - sz)/2)^2 + txz^2)/p0,

never below max |txz|/p0. Sources: Johnson and Jefferis 1963, Symposium on Fatigue in Rolling
Contact, Inst. Mech. Eng., London; K. L. Johnson, Contact Mechanics, 1985, section 9.2:
p0/k = 4.00 without friction, and 1/mu, by the surface, above a friction of 0.367.

Nomenclature: a half-width [m], p0 peak pressure [Pa] of Hertz's contact, mu friction coefficient,
k yield stress in pure shear [Pa]."""

from functools import lru_cache

import numpy as np

from analytic.exact.hertz import HertzContact, hertz_stress

UNIT = HertzContact(1.0, 1.0, 0.5 * np.pi, 1.0, 2.0)
FARTHEST = 6.0  # half-widths ahead and behind: beyond, no |txz| or difference decides
POINTS = 1201
DEPTHS, ZOOMS = 41, 6  # of a search whose step shrinks to 2/40 of the range each time
HALVINGS = 60  # of the bracket of r


@lru_cache(maxsize=64)
def shakedown_limit(friction: float) -> tuple[float, float]:
    """Largest p0/k at which the body shakes down, and the depth z/a that decides it.
    friction >= 0: the tangential traction is friction times the pressure. Good to 1e-5. Raises
    ValueError for a friction that is negative or not finite."""
    if not (np.isfinite(friction) and friction >= 0.0):
        raise ValueError(f"friction must be finite and not negative, not {friction:g}")
    low, high = 0.0, 2.0
    for _ in range(ZOOMS):
        depth = np.linspace(low, high, DEPTHS)
        shear = _least_shear(depth, friction)
        best, step = depth[shear.argmax()], depth[1] - depth[0]
        low, high = max(0.0, best - step), best + step
    return float(1.0 / shear.max()), float(best)


def _places() -> np.ndarray:
    """x/a (n,), dense next to the edges, where the stresses of a shallow depth change fast."""
    angle = np.linspace(0.0, np.pi, POINTS)
    beside = 1.0 + (FARTHEST - 1.0) * np.linspace(0.0, 1.0, POINTS // 2) ** 3
    return np.unique(np.concatenate([np.cos(angle), beside, -beside]))


def _least_shear(depth: np.ndarray, friction: float) -> np.ndarray:
    """Largest principal shear (n,) [p0] that every point at depths (n,) [a] meets under the best
    residual stress r: convex in r, whose bracket is cut by thirds."""
    stress = hertz_stress(UNIT, _places(), depth[:, None], friction)
    apart, square = stress.sx - stress.sz, stress.txz**2

    def shear(r: np.ndarray) -> np.ndarray:
        return np.sqrt((0.25 * (apart + r[:, None]) ** 2 + square).max(axis=1))

    low, high = -apart.max(axis=1), -apart.min(axis=1)
    for _ in range(HALVINGS):
        third = (high - low) / 3.0
        left = shear(low + third) <= shear(high - third)
        low, high = np.where(left, low, low + third), np.where(left, high - third, high)
    return shear(0.5 * (low + high))
