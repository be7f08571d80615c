"""Work that cannot change a verdict is left out: the verdicts are those with all of it."""

from dataclasses import replace

import pytest
from scenes import judged

from comparisons.common.cache import Cache, kinds_of
from comparisons.common.tasks import LATER, PERHAPS, Tasks
from comparisons.figures.figure import is_decided
from comparisons.figures.quantity import MODELS
from comparisons.judging import comparison
from comparisons.judging.model_error import study as model_error
from comparisons.judging.study import unsolved
from comparisons.judging.verdict.headline import validity
from comparisons.models.level import Level
from comparisons.models.plan import make_plan
from comparisons.runs.refinement import refined

SMALL = {"resolution": {"pitch": 12e-6, "levels": 3}, "finite_element": {"block": 40}}
JUDGED = ("peak_pressure", "contact_length")
RIGID = {"rigid": True}
WAVY = {"kind": "sinusoid", "wavelength": 150e-6, "amplitude": 0.2e-6}
SCENES = {
    "smooth": {"roller": RIGID},
    "smooth, well within": {"roller": RIGID, "tolerance": dict.fromkeys(JUDGED, 0.1)},
    "layer": {"roller": RIGID, "body": {"thickness": 0.3e-3, "base": "bonded"}},
    "coated": {
        "roller": RIGID,
        "coating": {"thickness": 40e-6, "youngs_modulus": 30e9, "poissons_ratio": 0.3},
    },
    "wave": {"roller": RIGID, "profile": WAVY, "load": {"friction": 0.1}},
    "wave, tight": {
        "roller": RIGID,
        "profile": WAVY,
        "tolerance": {"peak_pressure": 0.002, "contact_length": 0.05},
        "budget": {"time": 20.0},
    },
}
DECIDED = ("smooth, well within", "layer")  # by the comparison and the effects' estimates
FIXED = ("coated", "wave, tight")  # on the second level


@pytest.fixture(scope="module")
def budgets(problem_with, tmp_path_factory):
    """`budgets(name)`: of a scene, as it is and with all effects, and its tolerances."""

    def made(name: str):
        problem = problem_with(**(SMALL | SCENES[name]))
        plan = make_plan(problem, MODELS)
        cache = Cache(tmp_path_factory.mktemp("levels"), name, kinds_of(Level))
        solved = refined(unsolved(problem, plan), Tasks(kept=cache))
        rows, results = comparison.solve(solved, {}, None).figures, []
        for effects in (True, "all"):
            scene = problem.scene.unchecked({"budget.effects": effects})
            posed = replace(solved, problem=replace(problem, scene=scene))
            results.append(model_error.error_budget(posed, rows, Tasks(kept=cache)))
        return *results, problem.scene.tolerances

    return made


@pytest.mark.parametrize("name", SCENES)
def test_verdicts_are_those_with_all_effects(budgets, name):
    frugal, whole, tolerance = budgets(name)
    assert whole.left_out is None
    frugally, wanted = (
        [figure for figure in result.figures(tolerance) if figure.bounds]
        for result in (frugal, whole)
    )
    assert [figure.verdict for figure in frugally] == [figure.verdict for figure in wanted]
    assert validity(frugally) == validity(wanted)
    selections = [result.selection.added for result in (frugal, whole)]
    assert (selections[0] < selections[1]) == (name in DECIDED)
    assert (frugal.left_out is not None) == (frugal.levels < whole.levels) == (name in FIXED)
    for one, other in zip(frugally, wanted, strict=True):  # what was left out is stated as unknown
        assert abs(one.value - other.value) <= one.total


@pytest.mark.parametrize(
    ("value", "uncertainty", "unknown", "fixed"),
    [
        (0.010, 0.002, 0.005, True),  # holds
        (0.050, 0.010, 0.010, True),  # fails
        (0.010, 0.005, 0.030, True),  # what is not modelled is in the way
        (0.010, 0.011, 0.030, False),  # and the error itself is hardly known
        (0.010, 0.008, 0.011, False),  # may come to hold
        (0.055, 0.010, 0.040, False),  # may come to fail
        (0.010, float("inf"), 0.030, False),
    ],
)
def test_a_verdict_is_fixed_where_no_finer_solution_turns_it(value, uncertainty, unknown, fixed):
    error = judged("peak_pressure", value, uncertainty, {"coating": unknown})
    assert error.is_fixed == fixed


@pytest.mark.parametrize(
    ("difference", "uncertainty", "size", "decided"),
    [
        (0.005, 0.002, 0.010, True),
        (0.005, 0.002, 0.014, False),
        (-0.30, 0.01, 0.10, True),
        (-0.30, 0.01, 0.25, False),
        (-0.30, 0.01, 1.5, False),
    ],
)
def test_a_difference_is_decided_where_no_effect_turns_it(difference, uncertainty, size, decided):
    assert is_decided(difference, uncertainty, size, 0.02) == decided


@pytest.mark.parametrize(("pitch", "urgency"), [(2e-6, PERHAPS), (12e-6, LATER)])
def test_its_own_elements_say_whether_a_third_level_of_the_whole_is_likely(
    problem_with, pitch, urgency
):
    """It then waits for nothing: the second level of the scene's own leaves a figure open."""
    changed = SMALL | {"resolution": {"pitch": pitch, "levels": 3}, "budget": {"time": 20.0}}
    problem = problem_with(**changed, roller=RIGID, profile=WAVY)
    plan, tasks = make_plan(problem, MODELS), Tasks()
    refined(unsolved(problem, plan), tasks, lambda solved: model_error.begin(solved, tasks))
    wholes = {key: task for key, task in tasks._tasks.items() if key.startswith("whole-")}
    assert [task.urgency for key, task in wholes.items() if key.endswith("-3")] == [urgency]
