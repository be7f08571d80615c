"""Turned surfaces against the geometry of the tool's path."""

from math import sqrt

import numpy as np
import pytest

from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.roughness import roughness
from analytic.surface.turned import SAMPLES_PER_RIDGE, turned, turned_height

FEED, NOSE = 0.1e-3, 0.8e-3
SHAPES = [  # feed, nose radius, ridge radius
    (0.1e-3, 0.8e-3, 0.08e-3),
    (0.2e-3, 0.4e-3, 0.02e-3),
    (0.4e-3, 0.4e-3, 0.04e-3),
    (0.1e-3, 1.2e-3, 0.5e-3),
]


def centres(profile: Profile, feed: float, nose: float, ridge: float) -> np.ndarray:
    """Distance of each sample from the centre of its arc, over the arc's radius; heights free."""
    u = np.abs((profile.x / feed + 0.5) % 1.0 - 0.5) * feed
    concave = u > 0.5 * feed * ridge / (nose + ridge)
    lowest = profile.spline()(0.5 * feed)
    z = profile.height - lowest
    across = np.where(concave, 0.5 * feed - u, u)
    height = turned_height(feed, nose, ridge)
    along = np.where(concave, nose - z, z - height + ridge)
    return np.hypot(across, along) / np.where(concave, nose, ridge)


@pytest.mark.parametrize(("feed", "nose", "ridge"), SHAPES)
def test_every_sample_lies_on_its_arc(feed, nose, ridge):
    profile = turned(feed=feed, nose_radius=nose, ridge_radius=ridge, length=6.0 * feed)
    np.testing.assert_allclose(centres(profile, feed, nose, ridge), 1.0, rtol=0.0, atol=1e-7)


def test_height_is_the_machinists_estimate_where_feed_and_ridge_are_small():
    height = turned_height(1e-5, NOSE, 1e-9)
    assert height == pytest.approx(1e-10 / (8.0 * NOSE), rel=2e-5)
    assert turned_height(FEED, NOSE, 1e-12) == pytest.approx(
        NOSE - sqrt(NOSE**2 - FEED**2 / 4.0), rel=1e-6
    )
    reach = NOSE + 0.1e-3
    assert turned_height(FEED, NOSE, 0.1e-3) == pytest.approx(
        reach - sqrt(reach**2 - FEED**2 / 4.0), rel=1e-9
    )


@pytest.mark.parametrize("phase", [0.0, 0.37])
@pytest.mark.parametrize(("feed", "nose", "ridge"), SHAPES)
def test_the_spline_overshoots_neither_ridge_nor_valley(feed, nose, ridge, phase):
    profile = turned(
        feed=feed, nose_radius=nose, ridge_radius=ridge, length=10.0 * feed, phase=phase
    )
    height = turned_height(feed, nose, ridge)
    figures = roughness(profile)
    assert -1e-3 * height < figures.rt - height < 1e-6 * height
    steepest = 0.5 * feed / (nose + ridge)
    assert figures.max_slope == pytest.approx(steepest / sqrt(1.0 - steepest**2), rel=0.02)
    assert abs(figures.mean) < 1e-9 * height
    bend = profile.spline()(np.linspace(-3.0 * feed, 3.0 * feed, 20001), 2)
    assert -2.0 / ridge < bend.min() < -0.9 / ridge


def test_the_spline_reaches_the_arcs_at_second_order():
    """No more: the curvature jumps where arcs meet."""
    fine = turned(feed=FEED, nose_radius=NOSE, length=4.0 * FEED, samples_per_feed=132 * 128)
    errors = []
    for refined in (1, 2, 4, 8):
        coarse = turned(
            feed=FEED, nose_radius=NOSE, length=4.0 * FEED, samples_per_feed=132 * refined
        )
        inner = np.abs(fine.x) < 1.9 * FEED
        difference = coarse.spline()(fine.x[inner]) - fine.height[inner]
        errors.append(np.ptp(difference))
    order = np.log2(errors[0] / errors[-1]) / 3.0
    assert order == pytest.approx(2.0, abs=0.3), errors
    assert errors[0] < 5e-4 * turned_height(FEED, NOSE, 0.1 * NOSE)


def test_a_ridge_stands_where_the_phase_puts_it():
    plain = turned(feed=FEED, nose_radius=NOSE, length=8.0 * FEED)
    assert plain.x[np.argmax(plain.height * (np.abs(plain.x) < 0.5 * FEED))] == 0.0
    np.testing.assert_allclose(plain.height, plain.height[::-1], rtol=0.0, atol=1e-18)
    half = turned(feed=FEED, nose_radius=NOSE, length=8.0 * FEED, phase=0.5)
    middle = len(half.x) // 2
    assert half.height[middle] == pytest.approx(half.height.min(), rel=1e-12)
    quarter = turned(feed=FEED, nose_radius=NOSE, length=8.0 * FEED, phase=0.25)
    inner = np.abs(plain.x) < 3.0 * FEED
    moved = plain.spline()(plain.x[inner] - 0.25 * FEED)
    np.testing.assert_allclose(
        quarter.height[inner] - quarter.height[0], moved - quarter.height[0], atol=1e-10
    )


