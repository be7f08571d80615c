"""A layer on a rigid base or bonded to a half-plane, under one wave of pressure and of traction.

      p cos kx, q sin kx         p positive in compression, q acting on the layer in +x
    ----------------------> x    E, nu, G       t
    ///////// or E2, nu2, G2     a rigid base, or another half-plane that the layer is bonded to
            z                    plane strain; u positive into the body and in +x

The solution is in `analytic.layers.waves`. Where k is large the layer is a half-plane; what the
base adds to that decays like e^-2kt on the surface and like e^-k(2t - z) below it.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from analytic.layers.waves import Contrast, added, coupling, normal, tangential
from analytic.material import Material

Base = Literal["bonded", "frictionless"]

_LONGEST = 1e-100  # w so small that every limit is reached


@dataclass(frozen=True)
class LayeredBody:
    """A layer of `material` and `thickness` t [m] on a `base`.

    base  a rigid one that the layer is "bonded" to, or that it slides on, "frictionless"; or the
          Material of a half-plane that it is bonded to
    """

    material: Material
    thickness: float
    base: Base | Material

    def __post_init__(self) -> None:
        if not (np.isfinite(self.thickness) and self.thickness > 0.0):
            raise ValueError(f"the layer's thickness must be positive, not {self.thickness:g} m")
        if not (isinstance(self.base, Material) or self.base in ("bonded", "frictionless")):
            raise ValueError(
                f'the base must be "bonded", "frictionless" or a material, not {self.base!r}'
            )

    @property
    def rigid(self) -> bool:
        """Whether displacements count from a rigid base."""
        return not isinstance(self.base, Material)

    @property
    def contrast(self) -> Contrast:
        e = 1.0 - 2.0 * self.material.poissons_ratio
        if self.rigid:
            return Contrast(e, slides=self.base == "frictionless")
        softness = self.material.shear_modulus / self.base.shear_modulus
        return Contrast(e, 1.0 - 2.0 * self.base.poissons_ratio, softness)


@dataclass(frozen=True)
class WaveCompliance:
    """Surface displacements a wave of unit amplitude makes [m/Pa], arrays shaped as k.

    normal      uz under p: uz cos kx under cos kx
    coupling    uz under q, uz cos kx under sin kx, and ux under p, ux sin kx under cos kx
    tangential  ux under q: ux sin kx under sin kx

    A load exp(ikx) of either sign of k therefore gives uz = normal p + i sign(k) coupling q.
    """

    normal: np.ndarray
    coupling: np.ndarray
    tangential: np.ndarray


@dataclass(frozen=True)
class WaveStress:
    """Stresses in the layer under a wave of unit amplitude: sx cos kx, sz cos kx, txz sin kx."""

    sx: np.ndarray
    sz: np.ndarray
    txz: np.ndarray


def wave_compliance(body: LayeredBody, wavenumber: ArrayLike) -> WaveCompliance:
    """Displacements of the surface under waves of k [1/m], any shape, k >= 0.

    At k = 0 they are the limits, infinite where the body gives way as a whole: on a half-plane,
    and along a frictionless base.
    """
    k = np.asarray(wavenumber, dtype=float)
    scale = body.thickness / (2.0 * body.material.shear_modulus)
    w = np.maximum(k * body.thickness, _LONGEST)
    layer = body.contrast
    with np.errstate(over="ignore"):
        return WaveCompliance(
            normal_compliance(body, k),
            scale * (coupling(layer, w) / w),
            scale * (tangential(layer, w) / w),
        )


def normal_compliance(body: LayeredBody, wavenumber: ArrayLike) -> np.ndarray:
    """`wave_compliance(…).normal` alone [m/Pa]."""
    w = np.maximum(np.asarray(wavenumber, dtype=float) * body.thickness, _LONGEST)
    return body.thickness / (2.0 * body.material.shear_modulus) * normal(body.contrast, w)


def wave_stress(
    body: LayeredBody, wavenumber: ArrayLike, z: ArrayLike
) -> tuple[WaveStress, WaveStress]:
    """Stresses under p cos kx alone and under q sin kx alone, at depths 0 <= z <= t [m].

    k [1/m], k > 0, and z are broadcast together. Raises ValueError for a depth outside the layer.
    """
    k, z = np.broadcast_arrays(np.asarray(wavenumber, dtype=float), np.asarray(z, dtype=float))
    normal, traction = added_stress(body, k, z)
    depth, decay = k * z, np.exp(-k * z)
    return (
        WaveStress(
            normal.sx - (1.0 - depth) * decay,
            normal.sz - (1.0 + depth) * decay,
            normal.txz - depth * decay,
        ),
        WaveStress(
            traction.sx + (2.0 - depth) * decay,
            traction.sz + depth * decay,
            traction.txz - (1.0 - depth) * decay,
        ),
    )


def added_stress(
    body: LayeredBody, wavenumber: np.ndarray, z: np.ndarray
) -> tuple[WaveStress, WaveStress]:
    """`wave_stress` less that of a half-plane of the layer's material: what the base adds.

    With r = (m - that of the half-plane)/(1 + e), its two columns a = (r11, r12), (r12, r22)
    under p and under q, and Z = k z:

        sz  = -(Z cosh Z - sinh Z) a1 - Z sinh Z a2
        txz =   Z sinh Z a1 + (Z cosh Z + sinh Z) a2
        sx  =  (Z cosh Z + sinh Z) a1 + (2 cosh Z + Z sinh Z) a2
    """
    if np.any((z < 0.0) | (z > body.thickness * (1.0 + 1e-12))):
        raise ValueError(f"depths must lie in the layer, from 0 to {body.thickness:g} m")
    w = np.maximum(wavenumber * body.thickness, _LONGEST)
    depth = w * np.minimum(z / body.thickness, 1.0)
    rise = 2.0 * np.exp(depth - 2.0 * w)  # 4 e^-2w times half of e^Z
    sinh, cosh = -rise * np.expm1(-2.0 * depth), rise * (1.0 + np.exp(-2.0 * depth))
    r11, r12, r22 = added(body.contrast, w)

    def under(first: np.ndarray, second: np.ndarray) -> WaveStress:
        both = depth * cosh + sinh
        return WaveStress(
            sx=both * first + (2.0 * cosh + depth * sinh) * second,
            sz=-(depth * cosh - sinh) * first - depth * sinh * second,
            txz=depth * sinh * first + both * second,
        )

    return under(r11, r12), under(r12, r22)
