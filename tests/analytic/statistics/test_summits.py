"""Summits of computed profiles: moments against sums of waves, and peaks against moments."""

import numpy as np
import pytest

from analytic.profile import Profile
from analytic.statistics.summits import (
    SpectralMoments,
    counted_peaks,
    spectral_moments,
    summits_of_peaks,
)
from analytic.surface.synthetic import self_affine, sinusoid, smooth


def gaussian(seed, samples=40001):
    """A flat spectrum of wide band, well resolved."""
    return self_affine(
        hurst=0.8, samples=samples, length=4e-3, seed=seed, rms_height=0.4e-6,
        shortest_wavelength=4e-6, longest_wavelength=40e-6,
    )  # fmt: skip


def test_moments_of_one_wave():
    amplitude, wavelength = 1e-6, 50e-6
    profile = sinusoid(wavelength=wavelength, amplitude=amplitude, length=2e-3)
    moments, k = spectral_moments(profile), 2.0 * np.pi / wavelength
    expected = 0.5 * amplitude**2 * np.array([1.0, k**2, k**4])
    assert [moments.m0, moments.m2, moments.m4] == pytest.approx(expected, rel=2e-3)
    assert moments.bandwidth == pytest.approx(1.0, rel=2e-3)
    counted = counted_peaks(profile)
    assert counted.radius == pytest.approx(1.0 / (amplitude * k**2), rel=2e-3)
    assert counted.mean == pytest.approx(amplitude, rel=1e-3)


def test_counted_peaks_of_gaussian_profiles_are_those_of_the_moments():
    """Over many peaks, within a few of their standard errors."""
    ratios = []
    for seed in range(8):
        moments, counted = spectral_moments(gaussian(seed)), counted_peaks(gaussian(seed))
        expected = moments.peaks()
        names = ("density", "radius", "deviation", "mean")
        ratios.append([getattr(counted, n) / getattr(expected, n) for n in names])
    mean, error = np.mean(ratios, axis=0), np.std(ratios, axis=0, ddof=1) / np.sqrt(8.0)
    assert np.all(np.abs(mean - 1.0) < 4.0 * error + 2e-3)
    assert np.all(error < 0.02)


def test_summits_stand_higher_and_sharper_than_a_profiles_peaks():
    """Nayak's ratios: curvature 1.2004, density 1.2092 n^2; 0.326 m0/alpha less variance."""
    moments = SpectralMoments(m0=1e-12, m2=1e-2, m4=4e8)
    peaks, summits = moments.peaks(), moments.summits()
    assert peaks.radius / summits.radius == pytest.approx(1.2004, abs=1e-4)
    assert summits.density / peaks.density**2 == pytest.approx(1.2092, abs=1e-4)
    less = (peaks.deviation**2 - summits.deviation**2) / (moments.m0 / moments.bandwidth)
    assert less == pytest.approx(0.326, abs=1e-4)
    assert summits.mean > peaks.mean


def test_summits_of_the_expected_peaks_are_the_expected_summits():
    moments = SpectralMoments(m0=1e-12, m2=1e-2, m4=4e8)
    carried, expected = summits_of_peaks(moments.peaks(), moments), moments.summits()
    for name in ("density", "radius", "deviation", "mean"):
        assert getattr(carried, name) == pytest.approx(getattr(expected, name), rel=1e-12)


def test_scaling_of_heights_and_lengths():
    profile = gaussian(3, samples=8001)
    other = Profile(2.0 * profile.x, 6.0 * profile.height)
    one, two = spectral_moments(profile).summits(), spectral_moments(other).summits()
    assert two.density == pytest.approx(one.density / 4.0)
    assert two.deviation == pytest.approx(6.0 * one.deviation)
    assert two.radius == pytest.approx(one.radius * 4.0 / 6.0)


def test_a_smooth_profile_has_no_statistics():
    with pytest.raises(ValueError, match="the profile is smooth"):
        spectral_moments(smooth(length=1e-3))
    x = np.linspace(0.0, 1e-3, 101)
    with pytest.raises(ValueError, match="has 1 peaks; allowed is 8 or more"):
        counted_peaks(Profile(x, 1e-6 * np.sin(np.pi * x / 1e-3)))
