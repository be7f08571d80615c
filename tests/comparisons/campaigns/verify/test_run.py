"""`crosscheck verify` on a part of its cases: it holds, and it sees what does not."""

import json
import pickle
import re
from functools import partial
from pathlib import Path
from xml.etree import ElementTree

import pytest

from comparisons import cli
from comparisons.campaigns.cases import Trial
from comparisons.campaigns.verify import run
from comparisons.campaigns.verify.coverage import FEWEST_ROUGH, LEAST_COVERAGE, PRESSURE, pairs_of
from comparisons.campaigns.verify.independent_solver import independent_cases
from comparisons.campaigns.verify.manufactured import manufactured_cases
from comparisons.campaigns.verify.operators import operator_cases, operator_contacts
from comparisons.campaigns.verify.rough import rough_operator_contacts, rough_scenes
from comparisons.campaigns.verify.run import Verification, verify
from comparisons.campaigns.verify.scenes import (
    finite_element_scenes,
    half_plane_scenes,
    layer_scenes,
    scene_cases,
)
from comparisons.common.errors import ExitStatus
from comparisons.figures import convergence

SOME_LAYERS = (0, 9)  # thick and hardly pressed, thin and nearly incompressible


@pytest.fixture(scope="module")
def quick(tmp_path_factory) -> tuple[Verification, Path]:
    """A verification of some finite elements, of half-planes for the orders; and its folder."""
    folder = tmp_path_factory.mktemp("verify")
    scenes = (
        *(scene for scene in half_plane_scenes(rounds=4) if scene.kind == "Hertz"),
        *(scene for scene in half_plane_scenes(rounds=1) if scene.kind != "Hertz"),
        finite_element_scenes()[0],
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
    def test_there_are_enough_of_each_kind_with_names_of_their_own(self):
        cases = run.everything()
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
