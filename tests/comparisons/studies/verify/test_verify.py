"""`crosscheck verify` on a part of its cases: it holds, and it sees what does not."""

import json
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from analytic.exact.layers import layer_references
from comparisons import cli
from comparisons.assessment import uncertainty
from comparisons.common.errors import ExitStatus, InputError
from comparisons.studies.verify import verify as verification
from comparisons.studies.verify.checks import Check, order_check
from comparisons.studies.verify.junit import junit
from comparisons.studies.verify.operators import operator_cases
from comparisons.studies.verify.orders import observed_order
from comparisons.studies.verify.pairs import LEAST_COVERAGE, Pair, coverage, solved
from comparisons.studies.verify.result import Failure, Verification
from comparisons.studies.verify.scenes import (
    COMPARED,
    exact_scenes,
    finite_element_scenes,
    gallery_scenes,
    half_plane_scenes,
    layer_scenes,
)
from comparisons.studies.verify.table import coverage_line, verify_page
from comparisons.studies.verify.verify import Scope, verify

SOME_LAYERS = (0, 9)  # thick and hardly pressed, thin and nearly incompressible


def quick_scope() -> Scope:
    """A second's worth of finite elements, and half-planes for the orders."""
    scenes = (
        *(scene for scene in half_plane_scenes(rounds=4) if scene.kind == "Hertz"),
        *(scene for scene in half_plane_scenes(rounds=1) if scene.kind != "Hertz"),
        finite_element_scenes()[0],
        *(layer_scenes()[k] for k in SOME_LAYERS),
    )
    return Scope(scenes, operator_cases()[:12], (("flat", 2),), ("smooth",), fewest=60)


@pytest.fixture(scope="module")
def quick(tmp_path_factory) -> tuple[Verification, Path]:
    """The verification and its folder."""
    folder = tmp_path_factory.mktemp("verify")
    return verify(folder / "out", folder / "ci" / "verify.xml", scope=quick_scope()), folder


def pair(error: float = 1e-3, stated: float = 2e-3, **others) -> Pair:
    exact = 2.0
    given = {
        "case": "case <&>",
        "source": "source",
        "kind": "Hertz",
        "model": "half_plane",
        "quantity": "contact_length",
        "levels": (1.9, 1.95, exact * (1.0 + error)),
        "exact": exact,
        "uncertainty": (0.0, stated, 0.0),
        "scale": exact,
        "behaviour": "monotone",
        "order": 1.0,
        "converged": True,
    }
    return Pair(**(given | others))


class TestCases:
    def test_there_are_enough_of_each_kind(self):
        scenes = exact_scenes()
        assert len({scene.name for scene in scenes}) == len(scenes)
        for model in ("half_plane", "finite_element"):
            kinds = {scene.kind for scene in scenes if model in scene.models}
            assert kinds >= {"Hertz", "surface", "sliding", "hardness"}
        assert sum(len(scene.exact) * len(scene.models) for scene in scenes) >= 350
        assert {kind for case in operator_cases() for kind in [case.kind]} == {
            "wave",
            "punch",
            "layer",
        }

    def test_no_two_cases_put_the_edge_at_the_same_place(self):
        pitches = [scene.tables["resolution"]["pitch"] for scene in half_plane_scenes()]
        loads = [scene.tables["load"]["per_length"] for scene in half_plane_scenes()]
        assert len(set(zip(pitches, loads, strict=True))) == len(pitches)

    def test_scenes_are_judged_by_what_is_compared(self):
        for scene in exact_scenes():
            assert set(scene.exact) <= set(COMPARED)
            assert set(scene.exact) >= {"peak_pressure", "contact_length"}
        assert len(gallery_scenes()) >= 10

    def test_layers_have_their_own_load(self):
        reference = layer_references()[3]
        scene = next(s for s in layer_scenes() if "a = 0.25 t" in s.name and "nu = 0.3," in s.name)
        modulus = 200e9 / (1.0 - 0.3**2)
        assert scene.exact["contact_length"] == pytest.approx(2.0 * 0.25e-3)
        load = reference.load * modulus * 1e-6 / 0.1
        assert scene.tables["load"]["per_length"] == pytest.approx(load)


