"""References in a hundred digits, against tables and closed forms."""

import json

import pytest
from mpmath import mpf, workdps
from scenes import DATA

from analytic.exact.layers import base_deficit
from analytic.layers.layered import LayeredBody
from analytic.material import Material
from comparisons.studies.robustness.many_digits import galerkin_log, hat_parts, wave_compliance


@workdps(100)
def test_coefficients_are_those_of_the_data():
    rows = json.loads((DATA / "galerkin_hat_coefficients.json").read_text())["rows"]
    whole = [row for row in rows if float(row["offset"]).is_integer()]
    assert len(whole) > 5
    for row in whole:
        assert abs(galerkin_log(int(row["offset"])) / mpf(row["Lg"]) - 1) < 1e-28


def test_stresses_are_those_of_the_data():
    points = json.loads((DATA / "hat_stress.json").read_text())["points"]
    below = [point for point in points if float(point["z_over_pitch"]) > 0.0]
    assert len(below) > 20
    for point in below:
        found = hat_parts(float(point["x_over_pitch"]), float(point["z_over_pitch"]))
        expected = [float(point[name]) for name in ("sx", "sz", "txz", "sx_traction")]
        assert found == pytest.approx(expected, rel=1e-15, abs=1e-90)


@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_a_wave_is_the_closed_form(base):
    body = LayeredBody(Material(2.0, 0.3), 0.5, base)
    for k in (0.1, 1.0, 10.0):
        share = 1.0 - base_deficit(0.5 * k, base, 0.3)
        expected = 2.0 / (body.material.plane_strain_modulus * k) * share
        assert wave_compliance(body, k) == pytest.approx(float(expected), rel=1e-14)
