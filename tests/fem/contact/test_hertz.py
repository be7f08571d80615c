"""Hertz's contact on the compliance operator, solved by a dense active set."""

import numpy as np
import pytest

from analytic.contact.patches import contact_patches


def half_width(case):
    """Mean reach of the contact patch to both sides."""
    pitch = case.x[1] - case.x[0]
    gap = case.x**2 + pitch**2 / 6.0  # averaged over each hat
    opening = gap + case.compliance.apply(case.pressure) / pitch - case.approach
    (patch,) = contact_patches(case.x, case.pressure, opening)
    return 0.5 * np.ptp(patch)


def test_peak_pressure_and_half_width(pressed):
    case = pressed(20)
    assert case.pressure.max() == pytest.approx(1.0, rel=1e-3)
    assert half_width(case) == pytest.approx(1.0, rel=2e-3)


def test_errors_of_pressure_fall_with_their_orders(pressed):
    """Peak of second order, the whole pressure of first: its edge is a square root."""
    peak, whole = [], []
    for edges in (10, 20, 40):
        case = pressed(edges)
        x = np.linspace(-1.1, 1.1, 8801)
        error = case.pressure_at(x) - case.hertz.pressure(x)
        peak.append(abs(case.pressure.max() - 1.0))
        whole.append(np.sqrt(np.mean(error**2)))
    peak, whole = (np.log2(np.divide(e[:-1], e[1:])) for e in (peak, whole))
    assert np.all((peak > 1.5) & (peak < 2.5)), peak
    assert np.all(np.abs(whole - 1.0) < 0.1), whole


def test_a_nearly_incompressible_body_is_pressed_alike(pressed):
    case = pressed(20, poisson=0.4999)
    assert case.pressure.max() == pytest.approx(1.0, rel=2e-3)
