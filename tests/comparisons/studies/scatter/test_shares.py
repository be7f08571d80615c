"""Shares of variance against functions whose shares are known, and where these must vanish."""

import numpy as np
import pytest

from comparisons.studies.scatter.shares import designs, shares


def shares_of(function, inputs: int, samples: int, seed: int = 0):
    cube = designs(samples, inputs, seed)
    return shares(function(cube), cube)


def test_a_design_mixes_two_and_changes_one_input_each():
    one, other, *mixed = designs(16, 3, 5)
    for i, sample in enumerate(mixed):
        changed = np.array([j == i for j in range(3)])
        assert np.array_equal(sample, np.where(changed, other, one))
    assert not np.any(one == other)
    assert np.array_equal(designs(16, 3, 5), designs(16, 3, 5))
    assert not np.array_equal(designs(16, 3, 5), designs(16, 3, 6))


def test_ishigami():
    """sin x + 7 sin^2 y + 0.1 z^4 sin x on (-pi, pi)^3: shares in closed form."""

    def ishigami(cube):
        x, y, z = np.moveaxis(np.pi * (2.0 * cube - 1.0), -1, 0)
        return np.sin(x) + 7.0 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x)

    x = 0.5 * (1.0 + 0.1 * np.pi**4 / 5.0) ** 2
    y, together = 7.0**2 / 8.0, 8.0 * 0.1**2 * np.pi**8 / 225.0
    exact = np.array([[x, y, 0.0], [x + together, y, together]]) / (x + y + together)
    result = shares_of(ishigami, 3, 4096)
    assert result.first == pytest.approx(exact[0], abs=0.02)
    assert result.total == pytest.approx(exact[1], abs=0.02)
    assert np.all(np.abs(result.first - exact[0]) < 2.0 * result.first_uncertainty)
    coarse = shares_of(ishigami, 3, 256)
    assert np.all(coarse.first_uncertainty > 2.0 * result.first_uncertainty)


@pytest.mark.parametrize("samples", [16, 64])
def test_few_samples_suffice_for_a_line(samples):
    slopes = np.array([3.0, -1.0, 0.5])
    result = shares_of(lambda cube: 10.0 + cube @ slopes, 3, samples)
    exact = slopes**2 / np.sum(slopes**2)
    assert result.first == pytest.approx(exact, abs=0.02)
    assert result.total == pytest.approx(result.first, abs=1e-12)


def test_samples_without_an_answer_are_left_out():
    cube = designs(64, 2, 0)
    values = cube @ np.array([1.0, 1.0])
    values[2, 5] = np.nan
    assert shares(values, cube).first == pytest.approx([0.5, 0.5], abs=0.05)


def test_what_does_not_vary_has_no_shares():
    cube = designs(16, 2, 0)
    assert shares(np.full(cube.shape[:2], 3.0), cube) is None
    assert shares(np.full(cube.shape[:2], np.nan), cube) is None
