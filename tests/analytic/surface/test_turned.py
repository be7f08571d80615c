"""Turned surfaces against the geometry of the tool's path. Form removal: exact recovery, fair
weights, honest words."""

from math import inf, isinf, sqrt

import numpy as np
import pytest
from text_profiles import mirrored

from analytic.profile import MAX_SAMPLES, Profile
from analytic.surface.form import remove_form, trapezoid_widths
from analytic.surface.roughness import roughness
from analytic.surface.turned import SAMPLES_PER_RIDGE, turned, turned_height

FEED, NOSE = 0.1e-3, 0.8e-3
SHAPES = [  # feed, nose radius, ridge radius
    (0.1e-3, 0.8e-3, 0.08e-3),
    (0.2e-3, 0.4e-3, 0.02e-3),
    (0.4e-3, 0.4e-3, 0.04e-3),
    (0.1e-3, 1.2e-3, 0.5e-3),
]


@pytest.mark.parametrize(("feed", "nose", "ridge"), SHAPES)
def test_every_sample_lies_on_its_arc(feed, nose, ridge):
    """Distance from the centre of the arc, over its radius; heights free."""
    profile = turned(feed=feed, nose_radius=nose, ridge_radius=ridge, length=6.0 * feed)
    u = np.abs((profile.x / feed + 0.5) % 1.0 - 0.5) * feed
    concave = u > 0.5 * feed * ridge / (nose + ridge)
    lowest = profile.spline()(0.5 * feed)
    z = profile.height - lowest
    across = np.where(concave, 0.5 * feed - u, u)
    height = turned_height(feed, nose, ridge)
    along = np.where(concave, nose - z, z - height + ridge)
    distance = np.hypot(across, along) / np.where(concave, nose, ridge)
    np.testing.assert_allclose(distance, 1.0, rtol=0.0, atol=1e-7)


def test_height_is_the_machinists_estimate_where_feed_and_ridge_are_small():
    height = turned_height(1e-5, NOSE, 1e-9)
    assert height == pytest.approx(1e-10 / (8.0 * NOSE), rel=2e-5)
    for ridge, reach, near in ((1e-12, NOSE, 1e-6), (0.1e-3, NOSE + 0.1e-3, 1e-9)):
        exact = reach - sqrt(reach**2 - FEED**2 / 4.0)
        assert turned_height(FEED, NOSE, ridge) == pytest.approx(exact, rel=near)


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
    how, errors = {"feed": FEED, "nose_radius": NOSE, "length": 4.0 * FEED}, []
    fine = turned(**how, samples_per_feed=132 * 128)
    for refined in (1, 2, 4, 8):
        coarse = turned(**how, samples_per_feed=132 * refined)
        inner = np.abs(fine.x) < 1.9 * FEED
        errors.append(np.ptp(coarse.spline()(fine.x[inner]) - fine.height[inner]))
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
    np.testing.assert_allclose(quarter.height[inner], moved, rtol=0.0, atol=1e-10)


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
    noisy, again, other = (
        turned(**settings, noise=0.2e-6, noise_wavelength=8e-6, seed=seed) for seed in (4, 4, 5)
    )
    noise = noisy.height - plain.height
    assert np.std(noise) == pytest.approx(0.2e-6, rel=1e-3)
    power = np.abs(np.fft.rfft(noise[:-1])) ** 2
    waves = np.arange(len(power)) / noisy.length
    assert np.sum(power[waves > 1.0 / 8e-6 * (1 + 1e-9)]) < 1e-20 * np.sum(power)
    assert power[0] < 1e-6 * np.mean(power[waves <= 1.0 / 8e-6])
    assert power[round(noisy.length / 8e-6)] > 0.01 * np.mean(power[waves <= 1.0 / 8e-6])
    low, high = power[(waves > 0) & (waves < 0.5 / 8e-6)], power[(waves > 0.5 / 8e-6)]
    assert np.sum(low) == pytest.approx(np.sum(high), rel=0.35)
    assert np.array_equal(noisy.height, again.height)
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


LENGTH = 4e-3


