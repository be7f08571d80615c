"""Limits of a thick and of a thin layer against the full problem, solved by collocation."""

import json
from functools import cache

import numpy as np
import pytest
from layer_limits import (
    LayerLimit,
    base_deficit,
    thick_layer,
    thin_compressible_layer,
    thin_incompressible_layer,
    thin_modulus,
)
from scenes import PROJECT

from analytic.exact.hertz import hertz_from_load
from analytic.material import Material

CASES = json.loads((PROJECT / "analytic/exact/layer_contact.json").read_text())["cases"]
GAUSS, WEIGHT = np.polynomial.legendre.leggauss(300)
HARDLY_COMPRESSIBLE = 0.5 - 1e-9
BASES = [("frictionless", 0.3), ("bonded", 0.0), ("bonded", 0.3), ("bonded", 0.4999)]


def material(nu: float) -> Material:
    """Of plane-strain modulus 1."""
    return Material(1.0 - nu**2, nu)


@cache
def full_problem(a_over_t: float, nu: float, base: str) -> tuple[float, float]:
    """Peak pressure and load in E'a/R and E'a^2/R of the full layer.

    Slope of the surface (1/pi) int p (1/(x-s) - L(x-s)) ds = x/2, L = int (1-K) sin kx dk, with
    p = sqrt(1 - s^2) phi at Chebyshev's points; lengths in a.
    """
    count = 60 if a_over_t < 8.0 else 160
    angle = np.arange(1, count + 1) * np.pi / (count + 1)
    point, weight = np.cos(angle), np.pi / (count + 1) * np.sin(angle) ** 2
    place = np.cos((2 * np.arange(1, count + 2) - 1) * np.pi / (2 * (count + 1)))
    panels = np.array([0.0, 5.0, 10.0, 20.0, 40.0])
    half = 0.5 * np.diff(panels)
    w = 0.5 * (panels[1:] + panels[:-1])[:, None] + half[:, None] * GAUSS
    dw = half[:, None] * WEIGHT
    distance = place[:, None] - point
    lines, back = np.unique(np.round(np.abs(distance), 13), return_inverse=True)
    slope = a_over_t * sum(
        np.sin(np.multiply.outer(lines * a_over_t, at)) @ (base_deficit(at, base, nu) * weights)
        for at, weights in zip(w, dw, strict=True)
    )
    slope = np.sign(distance) * slope[back.reshape(distance.shape)]
    matrix = weight / np.pi * (1.0 / distance - slope)
    shape = np.linalg.lstsq(matrix, 0.5 * place, rcond=None)[0]
    pressure = shape * weight
    # the series phi = sum c_n U_n: its value in the middle
    number = np.arange(count)
    waves = np.sin(np.multiply.outer(number + 1, angle)) / np.sin(angle)
    series = (2.0 / np.pi * waves @ pressure)[::2]
    sign = (-1.0) ** np.arange(len(series))
    return float(series @ sign), float(pressure.sum())


def errors(limit: LayerLimit, a_over_t: float, nu: float, base: str) -> np.ndarray:
    """Full over limiting peak pressure and load, less 1; the limit for a = R = 1."""
    full = np.array(full_problem(a_over_t, nu, base))
    return full / [limit.peak_pressure, limit.load_per_length] - 1.0


@pytest.mark.parametrize(
    "case", CASES, ids=lambda c: f"{c['base']}, a/t {c['a_over_t']}, nu {c['nu']}"
)
def test_full_problem_meets_the_reference(case):
    """What the limits are judged by; the reference states 1e-10 of itself."""
    a_over_t, nu = float(case["a_over_t"]), 0.3 if case["nu"] == "any" else float(case["nu"])
    peak, load = full_problem(a_over_t, nu, case["base"])
    assert peak * a_over_t == pytest.approx(float(case["p0_R_over_Eprime_t"]), rel=1e-9)
    assert load * a_over_t**2 == pytest.approx(float(case["P_R_over_Eprime_t2"]), rel=1e-9)


@pytest.mark.parametrize(("base", "nu"), BASES)
def test_what_the_base_takes_away(base, nu):
    """K of the layer's own equations, in the form of Johnson 1985, section 5.8."""
    w = np.array([0.3, 1.0, 2.5])
    n = 3.0 - 4.0 * nu
    if base == "frictionless":
        expected = 2.0 * np.sinh(w) ** 2 / (np.sinh(2.0 * w) + 2.0 * w)
    else:
        below = 2.0 * n * np.cosh(2.0 * w) + 4.0 * w**2 + 1.0 + n**2
        expected = (2.0 * n * np.sinh(2.0 * w) - 4.0 * w) / below
    assert 1.0 - base_deficit(w, base, nu) == pytest.approx(expected, rel=1e-14)
    # long waves feel the thin layer's modulus, short ones the half-plane's
    thin = thin_modulus(material(nu), base)
    small = 1e-4 if nu < 0.4 else 1e-6
    compliance = 2.0 * (1.0 - base_deficit(small, base, nu)) / small
    assert compliance == pytest.approx(1.0 / thin, rel=1e-3)
    assert base_deficit(20.0, base, nu) == pytest.approx(0.0, abs=1e-14)


@pytest.mark.parametrize(("base", "nu"), BASES)
def test_thick_limit_is_of_fourth_order(base, nu):
    """And within the bound that the module states."""
    left = [
        errors(thick_layer(1.0, 1.0, 1.0 / a, material(nu), base), a, nu, base)
        for a in (0.125, 0.25)
    ]
    assert np.log2(left[1][1] / left[0][1]) == pytest.approx(4.0, abs=0.35)
    assert abs(left[1][1]) < 0.23 * 0.25**4
    # the peak's remainder is the difference of two: it may vanish in between
    assert abs(left[1][0]) < 0.12 * 0.25**4
    hertz = hertz_from_load(0.25 * np.pi, 1.0, 1.0)
    uncorrected = full_problem(0.25, nu, base)[1] / hertz.load_per_length - 1.0
    assert uncorrected > 30.0 * abs(left[1][1])


@pytest.mark.parametrize(
    ("base", "nu", "stated"), [("frictionless", 0.3, 0.53), ("bonded", 0.3, 0.37)]
)
def test_thin_compressible_limit_is_of_first_order(base, nu, stated):
    left = np.array(
        [
            errors(thin_compressible_layer(1.0, 1.0, 1.0 / a, material(nu), base), a, nu, base)
            for a in (8.0, 16.0, 32.0)
        ]
    )
    assert np.log2(left[0] / left[2]) / 2.0 == pytest.approx([1.0, 1.0], abs=0.05)
    assert left[2][1] * 32.0 == pytest.approx(stated, abs=0.01)


def test_thin_incompressible_limit_is_of_first_order():
    left = np.array(
        [
            errors(
                thin_incompressible_layer(1.0, 1.0, 1.0 / a, 1.0 - HARDLY_COMPRESSIBLE**2),
                a,
                HARDLY_COMPRESSIBLE,
                "bonded",
            )
            for a in (8.0, 16.0, 32.0)
        ]
    )
    assert np.log2(left[1] / left[2]) == pytest.approx([1.0, 1.0], abs=0.15)
    assert left[2][1] * 32.0 == pytest.approx(8.0, abs=0.1)
