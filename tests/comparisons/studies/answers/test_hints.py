"""What explains a difference is named, and nothing is where it does not."""

import numpy as np
import pytest
from scenes import QUICK

from analytic.exact.hertz import hertz_from_load


def hints(outcome):
    series = outcome.findings["answers"].table("hints")
    return {row["kind"]: row for row in (series.rows() if series else ())}


def test_a_tenth_of_a_half_width_aside(answered, curve, hertz):
    hint = hints(answered(curve(x=lambda x: x + 0.1 * hertz.half_width)))
    assert set(hint) == {"shift"}
    assert hint["shift"]["text"] == "shifted by 0.1 a explains it"
    assert hint["shift"]["value"] == pytest.approx(0.1 * hertz.half_width, rel=2e-3)


@pytest.mark.parametrize(
    ("change", "kinds"),
    [
        ({"x": lambda x: 1e3 * x, "p": lambda p: 1e-6 * p}, {"length unit", "stress unit"}),
        ({"p": lambda p: 1e-3 * p}, {"stress unit"}),
        ({"p": lambda p: -p}, {"sign"}),
        ({"p": lambda p: 0.5 * p}, {"factor"}),
    ],
    ids=["mm and MPa", "kPa", "sign", "half"],
)
def test_units_signs_and_factors(answered, curve, change, kinds):
    assert set(hints(answered(curve(**change)))) == kinds


@pytest.mark.parametrize(("load", "radius"), [(0.5, 1.0), (1.0, 2.0)])
def test_another_load_and_the_diameter_for_the_radius(answered, curve, hertz, load, radius):
    changed = load * hertz.load_per_length, radius * QUICK["roller"]["radius"]
    contact = hertz_from_load(*changed, hertz.combined_modulus)
    [(kind, hint)] = hints(answered(curve(contact=contact))).items()
    assert hint["value"] == load * radius
    assert kind == ("load" if load < 1.0 else "radius")


def test_half_of_a_symmetric_model(answered, tmp_path, hertz):
    x = np.linspace(0.0, 1.2, 400) * hertz.half_width
    np.savetxt(tmp_path / "half.csv", np.column_stack([x, hertz.pressure(x)]), delimiter=",")
    outcome = answered({"file": str(tmp_path / "half.csv")})
    assert set(hints(outcome)) == {"half model"}
    balance = outcome.figures.one(study="answers", quantity="load_balance").value
    assert balance == pytest.approx(-0.5, abs=2e-3)


def test_a_mirrored_answer(answered, curve, hertz):
    """On a contact that is not its own mirror image: a wave off the middle."""
    wave = {"kind": "sinusoid", "wavelength": "300 um", "amplitude": "0.1 um"}
    changed = {"profile": wave, "load": QUICK["load"] | {"position": "70 um"}}
    ours = answered(curve(), **changed).runs["half_plane"].finest

    def mirrored(pressure):
        x = 1.2 * hertz.half_width * np.linspace(-1.0, 1.0, len(pressure))
        return np.interp(-x, ours.grid.x, ours.solution.pressure)

    assert set(hints(answered(curve(p=mirrored, points=4001), **changed))) == {"mirrored"}


def test_another_contact_is_said_to_be_one(answered, curve):
    """Many narrow contacts in place of one."""
    hint = hints(answered(curve(p=lambda p: p * (np.arange(len(p)) % 100 < 20))))
    assert set(hint) == {"unexplained"}