def uneven(samples=301, seed=3):
    """Ascending x over LENGTH, crowded at random."""
    x = np.cumsum(np.random.default_rng(seed).uniform(0.05, 1.0, samples))
    return LENGTH * (x - x[0]) / (x[-1] - x[0])


X = uneven()


def arc(x, radius, tilt=0.0):
    """Circle of signed radius through the middle of x, where its slope is `tilt`.

    Written with half-angle terms so that radii far beyond the length keep all their digits.
    """
    u = x - 0.5 * (x[0] + x[-1])
    sine = tilt / np.hypot(1.0, tilt)
    s = sine - u / radius
    return u * (sine + s) / (np.sqrt(1.0 - s**2) + np.sqrt(1.0 - sine**2))


def test_none_leaves_the_profile_alone():
    profile = Profile(X, np.cos(X / 1e-3))
    left, form = remove_form(profile, "none")
    assert left is profile
    assert str(form) == "no form removed"


def test_mean_is_the_mean_over_length_not_over_samples():
    # One quarter of the length holds most samples; a ramp's mean is still in its middle.
    x = np.concatenate((np.linspace(0.0, 1.0, 400), np.linspace(1.2, 4.0, 15)))
    left, form = remove_form(Profile(x, 3.0 * x), "mean")
    assert form.mean == pytest.approx(6.0, rel=1e-14)
    np.testing.assert_allclose(left.height, 3.0 * x - 6.0, atol=1e-13)
    assert form.slope == 0.0 and isinf(form.radius)


def test_line_is_recovered_exactly_on_uneven_samples():
    left, form = remove_form(Profile(X, 2e-6 - 3e-3 * X), "line")
    assert form.slope == pytest.approx(-3e-3, rel=1e-13)
    assert form.mean == pytest.approx(2e-6 - 3e-3 * 0.5 * LENGTH, rel=1e-13)
    assert np.max(np.abs(left.height)) < 1e-20
    np.testing.assert_array_equal(left.x, X)


def test_residual_of_a_line_is_orthogonal_to_lines_under_the_integral():
    height = np.random.default_rng(1).normal(size=len(X))
    left, _ = remove_form(Profile(X, height), "line")
    weight = trapezoid_widths(X) / LENGTH
    assert np.sum(weight) == pytest.approx(1.0, rel=1e-14)
    assert abs(np.dot(weight, left.height)) < 1e-14
    assert abs(np.dot(weight, left.height * X / LENGTH)) < 1e-14


@pytest.mark.parametrize("tilt", [0.0, 2e-4, -0.1])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("radius_over_length", [0.7, 3.0, 1e2, 1e4, 1e6])
def test_arc_is_recovered(radius_over_length, sign, tilt):
    radius = sign * radius_over_length * LENGTH
    height = arc(X, radius, tilt)
    left, form = remove_form(Profile(X, height + 5e-8), "arc")
    sagitta = LENGTH / (8.0 * radius_over_length)
    rounding = np.finfo(float).eps * (np.max(np.abs(height)) + 5e-8)
    assert form.radius == pytest.approx(radius, rel=1e-12 + 20.0 * rounding / sagitta)
    assert form.slope == pytest.approx(tilt, abs=1e-12)
    assert np.max(np.abs(left.height)) < 30.0 * rounding


@pytest.mark.parametrize(("radius", "said"), [(0.05, "convex"), (-0.05, "concave")])
def test_convex_is_positive_and_said_so(radius, said):
    _, form = remove_form(Profile(X, -((X - 0.5 * LENGTH) ** 2) / (2.0 * radius)), "arc")
    assert form.radius == pytest.approx(radius, rel=1e-3)
    assert f"{said}, radius 0.05" in str(form)


@pytest.mark.parametrize(("mean", "slope"), [(0.0, 0.0), (1e-3, 0.0), (0.0, 0.02), (1e-3, -0.3)])
def test_straight_trace_has_no_radius(mean, slope):
    left, form = remove_form(Profile(X, mean + slope * X), "arc")
    assert form.radius == inf
    assert form.slope == pytest.approx(slope, abs=1e-12)
    assert "straight" in str(form)
    assert np.max(np.abs(left.height)) < 1e-17


