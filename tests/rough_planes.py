"""Rough planes of Gaussian heights by Greenwood and Williamson."""

import numpy as np
from numpy.typing import ArrayLike

from analytic.statistics.nominally_flat import Summits, tail_integral


def nominally_flat(summits: Summits, modulus: float, h: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """p [Pa] and f at separations h. Summits never merge: beyond some tenths f is off."""
    scale = summits.density * modulus * np.sqrt(summits.radius) * summits.deviation**1.5
    area = np.pi * summits.density * summits.radius * summits.deviation
    return 4.0 / 3.0 * scale * tail_integral(1.5, h), area * tail_integral(1.0, h)
