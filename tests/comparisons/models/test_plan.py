"""Forecast of a run before anything is solved, against what the run then takes; unknowns over
all shipped scenes."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import PROJECT, STEEL_PAIR, changed, problem

from comparisons.common.tasks import Tasks
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import unsolved
from comparisons.models.finite_element.mesh import (
    Refinement,
    block_spec,
    expected_unknowns,
    roller_spec,
)
from comparisons.models.plan import forecast, make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels
from comparisons.runs.refinement import refined
from comparisons.scenes.files import scene_names
from comparisons.scenes.scene import Scene
from meshes.build import build_block

DOCS = PROJECT / "comparisons" / "docs"
TABLES = STEEL_PAIR | {
    "load": {"hertz_peak_pressure": 1e9},
    "tolerance": {"peak_pressure": 1e-9},
    "budget": {"effects": False},
}
SHORT = {"profile": {"kind": "sinusoid", "wavelength": 0.2e-6, "amplitude": 1e-9}}


def planned(**sections):
    posed = problem(changed(TABLES, **sections))
    plan = make_plan(posed, MODELS)
    return posed, plan, forecast(posed, plan)


@pytest.mark.parametrize("count", [1, 3, 4])
def test_as_many_levels_as_the_run_then_has(count):
    _, _, whole = planned(budget={"time": 60.0, "effects": False})
    time = 1.15 * sum(level.seconds for level in whole.levels[:count])
    posed, plan, cast = planned(budget={"time": time, "effects": False})
    solved = refined(unsolved(posed, plan), Tasks())
    levels, stop = solved.runs["finite_element"].levels, solved.refinement
    assert len(levels) == len(cast.levels) == count
    assert "budget.time" in stop and "budget.time" in cast.ends
    for level, said in zip(levels, cast.levels, strict=True):
        assert (level.grid.pitch, level.grid.count) == (said.pitch, said.elements)
        # contact is narrower than the stretch that is planned for
        assert 0.4 * said.unknowns < level.unknowns < 1.3 * said.unknowns
        assert level.expected_seconds < 1.1 * said.seconds


def test_waves_of_a_five_hundredth_of_the_half_width_are_told_to_be_coarse():
    """The fourth level has a million unknowns and five to ten elements a wave; the fifth would
    exceed the memory. The half-plane alone takes no finite elements."""
    posed, _, cast = planned(**SHORT, budget={"memory": 3e9, "effects": False})
    assert 400 < posed.hertz.half_width / 0.2e-6 < 800
    assert len(cast.levels) == 4 and "budget.memory" in cast.ends
    assert 4.0 < cast.per_wave < 10.0
    assert cast.levels[-1].unknowns > 5e5
    assert cast.text.startswith("3 levels (") and "up to 4 where" in cast.text
    finest = forecast(posed, make_plan(posed, ("half_plane",))).levels[-1]
    assert finest.unknowns == finest.elements > 1e5


def test_less_time_is_fewer_levels_but_never_none():
    _, _, cast = planned(budget={"time": 1e-6, "effects": False})
    assert len(cast.levels) == 1
    assert "1 level of 3 asked for" in cast.text


def test_a_smooth_body_has_no_waves():
    posed, plan, cast = planned()
    assert cast.per_wave is None and "wave" not in cast.text
    limited = forecast(replace(posed, levels=Levels(3)), plan)
    assert limited.ends == "3 levels are the most"


@pytest.mark.parametrize(
    ("name", "seconds"),
    [("flow-turned", (2.8, 10.7)), ("flow-flank", (1.8, 6.5)), ("ground-unrun", (35.8, 209.0))],
)
def test_flow_on_rough_metals_takes_half_to_twice_as_long(name, seconds):
    """Times were measured in processor seconds of a busy machine."""
    if name == "ground-unrun":
        scene = Scene.read(name).changed("body.yield_stress", 2e9).changed("load.friction", 0.1)
        scene = scene.changed("finite_element.plastic", True)
    else:
        scene = Scene.read(DOCS / f"{name}.toml")
    posed = problem_of(scene, levels=Levels(2))
    levels = forecast(posed, make_plan(posed, MODELS)).levels
    for level, took in zip(levels, seconds, strict=True):
        assert 0.5 < level.seconds / took < 2.0


@pytest.mark.parametrize("name", scene_names())
def test_unknowns_are_those_of_the_meshes(name):
    """Unknowns of level 1, as if contact were all over the extent; with quadratic elements."""
    scene = Scene.read(name)
    problem = problem_of(scene.unchecked({"finite_element.element": "P2"}))
    refinement, patches = Refinement(problem.pitches[0]), np.array([problem.extent])
    specs = [block_spec(problem, refinement, patches)]
    if not problem.scene.roller.rigid and not problem.shares_factor:
        specs.append(roller_spec(problem, specs[0]))
    made = sum(2 * len(build_block(spec).points) for spec in specs)
    expected = expected_unknowns(problem, refinement, patches)
    assert expected == pytest.approx(made, rel=0.2)
