"""The Gaussian filter against its transmission, brute-force integrals and scipy's own."""

from math import pi

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

import analytic.surface.filters as module
from analytic.profile import Profile
from analytic.surface.filters import ALPHA, check_cutoff, filtered, mean_line
from analytic.surface.synthetic import self_affine

LENGTH, CUTOFF = 40.0, 1.0
X = np.linspace(0.0, LENGTH, 40 * 64 + 1)
ROUGH = self_affine(hurst=0.8, samples=1001, length=1e-2, seed=8, rms_height=1e-6)


def transmission(wavelength: float, cutoff: float) -> float:
    """Part of a wave's amplitude that the mean line holds (ISO 16610-21:2011, eq. 2)."""
    return 2.0 ** -((cutoff / wavelength) ** 2)


def wave(x: np.ndarray, wavelength: float) -> np.ndarray:
    return np.cos(2.0 * pi * x / wavelength + 0.3)


def inside(x: np.ndarray, margin: float = 2.0 * CUTOFF) -> np.ndarray:
    return (x > x[0] + margin) & (x < x[-1] - margin)


def least_squares_line(profile: Profile, cutoff: float, place: float) -> float:
    """The line fitted to the spline with the weighting function, at `place`, by a fine sum."""
    t = np.linspace(profile.x[0], profile.x[-1], 200_001)
    weight = np.exp(-pi * ((t - place) / (ALPHA * cutoff)) ** 2)
    weight[[0, -1]] *= 0.5
    basis = np.stack((np.ones_like(t), (t - place) / cutoff))
    return np.linalg.solve((basis * weight) @ basis.T, (basis * weight) @ profile.spline()(t))[0]


@pytest.mark.parametrize("wavelength", [0.25, 0.5, 1.0, 2.0, 4.0])
def test_waves_pass_as_the_standard_says(wavelength):
    share = transmission(wavelength, CUTOFF)
    assert share == pytest.approx(np.exp(-pi * (ALPHA * CUTOFF / wavelength) ** 2), rel=1e-13)
    line = mean_line(Profile(X, wave(X, wavelength)), CUTOFF)
    # no part of it out of phase, or the difference would show it
    assert np.max(np.abs(line - share * wave(X, wavelength))[inside(X)]) < 2e-7


def test_both_cutoffs_leave_the_waves_between():
    waves = {0.125: 1.0, 0.5: 0.3, 8.0: 2.0}
    x = np.linspace(0.0, LENGTH, 40 * 256 + 1)
    profile = Profile(x, sum(a * wave(x, w) for w, a in waves.items()))
    height = filtered(profile, 2.0, 0.1).height
    wanted = sum(
        a * transmission(w, 0.1) * (1.0 - transmission(w, 2.0)) * wave(x, w)
        for w, a in waves.items()
    )
    assert np.max(np.abs(height - wanted)[inside(x, 4.0)]) < 2e-6


def test_uneven_samples_change_nothing():
    x = np.concatenate(([0.0], np.cumsum(np.random.default_rng(1).uniform(0.2, 1.8, 4000))))
    x *= LENGTH / x[-1]
    line = mean_line(Profile(x, wave(x, CUTOFF)), CUTOFF)
    assert np.max(np.abs(line - 0.5 * wave(x, CUTOFF))[inside(x)]) < 1e-6


@pytest.mark.parametrize("sample", [0, 1, 3, 10, 32, 320, 640])
def test_up_to_the_ends_it_is_the_line_fitted_with_the_same_weights(sample):
    x = X[:641]
    profile = Profile(x, wave(x, 1.5) + 0.3 * wave(x, 0.4))
    line = mean_line(profile, CUTOFF)[sample]
    assert line == pytest.approx(least_squares_line(profile, CUTOFF, x[sample]), abs=5e-6)


def test_short_cutoff_at_its_bound_is_integrated_too():
    x = np.linspace(0.0, 1.0, 101)
    profile = Profile(x, np.random.default_rng(2).standard_normal(101))
    line = mean_line(profile, 0.02)
    for sample in (1, 5, 50, 99):
        wanted = least_squares_line(profile, 0.02, x[sample])
        assert line[sample] == pytest.approx(wanted, abs=5e-5)


def test_a_straight_line_is_no_roughness():
    for x in (X, X**1.1):
        line = Profile(x, 3.0 + 0.2 * x)
        assert np.max(np.abs(filtered(line, CUTOFF).height)) < 1e-11


@pytest.mark.parametrize("cutoff", [1e-4, 8e-4])
def test_agrees_with_the_filter_of_scipy(cutoff):
    pitch = ROUGH.spacing
    sigma = ALPHA * cutoff / np.sqrt(2.0 * pi) / pitch
    theirs = gaussian_filter1d(ROUGH.height, sigma, truncate=12.0)
    ours = mean_line(ROUGH, cutoff)
    middle = inside(ROUGH.x, 2.0 * cutoff)
    assert np.max(np.abs(ours - theirs)[middle]) < 2e-4 * np.std(theirs)


def test_scales_and_mirrors():
    line = mean_line(ROUGH, 5e-4)
    scaled = mean_line(Profile(1e3 * ROUGH.x, 1e-6 * ROUGH.height), 0.5)
    np.testing.assert_allclose(scaled, 1e-6 * line, rtol=0.0, atol=1e-12 * 1e-12)
    mirrored = mean_line(ROUGH.mirrored(), 5e-4)[::-1]
    np.testing.assert_allclose(mirrored, line, rtol=0.0, atol=1e-11 * np.max(np.abs(line)))
    lifted = mean_line(Profile(ROUGH.x, ROUGH.height + 1.0), 5e-4)
    np.testing.assert_allclose(lifted - 1.0, line, rtol=0.0, atol=1e-14)


def test_error_of_the_grid_falls_with_its_step(monkeypatch):
    """Quintic spline between points of the grid: sixth order."""
    x = X + 0.002 * np.sin(40.0 * X)  # no even samples
    profile = Profile(x, wave(x, CUTOFF))
    monkeypatch.setattr(module, "STEPS_PER_SPACING", 1e-9)
    errors = []
    for steps in (8, 11, 16):
        monkeypatch.setattr(module, "STEPS_PER_CUTOFF", steps)
        line = mean_line(profile, CUTOFF)
        errors.append(np.max(np.abs(line - 0.5 * wave(x, CUTOFF))[inside(x)]))
    orders = np.log2(np.array(errors[:-1]) / errors[1:]) / np.log2([11 / 8, 16 / 11])
    assert np.all(np.abs(orders - 6.0) < 0.8), (errors, orders)


@pytest.mark.parametrize("cutoff", [0.0, 1.9e-5, 5.1e-3, np.nan])
def test_cutoffs_that_do_not_suit_are_refused(cutoff):
    with pytest.raises(ValueError, match=r"spacings, 2e-05 m, to half of its length, 0\.005 m"):
        mean_line(ROUGH, cutoff)


@pytest.mark.parametrize("bound", [2e-5, 5e-3])
def test_bounds_themselves_are_allowed(bound):
    check_cutoff(ROUGH, bound)


def test_cutoffs_in_the_wrong_order_are_refused():
    with pytest.raises(ValueError, match=r"short cut-off of 0\.001 m must lie below .* 0\.0005 m"):
        filtered(ROUGH, 5e-4, 1e-3)


def test_without_a_cutoff_nothing_changes():
    assert filtered(ROUGH) is ROUGH
