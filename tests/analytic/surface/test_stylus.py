"""Noise has the size and correlation asked for; a tip rounds crests and leaves the rest."""

import numpy as np
import pytest

from analytic.profile import Profile
from analytic.surface.stylus import opened, with_noise

X = np.linspace(0.0, 4e-3, 8001)
FLAT = Profile(X, np.zeros_like(X))
SIZE = 20e-9


@pytest.mark.parametrize("length", [0.0, 0.3e-6, 2e-6, 10e-6])
def test_noise_has_its_deviation(length):
    noise = with_noise(FLAT, SIZE, length, np.random.default_rng(1)).height
    # as many independent values as correlation lengths
    scatter = np.sqrt(max(length, X[1]) / X[-1])
    assert noise.std() == pytest.approx(SIZE, rel=2.0 * scatter)


def test_noise_has_its_correlation():
    length = 5e-6
    of_seeds = [with_noise(FLAT, SIZE, length, np.random.default_rng(s)).height for s in range(40)]
    for lag in (4, 10, 20):
        distance = X[lag]
        products = np.mean([np.mean(z[:-lag] * z[lag:]) for z in of_seeds])
        assert products / SIZE**2 == pytest.approx(np.exp(-((distance / length) ** 2)), abs=0.03)


def test_white_noise_has_none():
    z = with_noise(FLAT, SIZE, 0.0, np.random.default_rng(1)).height
    assert abs(np.mean(z[1:] * z[:-1])) < 0.05 * SIZE**2


def test_the_same_generator_makes_the_same_noise():
    one, other = (with_noise(FLAT, SIZE, 1e-6, np.random.default_rng(7)) for _ in range(2))
    assert np.array_equal(one.height, other.height)


def test_a_crest_sharper_than_the_tip_gets_its_radius():
    radius, sharp = 2e-6, 0.5e-6
    x = np.linspace(-5e-6, 5e-6, 4001)
    ridge = Profile(x, -np.abs(x))  # an edge, sharper than any tip
    rounded = opened(ridge, radius)
    top = np.abs(x) < 0.3 * sharp
    curvature = -np.polyfit(x[top], rounded.height[top], 2)[0] * 2.0
    assert curvature == pytest.approx(1.0 / radius, rel=0.02)
    # the circle touches both flanks at 45 degrees: its top is (sqrt 2 - 1) r below the edge
    assert rounded.height.max() == pytest.approx(-(np.sqrt(2.0) - 1.0) * radius, rel=1e-3)
    flank = np.abs(x) > radius
    assert rounded.height[flank][10:-10] == pytest.approx(ridge.height[flank][10:-10], abs=1e-12)


def test_blunt_crests_and_valleys_stay():
    x = np.linspace(-1e-3, 1e-3, 4001)
    wave = Profile(x, 0.1e-6 * np.cos(2.0 * np.pi * x / 100e-6))  # crests of 2.5 mm radius
    assert opened(wave, 5e-6).height == pytest.approx(wave.height, abs=1e-12)
    cusps = Profile(x, 0.1e-6 * np.abs(np.sin(2.0 * np.pi * x / 100e-6)))  # edges are valleys
    assert opened(cusps, 5e-6).height == pytest.approx(cusps.height, abs=1e-12)


def test_opening_is_idempotent_and_never_adds():
    rng = np.random.default_rng(3)
    rough = with_noise(FLAT, 100e-9, 2e-6, rng)
    once = opened(rough, 10e-6)
    assert np.all(once.height <= rough.height + 1e-18)
    assert np.ptp(once.height - rough.height) > 10e-9
    assert opened(once, 10e-6).height == pytest.approx(once.height, abs=1e-15)


def test_uneven_samples_are_opened_alike():
    rng = np.random.default_rng(3)
    x = np.sort(rng.uniform(-5e-6, 5e-6, 8000))
    rounded = opened(Profile(x, -np.abs(x)), 2e-6)
    assert rounded.height.max() == pytest.approx(-(np.sqrt(2.0) - 1.0) * 2e-6, rel=5e-3)
    flank = np.abs(x) > 2e-6
    assert rounded.height[flank][30:-30] == pytest.approx(-np.abs(x[flank])[30:-30], abs=1e-11)