class TestPairs:
    def test_an_error_within_the_uncertainty_is_covered(self):
        assert pair(1e-3, 1.001e-3).covered and not pair(1e-3, 0.999e-3).covered
        assert not pair(-1e-3, 0.999e-3).covered
        assert pair(-1e-3, 2e-3).width == pytest.approx(2.0)
        assert pair(-1e-3, 2e-3, uncertainty=(1e-3, 2e-3, 4e-3)).width == pytest.approx(7.0)

    def test_an_error_of_rounding_tells_nothing(self):
        rounded = pair(1e-14, 0.0)
        assert rounded.covered and not rounded.tells and rounded.width is None
        found = coverage([rounded, pair(), pair(stated=0.5e-3)])
        assert (found.count, found.tell, found.covered) == (3, 2, 0.5)
        assert found.median_width == pytest.approx(1.25)

    def test_a_wrong_figure_is_seen_however_wide_its_uncertainty(self):
        assert pair().close
        assert not pair(error=0.1, stated=1.0).close
        assert not pair(converged=False).close
        largest = pair(error=0.03, quantity="tau1_max")
        assert replace(largest, kind="surface").close and not largest.close

    def test_coverage_needs_both_a_share_and_a_width(self):
        assert coverage([pair()] * 95 + [pair(stated=0.0)] * 5).holds
        assert not coverage([pair()] * 94 + [pair(stated=0.0)] * 6).holds
        assert not coverage([pair(stated=6e-3)] * 100).holds
        assert not coverage([]).holds

    def test_a_scene_solved_as_a_run_is(self):
        scene = half_plane_scenes()[0]
        found = solved(scene, "half_plane")
        assert [p.quantity for p in found.pairs] == list(scene.exact)
        assert all(p.close and p.converged and len(p.levels) == 3 for p in found.pairs)
        assert found.pressure_errors[-1] < 0.02 and len(found.pressure_errors) == 3


class TestWhole:
    def test_a_part_of_it_holds(self, quick):
        found, _ = quick
        assert found.faults == []
        assert found.exit_status == ExitStatus.DONE
        assert found.coverage.covered >= LEAST_COVERAGE
        assert {check.group for check in found.checks} == {"order", "manufactured", "second road"}
        assert sum(check.group == "order" for check in found.checks) >= 5

    def test_files_say_the_same(self, quick):
        found, folder = quick
        content = json.loads((folder / "out" / "verify.json").read_text())
        assert content["holds"] is True
        assert content["coverage"]["covered"] == found.coverage.covered
        assert len(content["pairs"]) == len(found.pairs)
        first = content["pairs"][0]
        assert first["error"] == found.pairs[0].error
        page = (folder / "out" / "verify.html").read_text()
        assert "http" not in page and page.count("<tr>") > len(found.pairs)
        assert sorted(p.name for p in (folder / "out").iterdir()) == ["verify.html", "verify.json"]

    def test_junit_has_a_testcase_for_each_figure_and_check(self, quick):
        found, folder = quick
        suite = ElementTree.parse(folder / "ci" / "verify.xml").getroot()[0]
        cases = suite.findall("testcase")
        assert len(cases) == len(found.pairs) + len(found.checks) + 3
        assert len({(c.get("classname"), c.get("name")) for c in cases}) == len(cases)
        assert suite.get("tests") == str(len(cases)) and suite.get("failures") == "0"
        assert all("relative error" in c.find("system-out").text for c in cases[: len(found.pairs)])

    def test_a_stated_uncertainty_that_is_too_small_is_seen(self, monkeypatch, tmp_path):
        monkeypatch.setattr(uncertainty, "FACTOR", 0.0)
        scope = Scope(half_plane_scenes(rounds=1), (), (), (), fewest=0)
        found = verify(tmp_path / "out", scope=scope)
        assert not found.holds
        assert any(line.startswith("coverage: 0.") for line in found.faults)

    def test_a_case_that_cannot_be_solved_is_a_fault_and_not_the_end(self, tmp_path):
        scene = half_plane_scenes()[0]
        impossible = replace(scene, tables=scene.tables | {"resolution": {"pitch": 1.0}})
        found = verify(tmp_path, scope=Scope((impossible, scene), (), (), (), fewest=0))
        assert len(found.failed) == 1 and len(found.pairs) == len(scene.exact)
        assert found.exit_status == ExitStatus.OUTSIDE_TOLERANCE

    def test_places_that_cannot_be_written_are_refused_first(self, tmp_path, monkeypatch):
        monkeypatch.setattr(verification, "solved", None)
        (tmp_path / "file").write_text("")
        with pytest.raises(InputError, match="not a folder"):
            verify(tmp_path / "file", scope=quick_scope())
        with pytest.raises(InputError, match="allowed is a file"):
            verify(tmp_path / "out", tmp_path, scope=quick_scope())
        assert not (tmp_path / "out").exists()


