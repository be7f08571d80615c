"""Times at which fluxes that begin at once are followed."""

import numpy as np


def doubling_times(first: float, last: float, steps: int = 8) -> np.ndarray:
    """Times (k,) [s] from 0: `steps` of `first` [s], as many to each further doubling of the time,
    up to `last` or just beyond, as temperatures go with roots of time."""
    times = [first * np.arange(steps + 1)]
    while times[-1][-1] < last * (1.0 - 1e-9):
        start = times[-1][-1]
        times.append(start + start / steps * np.arange(1, steps + 1))
    return np.concatenate(times)
