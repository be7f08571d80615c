"""Normal displacement of the surfaces under sliding traction, and compliances that contain it.

Ahead of a traction q = mu p in +x the surface of a half-plane is pushed into the body, behind it it
rises, each by the same constant: e_z = (1+nu)/E ((1-nu) sz - nu sx) of the simple radial field of a
tangential line load (Johnson 1985, eq. 2.20) integrated over the depth gives

    u_z(x) = (1-2nu)(1+nu)/(2E) integral q(s) sign(x - s) ds,     positive into the body.

The roller takes -q and is turned over: its displacement is subtracted. With Dundurs' beta of body
and roller (`analytic.material.dundurs_constants`) the mutual displacement is

    u(x) = (beta / E*) integral q(s) sign(x - s) ds,

nothing for equal materials. Being odd in x - s it does no work, p'Tp = 0: with it the compliance is
not symmetric but positive definite as before, and its contact problem has exactly one solution.

    h      pitch [m]             E*    modulus [Pa]
    phi    hat of height 1       beta  Dundurs' constant      mu   friction coefficient
    C, T   normal and tangential compliance, integral phi_i u dx [m^2/Pa]"""

from functools import cached_property

import numpy as np
import scipy.linalg
from numpy.typing import ArrayLike

from analytic.material import Material
from analytic.operators.convolution import DIRECT, Convolution
from analytic.operators.half_plane import HalfPlane


def hat_sign(offset: ArrayLike) -> np.ndarray:
    """The sign of the distance of two hats, averaged over both, `offset` pitches apart, any shape.
    int int (1-|s|) (1-|t|) sign(offset + t - s) ds dt: odd, 11/12 at 1 and exactly 1 from 2 on;
    between them the integral of the cubic spline that two hats make."""
    offset = np.asarray(offset, dtype=float)
    x = np.abs(offset)
    near = x * (4.0 / 3.0 + x**2 * (x / 4.0 - 2.0 / 3.0))
    far = 1.0 - np.maximum(2.0 - x, 0.0) ** 4 / 12.0
    return np.sign(offset) * np.where(x < 1.0, near, far)


class TangentialHalfPlane(Convolution):
    """T of half-planes, hat tractions (n,) [Pa] in +x to weighted displacements (n,) [m^2].

    count       number of elements      pitch    h [m]
    compliance  [1/Pa] beta / E*; `tangential_compliance` of one half-plane alone"""

    def __init__(self, count: int, pitch: float, compliance: float) -> None:
        self.pitch, self.arguments, self._compliance = pitch, (compliance,), compliance
        column = compliance * pitch**2 * hat_sign(np.arange(count))
        super().__init__(column, self._symbol, row=-column)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """-2i/k beta/E* seen through two hats, with the nearest aliases."""
        c = np.where(cycles == 0.0, 0.5 * cycles[1], cycles)  # the mean: any value
        seen = (np.sin(np.pi * c) / np.pi) ** 4 * (c**-5 - (1.0 - c) ** -5 + (1.0 + c) ** -5)
        return self.pitch**2 / np.pi * self._compliance * (-1j * seen)


def tangential_compliance(material: Material) -> float:
    """beta / E* [1/Pa] of one half-plane under a traction on it in +x."""
    nu = material.poissons_ratio
    return (1.0 - 2.0 * nu) * (1.0 + nu) / (2.0 * material.youngs_modulus)


class CoupledPair(Convolution):
    """C + mu T of two convolutions on the same grid, in one: an application costs what C alone
    does.

    normal      C, symmetric positive definite
    tangential  T: normal displacement under hats of traction q in +x, skew
    friction    mu, positive for sliding traction on the body in +x"""

    def __init__(self, normal: Convolution, tangential: Convolution, friction: float) -> None:
        self.normal, self.tangential, self.friction = normal, tangential, friction
        odd = friction * tangential.column
        self.pitch, self.skew = normal.pitch, bool(odd.any())
        row = normal.column - odd if self.skew else None
        super().__init__(normal.column + odd, self._symbol, row)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        return self.normal.symbol(cycles) + self.friction * self.tangential.symbol(cycles)

    def solve(self, nodes: np.ndarray, right: np.ndarray) -> np.ndarray | None:
        """See `Convolution`; by elimination."""
        if not self.skew:
            return super().solve(nodes, right)
        if len(nodes) > DIRECT:
            return None
        return scipy.linalg.solve(self.block(nodes), right, check_finite=False)

    @cached_property
    def coarser(self) -> "CoupledPair | None":
        """Pair on elements twice as wide, centred on nodes 1, 3, 5, …"""
        normal, tangential = self.normal.coarser, self.tangential.coarser
        if normal is None or tangential is None:
            return None
        return CoupledPair(normal, tangential, self.friction)


def coupled_half_planes(
    count: int, pitch: float, modulus: float, friction_dundurs: float
) -> CoupledPair:
    """Two half-planes; count, pitch h [m] and modulus E* [Pa] as in `HalfPlane`, `friction_dundurs`
    is mu beta."""
    normal = HalfPlane(count, pitch, modulus)
    return CoupledPair(normal, TangentialHalfPlane(count, pitch, friction_dundurs / modulus), 1.0)
