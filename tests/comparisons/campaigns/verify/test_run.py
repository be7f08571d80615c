"""`crosscheck verify` on a part of its cases: it holds, and it sees what does not; pairs of stated
uncertainty and true error, their coverage, and observed orders."""

import json
import pickle
import re
from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

import pytest

from analytic.exact.manufactured import ManufacturedContact
from analytic.stress_state import Extremum
from comparisons import cli
from comparisons.campaigns.cases import Row, Trial, holds, junit_of
from comparisons.campaigns.verify import run
from comparisons.campaigns.verify.coverage import (
    FEWEST_ROUGH,
    LEAST_COVERAGE,
    PRESSURE,
    Pair,
    compared,
    coverage,
    coverage_rows,
    observed_order,
    pairs_of,
)
from comparisons.campaigns.verify.independent_solver import independent_cases
from comparisons.campaigns.verify.manufactured import manufactured_cases
from comparisons.campaigns.verify.operators import operator_cases, operator_contacts
from comparisons.campaigns.verify.rough import rough_operator_contacts, rough_scenes
from comparisons.campaigns.verify.run import Verification, verification, verify
from comparisons.campaigns.verify.scenes import half_plane_scenes, layer_scenes, scene_cases
from comparisons.common.errors import ExitStatus
from comparisons.figures import convergence
from comparisons.figures.convergence import Convergence
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.study import MODEL_ERROR

SOME_LAYERS = (0, 9)  # thick and hardly pressed, thin and nearly incompressible


@pytest.fixture(scope="module")
def quick(tmp_path_factory) -> tuple[Verification, Path]:
    """A verification of some finite elements, of half-planes for the orders; and its folder."""
    folder = tmp_path_factory.mktemp("verify")
    scenes = (
        *(scene for scene in half_plane_scenes(rounds=3) if scene.kind == "Hertz"),
        *(scene for scene in half_plane_scenes(rounds=1) if scene.kind != "Hertz"),
        *(layer_scenes()[k] for k in SOME_LAYERS),
        *rough_scenes(half_planes=3, finite_elements=1, layers=1),
    )
    contacts = (*operator_contacts()[:12], *rough_operator_contacts()[:2])
    cases = [*scene_cases(scenes), *operator_cases(contacts)]
    cases += [*manufactured_cases([("flat", 2)]), *independent_cases()]
    junit = folder / "ci" / "verify.xml"
    return verify(folder / "out", junit, cases=cases, fewest=(60, 10)), folder


def half_plane_cases(count: int | None = None) -> list[Trial]:
    return scene_cases(half_plane_scenes(rounds=1)[:count])


class TestCases:
    def test_there_are_enough_of_each_kind_with_names_of_their_own(self, monkeypatch):
        anything = dict.fromkeys(("tau1", "txz"), Extremum(0.0, 0.0, 0.0))  # figures are counted
        monkeypatch.setattr(ManufacturedContact, "extremes", lambda *_: anything)
        cases = list(run.everything())
        exact = [case for case in cases if case.group not in ("manufactured", "independent solver")]
        assert len({(case.model, case.group, case.name) for case in cases}) == len(cases)
        assert pickle.dumps([case.solve for case in cases])  # for other processes
        kinds = {"Hertz", "surface", "sliding", "hardness", "rough"}
        assert kinds <= {case.group for case in exact if case.model == "finite_element"}
        kinds |= {"wave", "punch"}
        assert kinds <= {case.group for case in exact if case.model == "half_plane"}
        figures = [(case.group, len(case.solve.args[0].exact)) for case in exact]
        assert sum(count for group, count in figures if group != "rough") >= 550
        assert sum(count for group, count in figures if group == "rough") >= FEWEST_ROUGH

    def test_no_two_cases_put_the_edge_at_the_same_place(self):
        tables = [scene.tables for scene in half_plane_scenes()]
        places = {(t["resolution"]["pitch"], t["load"]["per_length"]) for t in tables}
        assert len(places) == len(tables)