def test_blunt_ridges_skew_the_heights_less():
    figures = [
        roughness(turned(feed=FEED, nose_radius=NOSE, length=20.0 * FEED, ridge_radius=ridge))
        for ridge in (0.02 * NOSE, 0.2 * NOSE, NOSE)
    ]
    skewness = [figure.rsk for figure in figures]
    # Parabolas between sharp ridges have 0.639 (2 sqrt(5)/7); equal arcs up and down none.
    assert skewness[0] == pytest.approx(2.0 * sqrt(5.0) / 7.0, rel=0.03)
    assert skewness[0] > skewness[1] > skewness[2] == pytest.approx(0.0, abs=1e-3)
    height = turned_height(FEED, NOSE, 0.02 * NOSE)
    assert figures[0].ra == pytest.approx(4.0 / (9.0 * sqrt(3.0)) * height, rel=0.02)


def test_noise_has_its_size_and_its_waves():
    settings = {"feed": FEED, "nose_radius": NOSE, "length": 20.0 * FEED}
    plain = turned(**settings)
    noisy = turned(**settings, noise=0.2e-6, noise_wavelength=8e-6, seed=4)
    noise = noisy.height - plain.height
    assert np.std(noise) == pytest.approx(0.2e-6, rel=1e-3)
    power = np.abs(np.fft.rfft(noise[:-1])) ** 2
    waves = np.arange(len(power)) / noisy.length
    assert np.sum(power[waves > 1.0 / 8e-6 * (1 + 1e-9)]) < 1e-20 * np.sum(power)
    assert power[0] < 1e-6 * np.mean(power[waves <= 1.0 / 8e-6])
    assert power[round(noisy.length / 8e-6)] > 0.01 * np.mean(power[waves <= 1.0 / 8e-6])
    low, high = power[(waves > 0) & (waves < 0.5 / 8e-6)], power[(waves > 0.5 / 8e-6)]
    assert np.sum(low) == pytest.approx(np.sum(high), rel=0.35)
    assert np.array_equal(noisy.height, turned(**settings, noise=0.2e-6, noise_wavelength=8e-6,
                                               seed=4).height)  # fmt: skip
    other = turned(**settings, noise=0.2e-6, noise_wavelength=8e-6, seed=5)
    assert np.std(other.height - noisy.height) > 0.2e-6


def test_units_do_not_matter():
    base = turned(feed=FEED, nose_radius=NOSE, length=8.0 * FEED, noise=1e-7, seed=1)
    other = turned(feed=1e6 * FEED, nose_radius=1e6 * NOSE, length=8e6 * FEED, noise=0.1, seed=1)
    np.testing.assert_allclose(other.x, 1e6 * base.x, rtol=1e-12)
    np.testing.assert_allclose(other.height, 1e6 * base.height, rtol=0.0, atol=1e-12)


def test_covers_the_length_evenly():
    profile = turned(feed=FEED, nose_radius=NOSE, length=3.3 * FEED)
    assert 3.3 * FEED <= profile.length < 3.3 * FEED + 2.0 * profile.spacing
    assert np.ptp(np.diff(profile.x)) < 1e-9 * profile.spacing
    assert profile.x[0] == -profile.x[-1]
    assert profile.spacing * SAMPLES_PER_RIDGE <= FEED / 11.0 * (1.0 + 1e-9)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"feed": 0.0}, "feed must be positive"),
        ({"nose_radius": 0.5 * FEED}, "feed 0.0001 m must be at most nose_radius, 5e-05 m"),
        ({"phase": 1.0}, "phase must be at least 0 and below 1 feed, not 1"),
        ({"samples_per_feed": 131}, "samples_per_feed must be at least 132 to follow ridges"),
        ({"ridge_radius": 1e-9}, "allowed is a whole number from 8"),
        ({"length": 1e3}, f"to {MAX_SAMPLES}"),
        ({"noise": -1e-7}, "noise must be positive"),
        ({"noise": 1e-7, "noise_wavelength": 1e-7}, "noise_wavelength 1e-07 m must be from two"),
        ({"noise": 1e-7, "noise_wavelength": 1.0}, "to the length, 0.001 m"),
        ({"noise_wavelength": 1e-5}, "noise_wavelength is given without noise"),
    ],
)
def test_parameters_that_make_no_sense(changes, words):
    with pytest.raises(ValueError, match=words):
        turned(**({"feed": FEED, "nose_radius": NOSE, "length": 10.0 * FEED} | changes))


def test_sharp_ridges_leave_parabolas():
    """Mean square of a parabola between sharp ridges: four forty-fifths of its height."""
    profile = turned(feed=FEED, nose_radius=NOSE, ridge_radius=0.01 * NOSE, length=20.0 * FEED)
    height = turned_height(FEED, NOSE, 0.01 * NOSE)
    assert roughness(profile).rq == pytest.approx(sqrt(4.0 / 45.0) * height, rel=0.01)
