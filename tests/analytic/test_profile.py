"""The profile as data and as a curve that refuses to leave its samples."""

import numpy as np
import pytest

from analytic.profile import Profile, surface

UNEVEN = np.array([-3.0, -1.0, 0.0, 0.5, 2.0, 6.0])


def cubic(x):
    return 0.25 * x**3 - x**2 + 2.0


def cubic_profile():
    return Profile(UNEVEN, cubic(UNEVEN))


def test_spline_reproduces_a_cubic_with_its_derivatives():
    height = surface(cubic_profile())
    x = np.linspace(-3.0, 6.0, 37).reshape(1, 37)
    for derivative, exact in enumerate((cubic(x), 0.75 * x**2 - 2.0 * x, 1.5 * x - 2.0)):
        value = height(x, derivative)
        assert value.shape == x.shape
        np.testing.assert_allclose(value, exact, rtol=1e-12, atol=1e-12)


def test_length_is_end_to_end_and_spacing_the_median():
    assert cubic_profile().length == 9.0
    assert cubic_profile().spacing == 1.5


def test_shift_moves_the_position_to_the_origin():
    moved = cubic_profile().shifted(2.0)
    np.testing.assert_array_equal(moved.x, UNEVEN - 2.0)
    assert surface(moved)(0.0) == pytest.approx(cubic(2.0), rel=1e-14)


@pytest.mark.parametrize("x", [-3.001, 6.001, np.nan, [0.0, 7.0]])
def test_surface_refuses_to_extrapolate(x):
    with pytest.raises(ValueError, match="known from x = -3 m to 6 m, not at"):
        surface(cubic_profile())(x)


def test_rounding_beyond_an_end_is_the_end():
    height = surface(cubic_profile())
    assert height(np.nextafter(6.0, 7.0)) == height(6.0)
    assert height(np.nextafter(-3.0, -4.0)) == height(-3.0)


@pytest.mark.parametrize(
    ("x", "height", "words"),
    [
        ([0.0, 1.0, 2.0], [0.0, 0.0, 0.0], "at least 4 samples, not 3"),
        ([0.0, 1.0, 1.0, 2.0], [0.0] * 4, "ascend strictly"),
        ([0.0, 1e-40, 2e-40, 3e-40], [0.0] * 4, "1e-40 m apart; allowed is 1e-33 m or more"),
        ([0.0, 1.0, 2.0, 1e40], [0.0] * 4, "a position is 1e.40 m; allowed is up to 1e.33 m"),
        ([0.0, 1.0, 2.0, 3.0], [0.0, 1e300, 0.0, 0.0], "a height is 1e.300 m"),
        ([0.0, 1.0, 2.0, 3.0], [0.0, np.nan, 0.0, 0.0], "finite"),
        ([0.0, 1.0, 2.0, 3.0], [0.0] * 5, "equal length"),
        ([[0.0, 1.0], [2.0, 3.0]], [[0.0, 1.0], [2.0, 3.0]], "one-dimensional"),
    ],
)
def test_samples_that_are_no_profile_are_refused(x, height, words):
    with pytest.raises(ValueError, match=words):
        Profile(np.array(x), np.array(height))
