"""The stiff and extreme cases: rows pass on figures, and fail when what they test is broken.

Requirement: every row can fail. Kernels, solvers and an assembly are each broken by a little here,
and the rows that are meant for them must see it. The command's rows as a whole are its own
business; a quick subset of each kind is carried out.
"""

import io
import json
from decimal import Decimal
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

import comparisons.studies.robustness.run as stability_run
from analytic.contact import problem as contact
from analytic.exact.layers import base_deficit
from analytic.layers import layered
from analytic.layers.layered import LayeredBody
from analytic.material import Material
from analytic.operators import half_plane as operators
from analytic.operators.elements import hat_galerkin
from analytic.stress import elements as stress_elements
from comparisons.cli import main
from comparisons.common.errors import ExitStatus
from comparisons.studies.robustness import many_digits, pressing
from comparisons.studies.robustness.backward import THRESHOLD, backward_ratio, condition_estimate
from comparisons.studies.robustness.cases import algebra as algebra_cases
from comparisons.studies.robustness.cases import friction as friction_cases
from comparisons.studies.robustness.cases import layers as layer_cases
from comparisons.studies.robustness.cases import rough as rough_cases
from comparisons.studies.robustness.cases import rounding as rounding_cases
from comparisons.studies.robustness.cases import smooth as smooth_cases
from comparisons.studies.robustness.cases import stresses as stress_cases
from comparisons.studies.robustness.cases import units as unit_cases
from comparisons.studies.robustness.row import Case, Figure, Findings, Row, carried_out
from comparisons.studies.robustness.run import all_cases, run_stability
from comparisons.studies.robustness.table import stability_table

DATA = Path(__file__).resolve().parents[3] / "data"
QUICK = (
    smooth_cases,
    rough_cases,
    unit_cases,
    friction_cases,
    layer_cases,
    stress_cases,
    algebra_cases,
)
SLOW = ("1000000 points", "65536 points", "a line of hats")


def named(module, name: str) -> Case:
    [case] = [case for case in module.cases() if case.name == name]
    return case


def row_of(module, name: str) -> Row:
    return carried_out(named(module, name))


def finding(value: float, most: float, least: float = 0.0) -> Findings:
    return Findings((Figure("error", value, most, "the exact one", least),))


def case_of(findings: Findings, name: str = "made") -> Case:
    return Case("tests", name, "half_plane", lambda: findings)


def failing() -> Findings:
    raise ArithmeticError("no\nsolution [bold]")


@pytest.mark.parametrize("module", QUICK, ids=lambda module: module.__name__.split(".")[-1])
def test_quick_cases_hold(module):
    rows = [carried_out(case) for case in module.cases() if not case.name.startswith(SLOW)]
    failed = [f"{row.case.name}: {row.error or row.telling}" for row in rows if not row.passed]
    assert rows and not failed, "\n".join(failed)


def test_there_are_as_many_cases_as_promised_and_each_has_a_name_of_its_own():
    cases = all_cases()
    names = [(case.model, case.group, case.name) for case in cases]
    assert len(set(names)) == len(names) >= 60
    assert {case.model for case in cases} == {"half_plane", "finite_element"}
    assert sum(case.model == "finite_element" for case in cases) >= 30


@pytest.mark.parametrize(
    ("value", "most", "least", "passed"),
    [
        (1.0, 1.0, 0.0, True),
        (1.1, 1.0, 0.0, False),
        (np.nan, 1.0, 0.0, False),
        (np.inf, np.inf, 0.0, False),
        (0.5, 1.0, 0.6, False),
        (-0.1, 1.0, 0.0, False),
    ],
)
def test_a_figure_holds_within_its_bounds(value, most, least, passed):
    assert carried_out(case_of(finding(value, most, least))).passed is passed


def test_a_row_without_a_figure_has_failed():
    assert not carried_out(case_of(Findings(()))).passed


def test_a_row_that_raises_has_failed_and_says_why():
    row = carried_out(Case("tests", "raises", "half_plane", failing))
    assert not row.passed and row.error == "ArithmeticError: no solution [bold]"


def test_an_interrupt_is_no_row():
    def stop() -> Findings:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        carried_out(Case("tests", "stops", "half_plane", stop))


def test_the_figure_that_tells_is_the_first_or_the_one_that_fails_by_most():
    right, wrong = Figure("a", 0.5, 1.0, "x"), Figure("b", 3.0, 1.0, "x")
    worse = Figure("c", np.nan, 1.0, "x")
    assert carried_out(case_of(Findings((right, right)))).telling is right
    assert carried_out(case_of(Findings((right, wrong)))).telling is wrong
    assert carried_out(case_of(Findings((wrong, worse)))).telling is worse