@pytest.mark.parametrize("size", [1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-4, 1e-2])
def test_noise_of_any_size_leaves_an_arc(size):
    generator = np.random.default_rng(12)
    for _ in range(20):
        x = uneven(samples=generator.integers(30, 300), seed=generator.integers(1000))
        radius, tilt = LENGTH * 10 ** generator.uniform(0.5, 3.0), generator.uniform(-0.3, 0.3)
        noise = size * LENGTH * generator.normal(size=len(x))
        _, form = remove_form(Profile(x, arc(x, radius, tilt) + noise), "arc")
        # The curvature of noise alone over a line of n samples has a scatter of 27 / sqrt(n).
        scatter = 27.0 * size / np.sqrt(len(x)) / LENGTH
        assert abs(1.0 / form.radius - 1.0 / radius) < 10.0 * scatter + 1e-12 / LENGTH
        assert form.slope == pytest.approx(tilt, abs=30.0 * size)


def test_residual_of_an_arc_is_orthogonal_to_every_change_of_the_arc():
    radius, tilt = 1.2 * LENGTH, 0.5
    rough = 0.02 * LENGTH * np.random.default_rng(8).normal(size=len(X))
    left, form = remove_form(Profile(X, arc(X, radius, tilt) + rough), "arc")
    weight = trapezoid_widths(X) / LENGTH
    step = 1e-6
    by_tilt = arc(X, form.radius, form.slope + step) - arc(X, form.radius, form.slope - step)
    more, less = form.radius * (1.0 + step), form.radius * (1.0 - step)
    by_radius = arc(X, more, form.slope) - arc(X, less, form.slope)
    for change in (np.ones_like(X), by_tilt, by_radius):
        size = np.sqrt(np.dot(weight, change**2) * np.dot(weight, left.height**2))
        assert abs(np.dot(weight, left.height * change)) < 1e-6 * size


# Arcs form no linear space: what is best beside a bent arc is not quite so beside a flat one.
@pytest.mark.parametrize(("form", "change"), [("mean", 1e-12), ("line", 1e-12), ("arc", 1e-4)])
def test_removing_twice_changes_nothing(form, change):
    rough = 1e-7 * np.random.default_rng(2).normal(size=len(X))
    once, _ = remove_form(Profile(X, arc(X, -0.03, 0.01) + rough), form)
    twice, rest = remove_form(once, form)
    size = np.max(np.abs(once.height))
    np.testing.assert_allclose(twice.height, once.height, rtol=0.0, atol=change * size)
    assert abs(rest.slope) < change * size / LENGTH * 10.0
    assert abs(rest.radius) > 1e3


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_units_of_form_do_not_matter(scale):
    height = arc(X, 0.01, 0.05) + 1e-6 * np.cos(X / 1e-4)
    left, form = remove_form(Profile(X, height), "arc")
    scaled_left, scaled = remove_form(Profile(scale * X, scale * height), "arc")
    assert scaled.radius == pytest.approx(scale * form.radius, rel=1e-9)
    assert scaled.slope == pytest.approx(form.slope, rel=1e-9)
    np.testing.assert_allclose(scaled_left.height, scale * left.height, atol=1e-14 * scale)


def test_mirrored_trace_has_the_mirrored_form():
    profile = Profile(X, arc(X, 0.01, 0.05) + 1e-6 * np.cos(X / 1e-4))
    left, form = remove_form(profile, "arc")
    other_left, other = remove_form(mirrored(profile), "arc")
    assert other.slope == pytest.approx(-form.slope, rel=1e-9)
    assert other.radius == pytest.approx(form.radius, rel=1e-9)
    np.testing.assert_allclose(other_left.height, left.height[::-1], atol=1e-15)


@pytest.mark.parametrize(
    ("height", "form", "words"),
    [
        (lambda x: np.sqrt(1.0 - x**2), "arc", "no circular arc fits"),
        (lambda x: 100.0 * np.sign(x), "arc", "no circular arc fits"),
        (np.cos, "circle", "allowed: none, mean, line, arc"),
    ],
)
def test_what_has_no_such_form_is_refused(height, form, words):
    x = np.linspace(-1.0, 1.0, 41)
    with pytest.raises(ValueError, match=words):
        remove_form(Profile(x, height(x)), form)
