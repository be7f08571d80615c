"""Model of a stylus: noise on a trace's heights, and crests no sharper than its tip."""

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d, grey_opening

from analytic.profile import Profile

WIDEST = 8.0  # correlation lengths that the noise is longer than the trace: its ends do not meet


def with_noise(
    profile: Profile, deviation: float, correlation_length: float, rng: np.random.Generator
) -> Profile:
    """The profile with Gaussian noise added to its heights.

    deviation           [m] standard deviation
    correlation_length  [m] l of the autocorrelation exp(-(r/l)^2); 0 is white noise on the samples
    """
    if correlation_length == 0.0:
        return Profile(profile.x, profile.height + deviation * rng.standard_normal(len(profile.x)))
    step = min(profile.spacing, 0.25 * correlation_length)
    width = 0.5 * correlation_length / step  # of the Gaussian whose square is the autocorrelation
    count = int(np.ceil((profile.length + WIDEST * correlation_length) / step)) + 1
    noise = gaussian_filter1d(rng.standard_normal(count), width, mode="wrap")
    impulse = np.zeros(count)
    impulse[count // 2] = 1.0
    noise *= deviation / np.linalg.norm(gaussian_filter1d(impulse, width, mode="wrap"))
    places = profile.x[0] + step * np.arange(count)
    return Profile(profile.x, profile.height + CubicSpline(places, noise)(profile.x))


def opened(profile: Profile, radius: float) -> Profile:
    """The profile opened by a circle of `radius` [m] from below: no crest is sharper than it. A tip
    of that radius records no sharper crest; one in a trace is noise, or a trace's of a sharper tip.
    Morphological opening on the trace's samples; of uneven ones, on as many even ones."""
    even = np.linspace(profile.x[0], profile.x[-1], len(profile.x))
    step = even[1] - even[0]
    heights = np.interp(even, profile.x, profile.height)
    # farther out the circle lies deeper than the trace has relief
    reach = min(radius, np.sqrt(2.0 * radius * np.ptp(heights)))
    count = min(int(reach / step), len(even) - 1)
    across = step * np.arange(-count, count + 1)
    circle = np.sqrt(radius**2 - across**2) - radius
    moved = grey_opening(heights, structure=circle, mode="nearest") - heights
    return Profile(profile.x, profile.height + np.interp(profile.x, even, moved))