class TestWhole:
    def test_a_part_of_it_holds(self, quick):
        verified, _ = quick
        assert verified.faults == []
        assert verified.exit_status == ExitStatus.DONE
        assert verified.coverage.covered >= LEAST_COVERAGE
        groups = [row.case.group for row in verified.rows]
        assert {"manufactured", "independent solver", "coverage"} <= set(groups)
        assert groups.count("order") >= 5
        first = verified.rows[0]
        (pressure,) = (figure for figure in first.figures if figure.quantity == PRESSURE)
        assert pressure.value < 0.02 and len(pressure.levels) == 3
        assert all(len(pair.figure.levels) == 3 for pair in pairs_of(first))
        tables = verified.groups("table", "kind")
        assert all(tables["model error", kind].count >= 2 for kind in ("layer", "rough"))

    def test_files_say_the_same(self, quick):
        verified, folder = quick
        content = json.loads((folder / "out" / "verify.json").read_text())
        assert content["holds"] is True
        assert content["coverage"]["covered"] == verified.coverage.covered
        assert [pair["error"] for pair in content["pairs"]] == [p.error for p in verified.pairs]
        assert [p.name for p in (folder / "out").iterdir()] == ["verify.json"]

    def test_junit_names_each_figure_once(self, quick):
        verified, folder = quick
        [suite] = ElementTree.parse(folder / "ci" / "verify.xml").getroot()
        names = {(case.get("classname"), case.get("name")) for case in suite}
        assert len(names) == len(suite) == sum(len(row.judged) for row in verified.rows)
        figures = suite[: len(verified.pairs)]
        assert all("relative error" in case.find("system-out").text for case in figures)

    def test_a_stated_uncertainty_that_is_too_small_is_seen(self, monkeypatch, tmp_path):
        monkeypatch.setattr(convergence, "REGULAR", 0.0)
        verified = verify(tmp_path / "out", cases=half_plane_cases(), fewest=(0, 0))
        assert not verified.holds
        assert any("share covered: 0." in line for line in verified.faults)