class TestVerdict:
    whole = Verification((pair(),) * 200, (Check("order", "a", "b", 1.0, 0.9, 1.1),), (), {})

    def test_all_must_hold(self):
        assert self.whole.holds
        for broken in (
            replace(self.whole, checks=(Check("order", "a", "b", 1.2, 0.9, 1.1),)),
            replace(self.whole, checks=(Check("order", "a", "b", 0.8, 0.9, 1.1),)),
            replace(self.whole, checks=(Check("order", "a", "b", np.nan, 0.9, 1.1),)),
            replace(self.whole, failed=(Failure("case", "half_plane", "no"),)),
            replace(self.whole, pairs=self.whole.pairs[1:]),
            replace(self.whole, pairs=(*self.whole.pairs, pair(error=0.1, stated=1.0))),
            replace(self.whole, pairs=(pair(stated=0.0),) * 200),
            replace(self.whole, pairs=(pair(stated=1.0),) * 200),
        ):
            assert not broken.holds and len(broken.faults) == 1
            assert broken.exit_status == ExitStatus.OUTSIDE_TOLERANCE
            suite = ElementTree.fromstring(junit(broken))[0]
            assert suite.get("failures") == str(len(suite.findall("testcase/failure"))) == "1"
            assert "Does not hold" in verify_page(broken)

    def test_a_miss_among_many_is_told_but_does_not_fail(self):
        missed = replace(self.whole, pairs=(*self.whole.pairs, pair(stated=0.0)))
        suite = ElementTree.fromstring(junit(missed))[0]
        assert missed.holds and suite.get("failures") == "0"
        assert "NOT covered" in suite[200].find("system-out").text
        assert "case &lt;&amp;&gt;" in verify_page(missed)

    def test_coverage_is_rounded_down(self):
        nearly = (pair(),) * 1999 + (pair(stated=0.0),) * 1
        assert coverage_line(replace(self.whole, pairs=nearly)) == "coverage 99 %"
        assert coverage_line(self.whole) == "coverage 100 %"
        assert coverage_line(replace(self.whole, pairs=())) == "coverage 0 %"

    def test_orders_are_held_on_both_sides(self):
        errors = [[16.0, -4.0, 1.0], [-32.0, 7.0, -2.0]]
        assert observed_order(errors) == pytest.approx(2.0)
        assert order_check("order", "", "", 2.3, 2.0, 0.25).holds is False
        assert order_check("order", "", "", 1.7, 2.0, 0.25).holds is False
        assert order_check("order", "", "", 2.2, 2.0, 0.25).holds is True


def test_the_command_prints_the_coverage_and_ends_with_the_verdict(monkeypatch, capsys, tmp_path):
    scope = Scope(half_plane_scenes(rounds=1)[:4], (), (), (), fewest=0)
    monkeypatch.setattr(verification, "everything", lambda: scope)
    monkeypatch.chdir(tmp_path)
    assert cli.main(["verify", "--junit", "ci.xml"]) == ExitStatus.DONE
    shown = capsys.readouterr().out
    assert re.search(r"^coverage (9[5-9]|100) %\s*$", shown, re.MULTILINE)
    assert (tmp_path / "results" / "verify" / "verify.json").is_file()
    assert (tmp_path / "ci.xml").is_file()
    monkeypatch.setattr(verification, "everything", lambda: replace(scope, fewest=1000))
    assert cli.main(["verify", "--out", "other"]) == ExitStatus.OUTSIDE_TOLERANCE
    assert "does not hold: coverage:" in capsys.readouterr().out
