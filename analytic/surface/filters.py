"""Gaussian profile filters: which waves of a profile are form, which are roughness, which noise.

The weighting function is that of ISO 16610-21:2011, eq. 1, not truncated,

    s(x) = exp(-pi (x / (alpha lambda))^2) / (alpha lambda),   alpha = sqrt(ln 2 / pi) = 0.4697,

so that the mean line holds exactly half of a wave of the cut-off's length lambda [m], without a
phase: its transmission is 2^-(lambda / wavelength)^2 (eq. 2).

Towards the ends of the trace the mean line is that of a straight line fitted with the same weights
to what there is of the trace (ISO 16610-28:2016, retention of moments up to the first): a straight
line passes unchanged, and nothing of the trace is lost. Half a cut-off inside, this differs from
the plain filter by a few thousandths of the waviness; one cut-off inside, by 1e-6 of it.

The filter acts on the profile's spline, so that samples need not be evenly spaced."""

from math import ceil, log, pi, sqrt

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.interpolate import make_interp_spline

from analytic.profile import Profile

ALPHA = sqrt(log(2.0) / pi)
REACH = 1.7  # of the cut-off: s there is 1e-18 of its maximum
STEPS_PER_CUTOFF = 32  # of the even grid; a quintic spline through its points errs by 1e-8
STEPS_PER_SPACING = 2  # so that the grid carries every wave of the spline
MOST_STEPS = 2**23  # 67 MB a vector; only the longest traces are filtered on a coarser grid
EVEN = 1e-6  # of the spacing, by which the sample distances of an even trace may differ
ROUNDING = 1e-9  # relative, of lengths that are compared
LONGEST_CUTOFF = 0.5  # of the trace, so that one cut-off is left between half a cut-off at each end
SHORTEST_CUTOFF = 2.0  # sample spacings
# End weights of an even grid's fourth-order quadrature (Press et al., Numerical Recipes, 4.1.14).
END_WEIGHTS = np.array([3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0])


def mean_line(profile: Profile, cutoff: float) -> np.ndarray:
    """Height [m] of the long waves at the profile's samples, (n,).

    cutoff   [m] wavelength of which half passes; from two median sample spacings to half of the
             trace
    Raises ValueError for a cut-off out of these bounds."""
    check_cutoff(profile, cutoff)
    intervals = len(profile.x) - 1
    step = min(profile.spacing / STEPS_PER_SPACING, cutoff / STEPS_PER_CUTOFF)
    steps = min(ceil(profile.length / step * (1.0 - ROUNDING)), MOST_STEPS)
    even = np.ptp(np.diff(profile.x)) <= EVEN * profile.spacing
    if even:  # every sample is a point of the grid
        steps = intervals * max(1, min(ceil(steps / intervals), MOST_STEPS // intervals))
    x = np.linspace(profile.x[0], profile.x[-1], steps + 1)
    offset = float(np.mean(profile.height))  # taken off, the moments below do not cancel
    smooth = _weighted_line(profile.spline()(x) - offset, profile.length / steps / cutoff)
    if even:
        return offset + smooth[:: steps // intervals]
    return offset + make_interp_spline(x - x[0], smooth, k=5)(profile.x - x[0])


def filtered(
    profile: Profile, cutoff: float | None = None, short_cutoff: float | None = None
) -> Profile:
    """The profile between two cut-offs, at the same samples.

    short_cutoff  [m] (lambda_s) waves shorter than this are taken off first; None: none are
    cutoff        [m] (lambda_c) waves longer than this are taken off then, the mean height and a
                  tilt with them; None: none are
    Raises ValueError for cut-offs that make no sense on this profile."""
    if cutoff is not None and short_cutoff is not None and not short_cutoff < cutoff:
        raise ValueError(
            f"the short cut-off of {short_cutoff:g} m must lie below the cut-off of {cutoff:g} m"
        )
    if short_cutoff is not None:
        profile = Profile(profile.x, mean_line(profile, short_cutoff))
    if cutoff is not None:
        profile = Profile(profile.x, profile.height - mean_line(profile, cutoff))
    return profile


def check_cutoff(profile: Profile, cutoff: float) -> None:
    """Raises ValueError where the profile cannot be filtered at `cutoff` [m]."""
    shortest, longest = SHORTEST_CUTOFF * profile.spacing, LONGEST_CUTOFF * profile.length
    if not shortest * (1.0 - ROUNDING) <= cutoff <= longest * (1.0 + ROUNDING):
        raise ValueError(
            f"a cut-off of {cutoff:g} m does not suit the trace; allowed is from two sample "
            f"spacings, {shortest:.4g} m, to half of its length, {longest:.4g} m"
        )


def _weighted_line(height: np.ndarray, step: float) -> np.ndarray:
    """Value of the line fitted around each point of an even grid, (n,).

    step   of the grid, over the cut-off

    With m_k the moments of s over the trace and z_k those of s times the height, each about the
    point, the line's value is (m_2 z_0 - m_1 z_1) / (m_2 m_0 - m_1^2)."""
    count = len(height)
    reach = min(ceil(REACH / step), count - 1)
    u = step * np.arange(-reach, reach + 1)
    weighting = np.exp(-pi * (u / ALPHA) ** 2) * (step / ALPHA)
    ends = np.ones(count)
    ends[:3] = END_WEIGHTS
    ends[-3:] = END_WEIGHTS[::-1]
    padded = next_fast_len(count + 2 * reach, real=True)
    grid, traced = rfft(ends, padded), rfft(ends * height, padded)

    def moment(spectrum: np.ndarray, power: int) -> np.ndarray:
        # the point that is weighed lies at +u from the one where the line is wanted
        kernel = rfft((weighting * u**power)[::-1], padded)
        return irfft(spectrum * kernel, padded)[reach : reach + count]

    m0, m1, m2 = (moment(grid, power) for power in range(3))
    z0, z1 = (moment(traced, power) for power in range(2))
    return (m2 * z0 - m1 * z1) / (m2 * m0 - m1**2)
