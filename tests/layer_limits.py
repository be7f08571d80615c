r"""Rigid cylinder on an elastic layer of thickness t on a rigid base: the limits of thick and thin.

        \     /          cylinder of radius R, without friction
    -----\___/-----       contact on |x| < a
      layer, t
    ///////////////       base: "bonded", or "frictionless" (the layer slides but stays on it)

Nomenclature: E, nu constants of the layer, E' = E/(1 - nu^2) [Pa], M modulus of the thin layer
[Pa], R radius [m], t thickness [m], a half-width [m], P load per length [N/m], p0 peak pressure
[Pa], w = k t with the wavenumber k, K(w) the layer's compliance over the half-plane's,
u = (2/(E' k)) K p.

Thick, a << t. The base takes away 1 - K, which over a narrow contact bends the surface
evenly, as if the cylinder had the curvature 1/R + 2 C P/(pi E' t^2). To first order in that,

    P = (pi E' a^2/4R) (1 + C a^2/(2 t^2)),  p0 = 2 P/(pi a),  C = int w (1 - K) dw

    bonded        K = (2 n sinh 2w - 4 w)/(2 n cosh 2w + 4 w^2 + 1 + n^2),   n = 3 - 4 nu
    frictionless  K = 2 sinh^2 w/(sinh 2w + 2 w)                    (Johnson 1985, section 5.8)

Thin, a >> t (Johnson 1985, section 5.8):

    compressible     p = (M/2Rt) (a^2 - x^2)     M = E' on a frictionless base,
                                 M = E (1-nu)/((1+nu)(1-2nu)) on a bonded one
    incompressible   p = (E/24Rt^3) (a^2 - x^2)^2   bonded, nu = 1/2

Range: what is left out of the load for a given half-width, relative to it
    thick           below 0.23 (a/t)^4
    compressible    0.53 t/a frictionless, 0.37 t/a bonded with nu = 0.3; the full load is larger.
                    No limit any more where (1 - 2 nu)(a/t)^2 is not large
    incompressible  8 t/a, the full load is larger
"""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad

from analytic.layers.layered import Base
from analytic.material import Material
from analytic.numerics import check_positive

_LAST = 50.0  # w at which 1 - K, about 4 w^2 e^-2w, is long below rounding


@dataclass(frozen=True)
class LayerLimit:
    """A contact in a limit: `half_width` a [m], `peak_pressure` p0 [Pa], `load_per_length` P
    [N/m]."""

    half_width: float
    peak_pressure: float
    load_per_length: float


def thick_layer(
    half_width: float, radius: float, thickness: float, layer: Material, base: Base
) -> LayerLimit:
    """Hertz's contact of half-width a [m] with the first effect of the base, R and t [m].

    Raises ValueError for lengths that are not positive.
    """
    check_positive(half_width=half_width, radius=radius, thickness=thickness)
    deficit = partial(base_deficit, base=base, poissons_ratio=layer.poissons_ratio)
    bend, _ = quad(lambda w: w * deficit(w), 0.0, _LAST, epsabs=0.0, epsrel=1e-13, limit=200)
    modulus, ratio = layer.plane_strain_modulus, (half_width / thickness) ** 2
    peak = modulus * half_width / (2.0 * radius) * (1.0 + 0.5 * bend * ratio)
    return LayerLimit(half_width, peak, float(0.5 * np.pi * half_width * peak))


def thin_compressible_layer(
    half_width: float, radius: float, thickness: float, layer: Material, base: Base
) -> LayerLimit:
    """Winkler's bed of springs M/t under a contact of half-width a [m]; R and t [m].

    Raises ValueError for lengths that are not positive.
    """
    check_positive(half_width=half_width, radius=radius, thickness=thickness)
    peak = thin_modulus(layer, base) * half_width**2 / (2.0 * radius * thickness)
    return LayerLimit(half_width, peak, 4.0 / 3.0 * half_width * peak)


def thin_incompressible_layer(
    half_width: float, radius: float, thickness: float, youngs_modulus: float
) -> LayerLimit:
    """Bonded layer of nu = 1/2 with E [Pa] under a contact of half-width a [m]; R and t [m].

    Raises ValueError unless all four are positive.
    """
    check_positive(
        half_width=half_width, radius=radius, thickness=thickness, youngs_modulus=youngs_modulus
    )
    peak = youngs_modulus * half_width**4 / (24.0 * radius * thickness**3)
    return LayerLimit(half_width, peak, 16.0 / 15.0 * half_width * peak)


def thin_modulus(layer: Material, base: Base) -> float:
    """M [Pa]: pressure over thickness strain of a layer that is wide and pressed evenly."""
    nu = layer.poissons_ratio
    if base == "frictionless":
        return layer.plane_strain_modulus
    return layer.youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))


def base_deficit(w: ArrayLike, base: Base, poissons_ratio: float) -> np.ndarray:
    """1 - K at w = k t > 0, the share of the half-plane's compliance that the base takes away.

    Sums of positive terms over positive ones, multiplied by e^-2w: right to rounding.
    """
    w = np.asarray(w, dtype=float)
    decay, n = np.exp(-2.0 * w), 3.0 - 4.0 * poissons_ratio
    if base == "frictionless":
        return 2.0 * decay * (2.0 * w - np.expm1(-2.0 * w)) / (4.0 * w * decay - np.expm1(-4.0 * w))
    rest = 4.0 * w**2 + 1.0 + n**2
    return decay * (2.0 * n * decay + rest + 4.0 * w) / (n * (1.0 + decay**2) + rest * decay)
