"""JUnit XML of a run: a testcase for each judged figure, with what CI systems make of a verdict."""

from dataclasses import replace
from xml.etree import ElementTree

from scenes import refound, unconverged

from comparisons.cli import main
from comparisons.common.errors import ExitStatus
from comparisons.judging.study import Run
from comparisons.output.junit import junit_xml, run_cases_of

# As the schema that Jenkins, GitLab and GitHub's reporters read has them, in this order.
RESULTS = ("failure", "error", "skipped")


def suite_of(outcome: Run) -> ElementTree.Element:
    [suite] = ElementTree.fromstring(junit_xml("made", run_cases_of(outcome), 1.5).encode())
    return suite


def judged(outcome: Run, **verdicts: str) -> Run:
    """Nothing is judged but these quantities of the comparison, with a tolerance of 2 %."""
    values = {"differ": 0.05, "inconclusive": 0.02}
    rows = (
        replace(row, bounds=None)
        if row.quantity not in verdicts
        else replace(row, value=values[verdicts[row.quantity]], bounds=(-0.02, 0.02))
        for row in outcome.figures.of(study="comparison")
    )
    return refound(refound(outcome, "comparison", figures=tuple(rows)), "model_error", figures=())


def test_each_judged_figure_of_both_tables_has_one(wavy_outcome: Run):
    suite = suite_of(wavy_outcome)
    rows = [row for row in wavy_outcome.figures.of(study="comparison") if row.tolerance is not None]
    wanted = {("comparison", row.quantity, row.friction) for row in rows}
    wanted |= {("model_error", c.quantity, c.friction) for c in wavy_outcome.model_errors}
    assert len(wanted) == 2 * len(rows) > 4
    names = {(case.get("classname"), case.get("name")) for case in suite}
    scene = wavy_outcome.problem.scene.name
    assert names == {(f"{scene}.solvers", "converged")} | {
        (f"{scene}.{table}", f"{quantity}, friction {friction:g}")
        for table, quantity, friction in wanted
    }
    assert len(suite) == len(names) == int(suite.get("tests"))
    assert suite.get("time") == "1.500"


def test_what_differs_fails_and_what_is_inconclusive_is_skipped(smooth_outcome: Run):
    run = judged(smooth_outcome, peak_pressure="differ", contact_length="inconclusive")
    suite = suite_of(run)
    assert (suite.get("failures"), suite.get("errors"), suite.get("skipped")) == ("1", "0", "1")
    by_name = {case.get("name"): case for case in suite}
    differs, inconclusive = (
        by_name[f"{name}, friction 0"] for name in ("peak_pressure", "contact_length")
    )
    assert differs.find("failure").get("message").endswith(" %, differ at 2 %")
    assert inconclusive.find("skipped").get("message").endswith(" %, inconclusive at 2 %")
    assert all(by_name["converged"].find(name) is None for name in RESULTS)


def test_nothing_that_did_not_converge_passes(smooth_outcome: Run):
    suite = suite_of(unconverged(smooth_outcome, "half_plane"))
    assert suite.get("errors") == suite.get("tests") and len(suite) > 1
    assert "did not converge" in suite[0].find("error").get("message")


def test_the_command_leaves_it_where_it_is_told(tmp_path, capsys, undrawn):
    """A run of one model judges nothing; an impossible path is refused before it begins."""
    arguments = ["run", "smooth", "--models", "half-plane", "--out", str(tmp_path / "out")]
    assert main([*arguments, "--junit", str(tmp_path)]) == ExitStatus.BAD_INPUT
    assert "is a folder" in capsys.readouterr().err and list(tmp_path.iterdir()) == []
    assert main([*arguments, "--junit", str(tmp_path / "ci" / "run.xml")]) == ExitStatus.DONE
    [suite] = ElementTree.parse(tmp_path / "ci" / "run.xml").getroot()
    assert [case.get("name") for case in suite] == ["converged"]