def test_the_command_prints_the_coverage_and_ends_with_the_verdict(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(run, "verify", partial(verify, cases=half_plane_cases(4), fewest=(0, 0)))
    monkeypatch.chdir(tmp_path)
    assert cli.main(["verify", "--junit", "ci.xml"]) == ExitStatus.DONE
    shown = capsys.readouterr().out
    assert re.search(r"^coverage (9[5-9]|100) %\s*$", shown, re.MULTILINE)
    assert (tmp_path / "results" / "verify" / "verify.json").is_file()
    assert (tmp_path / "ci.xml").is_file()
    monkeypatch.setattr(run, "verify", partial(verify, cases=half_plane_cases(4), fewest=(1000, 0)))
    assert cli.main(["verify", "--out", "other"]) == ExitStatus.OUTSIDE_TOLERANCE
    assert "informative figures: 20, expected at least 1000" in capsys.readouterr().out


KNOWN = Convergence(2.0, 2.0, 0.0, 1.0, 1.0, "monotone")


def row(
    error: float = 1e-3,
    stated: float = 2e-3,
    *,
    kind: str = "Hertz",
    converged: bool = True,
    uncertainty: Uncertainty | None = None,
    **fields,
) -> Row:
    """Row of one case with an exact answer of 2."""
    levels = 1.9, 1.95, 2.0 * (1.0 + error)
    uncertainty = uncertainty or Uncertainty({"discretisation": stated}, KNOWN)
    more = {"scale": 2.0, "uncertainty": uncertainty, "levels": levels}
    figure = Figure("contact", "contact_length", "half_plane", levels[-1], **more)
    figures = compared(replace(figure, **fields), 2.0, "source", kind, converged)
    case = Trial(kind, "case <&>", "half_plane", lambda: figures)
    return Row(case, figures, None, 0.0)


def pair(*numbers: float, **fields) -> Pair:
    (made,) = pairs_of(row(*numbers, **fields))
    return made


def whole(rows: Iterable[Row], error: str | None = None) -> Verification:
    """The verification of some rows, the first of which raised `error`."""
    first, *others = rows
    first = replace(first, error=error)
    return verification((first, *others), 0.0, (200, 0))


ENOUGH = [row()] * 200


def test_an_error_within_the_uncertainty_is_covered():
    assert pair(1e-3, 1.001e-3).covered and not pair(1e-3, 0.999e-3).covered
    assert not pair(-1e-3, 0.999e-3).covered
    assert pair(-1e-3, 2e-3).overestimation == pytest.approx(2.0)
    three = Uncertainty({"iteration": 1e-3, "discretisation": 2e-3, "domain": 4e-3}, KNOWN)
    assert pair(-1e-3, uncertainty=three).overestimation == pytest.approx(7.0)


def test_an_error_of_rounding_is_not_informative():
    rounded = pair(1e-14, 0.0)
    assert rounded.covered and not rounded.informative and rounded.overestimation is None
    shown = coverage([rounded, pair(), pair(stated=0.5e-3)])
    assert (shown.count, shown.informative, shown.covered) == (3, 2, 0.5)
    assert shown.median_overestimation == pytest.approx(1.25)


def test_a_wrong_figure_is_seen_however_large_its_uncertainty():
    assert row().holds
    assert not row(error=0.1, stated=1.0).holds
    assert not row(converged=False).holds
    assert not row(error=0.03, quantity="tau1_max").holds


@pytest.mark.parametrize(
    ("pairs", "expected"),
    [
        ([pair()] * 95 + [pair(stated=0.0)] * 5, True),
        ([pair()] * 94 + [pair(stated=0.0)] * 6, False),
        ([pair(stated=6e-3)] * 100, False),
        ([], False),
    ],
)
def test_coverage_needs_both_a_share_and_a_ratio(pairs, expected):
    [row] = coverage_rows(pairs, fewest=0, fewest_rough=0)
    assert row.holds is expected


@pytest.mark.parametrize(
    ("rows", "error"),
    [
        ([*ENOUGH, *ENOUGH], "no solution"),
        (ENOUGH[1:], None),
        ([*ENOUGH, row(error=0.1, stated=1.0)], None),
        ([row(stated=0.0)] * 200, None),
        ([row(stated=1.0)] * 200, None),
    ],
)
def test_all_must_hold(rows, error):
    assert whole(ENOUGH).holds
    broken = whole(rows, error)
    assert not broken.holds and len(broken.faults) == 1
    assert broken.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    [suite] = ElementTree.fromstring(junit_of(broken).encode())
    assert suite.get("failures") == str(len(suite.findall("testcase/failure"))) == "1"


def test_one_miss_among_many_is_reported_but_does_not_fail():
    missed = whole([*ENOUGH, row(stated=0.0)])
    [suite] = ElementTree.fromstring(junit_of(missed).encode())
    assert missed.holds and suite.get("failures") == "0"
    assert "NOT covered" in suite[200].find("system-out").text
    assert "case <&>" in suite[200].get("name")


def test_rough_contacts_have_demands_of_their_own():
    smooth = [pair()] * 200
    rough = [pair(kind="rough")] * 94 + [pair(kind="rough", stated=0.0)] * 6
    every, of_rough = coverage_rows([*smooth, *rough], 200, 100)
    assert every.holds
    assert [*map(holds, of_rough.figures)] == [False, True, True]
    _, absent = coverage_rows(smooth, 200, 1)
    assert not any(map(holds, absent.figures))


def test_coverage_is_shown_by_table_model_quantity_and_kind():
    error = row(kind="layer", study=MODEL_ERROR, quantity="peak_pressure")
    verified = whole([*ENOUGH, row(kind="rough"), error])
    groups = verified.groups("table", "kind")
    assert groups["model error", "layer"].count == groups["figure", "rough"].count == 1
    assert groups["figure", "Hertz"].count == 200
    assert [figure.quantity for figure in error.judged] == ["model error, peak_pressure"]


def test_coverage_is_rounded_down():
    assert whole([row()] * 1999 + [row(stated=0.0)]).coverage_line == "coverage 99 %"
    assert whole(ENOUGH).coverage_line == "coverage 100 %"
    unsolved = replace(row(), figures=(), error="no solution")
    assert whole([unsolved]).coverage_line == "coverage 0 %"


def test_an_observed_order_is_of_the_root_mean_square():
    assert observed_order([[16.0, -4.0, 1.0], [-32.0, 7.0, -2.0]]) == pytest.approx(2.0)
