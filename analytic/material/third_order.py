"""Third-order elastic constants of an isotropic solid: their conventions, what they do to a
contact, and at which strains a law of elasticity is one.

    W = lambda/2 I1^2 + mu tr E^2 + terms of third order in Green's strain E:
        (l + 2m)/3 I1^3 - 2m I1 I2 + n I3                          Murnaghan 1937
        A/3 tr E^3 + B tr E tr E^2 + C/3 (tr E)^3                  Landau and Lifshitz
        nu1 = C123, nu2 = C144, nu3 = C456                         Toupin and Bernstein 1961
    pressure derivatives at p = 0: K' of the bulk, G' of the shear modulus

Every one of these is linear in l, m, n; any three that are independent give them. Sources: Hughes
and Kelly, Phys. Rev. 92 (1953) 1145 (pressure derivatives); Knowles and Sternberg, J. Elasticity 8
(1978) 329 (ellipticity in plane strain).

Nomenclature: lambda, mu Lame's constants [Pa], K bulk modulus [Pa], nu Poisson's ratio, p0 peak
pressure of a smooth contact by Hertz [Pa], E Young's modulus [Pa]."""

from collections.abc import Mapping

import numpy as np

from analytic.material import Law, Material

# Of each constant: its factors of l, m, n.
CONSTANTS = {
    "l": (1.0, 0.0, 0.0),
    "m": (0.0, 1.0, 0.0),
    "n": (0.0, 0.0, 1.0),
    "A": (0.0, 0.0, 1.0),
    "B": (0.0, 1.0, -0.5),
    "C": (1.0, -1.0, 0.5),
    "nu1": (2.0, -2.0, 1.0),
    "nu2": (0.0, 1.0, -0.5),
    "nu3": (0.0, 0.0, 0.25),
    "c111": (2.0, 4.0, 0.0),
    "c112": (2.0, 0.0, 0.0),
    "c123": (2.0, -2.0, 1.0),
    "c144": (0.0, 1.0, -0.5),
    "c155": (0.0, 1.0, 0.0),
    "c456": (0.0, 0.0, 0.25),
}
PRESSURE_DERIVATIVES = ("bulk_by_pressure", "shear_by_pressure")
# Change of the peak pressure of a smooth contact from one law to another, over p0/E, by factors of
# (1 - 2nu)^3 (l + m/2) and (1 - 2nu) m, both over mu; of the contact's length over that of the
# peak. Finite elements at a/R = 0.05 under a rigid roller, nu from 0.05 to 0.49, give them within
# 4 % and 10 %.
VOLUME, SHAPE, LENGTH_OVER_PEAK = 0.491, 0.261, -0.77


def murnaghan_constants(
    constants: Mapping[str, float], material: Material
) -> tuple[float, float, float]:
    """Murnaghan's l, m, n [Pa] of three `constants` by name, those of CONSTANTS [Pa] and of
    PRESSURE_DERIVATIVES, which take the `material`'s moduli.
    Raises ValueError for an unknown name, or unless they are three and independent."""
    factors, values = _equations(constants, material)
    return tuple(map(float, np.linalg.solve(factors, values)))


def murnaghan_errors(
    constants: Mapping[str, float], errors: Mapping[str, float], material: Material
) -> tuple[float, float, float]:
    """Standard errors [Pa] of l, m, n from those of `constants`, taken as independent; a constant
    without one counts as exact."""
    factors, _ = _equations(constants, material)
    scales = [_pressure_scale(name, material) for name in constants]
    widths = [errors.get(name, 0.0) * scale for name, scale in zip(constants, scales, strict=True)]
    return tuple(map(float, np.sqrt(np.linalg.inv(factors) ** 2 @ np.square(widths))))


def _pressure_scale(name: str, material: Material) -> float:
    """Factor [Pa] that makes a pressure derivative linear in l, m, n; else 1."""
    return -9.0 * material.bulk_modulus if name in PRESSURE_DERIVATIVES else 1.0


