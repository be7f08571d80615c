"""Summits of a surface from one profile of it: by spectral moments, and by counting peaks.

m0, m2, m4 are the mean squares of height, slope and curvature of the profile (the moments of its
power spectrum). On an isotropic Gaussian surface, with the bandwidth alpha = m0 m4 / m2^2,

    profile's peaks     n = sqrt(m4/m2) / 2 pi          1/m (Cartwright, Longuet-Higgins 1956)
                        mean curvature sqrt(pi m4/2),  mean height sqrt(pi m0 / 2 alpha)
                        variance of height (1 - (pi/2 - 1)/alpha) m0
    summits             eta = m4 / (6 sqrt(3) pi m2)    1/m^2 (Nayak 1971)
                        mean curvature 8 sqrt(m4) / (3 sqrt(pi)),  mean height 4 sqrt(m0 / pi alpha)
                        variance of height (1 - 0.8968/alpha) m0   (Bush, Gibson, Keogh 1976)

A profile passes beside most summits. Peaks that are counted become summits by the ratios of these.
"""

from dataclasses import dataclass

import numpy as np

from analytic.profile import Profile
from analytic.statistics.nominally_flat import Summits
from analytic.surface.roughness import moments, peaks

SUMMIT_VARIANCE = 0.8968  # of m2^2/m4, by which heights of summits scatter less than the surface
PEAK_VARIANCE = 0.5 * np.pi - 1.0
FEWEST_PEAKS = 8
SMOOTH = 1e-9  # largest rms slope whose peaks are rounding


@dataclass(frozen=True)
class SpectralMoments:
    """m0 [m^2], m2, m4 [1/m^2] of a profile."""

    m0: float
    m2: float
    m4: float

    @property
    def bandwidth(self) -> float:
        """alpha; 1.5 at least on an isotropic Gaussian surface."""
        return self.m0 * self.m4 / self.m2**2

    def peaks(self) -> Summits:
        """Peaks of a Gaussian profile."""
        return Summits(
            density=float(np.sqrt(self.m4 / self.m2) / (2.0 * np.pi)),
            radius=float(np.sqrt(2.0 / (np.pi * self.m4))),
            deviation=float(np.sqrt(self.m0 * (1.0 - PEAK_VARIANCE / self.bandwidth))),
            mean=float(np.sqrt(0.5 * np.pi * self.m0 / self.bandwidth)),
        )

    def summits(self) -> Summits:
        """Summits of an isotropic Gaussian surface."""
        return Summits(
            density=self.m4 / (6.0 * np.sqrt(3.0) * np.pi * self.m2),
            radius=3.0 * np.sqrt(np.pi / self.m4) / 8.0,
            deviation=np.sqrt(self.m0 * (1.0 - SUMMIT_VARIANCE / self.bandwidth)),
            mean=4.0 * np.sqrt(self.m0 / (np.pi * self.bandwidth)),
        )


def spectral_moments(profile: Profile) -> SpectralMoments:
    """Moments of the profile's spline; ValueError for a smooth profile."""
    _, rq, slope = moments(profile)
    if not slope > SMOOTH:
        raise ValueError(f"the profile is smooth: its rms slope is {slope:.3g}")
    steps, bend = np.diff(profile.x), profile.spline()(profile.x, 2)
    square = (bend[:-1] ** 2 + bend[:-1] * bend[1:] + bend[1:] ** 2) / 3.0  # linear in between
    return SpectralMoments(rq**2, slope**2, float(steps @ square / profile.length))


def counted_peaks(profile: Profile) -> Summits:
    """The spline's maxima; ValueError for fewer than FEWEST_PEAKS, or all of one height."""
    place, height, bend = peaks(profile)
    if len(place) < FEWEST_PEAKS:
        raise ValueError(f"the profile has {len(place)} peaks; allowed is {FEWEST_PEAKS} or more")
    mean = float(height.mean()) - moments(profile)[0]
    spread = float(np.std(height, ddof=1))
    return Summits(len(place) / profile.length, float(1.0 / bend.mean()), spread, mean)


def summits_of_peaks(counted: Summits, profile_moments: SpectralMoments) -> Summits:
    """Summits of an isotropic surface with a profile's counted peaks: density, curvature, variance
    and mean height are carried over by the ratios, and the differences, that a Gaussian one has.
    Raises ValueError where the peaks are hardly of different height."""
    peaks_expected, expected = profile_moments.peaks(), profile_moments.summits()
    spread = counted.deviation**2 - peaks_expected.deviation**2 + expected.deviation**2
    if not spread > 0.0:
        raise ValueError("the profile's peaks are all as high; statistics need random ones")
    return Summits(
        density=expected.density * (counted.density / peaks_expected.density) ** 2,
        radius=expected.radius * counted.radius / peaks_expected.radius,
        deviation=float(np.sqrt(spread)),
        mean=expected.mean + counted.mean - peaks_expected.mean,
    )
