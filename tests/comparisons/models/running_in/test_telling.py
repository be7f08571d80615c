"""What result, plan, table and report tell of the running-in."""

import json
from collections.abc import Callable
from dataclasses import replace

import pytest
from scenes import posed, refound

from comparisons.common.errors import ExitStatus
from comparisons.figures.figure import Statement
from comparisons.figures.quantity import MODELS
from comparisons.judging.presentation import lines_of, parts_of
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import headline
from comparisons.models.plan import make_plan
from comparisons.output.page.page import render
from comparisons.output.result_json import content_of, result_of
from comparisons.studies.running_in import STUDY

pytestmark = pytest.mark.usefixtures("undrawn")


@pytest.fixture(scope="module")
def outcome(finish: Callable[..., Run], wavy) -> Run:
    return finish({**wavy, "title": "Wavy, run in", "stress": {"points": [60, 20]}})


class TestTelling:
    def test_result(self, outcome: Run, hardness):
        findings, run_in = outcome.findings["running_in"], outcome.problem.surface.run_in
        by_quantity = {f.quantity: f.value for f in findings.figures if f.source == "half_plane"}
        assert by_quantity["passes"] == len(run_in.passes) == 5 * by_quantity["sweeps"]
        volumes = findings.table("passes").columns["volume"].values
        assert by_quantity["volume_moved"] == run_in.volume == sum(volumes)
        assert by_quantity["largest_lowering"] == run_in.largest_lowering > 0.0
        assert (findings.said("status"), findings.said("converged")) == ("settled", "yes")
        assert findings.table("at ends of the trace") is None
        known = outcome.figures.of(study="running_in")
        before, after = (known.one(source=s, quantity="rq").value for s in ("before", "after"))
        assert before > after > 0.0
        slope = outcome.figures.one(study="problem", source="scene", quantity="rms_slope")
        assert slope.value == known.one(source="after", quantity="rms_slope").value
        content = content_of(result_of(outcome))
        assert json.loads(json.dumps(content, allow_nan=False)) == content
        for peak in outcome.figures.of(study="contact", quantity="peak_pressure"):
            assert peak.value < 1.03 * hardness

    def test_result_without_running_in(self, wavy_outcome: Run):
        assert "running_in" not in wavy_outcome.findings
        assert 'id="running-in"' not in render(wavy_outcome)

    def test_page_and_terminal_show_it(self, outcome: Run):
        assert '<section id="running-in">' in render(outcome)
        [block], [(name, told)] = parts_of(STUDY, outcome), lines_of(STUDY, outcome)
        assert ("status", "settled") in block.items[2].rows
        assert name == "running in" and told.endswith("(half-plane), settled")

    def test_what_fell_short_is_told(self, outcome: Run):
        problem = outcome.problem
        run_in = problem.surface.run_in
        passes = (replace(run_in.passes[0], at_end=True), *run_in.passes[1:])
        run_in = replace(run_in, status="passes spent", passes=passes)
        surface = replace(problem.surface, run_in=run_in)
        plan = make_plan(replace(problem, surface=surface), MODELS)
        short = [text for text in plan.assumptions if text.startswith("running-in")][1:]
        assert "has not settled in" in short[0] and "from −30 µm" in short[1]
        moved = posed(outcome, problem=replace(problem, surface=surface))
        [(_, said)] = lines_of(STUDY, moved)
        assert said.endswith(", not settled")

    def test_a_pass_that_did_not_converge_ends_with_status_3(self, outcome: Run):
        assert outcome.exit_status != ExitStatus.NOT_CONVERGED
        problem = outcome.problem
        run_in = problem.surface.run_in
        passes = (replace(run_in.passes[0], converged=False), *run_in.passes[1:])
        surface = replace(problem.surface, run_in=replace(run_in, passes=passes))
        failed = posed(outcome, problem=replace(problem, surface=surface))
        failed = refound(failed, "running_in", statements=(Statement("converged", "no"),))
        assert not failed.converged
        assert failed.exit_status == ExitStatus.NOT_CONVERGED
        said = headline(failed)
        assert said.kind == "not converged"
        assert f"running-in, 1 of {len(passes)} passes" in said.within.sentence