def made(*cases: Case):
    return lambda: cases


def test_rows_are_written_whole_and_the_others_go_on(tmp_path):
    bad = Case("tests", "raises", "finite_element", failing)
    said = []
    cases = made(case_of(finding(np.inf, 1.0)), bad, case_of(finding(0.1, 1.0), "good"))
    (tmp_path / "result.json").write_text("a run's own")
    result = run_stability(tmp_path, said.append, cases)
    assert result.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    assert [row.passed for row in result.rows] == [False, False, True]
    kept = json.loads((tmp_path / "stability.json").read_text())
    assert (kept["passed"], kept["failed"], kept["schema"]) == (1, 2, 1)
    assert kept["rows"][0]["figures"][0]["value"] is None
    assert kept["rows"][1]["error"] == "ArithmeticError: no solution [bold]"
    assert kept["rows"][2]["figures"][0] == {
        "name": "error",
        "value": 0.1,
        "most": 1.0,
        "least": 0.0,
        "against": "the exact one",
        "passed": True,
    }
    assert said[-1] == "3 of 3, 2 failed: half_plane: tests: good"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["result.json", "stability.json"]
    console = Console(width=160, file=io.StringIO())
    console.print(stability_table(result))
    text = console.file.getvalue()
    assert "1 of 3 cases hold" in text and "[bold]" in text and "raises" in text


def test_no_rows_are_no_success(tmp_path):
    assert run_stability(tmp_path, cases=made()).exit_status == ExitStatus.OUTSIDE_TOLERANCE


@pytest.mark.parametrize(("value", "status"), [(0.5, 0), (2.0, 1)])
def test_command_ends_with_what_the_rows_say(tmp_path, monkeypatch, capsys, value, status):
    monkeypatch.chdir(tmp_path)
    cases = made(case_of(finding(value, 1.0)))
    original = run_stability
    monkeypatch.setattr(
        stability_run, "run_stability", lambda out, tell: original(out, tell, cases)
    )
    assert main(["stability"]) == status
    assert (tmp_path / "results" / "stability" / "stability.json").exists()
    out, err = capsys.readouterr()
    assert f"{1 - status} of 1 cases hold" in out and err == ""


def test_command_refuses_a_folder_that_cannot_be(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["stability", "--out", str(tmp_path / "file")]) == ExitStatus.BAD_INPUT
    assert "is not a folder" in capsys.readouterr().err


# What breaks a kernel, a solver, an element, and a row that must see it.


def bent_kernel(offset: np.ndarray) -> np.ndarray:
    """The hat's coefficients, that of neighbours a thousandth off."""
    return hat_galerkin(offset) * np.where(np.abs(offset) == 1.0, 1.001, 1.0)


def test_a_broken_kernel_fails_the_rows(monkeypatch):
    monkeypatch.setattr(operators, "hat_galerkin", bent_kernel)
    smooth_cases.ordinary_shape.cache_clear()
    pressing.ordinary_applications.cache_clear()
    try:
        row = row_of(smooth_cases, "ordinary: steel on steel")
        rough = row_of(rough_cases, "profile reversed")
        dense = row_of(rough_cases, "rms slope 1")
    finally:
        smooth_cases.ordinary_shape.cache_clear()
        pressing.ordinary_applications.cache_clear()
    assert not dense.passed and dense.telling.name == "gap against pressure"
    # a symmetric mistake cannot be seen from behind: that row is about something else
    assert rough.passed
    assert not row.passed and row.telling.name == "gap against pressure"


