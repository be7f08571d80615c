"""Quasi-steady temperature of a half-space whose surface passes a source of heat at rest.

The source moves in +x over the material, the material passes it in -x, at the speed V [m/s]. With
X = V x / (2 kappa), Z = V z / (2 kappa), R = hypot(X, Z), a line source of Q [W/m] gives

    T = Q / (pi k) e^{-X} K0(R)

above the temperature far away (Jaeger 1942; Carslaw and Jaeger 1959, section 10.7).
"""

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import k0e

from analytic.material import ThermalMaterial
from analytic.operators.convolution import Convolution

# Quadrature of the kernel over a cell: away from its logarithm by few Gauss points, more for the
# next cells; in the two cells that meet there after x = t^POWER, which leaves nothing singular.
_FAR, _FAR_POINTS, _NEXT_POINTS = 8, 6, 16
_POWER, _SINGULAR_POINTS = 8, 72


@dataclass(frozen=True)
class HeatedSurface:
    """A half-space under fluxes that are piecewise linear between nodes of one pitch."""

    material: ThermalMaterial
    count: int  # nodes
    pitch: float  # [m]
    velocity: float  # [m/s] at which the material passes the contact, towards +x; 0: at rest
    # [m] where a half-space at rest has the temperature from which rises count
    reach: float = np.inf

    def __post_init__(self) -> None:
        if self.velocity == 0.0 and not np.isfinite(self.reach):
            raise ValueError("a half-space at rest has no steady temperature without a reach")

    @property
    def peclet(self) -> float:
        """V h / (2 kappa) of the pitch h, positive for a source that moves towards +x."""
        return -self.velocity * self.pitch / (2.0 * self.material.diffusivity)

    def at(self, depth: float) -> Convolution:
        """T [K] at `depth` [m] below the nodes by the fluxes [W/m^2] of hats, as an operator."""
        whole, first = _cell_integrals(
            self.count, self.peclet, depth / self.pitch, self.reach / self.pitch
        )
        # a hat at m is falling on the cell before it and rising on the one behind
        hats = whole[1:] - first[1:] + first[:-1]  # from count - 1 pitches behind to as far before
        kernel = self.pitch / (np.pi * self.material.conductivity) * hats
        return Convolution(kernel[self.count - 1 :], None, row=kernel[self.count - 1 :: -1])

    @cached_property
    def surface(self) -> Convolution:
        """`at` no depth."""
        return self.at(0.0)

    def rise(self, flux: np.ndarray, depth: float = 0.0) -> np.ndarray:
        """T [K] at the nodes, at a depth [m], under fluxes (n,) [W/m^2] at the nodes."""
        return (self.surface if depth == 0.0 else self.at(depth)).apply(flux)

    def field(self, flux: np.ndarray, depths: ArrayLike) -> np.ndarray:
        """T [K] (m, n) at depths (m,) [m] below the nodes."""
        return np.array([self.rise(flux, float(depth)) for depth in np.ravel(depths)])


def _cell_integrals(
    count: int, peclet: float, depth: float, reach: float
) -> tuple[np.ndarray, np.ndarray]:
    """Integrals of f and s f over the cells from m to m + 1 = m + s pitches, m from -count to
    count - 1, with f = e^{-X} K0(R), or ln(reach / r) at rest; lengths in pitches."""
    cells = np.arange(-count, count)
    integrals = np.empty((2, 2 * count))
    far = (cells >= _FAR) | (cells < -_FAR)
    near = (cells == 0) | (cells == -1)
    points, weights = _gauss(_SINGULAR_POINTS)
    singular = points**_POWER, weights * _POWER * points ** (_POWER - 1)
    for part, (place, weight) in (
        (far, _gauss(_FAR_POINTS)),
        (~far & ~near, _gauss(_NEXT_POINTS)),
        (cells == 0, singular),
        (cells == -1, (-singular[0], singular[1])),  # counted from its end, where the source is
    ):
        start = np.where(cells[part] == -1, 0, cells[part])[:, None]
        share = place if place[0] > 0.0 else 1.0 + place
        value = line_source(start + place, peclet, depth, reach)
        integrals[0, part], integrals[1, part] = value @ weight, value @ (weight * share)
    return integrals[0], integrals[1]


def line_source(
    x: np.ndarray, peclet: float, depth: float | np.ndarray, reach: float = np.inf
) -> np.ndarray:
    """e^{-X} K0(R) at points x before the source, or ln(reach / r) at rest: pi k T / Q. Lengths in
    a unit of which `peclet` is -velocity / (2 kappa)."""
    distance = np.hypot(x, depth)
    if peclet == 0.0:
        return np.log(reach / distance)
    scaled = abs(peclet) * distance
    # X + R without cancellation behind the source
    ahead = np.sign(peclet) * x
    behind = depth**2 / (distance + np.abs(x))
    exponent = np.where(ahead < 0.0, behind, distance + ahead)
    return np.exp(-abs(peclet) * exponent) * k0e(scaled)


@cache
def _gauss(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights on 0 to 1."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return 0.5 * (1.0 + points), 0.5 * weights
