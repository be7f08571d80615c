"""Form removal: exact recovery, fair weights, honest words."""

from math import inf, isinf

import numpy as np
import pytest

from analytic.profile import Profile
from analytic.surface.form import remove_form, trapezoid_widths

LENGTH = 4e-3


def uneven(samples=301, seed=3):
    """Ascending x over LENGTH, crowded at random."""
    x = np.cumsum(np.random.default_rng(seed).uniform(0.05, 1.0, samples))
    return LENGTH * (x - x[0]) / (x[-1] - x[0])


def arc(x, radius, tilt=0.0):
    """Circle of signed radius through the middle of x, where its slope is `tilt`.

    Written with half-angle terms so that radii far beyond the length keep all their digits.
    """
    u = x - 0.5 * (x[0] + x[-1])
    sine = tilt / np.hypot(1.0, tilt)
    s = sine - u / radius
    return u * (sine + s) / (np.sqrt(1.0 - s**2) + np.sqrt(1.0 - sine**2))


def test_none_leaves_the_profile_alone():
    profile = Profile(uneven(), np.cos(uneven() / 1e-3))
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
    x = uneven()
    left, form = remove_form(Profile(x, 2e-6 - 3e-3 * x), "line")
    assert form.slope == pytest.approx(-3e-3, rel=1e-13)
    assert form.mean == pytest.approx(2e-6 - 3e-3 * 0.5 * LENGTH, rel=1e-13)
    assert np.max(np.abs(left.height)) < 1e-20
    np.testing.assert_array_equal(left.x, x)


def test_residual_of_a_line_is_orthogonal_to_lines_under_the_integral():
    x = uneven()
    height = np.random.default_rng(1).normal(size=len(x))
    left, _ = remove_form(Profile(x, height), "line")
    weight = trapezoid_widths(x) / LENGTH
    assert np.sum(weight) == pytest.approx(1.0, rel=1e-14)
    assert abs(np.dot(weight, left.height)) < 1e-14
    assert abs(np.dot(weight, left.height * x / LENGTH)) < 1e-14


@pytest.mark.parametrize("tilt", [0.0, 2e-4, -0.1])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("radius_over_length", [0.7, 3.0, 1e2, 1e4, 1e6])
def test_arc_is_recovered(radius_over_length, sign, tilt):
    x = uneven()
    radius = sign * radius_over_length * LENGTH
    height = arc(x, radius, tilt)
    left, form = remove_form(Profile(x, height + 5e-8), "arc")
    sagitta = LENGTH / (8.0 * radius_over_length)
    rounding = np.finfo(float).eps * (np.max(np.abs(height)) + 5e-8)
    assert form.radius == pytest.approx(radius, rel=1e-12 + 20.0 * rounding / sagitta)
    assert form.slope == pytest.approx(tilt, abs=1e-12)
    assert np.max(np.abs(left.height)) < 30.0 * rounding


@pytest.mark.parametrize(("radius", "said"), [(0.05, "convex"), (-0.05, "concave")])
def test_convex_is_positive_and_said_so(radius, said):
    x = uneven()
    _, form = remove_form(Profile(x, -((x - 0.5 * LENGTH) ** 2) / (2.0 * radius)), "arc")
    assert form.radius == pytest.approx(radius, rel=1e-3)
    assert f"{said}, radius 0.05" in str(form)


@pytest.mark.parametrize(("mean", "slope"), [(0.0, 0.0), (1e-3, 0.0), (0.0, 0.02), (1e-3, -0.3)])
def test_straight_trace_has_no_radius(mean, slope):
    x = uneven()
    left, form = remove_form(Profile(x, mean + slope * x), "arc")
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
    x = uneven()
    radius, tilt = 1.2 * LENGTH, 0.5
    rough = 0.02 * LENGTH * np.random.default_rng(8).normal(size=len(x))
    left, form = remove_form(Profile(x, arc(x, radius, tilt) + rough), "arc")
    weight = trapezoid_widths(x) / LENGTH
    step = 1e-6
    by_tilt = arc(x, form.radius, form.slope + step) - arc(x, form.radius, form.slope - step)
    more, less = form.radius * (1.0 + step), form.radius * (1.0 - step)
    by_radius = arc(x, more, form.slope) - arc(x, less, form.slope)
    for change in (np.ones_like(x), by_tilt, by_radius):
        size = np.sqrt(np.dot(weight, change**2) * np.dot(weight, left.height**2))
        assert abs(np.dot(weight, left.height * change)) < 1e-6 * size


# Arcs form no linear space: what is best beside a bent arc is not quite so beside a flat one.
@pytest.mark.parametrize(("form", "change"), [("mean", 1e-12), ("line", 1e-12), ("arc", 1e-4)])
def test_removing_twice_changes_nothing(form, change):
    x = uneven()
    rough = 1e-7 * np.random.default_rng(2).normal(size=len(x))
    once, _ = remove_form(Profile(x, arc(x, -0.03, 0.01) + rough), form)
    twice, rest = remove_form(once, form)
    size = np.max(np.abs(once.height))
    np.testing.assert_allclose(twice.height, once.height, rtol=0.0, atol=change * size)
    assert abs(rest.slope) < change * size / LENGTH * 10.0
    assert abs(rest.radius) > 1e3


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_units_do_not_matter(scale):
    x = uneven()
    height = arc(x, 0.01, 0.05) + 1e-6 * np.cos(x / 1e-4)
    left, form = remove_form(Profile(x, height), "arc")
    scaled_left, scaled = remove_form(Profile(scale * x, scale * height), "arc")
    assert scaled.radius == pytest.approx(scale * form.radius, rel=1e-9)
    assert scaled.slope == pytest.approx(form.slope, rel=1e-9)
    np.testing.assert_allclose(scaled_left.height, scale * left.height, atol=1e-14 * scale)


def test_mirrored_trace_has_the_mirrored_form():
    x = uneven()
    profile = Profile(x, arc(x, 0.01, 0.05) + 1e-6 * np.cos(x / 1e-4))
    left, form = remove_form(profile, "arc")
    mirrored_left, mirrored = remove_form(profile.mirrored(), "arc")
    assert mirrored.slope == pytest.approx(-form.slope, rel=1e-9)
    assert mirrored.radius == pytest.approx(form.radius, rel=1e-9)
    np.testing.assert_allclose(mirrored_left.height, left.height[::-1], atol=1e-15)


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
