"""Spikes of a measured trace: dirt, or a stylus or a beam that lost the surface."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import median_filter

from analytic.profile import Profile

WINDOW = 9  # samples; a spike has up to four
BEYOND = 6.0  # times what 19 samples in 20 stand out by; measured and made surfaces reach 5
LEAST = 0.1  # of the rms height: less than that is no spike, however smooth the rest


@dataclass(frozen=True)
class Spikes:
    """`count` spikes, the largest `height` [m] from its neighbours (signed) at `place` [m]."""

    count: int
    height: float
    place: float


def spikes(profile: Profile) -> Spikes | None:
    """Samples that stand out of the running median of WINDOW samples, neighbours as one spike.
    Beyond BEYOND times the 95th percentile of that distance, and LEAST of the rms height about a
    line. None where there are none."""
    x, height = profile.x, profile.height
    apart = height - median_filter(height, WINDOW, mode="nearest")
    along = x - x.mean()
    line = height.mean() + along * (along @ height) / (along @ along)
    most = max(BEYOND * np.quantile(np.abs(apart), 0.95), LEAST * np.std(height - line))
    outlying = np.abs(apart) > most
    if not np.any(outlying):
        return None
    starts = outlying & ~np.concatenate(([False], outlying[:-1]))
    largest = int(np.argmax(np.abs(apart)))
    return Spikes(int(np.count_nonzero(starts)), float(apart[largest]), float(x[largest]))
