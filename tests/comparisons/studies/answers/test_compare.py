"""Answers from outside against a model: verdicts, uncertainties, what the run leaves of them. What
explains a difference is named, and nothing is where it does not."""

import io
from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console
from scenes import QUICK, run_of

from analytic.exact.hertz import hertz_from_load
from comparisons.common.progress import no_progress
from comparisons.output.flat_csv import tidy_rows
from comparisons.output.result import read_result
from comparisons.output.terminal import summary
from comparisons.runs.rerun import rerun
from comparisons.runs.write import write_files
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.show import answer_verdict
from comparisons.studies.answers.study import CONDITIONS, HINTS, VALIDATION


def verdicts(outcome):
    return {figure.quantity: figure.verdict for figure in outcome.judged.of(study="answers")}


def row(outcome, quantity):
    known = outcome.figures.of(study="answers", quantity=quantity)
    return next(figure for figure in known if figure.against)


def own_uncertainty(outcome, quantity):
    return row(outcome, quantity).uncertainty.parts.get("own")


def balance(outcome):
    return outcome.figures.one(study="answers", quantity="load_balance").value


def table(outcome, name):
    series = outcome.findings["answers"].table(name, "other")
    return [] if series is None else series.rows()


def off_its_conditions(outcome, model):
    """The largest residual of the pressures by a model's operator."""
    [row] = [row for row in table(outcome, CONDITIONS) if row["model"] == model]
    return max(value for name, value in row.items() if name != "model")


def test_hertz_exact_pressure_agrees(answered, curve):
    outcome = answered(curve())
    assert verdicts(outcome) == {"peak_pressure": "agree", "contact_length": "agree"}
    assert abs(balance(outcome)) < 1e-3 and table(outcome, HINTS) == []
    assert off_its_conditions(outcome, "half_plane") < 1e-3
    assert own_uncertainty(outcome, "contact_length") is None
    assert outcome.exit_status == 0
    kind, sentence = answer_verdict(outcome, "other")
    assert kind == "agree"
    said = "The answer other agrees with the half-plane in both judged figures; nearest to its "
    assert sentence.startswith(said)


def test_three_per_cent_more_differ(answered, curve):
    outcome = answered(curve(p=lambda p: 1.03 * p))
    assert verdicts(outcome) == {"peak_pressure": "differ", "contact_length": "agree"}
    assert row(outcome, "peak_pressure").value == pytest.approx(0.03, abs=1e-4)
    assert balance(outcome) == pytest.approx(0.03, abs=1e-3) and table(outcome, HINTS) == []
    assert table(outcome, CONDITIONS)[0]["penetration"] > 0.01
    assert outcome.exit_status == 1
    kind, sentence = answer_verdict(outcome, "other")
    assert kind == "differ"
    words = (
        "differs from the half-plane in 1 of 2 judged figures; the farthest: peak pressure, +3.0"
    )
    assert words in sentence
    console = Console(file=io.StringIO(), width=1000)
    console.print(summary(outcome))
    printed = console.file.getvalue()
    assert "NOT COMPARED" in printed and f"DIFFER  {sentence}".replace("±", "+-") in printed
    assert "only answers from outside were compared" in printed


def test_own_finite_elements_field_agrees(tmp_path, undrawn):
    """It is read as any code's file: from the mesh, and compared with values off its nodes."""
    own = replace(run_of(QUICK, "finite_element"), directory=tmp_path / "own")
    write_files(own, no_progress)
    section = {"file": str(tmp_path / "own/finite_element/stress.vtu")}
    outcome = run_of(QUICK | {"answers": {"other": section}}, "finite_element")
    assert set(verdicts(outcome)) == {"peak_pressure", "contact_length", "tau1_max"}
    assert set(verdicts(outcome).values()) == {"agree"}
    assert row(outcome, "tau1_l2").value < 0.005
    assert off_its_conditions(outcome, "finite_element") < 1e-3


def test_several_resolutions_state_an_uncertainty(answered, curve):
    """Too long by 8 %, 4 % and 2 % of what each has left: the fit sees order one."""

    def stretched(by):
        return curve(x=lambda x: (1.0 + by) * x, points=round(8.0 / by) + 1)["file"]

    outcome = answered({"file": [stretched(by) for by in (0.02, 0.08, 0.04)]})
    spacing = [answer.spacing for answer in outcome.data("answers")["other"]]
    assert spacing == sorted(spacing, reverse=True)
    length = row(outcome, "contact_length")
    assert length.value == pytest.approx(0.02, abs=2e-3)
    assert length.uncertainty.parts["own"] == pytest.approx(1.25 * 0.02, rel=0.1)
    assert length.verdict == "inconclusive"


def test_measured_data_have_their_validation_comparison(answered, curve):
    outcome = answered(curve(p=lambda p: 0.95 * p, scatter=0.04))
    rows = table(outcome, VALIDATION)
    [peak] = [row for row in rows if row["quantity"] == "peak_pressure"]
    assert peak["E"] == pytest.approx(1.0 / 0.95 - 1.0, abs=1e-3)
    assert peak["u_D"] == 0.04 and peak["u_input"] is None
    assert peak["u_val"] == pytest.approx(np.hypot(peak["u_num"], 0.04))
    assert own_uncertainty(outcome, "peak_pressure") == pytest.approx(0.038, abs=1e-3)
    assert row(outcome, "peak_pressure").verdict == "inconclusive"  # 5 +- 3.8 against 2 %


def test_files_table_and_repetition_follow(answered, curve, tmp_path, undrawn):
    section = curve(p=lambda p: 1.03 * p)
    outcome = answered(section, out=tmp_path / "out")
    result = read_result(tmp_path / "out")
    wanted = {"source": "other", "quantity": "peak_pressure", "against": "half_plane"}
    figure = result.figures.one(study="answers", **wanted)
    assert figure.verdict == "differ" and figure.friction == 0.0
    [answer] = outcome.data("answers")["other"]
    assert result.record["hashes"]["answer_other"] == [answer.sha256]
    rows = [r for r in tidy_rows([tmp_path / "out"]) if r["source"] == "other" and r["against"]]
    assert {"peak_pressure": "differ", "contact_length": "agree"}.items() <= {
        r["quantity"]: r["verdict"] for r in rows
    }.items()
    assert "Answers from outside" in (tmp_path / "out/report.html").read_text()
    [same] = result.arrays.answers["other"]
    np.testing.assert_array_equal(same.x, answer.x)
    with open(section["file"], "w") as file:
        file.write("gone\n")
    again = rerun(tmp_path / "out")
    assert again.movement.moved == () and again.bits


def test_edges_are_found_between_points():
    """A smooth edge is found to a small part of the spacing."""
    for offset in np.linspace(0.0, 0.9, 4):
        x = 0.05 * (np.arange(-30, 31) + offset)
        answer = Answer("f", "0", x, np.sqrt(np.maximum(1.0 - x**2, 0.0)))
        assert answer.patches == pytest.approx(np.array([[-1.0, 1.0]]), abs=0.05 * 0.05)
        assert answer.load == pytest.approx(np.pi / 2.0, rel=5e-3)


def hints(outcome):
    return {row["kind"]: row for row in table(outcome, HINTS)}


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
    assert balance(outcome) == pytest.approx(-0.5, abs=2e-3)


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
