"""Lost heights of a trace: put on the straight line between their neighbours, never beyond them."""

import numpy as np


def bridge(
    x: np.ndarray, height: np.ndarray, lost: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and height (m,) [m] without gaps, and the m samples that they come from.

    x      (n,) [m] in any order; NaN only where nothing is to be kept
    lost   (n,) which heights are; at least one is not
    Lost samples beyond the outermost ones that are known are left out.
    """
    good = np.flatnonzero(~lost)
    good = good[np.argsort(x[good], kind="stable")]
    inside = np.flatnonzero((x >= x[good[0]]) & (x <= x[good[-1]]))
    height = np.where(lost, np.interp(x, x[good], height[good]), height)
    return x[inside], height[inside], inside
