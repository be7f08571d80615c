"""The table of layers under a cylinder against the full problem, solved by collocation."""

import json

import numpy as np
import pytest
from scenes import PROJECT

CASES = json.loads((PROJECT / "analytic/exact/layer_contact.json").read_text())["cases"]
GAUSS, WEIGHT = np.polynomial.legendre.leggauss(300)


def base_deficit(w: np.ndarray, base: str, poissons_ratio: float) -> np.ndarray:
    """1 - K at w = k t > 0, the share of the half-plane's compliance that the base takes away
    (Johnson 1985, section 5.8), as sums of positive terms over positive ones: right to rounding.

    bonded        K = (2 n sinh 2w - 4 w)/(2 n cosh 2w + 4 w^2 + 1 + n^2),   n = 3 - 4 nu
    frictionless  K = 2 sinh^2 w/(sinh 2w + 2 w)
    """
    decay, n = np.exp(-2.0 * w), 3.0 - 4.0 * poissons_ratio
    if base == "frictionless":
        return 2.0 * decay * (2.0 * w - np.expm1(-2.0 * w)) / (4.0 * w * decay - np.expm1(-4.0 * w))
    rest = 4.0 * w**2 + 1.0 + n**2
    return decay * (2.0 * n * decay + rest + 4.0 * w) / (n * (1.0 + decay**2) + rest * decay)


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


@pytest.mark.parametrize(
    "case", CASES, ids=lambda c: f"{c['base']}, a/t {c['a_over_t']}, nu {c['nu']}"
)
def test_full_problem_meets_the_reference(case):
    """The reference states 1e-10 of itself."""
    a_over_t, nu = float(case["a_over_t"]), 0.3 if case["nu"] == "any" else float(case["nu"])
    peak, load = full_problem(a_over_t, nu, case["base"])
    assert peak * a_over_t == pytest.approx(float(case["p0_R_over_Eprime_t"]), rel=1e-9)
    assert load * a_over_t**2 == pytest.approx(float(case["P_R_over_Eprime_t2"]), rel=1e-9)
