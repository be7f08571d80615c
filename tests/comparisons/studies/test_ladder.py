"""Which model suffices: errors of every rung against the whole, and what is said of them.

The finished runs stand their finite elements in for by a half-plane that is one per cent stiffer:
the whole is Hertz's contact at 1.01 E*."""

import json
from dataclasses import replace

import pytest
from scenes import RUBBER, changed, problem, refound, resolved

from comparisons.cli import main
from comparisons.common.errors import ExitStatus
from comparisons.figures.figure import Statement
from comparisons.figures.quantity import MODELS
from comparisons.models.plan import make_plan
from comparisons.output.result_json import content_of
from comparisons.runs.run import run
from comparisons.studies.ladder import show
from comparisons.studies.ladder.estimated import hertz_alone
from comparisons.studies.ladder.limits import limited
from comparisons.studies.ladder.planned import FLOWS, planned_rungs
from comparisons.studies.study import LADDER, MODEL_ERROR, WHY_NOT

STIFFER = 1.01


TOLERANT = {"peak_pressure": 0.1, "contact_length": 0.1, "tau1_max": 0.1}


@pytest.fixture(scope="module")
def smooth_outcome(finish, smooth_tables):
    """Under a load at which nothing else matters."""
    return finish(changed(smooth_tables, load={"per_length": 1e4}))


@pytest.fixture(scope="module")
def wavy_outcome(finish, wavy_tables):
    return finish(changed(wavy_tables, tolerance=TOLERANT))


def test_hertz_stands_where_the_surface_is_smooth(smooth_outcome):
    """p0 and tau1 go with the root of E*, the length with its inverse."""
    known = smooth_outcome.figures.of(study=LADDER, source="hertz", against="whole")
    softer = STIFFER**-0.5 - 1.0
    assert known.one(quantity="peak_pressure").value == pytest.approx(softer, rel=0.02)
    assert known.one(quantity="tau1_max").value == pytest.approx(softer, rel=1e-6)
    length = known.one(quantity="contact_length")
    assert abs(length.value - (STIFFER**0.5 - 1.0)) <= length.numerical
    assert {figure.verdict for figure in known} == {"holds"}
    assert smooth_outcome.findings[LADDER].said(show.SUFFICES) == "hertz"


def test_hertz_fails_and_the_half_plane_holds_on_a_wavy_surface(wavy_outcome):
    known, findings = wavy_outcome.figures.of(study=LADDER), wavy_outcome.findings[LADDER]
    assert "fails" in {figure.verdict for figure in known.of(source="hertz")}
    assert findings.said(show.SUFFICES) == "half_plane"
    [(name, line)] = show.lines(wavy_outcome)
    assert name == "cheapest that holds"
    assert line.startswith("half-plane (")


def test_the_half_plane_has_its_model_errors(wavy_outcome):
    """And the whole no error but its uncertainty."""
    known = wavy_outcome.figures.of(study=LADDER)
    for error in wavy_outcome.model_errors:
        rung = known.one(source="half_plane", quantity=error.quantity, at=error.at)
        assert (rung.value, rung.total) == (error.value, error.total)
        whole = known.one(source="whole", quantity=error.quantity, at=error.at)
        assert whole.value == 0.0 < whole.numerical


def test_a_run_answers_for_its_half_plane_alone(wavy_outcome):
    """Hertz fails, the run does not; result.json names what suffices."""
    assert wavy_outcome.exit_status == ExitStatus.DONE
    content = json.loads(json.dumps(content_of(wavy_outcome)))
    assert content["suffices"] == "half_plane"
    assert content["escalate_to"] is None


def test_nothing_suffices_where_no_rung_holds(wavy_outcome):
    """The line names what was not refuted."""
    errors = wavy_outcome.figures.of(study=LADDER)
    looser = tuple(replace(error, unknown={"finite_strain": 0.3}) for error in errors)
    said = (Statement(show.NONE, "the whole model is not known to the tolerance"),)
    [(_, line)] = show.lines(refound(wavy_outcome, LADDER, figures=looser, statements=said))
    assert line.startswith("none, the whole model is not known to the tolerance; cheapest that")
    without = refound(
        wavy_outcome, LADDER, figures=(), series=(), statements=(Statement(WHY_NOT, "no whole"),)
    )
    assert show.lines(without) == [] == show.blocks(without)


def test_a_table_of_the_page_has_every_rung(wavy_outcome):
    [block] = show.blocks(wavy_outcome)
    table = block.items[0]
    assert [row[0] for row in table.rows][:2] == ["Hertz's closed form", "half-plane"]
    assert wavy_outcome.findings[MODEL_ERROR].data.solutions


def test_a_model_that_fails_is_shown_by_an_error_that_fails(wavy_outcome):
    """Not by one whose uncertainty reaches farther."""
    vague = tuple(
        replace(error, unknown={"finite_strain": 9.0}) if error.verdict != "fails" else error
        for error in wavy_outcome.figures.of(study=LADDER)
    )
    [block] = show.blocks(refound(wavy_outcome, LADDER, figures=vague))
    rows = block.items[0].rows
    assert (rows[0][4], rows[1][4]) == ("fails", "inconclusive")
    assert float(rows[0][3].split()[0]) < 10.0 < float(rows[1][3].split()[0])


