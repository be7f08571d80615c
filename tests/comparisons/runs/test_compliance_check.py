"""The check of the finite elements' compliance in a run: levels, result, report, repetition."""

from dataclasses import replace

import pytest
from scenes import STEEL, resolved

from comparisons.common.cache import Cache, kinds_of
from comparisons.common.progress import Stages
from comparisons.figures.moved import items_of, movement
from comparisons.models.finite_element import level as finite_element
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.level import Level
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.output.page.tables.verification import operator_note, operator_table
from comparisons.output.record import read_result
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene

LAYER = {
    "title": "Smooth layer",
    "roller": {"radius": 8e-3, **STEEL},
    "body": {**STEEL, "thickness": 2.1e-4},
    "load": {"per_length": 1e6},
    "resolution": {"pitch": 2e-5},
}


@pytest.fixture(scope="module")
def outcome(tmp_path_factory):
    coarse = resolved(LAYER)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("comparisons.output.page.page.render", lambda *_: "")
        return run(coarse, tmp_path_factory.mktemp("run") / "out", ("finite_element",))


def test_every_level_but_the_far_boundary_check_is_checked(outcome):
    ladder = outcome.runs["finite_element"]
    assert all(level.operator is not None for level in ladder.levels)
    assert (
        ladder.far_boundary_check.operator is None
        and "check" not in ladder.far_boundary_check.seconds
    )
    waves = [level.operator.nearest.waves[-1].difference for level in ladder.levels]
    assert abs(waves[-1]) < abs(waves[0])


def test_result(outcome):
    checks = read_result(outcome.directory / "result.json").findings["checks"]
    levels = [level.operator for level in outcome.runs["finite_element"].levels]
    assert checks.said("compliance") == levels[-1].verdict == "neither"
    assert checks.said("compliance, by level") == ", ".join(
        one_level.verdict for one_level in levels
    )
    columns, waves, moved = (
        checks.table(f"compliance, {name}").columns
        for name in ("columns, nearest surface", "waves, nearest surface", "columns, half-plane")
    )
    assert columns["x"].values[2] == levels[-1].nearest.columns[2].x
    assert waves["difference"].values[0] == levels[-1].nearest.waves[0].difference
    assert checks.said("compliance, finite") == "thickness"
    assert checks.said("compliance, datum") == "a constant is removed"
    assert len(moved["x"].values) == len(columns["x"].values) == 5


def test_a_figure_of_it_may_move_by_its_own_size(outcome):
    recorded = items_of(outcome.findings, {})
    [name] = [n for n in recorded if "waves, nearest surface.difference" in n]
    for times, beyond in ((1.5, 0), (3.0, 1)):
        values = tuple(times * value for value in recorded[name].value)
        checks = movement(recorded, recorded | {name: replace(recorded[name], value=values)})
        assert len(checks.moved) == 1 and len(checks.beyond) == beyond


def test_table_and_how_to_read_it(outcome):
    table = operator_table(outcome)
    assert table.title.endswith(": no fault of mesh or body")
    assert table.head[-1] == "from the half-plane: what the thickness does"
    assert len(table.rows) == 10 and {len(row) for row in table.rows} == {4}
    assert table.rows[2][0].startswith("column at x = ")
    assert table.rows[5][0].endswith(", 4 elements") and table.rows[5][1].startswith("−")
    note = operator_note(outcome)
    assert note.startswith("Mesh and body are right") and "a constant removed" in note


def test_it_survives_an_interrupt(outcome, tmp_path):
    checks = outcome.runs["finite_element"].finest.operator
    cache = Cache(tmp_path, "key", kinds_of(Level))
    cache.save("level", checks)
    assert cache.load("level") == checks


def test_a_body_that_deforms_finitely_is_not_pressed_linearly_as_well(monkeypatch):
    monkeypatch.setattr(finite_element, "pressed_linearly", lambda *arguments: 1 / 0)
    problem = problem_of(Scene.read("finite-strain"))
    plan, refinement = make_plan(problem, ("finite_element",)), Refinement(problem.pitches[0])
    assert finite_element_level(problem, plan, refinement, None, Stages()).solution.converged
