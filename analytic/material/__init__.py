"""Constants of one body and of a pair: elastic ones, and those of heat conduction.

A rigid body is `None` wherever a `Material` is expected for the roller.
Nomenclature: E Young's modulus [Pa], nu Poisson's ratio, E* combined modulus [Pa],
alpha and beta Dundurs' constants."""

from dataclasses import dataclass

import numpy as np

from analytic.numerics import check_positive

LAWS = ("neo-hookean", "hencky", "st-venant-kirchhoff", "murnaghan")


@dataclass(frozen=True)
class Law:
    """Stress that follows from a finite strain; all laws have the same limit of small strains."""

    name: str = "neo-hookean"  # one of LAWS
    # third-order constants l, m, n [Pa], of that law alone, and where known their standard errors
    murnaghan: tuple[float, float, float] | None = None
    standard_errors: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        if self.name not in LAWS:
            raise ValueError(f"the law must be one of {LAWS}, not {self.name!r}")
        if (self.name == "murnaghan") != (self.murnaghan is not None):
            raise ValueError("constants l, m, n are Murnaghan's, who needs them")
        if self.standard_errors is not None and self.murnaghan is None:
            raise ValueError("standard errors are those of constants l, m, n")


@dataclass(frozen=True)
class Material:
    """Isotropic elastic material: `youngs_modulus` [Pa] > 0, 0 <= `poissons_ratio` < 0.5, and its
    `law` at finite strains, which the linear theory does not ask for."""

    youngs_modulus: float
    poissons_ratio: float
    law: Law = Law()

    def __post_init__(self) -> None:
        if not (np.isfinite(self.youngs_modulus) and self.youngs_modulus > 0.0):
            raise ValueError(f"Young's modulus must be positive, not {self.youngs_modulus:g} Pa")
        if not 0.0 <= self.poissons_ratio < 0.5:
            raise ValueError(
                f"Poisson's ratio must be at least 0 and below 0.5, not {self.poissons_ratio:g}"
            )

    @property
    def shear_modulus(self) -> float:
        """G = E / (2 (1 + nu)) [Pa]."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))

    @property
    def lame_constants(self) -> tuple[float, float]:
        """lambda = 2 nu G / (1 - 2 nu) and mu = G [Pa]."""
        shear = self.shear_modulus
        return 2.0 * self.poissons_ratio * shear / (1.0 - 2.0 * self.poissons_ratio), shear

    @property
    def bulk_modulus(self) -> float:
        """K = E / (3 (1 - 2 nu)) [Pa]."""
        return self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poissons_ratio))

    @property
    def plane_strain_modulus(self) -> float:
        """E' = E / (1 - nu^2) [Pa]."""
        return self.youngs_modulus / (1.0 - self.poissons_ratio**2)


@dataclass(frozen=True)
class ThermalMaterial:
    """Heat conduction in one body: `conductivity` k [W/(m K)], `density` rho [kg/m^3] and
    `specific_heat` c [J/(kg K)], all positive."""

    conductivity: float
    density: float
    specific_heat: float

    def __post_init__(self) -> None:
        check_positive(**vars(self))

    @property
    def diffusivity(self) -> float:
        """kappa = k / (rho c) [m^2/s]."""
        return self.conductivity / (self.density * self.specific_heat)


def combined_modulus(first: Material | None, second: Material | None) -> float:
    """E* [Pa] of two bodies, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 (Johnson 1985, eq. 4.18).
    `None` is a rigid body. Raises ValueError if both are rigid."""
    compliance = sum(1.0 / m.plane_strain_modulus for m in (first, second) if m is not None)
    if compliance == 0.0:
        raise ValueError("two rigid bodies have no elastic contact")
    return 1.0 / compliance


def dundurs_constants(body: Material, roller: Material | None) -> tuple[float, float]:
    """Dundurs' (alpha, beta) in plane strain, `roller` as the first body (Barber 2018, ch. 4).
    alpha = (1/E'_body - 1/E'_roller) / (1/E'_body + 1/E'_roller); beta weighs the two (1-2nu)/G in
    the same way. It vanishes for equal materials, whose surfaces a tangential traction moves by the
    same amount. A rigid roller gives alpha = 1 and beta = (1-2nu)/(2(1-nu)) of the body."""

    def compliances(material: Material | None) -> tuple[float, float]:
        if material is None:
            return 0.0, 0.0
        nu, shear = material.poissons_ratio, material.shear_modulus
        return (1.0 - nu) / shear, (1.0 - 2.0 * nu) / shear

    normal_body, coupling_body = compliances(body)
    normal_roller, coupling_roller = compliances(roller)
    total = normal_body + normal_roller
    alpha = (normal_body - normal_roller) / total
    return alpha, (coupling_body - coupling_roller) / (2.0 * total)