def _equations(constants: Mapping[str, float], material: Material) -> tuple[np.ndarray, np.ndarray]:
    """The matrix of l, m, n, and the right-hand side [Pa]."""
    lame, shear = material.lame_constants
    of_pressure = {
        "bulk_by_pressure": ((18.0, 0.0, 2.0), 0.0),
        "shear_by_pressure": ((0.0, 9.0, -1.5), 9.0 * (lame + shear)),
    }
    rows, values = [], []
    for name, value in constants.items():
        if name not in CONSTANTS and name not in of_pressure:
            raise ValueError(f"there is no third-order constant {name!r}")
        row, offset = of_pressure.get(name) or (CONSTANTS[name], 0.0)
        rows.append(row)
        values.append(value * _pressure_scale(name, material) - offset)
    if len(rows) != 3 or np.linalg.matrix_rank(rows) < 3:
        raise ValueError(f"{', '.join(constants)} do not determine l, m, n")
    return np.array(rows), np.array(values)


def third_order(law: Law, material: Material) -> tuple[float, float, float]:
    """l, m, n [Pa] of any law's expansion to third order."""
    lame, shear = material.lame_constants
    if law.name == "murnaghan":
        return law.murnaghan
    return {
        "neo-hookean": (-lame, -lame - 2.0 * shear, -4.0 * shear),
        "hencky": (-lame, -lame - 3.0 * shear, -6.0 * shear),
        "st-venant-kirchhoff": (0.0, 0.0, 0.0),
    }[law.name]


def peak_change(law: Law, material: Material) -> float:
    """Relative change of the peak pressure of a smooth contact from the neo-Hookean law, over
    p0/E, to first order in p0/E; the contact's length changes by LENGTH_OVER_PEAK times that. In
    plane strain n has no part in it."""
    nu, shear = material.poissons_ratio, material.shear_modulus
    ell, m, _ = np.subtract(third_order(law, material), third_order(Law(), material)) / shear
    volume = VOLUME * (1.0 - 2.0 * nu) ** 3 * (ell + 0.5 * m)
    return float(-(volume + SHAPE * (1.0 - 2.0 * nu) * m) * (1.0 + nu) / (1.0 - nu))


def is_elliptic(law: Law, material: Material, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Whether the acoustic tensors of all directions in the plane are positive at principal
    stretches `first` != `second` (...), which are positive. Knowles and Sternberg 1978, eq. 1.5:
    of W's derivatives by the stretches."""
    one, two, w11, w22, w12 = _derivatives(law, material, first, second)
    root = np.sqrt(np.maximum(w11 * w22, 0.0))
    conditions = (
        w11,
        w22,
        (first * one - second * two) / (first - second),
        root + w12 + (one - two) / (first - second),
        root - w12 + (one + two) / (first + second),
    )
    return np.all(np.array(conditions) > 0.0, axis=0)


def _derivatives(
    law: Law, material: Material, first: np.ndarray, second: np.ndarray
) -> tuple[np.ndarray, ...]:
    """W1, W2, W11, W22, W12 [Pa] of the energy by the principal stretches in the plane."""
    lame, shear = material.lame_constants
    stretches = np.array([first, second])
    log = np.log(stretches)
    if law.name == "hencky":
        stress = 2.0 * shear * log + lame * log.sum(axis=0)
        curvature = (2.0 * shear + lame - stress) / stretches**2
        return *(stress / stretches), *curvature, lame / (first * second)
    if law.name == "neo-hookean":
        across = lame * log.sum(axis=0) - shear
        curvature = shear + (lame - across) / stretches**2
        return *(shear * stretches + across / stretches), *curvature, lame / (first * second)
    ell, m, _ = third_order(law, material)
    strain = 0.5 * (stretches**2 - 1.0)
    total, product = strain.sum(axis=0), strain.prod(axis=0)
    other = strain[::-1]
    slope = (lame + 2.0 * shear) * total + (ell + 2.0 * m) * total**2
    slope = slope - 2.0 * m * product - 2.0 * (shear + m * total) * other
    curvature = lame + 2.0 * shear + 2.0 * (ell + 2.0 * m) * total - 4.0 * m * other
    mixed = lame + 2.0 * ell * total
    return *(stretches * slope), *(slope + stretches**2 * curvature), first * second * mixed
