"""Cost studies: methods and where they apply, references for errors, how a setting is measured."""

import time
import types

import numpy as np
import pytest
from scenes import SMOOTH, changed, problem

from analytic.exact.hertz import hertz_from_load
from comparisons.campaigns.cost import measure as cost_measure
from comparisons.campaigns.cost.measure import (
    OK,
    CostRow,
    CostTask,
    ProcessorStages,
    RefusedError,
    measure,
)
from comparisons.campaigns.cost.methods import (
    FINEST,
    LADDER,
    METHODS,
    is_half_plane_problem,
    methods_of,
    solved,
    touching_strips,
    why_not,
    with_every_effect,
)
from comparisons.campaigns.cost.recommend import assess
from comparisons.campaigns.cost.reference import error_of, is_exact, references
from comparisons.campaigns.cost.show import cells, shown
from comparisons.common.errors import SceneError
from comparisons.common.progress import Stages
from comparisons.figures.quantity import MODELS

WAVY = SMOOTH | {
    "profile": {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.3e-6},
    "load": {"per_length": 2e5},
}
HERTZ = hertz_from_load(3.55e6, 7.5706e-3, 210e9 / 0.91 / 2.0)
BY_NAME = {method.name: method for method in METHODS}


class TestMethods:
    @pytest.mark.parametrize(
        ("sections", "half_plane"),
        [
            ({}, True),
            ({"roller": {"poissons_ratio": 0.2}}, True),
            ({"body": {"thickness": 2e-3}}, False),
            ({"body": {"hardness": 9e9}}, True),
            ({"finite_element": {"gap": "displaced"}}, False),
            ({"finite_element": {"roller_shape": "circle"}}, False),
            ({"finite_element": {"roller_body": "disc"}}, False),
        ],
    )
    def test_where_they_apply(self, sections, half_plane):
        made = problem(changed(SMOOTH, **sections))
        assert is_half_plane_problem(made) is half_plane
        assert is_exact(made) is half_plane
        assert all(why_not(m, made) is None for m in METHODS)

    def test_friction_that_moves_the_surfaces_leaves_hats_alone(self):
        coupled = {"friction": [0.3], "coupled": True}
        made = problem(changed(SMOOTH, roller={"poissons_ratio": 0.0}, load=coupled))
        plain = [m for m in METHODS if m.model == "half_plane"]
        assert [why_not(m, made) is None for m in plain] == [m == FINEST for m in plain]
        assert not is_exact(made)

    @pytest.mark.parametrize("element", ["hats", "strips"])
    def test_of_hertz_errors_fall_with_the_pitch(self, element):
        made = problem(changed(SMOOTH, stress={"points": [60, 20]}))
        exact = {
            "peak_pressure": HERTZ.peak_pressure,
            "contact_length": 2.0 * HERTZ.half_width,
            "tau1_max": HERTZ.tau1_max,
        }
        errors = []
        for part in (1.0, 0.125):
            task = CostTask(made, BY_NAME[f"{element}, FFT"], part * made.pitches[0])
            values = measure(task).values[0]
            errors.append([abs(values[name] / value - 1.0) for name, value in exact.items()])
        assert np.all(np.array(errors[0]) < [1e-3, 1.5e-2, 1e-3])
        assert np.all(np.array(errors[1]) < np.array(errors[0]) / 4.0)

    def test_strips_reach_from_edge_to_edge(self):
        grid = problem(SMOOTH).grid(1e-4)
        pressure = np.zeros(grid.count)
        pressure[[2, 3, 6]] = 1.0
        patches = touching_strips(grid, types.SimpleNamespace(pressure=pressure))
        assert patches / 1e-4 - grid.first == pytest.approx(np.array([[1.5, 3.5], [5.5, 6.5]]))


@pytest.fixture(scope="module")
def study():
    """The finest method on waves, at five settings."""
    made = problem(WAVY)
    rows = [
        CostRow(FINEST, pitch, OK, None, measure(CostTask(made, FINEST, pitch)))
        for pitch in FINEST.settings(made)[:5]
    ]
    return made, rows