def test_a_broken_solver_fails_the_rows(monkeypatch):
    def loose(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.linalg.solve(matrix, right).astype(np.float32).astype(float)

    monkeypatch.setattr("analytic.operators.convolution.cholesky_solve", loose)
    row = row_of(algebra_cases, "half-plane, 120 scattered nodes")
    assert not row.passed and row.telling.value > 1e3 * THRESHOLD
    assert not row_of(rough_cases, "plateau, heavy").passed


def test_a_solver_that_gives_up_early_fails_the_rows(monkeypatch):
    original = contact.exchange_blocks

    def hasty(problem, start, **settled):
        return np.maximum(original(problem, start, **settled), 1e-6)

    monkeypatch.setattr(contact, "exchange_blocks", hasty)
    row = row_of(rough_cases, "load 1e-12 of modulus times length")
    assert not row.passed


def test_a_broken_layer_fails_the_rows(monkeypatch):
    original = layered.normal
    monkeypatch.setattr(layered, "normal", lambda layer, w: original(layer, w) * (1.0 + 1e-12))
    assert not row_of(layer_cases, "waves: coating 1e6 times as stiff").passed


def test_stresses_that_cancel_far_away_fail_the_row(monkeypatch):
    monkeypatch.setattr(stress_elements, "NEAREST", 1e9)
    row = row_of(stress_cases, "one hat, at 1e6 a below")
    assert not row.passed and row.telling.value > 1e3


def test_a_length_that_is_not_in_proportion_fails_the_units(monkeypatch):
    original = operators.HalfPlane

    class Absolute(original):
        """A datum of one metre, whatever the grid's size."""

        def __init__(self, count, pitch, modulus, datum=10.0, element="hat"):
            super().__init__(count, pitch, modulus, datum, element)

    monkeypatch.setattr(unit_cases, "HalfPlane", Absolute)
    row = row_of(unit_cases, "lengths in pm")
    assert not row.passed


def test_friction_towards_the_wrong_side_fails_the_row(monkeypatch):
    original = friction_cases.CoupledHalfPlane
    monkeypatch.setattr(
        friction_cases, "CoupledHalfPlane", lambda *given: original(*given[:3], -given[3])
    )
    row = row_of(friction_cases, "friction 1, rigid on nu = 0")
    assert not row.passed


# The means: references in many digits, ratios, digits under perturbation.


def data(name: str) -> dict:
    return json.loads((DATA / name).read_text())


def test_reference_coefficients_are_those_of_the_data():
    rows = data("galerkin_hat_coefficients.json")["rows"]
    whole = [row for row in rows if float(row["offset"]).is_integer()]
    assert len(whole) > 5
    for row in whole:
        found, expected = many_digits.galerkin_log(int(row["offset"])), Decimal(row["Lg"])
        assert abs(found / expected - 1) < Decimal("1e-28")


def test_reference_stresses_are_those_of_the_data():
    points = [p for p in data("hat_stress.json")["points"] if float(p["z_over_pitch"]) > 0.0]
    assert len(points) > 20
    for point in points:
        place = (float(point[name]) for name in ("x_over_pitch", "z_over_pitch"))
        found = many_digits.hat_parts(*place)
        expected = [float(point[name]) for name in ("sx", "sz", "txz", "sx_traction")]
        assert found == pytest.approx(expected, rel=1e-15, abs=1e-90)


@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_reference_wave_is_the_closed_form(base):
    body = LayeredBody(Material(2.0, 0.3), 0.5, base)
    for k in (0.1, 1.0, 10.0):
        share = 1.0 - base_deficit(0.5 * k, base, 0.3)
        expected = 2.0 / (body.material.plane_strain_modulus * k) * share
        assert many_digits.wave_sinking(body, k) == pytest.approx(float(expected), rel=1e-14)


def test_backward_ratio_of_what_is_exact_and_of_what_is_not():
    matrix = np.array([[2.0, 1.0], [1.0, 3.0]])
    right = matrix @ [1.0, 1.0]
    assert backward_ratio(matrix, np.ones(2), right) == 0.0
    # a residual of 1e-10 in one row, over 4 * 2 * eps
    wrong = backward_ratio(matrix, np.ones(2), right + np.array([1e-10, 0.0]))
    assert wrong == pytest.approx(1e-10 / (4.0 * 2.0 * np.finfo(float).eps), rel=1e-5)


def test_condition_estimate_of_a_diagonal():
    from scipy.sparse import diags

    values = np.array([1e-3, 1.0, 1e5])
    matrix = diags(values).tocsr()
    found = condition_estimate(matrix, lambda right: np.ravel(right) / values)
    assert found == pytest.approx(1e8)


def test_digits_are_those_that_perturbation_leaves():
    def results(change, loss):
        return {"sum": change(1.0) - loss}

    kept = rounding_cases.Digits(14.0, 6.0)
    whole = rounding_cases.digits_findings(partial(results, loss=0.0), kept)
    assert whole.digits["sum"] > 14.5
    cancelled = rounding_cases.digits_findings(partial(results, loss=1.0 - 1e-6), kept)
    assert 8.5 < cancelled.digits["sum"] < 10.0
    assert not all(figure.passed for figure in cancelled.figures)


@pytest.mark.parametrize("name", ["smooth", "thin incompressible layer"])
def test_digits_of_a_contact(name):
    [case] = [
        case for case in rounding_cases.cases() if case.name == name and case.model == "half_plane"
    ]
    row = carried_out(case)
    assert row.passed and row.findings.digits["approach"] > 12.0
