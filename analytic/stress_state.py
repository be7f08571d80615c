"""Stresses in the x-z plane as data, and the scalars made of them.

Both models report their stresses in this type. Stresses [Pa] are positive in tension, z points
into the body, and the body is in plane strain.

Nomenclature: sx, sz normal stresses, txz orthogonal shear, sy the stress across the plane,
tau1 the principal shear, half the difference of the principal stresses in the plane, nu Poisson's
ratio.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class StressState:
    """`sx`, `sz` and `txz` [Pa]: arrays of one shape, one value a point."""

    sx: np.ndarray
    sz: np.ndarray
    txz: np.ndarray

    def __post_init__(self) -> None:
        if not np.shape(self.sx) == np.shape(self.sz) == np.shape(self.txz):
            raise ValueError("sx, sz and txz must be of equal shape")

    @property
    def parts(self) -> np.ndarray:
        """sx, sz and txz (3, …) [Pa]."""
        return np.array([self.sx, self.sz, self.txz])

    def plus(self, factor: float, other: "StressState") -> "StressState":
        """These stresses and `factor` times the others."""
        return StressState(*(self.parts + factor * other.parts))

    def sy(self, poissons_ratio: float) -> np.ndarray:
        """Stress across the plane [Pa], nu (sx + sz) in plane strain."""
        return poissons_ratio * (self.sx + self.sz)

    @cached_property
    def tau1(self) -> np.ndarray:
        """Principal shear in the plane [Pa], sqrt(((sx - sz)/2)^2 + txz^2) >= 0. sy is sometimes an
        extreme principal stress near the surface; the largest shear over all directions can then
        exceed tau1."""
        return np.hypot(0.5 * (self.sx - self.sz), self.txz)

    def von_mises(self, poissons_ratio: float) -> np.ndarray:
        """Equivalent stress of von Mises [Pa], sy included.
        With sy = nu (sx + sz): sqrt(3 tau1^2 + ((1 - 2 nu) (sx + sz)/2)^2)."""
        mean = 0.5 * (self.sx + self.sz)
        return np.hypot(np.sqrt(3.0) * self.tau1, (1.0 - 2.0 * poissons_ratio) * mean)


def von_mises(stress: StressState, sy: np.ndarray) -> np.ndarray:
    """Equivalent stress of von Mises [Pa] with any stress `sy` [Pa] across the plane."""
    normal = (stress.sx - stress.sz) ** 2 + (stress.sz - sy) ** 2 + (sy - stress.sx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * stress.txz**2)


@dataclass(frozen=True)
class Extremum:
    """An extreme `value` [Pa] of a stress and where it stands: `x`, `z` [m]."""

    value: float
    x: float
    z: float

    @classmethod
    def highest(cls, values: np.ndarray) -> "Extremum":
        """The largest of values with their x and z (3, k)."""
        return cls(*map(float, values[:, np.argmax(values[0])]))
