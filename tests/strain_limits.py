"""The strain up to which a law of elasticity is one of a stable solid."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

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
        strains = np.arange(SMALLEST_STEP, 1.0, SMALLEST_STEP)
        lost = np.flatnonzero(~is_elliptic(law, material, *stretches(strains)))
        if not lost.size:
            return np.inf
        low, high = strains[lost[0]] - SMALLEST_STEP, strains[lost[0]]
        while high - low > 1e-12:
            middle = 0.5 * (low + high)
            if is_elliptic(law, material, *stretches(np.array([middle])))[0]:
                low = middle
            else:
                high = middle
        return float(high)

    return StrainLimit(
        compression=limit(lambda e: (1.0 - e, np.ones_like(e))),
        shear=limit(lambda g: (1.0 + 0.5 * g, 1.0 - 0.5 * g)),
    )
