"""Elastic shakedown of the rolling and sliding line contact: Johnson's figures, and Melan."""

import numpy as np
import pytest

from analytic.exact.hertz import hertz_extremes, hertz_stress
from analytic.exact.shakedown import UNIT, shakedown_limit


def test_without_friction_at_four_times_the_shear_yield_stress():
    """Johnson 1985, section 9.2: 4.00 k, by the orthogonal shear at half a half-width's depth."""
    limit, depth = shakedown_limit(0.0)
    assert limit == pytest.approx(4.0, rel=1e-5)
    assert depth == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize("friction", [0.37, 0.5, 1.0])
def test_beyond_a_friction_of_0_367_the_surface_decides(friction):
    limit, depth = shakedown_limit(friction)
    assert depth == 0.0
    assert limit == pytest.approx(1.0 / friction, rel=1e-9)
    assert shakedown_limit(0.366)[1] > 0.3


@pytest.mark.parametrize("friction", [0.05, 0.1, 0.2, 0.36])
def test_below_the_orthogonal_shear_decides(friction):
    """Residual stresses cancel all but txz, whose largest value is found in another way."""
    extremes = hertz_extremes(UNIT, friction)
    largest = max(abs(extremes.txz_max.value), abs(extremes.txz_min.value))
    assert shakedown_limit(friction)[0] == pytest.approx(1.0 / largest, rel=2e-6)


def test_more_than_first_flow_and_ever_less_with_friction():
    frictions = np.linspace(0.0, 0.6, 7)
    limits = [shakedown_limit(mu)[0] for mu in frictions]
    first = [1.0 / hertz_extremes(UNIT, mu).tau1.value for mu in frictions]
    assert (np.diff(limits) < 0.0).all()
    assert all(a >= b * (1.0 - 1e-9) for a, b in zip(limits, first, strict=True))


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_one_residual_stress_a_depth_holds_every_place_at_the_limit(friction):
    """Melan's theorem, the residual stress by brute force."""
    limit, _ = shakedown_limit(friction)
    residual, x = np.linspace(-2.0, 2.0, 4001)[:, None], np.linspace(-8.0, 8.0, 1601)
    for depth in (0.05, 0.2, 0.4, 0.5, 0.8, 1.5):
        stress = hertz_stress(UNIT, x, depth, friction)
        shear = np.hypot(0.5 * (stress.sx - stress.sz + residual), stress.txz)
        assert limit * shear.max(axis=1).min() <= 1.002


@pytest.mark.parametrize("friction", [-0.1, np.nan, np.inf])
def test_bad_input(friction):
    with pytest.raises(ValueError, match="friction must be finite"):
        shakedown_limit(friction)
