"""A layer on a rigid base or bonded to a half-plane, under one wave of pressure and of traction.

      p cos kx, q sin kx         p positive in compression, q acting on the layer in +x
    ----------------------> x    E, nu, G       t
    ///////// or E2, nu2, G2     a rigid base, or another half-plane that the layer is bonded to
            z                    plane strain; u positive into the body and in +x

Where k is large the layer is a half-plane; what the base adds to that decays like e^-2kt on the
surface and like e^-k(2t - z) below it.

Elasticity turns into four equations in the depth Z = k z for (2 G k uz, 2 G k ux, sz, txz) with the
eigenvalues 1 and -1, each twice. On the surface, in terms of w = k t,

    uz cos kx:  2 G k uz = m11 p + m12 q          ux sin kx:  2 G k ux = m12 p + m22 q

and with s = sinh w, c = cosh w, e = 1 - 2 nu, n = 1 + 2 e = 3 - 4 nu, g = G/G2, a bonded layer has

    D   = (1+e)^2 + n s^2 + w^2 + 2 g (1+e)(1+e2) c s + g^2 n2 (s^2 - w^2) + 2 g e2 (e s^2 + w^2)
    m11 = (1+e) (n c s - w + 2 g e2 (e c s - w) + g^2 n2 (c s + w) + g (1+e)(1+e2)(c^2 + s^2)) / D
    m22 = (1+e) (n c s + w + 2 g e2 (e c s + w) + g^2 n2 (c s - w) + g (1+e)(1+e2)(c^2 + s^2)) / D
    m12 = -(e n s^2 - w^2 + g (1+e) (2 (1+e2) e c s + e2 (1+e)) + g^2 n2 (e s^2 + w^2)
            + 2 g e2 (e^2 s^2 - w^2)) / D

(g = 0: the base is rigid), and a layer that slides on a rigid base without lifting off

    m11, m22 = (1+e) (s^2, c^2) / (c s + w),      m12 = -e + (1+e) w / (c s + w).

Multiplied by 4 e^-2w all of this is without overflow; m11 and m22 are sums of positive terms, right
to rounding down to w = 0, where m11 may be as small as w^3. What the base adds to the half-plane's
1+e, -e and 1+e, r = (m - that)/(1+e), decays like e^-2w: with A = (g - 1)(g n2 + 1), B = g e2 - e,

    r11, r22 D = (1+e)(B + g - 1) + A (w^2 +- w) - (g - 1)(n - g n2)(1 - e^-2w)/2
    r12 D      = -A w^2 - (1+e) B

The substrate enters by g and e2; stresses depend on Dundurs' constants of the pair alone,
alpha = (1 + e - g (1+e2)) / (1 + e + g (1+e2)) and beta = (e - g e2) / (1 + e + g (1+e2))."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from analytic.material import Material
from analytic.stress_state import StressState

_SERIES = 0.5  # w below which sinh 2w - 2w is summed; 12 terms leave less than rounding


@dataclass(frozen=True)
class Contrast:
    """Constants of a layer and of what it lies on."""

    e: float  # 1 - 2 nu
    base_e: float = 0.0
    softness: float = 0.0  # g = G/G2, zero on a rigid base
    slides: bool = False  # along the base, without friction


def normal(layer: Contrast, w: np.ndarray) -> np.ndarray:
    """m11/w at real or complex w != 0, Re w >= 0: uz under p times 2 G/t."""
    e, wave = layer.e, _Wave.of(w)
    if layer.slides:
        return (1.0 + e) * wave.ss / w / (wave.cs + wave.w)
    total = (2.0 * e * wave.cs + wave.bulge) / w
    if layer.softness:
        e2, g = layer.base_e, layer.softness
        total = total + 2.0 * g * e2 * (e * wave.cs - wave.w) / w
        total = total + g**2 * (1.0 + 2.0 * e2) * (wave.cs + wave.w) / w
        total = total + g * (1.0 + e) * (1.0 + e2) * (wave.cc + wave.ss) / w
    return (1.0 + e) * total / _denominator(layer, wave)


def coupling(layer: Contrast, w: np.ndarray) -> np.ndarray:
    """m12."""
    e, wave = layer.e, _Wave.of(w)
    if layer.slides:
        return ((1.0 - e) * wave.w - e * wave.bulge) / (wave.cs + wave.w)
    total = e * (1.0 + 2.0 * e) * wave.ss - wave.ww
    if layer.softness:
        e2, g = layer.base_e, layer.softness
        total = total + g * (1.0 + e) * (2.0 * (1.0 + e2) * e * wave.cs + e2 * (1.0 + e) * wave.one)
        total = total + g**2 * (1.0 + 2.0 * e2) * (e * wave.ss + wave.ww)
        total = total + 2.0 * g * e2 * (e**2 * wave.ss - wave.ww)
    return -total / _denominator(layer, wave)


def added(layer: Contrast, w: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """r11, r12, r22 over 4 e^-2w."""
    e, wave, gap = layer.e, _Wave.of(w), -np.expm1(-2.0 * w)
    if layer.slides:
        below = wave.cs + wave.w
        return -(0.5 * gap + w) / below, w / below, (1.0 - 0.5 * gap - w) / below
    below, g = _denominator(layer, wave), layer.softness
    e2 = layer.base_e
    mismatch, lift = (g - 1.0) * (g * (1.0 + 2.0 * e2) + 1.0), g * e2 - e
    rest = (1.0 + e) * (lift + g - 1.0)
    rest = rest - 0.5 * (g - 1.0) * (1.0 + 2.0 * e - g * (1.0 + 2.0 * e2)) * gap
    return (
        (mismatch * (w**2 + w) + rest) / below,
        -(mismatch * w**2 + (1.0 + e) * lift) / below,
        (mismatch * (w**2 - w) + rest) / below,
    )


def _denominator(layer: Contrast, wave: "_Wave") -> np.ndarray:
    """4 e^-2w D."""
    e = layer.e
    total = (1.0 + e) ** 2 * wave.one + (1.0 + 2.0 * e) * wave.ss + wave.ww
    if not layer.softness:
        return total
    e2, g = layer.base_e, layer.softness
    total = total + 2.0 * g * (1.0 + e) * (1.0 + e2) * wave.cs
    total = total + g**2 * (1.0 + 2.0 * e2) * wave.swell
    return total + 2.0 * g * e2 * (e * wave.ss + wave.ww)


@dataclass(frozen=True)
class _Wave:
    """1, w, w^2, s^2, c s, c^2, c s - w and s^2 - w^2, all times 4 e^-2w."""

    one: np.ndarray
    w: np.ndarray
    ww: np.ndarray
    ss: np.ndarray
    cs: np.ndarray
    cc: np.ndarray
    bulge: np.ndarray
    swell: np.ndarray

    @classmethod
    def of(cls, w: np.ndarray) -> "_Wave":
        root = np.exp(-w)
        one, gap = 4.0 * root**2, -np.expm1(-2.0 * w)
        return cls(
            one=one,
            w=one * w,
            ww=one * w**2,
            ss=gap**2,
            cs=-np.expm1(-4.0 * w),
            cc=(1.0 + root**2) ** 2,
            bulge=_bulge(w),
            swell=_bulge(0.5 * w) * (gap + 2.0 * root * w),
        )


def _bulge(w: np.ndarray) -> np.ndarray:
    """4 e^-2w (c s - w) = 2 e^-2w (sinh 2w - 2w), right to rounding at any w."""
    decay = np.exp(-2.0 * w)
    small = np.abs(w) < _SERIES
    v = np.where(small, 2.0 * w, 0.0)
    series = np.zeros_like(v)
    for n in range(12, 0, -1):
        series = v**2 / (2.0 * n * (2.0 * n + 1.0)) * (1.0 + series)
    return np.where(small, 2.0 * decay * v * series, -np.expm1(-4.0 * w) - 4.0 * decay * w)


Base = Literal["bonded", "frictionless"]

_LONGEST = 1e-100  # w so small that every limit is reached


@dataclass(frozen=True)
class LayeredBody:
    """A layer of `material` and `thickness` t [m] on a `base`."""

    material: Material
    thickness: float
    # a rigid one that the layer is "bonded" to, or that it slides on, "frictionless"; or the
    # Material of a half-plane that it is bonded to
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


def normal_compliance(body: LayeredBody, wavenumber: ArrayLike) -> np.ndarray:
    """uz of the surface under waves p cos kx over p [m/Pa], of k [1/m], any shape, k >= 0.
    At k = 0 it is the limit, infinite where the body gives way as a whole, on a half-plane."""
    w = np.maximum(np.asarray(wavenumber, dtype=float) * body.thickness, _LONGEST)
    with np.errstate(over="ignore"):
        return body.thickness / (2.0 * body.material.shear_modulus) * normal(body.contrast, w)


def added_stress(
    body: LayeredBody, wavenumber: np.ndarray, z: np.ndarray
) -> tuple[StressState, StressState]:
    """Stresses under p cos kx and under q sin kx less those of a half-plane: what the base adds.

    At depths 0 <= z <= t [m], shaped as k [1/m]; ValueError for a depth outside the layer.
    With r = (m - that of the half-plane)/(1 + e), its two columns a = (r11, r12), (r12, r22)
    under p and under q, and Z = k z:

        sz  = -(Z cosh Z - sinh Z) a1 - Z sinh Z a2
        txz =   Z sinh Z a1 + (Z cosh Z + sinh Z) a2
        sx  =  (Z cosh Z + sinh Z) a1 + (2 cosh Z + Z sinh Z) a2"""
    if np.any((z < 0.0) | (z > body.thickness * (1.0 + 1e-12))):
        raise ValueError(f"depths must lie in the layer, from 0 to {body.thickness:g} m")
    w = np.maximum(wavenumber * body.thickness, _LONGEST)
    depth = w * np.minimum(z / body.thickness, 1.0)
    rise = 2.0 * np.exp(depth - 2.0 * w)  # 4 e^-2w times half of e^Z
    sinh, cosh = -rise * np.expm1(-2.0 * depth), rise * (1.0 + np.exp(-2.0 * depth))
    r11, r12, r22 = added(body.contrast, w)

    def under(first: np.ndarray, second: np.ndarray) -> StressState:
        both = depth * cosh + sinh
        return StressState(
            sx=both * first + (2.0 * cosh + depth * sinh) * second,
            sz=-(depth * cosh - sinh) * first - depth * sinh * second,
            txz=depth * sinh * first + both * second,
        )

    return under(r11, r12), under(r12, r22)
