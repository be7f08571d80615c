"""h/R of asperities: the book's chain of coefficients, Hertz's, and the thresholds."""

import numpy as np
import pytest

from analytic.exact.hertz import hertz_from_load
from analytic.statistics.penetration import contact_kind, relative_penetration

MODULUS = 207e9 / (1.0 - 0.3**2)


def test_printed_coefficient_is_short_of_hertz_by_a_rounded_factor():
    """a = 0.88 (P R/E)^(1/3), q0 = 0.66 (P E^2/R^2)^(1/3): 0.88^2/0.66^2; exact 0.6159."""
    q0 = 0.05 * 207e9
    depth = relative_penetration(q0, MODULUS)
    assert depth["book"] / 0.05**2 == pytest.approx(0.88**2 / 0.66**2, rel=2e-3)
    load, radius, young = 3.0, 1e-4, 207e9
    a = (0.75 * load * radius / MODULUS) ** (1 / 3)
    peak = 1.5 * load / (np.pi * a**2)
    assert peak / (load * young**2 / radius**2) ** (1 / 3) == pytest.approx(0.6159, abs=5e-5)
    assert relative_penetration(peak, MODULUS)["sphere"] == pytest.approx((a / radius) ** 2)
    assert depth["sphere"] / 0.05**2 == pytest.approx(2.043, abs=5e-4)
    assert depth["book"] / depth["sphere"] == pytest.approx(0.871, abs=1e-3)


def test_a_ridge_is_hertz_line_contact():
    hertz = hertz_from_load(1e5, 50e-6, MODULUS)
    depth = relative_penetration(hertz.peak_pressure, MODULUS)
    assert depth["ridge"] == pytest.approx((hertz.half_width / hertz.radius) ** 2)


@pytest.mark.parametrize(
    ("threshold", "book", "exact"),
    [(0.01, 0.0750, 0.0700), (1e-4, 0.00750, 0.00700), (0.1, 0.237, 0.221), (0.3, 0.411, 0.383)],
)
def test_thresholds_as_pressures(threshold, book, exact):
    """q0/E at the thresholds of h/R, three digits."""
    for name, ratio in (("book", book), ("sphere", exact)):
        unit = float(relative_penetration(207e9, MODULUS)[name])
        assert np.sqrt(threshold / unit) == pytest.approx(ratio, rel=2e-3)


def test_kinds_follow_metal_and_lubrication():
    depths = np.array([5e-5, 5e-3, 0.05, 0.2, 0.5])
    assert contact_kind(depths, depths, "ferrous", lubricated=False).tolist() == [
        "elastic", "elastic", "plastic", "cutting", "cutting",
    ]  # fmt: skip
    wet = contact_kind(depths, depths, "nonferrous", lubricated=True)
    assert wet.tolist() == ["elastic", "plastic", "plastic", "plastic", "cutting"]