@pytest.mark.parametrize(
    ("load", "name"), [(1e3, "hertz"), (1e6, None)], ids=["light load", "heavy load"]
)
def test_estimates_say_what_holds_where_no_whole_is_solved(finish, smooth_tables, load, name):
    """And that none is known to hold where they exceed a tolerance."""
    tables = smooth_tables | {"load": {"per_length": load}, "budget": {"up_to": "half-plane"}}
    alone = finish(tables, ("half_plane",))
    assert alone.findings[LADDER].said(show.SUFFICES) == name
    [(_, line)] = show.lines(alone)
    assert line.endswith("by estimates") == (name is not None)
    assert (hertz_alone(alone.problem)[0]) == (name is not None)


def planned(tables, models=MODELS):
    posed = problem(tables)
    return planned_rungs(posed, make_plan(posed, models))


def test_what_is_computed_is_planned(wavy_outcome):
    """Of the finished run every model by its name; the table of the plan begins with Hertz."""
    rows = planned_rungs(wavy_outcome.problem, wavy_outcome.plan)
    computed = {row.words for row in rows if row.computed != "no"}
    solved = wavy_outcome.findings[LADDER].table(show.RUNGS).rows()
    assert {row["model"] for row in solved} <= computed
    assert (rows[0].words, rows[0].seconds) == ("Hertz's closed form", 0.0)
    assert all((row.seconds is None) == (row.computed == "no") for row in rows)


def test_a_plan_says_why_a_model_is_not_computed(smooth_tables, wavy_tables):
    why = {row.words: row.why for row in planned(changed(smooth_tables, load={"per_length": 1e2}))}
    assert why["half-plane with what an operator carries"].startswith("does not apply")
    assert why["finite deformation"].startswith("does not apply: finite deformation is ")
    limited_tables = changed(wavy_tables, budget={"up_to": "operators"})
    rows = planned(limited_tables, MODELS[:1])
    assert rows[-1].why == "beyond --up-to operators" == rows[3].why
    layer = changed(smooth_tables, body={"thickness": 1e-3})
    [row] = [row for row in planned(layer) if row.words == "half-plane with layer"]
    assert row.computed == "if needed" and 0.0 < row.seconds < 1.0
    soft = changed(smooth_tables, body={"yield_stress": 1e8}, budget={"up_to": "deformed"})
    [row] = [row for row in planned(soft, MODELS[:1]) if "deformed" in row.words]
    assert row.why == FLOWS and row.seconds is None
    unjudged = make_plan(problem(layer), MODELS[1:])
    assert planned_rungs(problem(layer), unjudged) == []


def test_an_operator_refutes_a_half_plane_without_finite_elements(finish):
    """A thin layer of rubber, as in the library."""
    tables = {
        "roller": {"radius": 50e-3, "rigid": True},
        "body": {**RUBBER, "poissons_ratio": 0.495, "thickness": 2e-3},
        "load": {"per_length": 5e3},
        "budget": {"up_to": "operators"},
    }
    known = finish(tables, ("half_plane",)).figures.of(study=LADDER)
    assert "fails" in {figure.verdict for figure in known.of(source="half_plane")}
    assert {figure.verdict for figure in known.of(source="operators")} == {"inconclusive"}
    up_to = {"budget": {"up_to": "half-plane"}}
    below = finish(tables | up_to, ("half_plane",)).figures.of(study=LADDER)
    assert not below.of(source="operators")


def test_no_estimate_bounds_roughness_or_coupling_in_hertz(wavy_outcome, smooth_tables):
    assert not hertz_alone(wavy_outcome.problem)[0]
    roller = {"radius": 8e-3, "rigid": True}
    load = {"per_length": 1e3, "friction": 0.3, "coupled": True}
    assert "coupling" in hertz_alone(problem(smooth_tables | {"roller": roller, "load": load}))[1]


def test_a_run_goes_no_further_than_its_budget(smooth_tables):
    """Without flow and finite deformation up to linear ones; with a half-plane that holds alone."""
    yielding = {**smooth_tables["body"], "yield_stress": 1e9}
    tables = smooth_tables | {"body": yielding, "finite_element": {"plastic": True}}
    scene = resolved(changed(tables, budget={"up_to": "linear"}))
    linear, models = limited(scene, MODELS)
    assert (linear.finite_element.plastic, linear.budget.effects, models) == (False, False, MODELS)
    assert limited(scene.changed("budget.up_to", "operators"), MODELS)[1] == ("half_plane",)
    assert limited(scene.changed("budget.up_to", "whole"), MODELS) == (
        scene.changed("budget.up_to", "whole"),
        MODELS,
    )
    light = resolved(smooth_tables | {"load": {"per_length": 1e3}, "budget": {"up_to": "linear"}})
    assert list(run(light, None, MODELS).runs) == ["half_plane"]


def test_an_unknown_model_is_answered_in_one_line(capsys):
    assert main(["run", "smooth", "--up-to", "half-plan"]) == ExitStatus.BAD_INPUT
    said = capsys.readouterr().err
    assert said.startswith("crosscheck: --up-to: there is no model half-plan; the nearest is half-")
    assert said.count("\n") == 1
    assert main(["run", "smooth", "--up-to", "moon"]) == ExitStatus.BAD_INPUT
    assert "no model moon; allowed are hertz, half-plane, operators," in capsys.readouterr().err