class TestReference:
    def test_of_a_rough_half_plane_is_its_finest_with_its_uncertainty(self, study):
        made, rows = study
        known = references(made, rows, None)
        last = rows[-1]
        for name, reference in known.items():
            assert reference.row is last and reference.source.startswith("hats, FFT at ")
            assert 0.0 < reference.floors[name] < 0.05, name
        finer = measure(CostTask(made, FINEST, 0.25 * last.setting))
        for name in ("peak_pressure", "contact_length"):
            true = error_of(finer, name, known[name])
            assert true <= known[name].floors[name]

    def test_errors_fall_towards_it(self, study):
        made, rows = study
        costs = assess(made, rows)
        for name in ("peak_pressure", "pressure_l2"):
            *errors, last = (row.errors.get(name) for row in costs.rows)
            assert last is None
            assert errors[0].value > 3.0 * errors[2].value > 0.0
        texts = cells(costs, costs.rows[-1], shown(costs))
        assert texts[-1] == "reference"

    def test_two_rows_have_no_uncertainty(self, study):
        made, rows = study
        assert references(made, rows[:2], None) == {}


class TestMeasure:
    @pytest.fixture
    def calls(self, monkeypatch):
        """Every call of `solved`, which takes no time."""
        calls = []

        def solved(method, problem, setting, window, stages, half_block):
            calls.append(setting)
            with stages.stage("contact"):
                return "level", ()

        monkeypatch.setattr(cost_measure, "solved", solved)
        monkeypatch.setattr(cost_measure, "_begun", set())
        return calls

    def test_the_first_solution_does_not_count(self, calls):
        for pitch, solutions in ((1e-5, 4), (5e-6, 7)):
            cost = measure(CostTask(problem(SMOOTH), FINEST, pitch, repeats=3, limit=60.0))
            assert (len(calls), cost.repeats) == (solutions, 3)

    def test_no_more_than_fit_and_at_least_one(self, calls):
        cost = measure(CostTask(problem(SMOOTH), FINEST, 1e-5, repeats=3, limit=0.0))
        assert (len(calls), cost.repeats) == (2, 1)

    def test_what_goes_wrong_is_stated(self, monkeypatch):
        def solved(*arguments, **more):
            raise SceneError("made.toml: budget.memory: is too small")

        monkeypatch.setattr(cost_measure, "solved", solved)
        task = CostTask(problem(SMOOTH), FINEST, 1e-5)
        with pytest.raises(RefusedError) as refused:
            measure(task)
        assert refused.value.args == (
            cost_measure.SKIPPED,
            "made.toml: budget.memory: is too small",
        )
        monkeypatch.setattr(cost_measure, "solved", lambda *a, **b: 1 / 0)
        with pytest.raises(RefusedError) as failed:
            measure(task)
        assert failed.value.args == (cost_measure.FAILED, "ZeroDivisionError: division by zero")

    def test_seconds_are_processor_time(self):
        stages = ProcessorStages()
        with stages.stage("waiting"):
            time.sleep(0.05)
        assert stages.seconds["waiting"] < 0.02


class TestLadder:
    def test_its_models_are_measured_where_they_differ(self):
        """On the same elements: those of a layer, and of a wave that deforms finitely."""
        tall = {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 2e-6}
        whole = with_every_effect(problem(WAVY | {"profile": tall}))
        names = [method.name for method in methods_of(whole) if method not in METHODS]
        assert names == ["hats, deformed", "P2, linear"]
        layer = problem(changed(SMOOTH, body={"thickness": 2e-3}))
        names = [method.name for method in methods_of(layer) if method not in METHODS]
        assert names == ["hats, layered"]
        assert methods_of(problem(SMOOTH)) == METHODS

    def test_a_layer_by_its_operator_meets_finite_elements(self):
        layer = problem(changed(SMOOTH, body={"thickness": 2e-3}))
        pitch, [method] = layer.pitches[1], [m for m in LADDER if m.element == "operator"]
        values = [
            solved(m, layer, pitch, None, Stages())[1][0]["peak_pressure"]
            for m in (FINEST, method, BY_NAME["P2"])
        ]
        assert values[1] == pytest.approx(values[2], rel=1e-3)
        assert values[0] < values[2] * (1.0 - 1e-2)


def test_both_models_are_measured():
    assert {method.model for method in METHODS} == set(MODELS)
