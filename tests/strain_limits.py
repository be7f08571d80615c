"""The strain up to which a law of elasticity is one of a stable solid."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import bisect

from analytic.material import Law, Material
from analytic.material.third_order import is_elliptic

SMALLEST_STEP = 1e-4  # of the strain, in the search for a limit; the largest strain is 1


@dataclass(frozen=True)
class StrainLimit:
    """Strains at which ellipticity in plane strain is lost: `compression` e of the stretches
    1 - e and 1, `shear` g of the stretches 1 + g/2 and 1 - g/2; infinite if not below 1."""

    compression: float
    shear: float


def strain_limit(law: Law, material: Material) -> StrainLimit:
    """Where the law stops being one of a stable solid: beyond, the acoustic tensor of some
    direction in the plane is no longer positive and a uniform strain falls apart into bands."""

    def limit(stretches: Callable[[float], tuple[float, float]]) -> float:
        def is_stable(strain: np.ndarray) -> np.ndarray:
            return is_elliptic(law, material, *stretches(strain))

        strains = np.arange(SMALLEST_STEP, 1.0, SMALLEST_STEP)
        lost = np.flatnonzero(~is_stable(strains))
        if not lost.size:
            return np.inf
        ends = strains[lost[0]] - SMALLEST_STEP, strains[lost[0]]
        return bisect(lambda strain: is_stable(np.array([strain]))[0] - 0.5, *ends, xtol=1e-12)

    return StrainLimit(
        compression=limit(lambda e: (1.0 - e, np.ones_like(e))),
        shear=limit(lambda g: (1.0 + 0.5 * g, 1.0 - 0.5 * g)),
    )
