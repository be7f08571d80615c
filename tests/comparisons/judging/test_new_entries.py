"""An analytic model that is added as an entry of CANDIDATES is judged and its cost is shown; an
effect is one entry of EFFECTS: what selects, computes, splits and lists has it from there.

The effect is a body that ends ten half-widths below and beside the contact."""

import pytest
from scenes import STEEL, changed, resolved, run_of

from comparisons.figures.quantity import MODELS
from comparisons.judging.effects.catalogue import EFFECTS, Effect
from comparisons.judging.ladder import candidates
from comparisons.judging.ladder.candidates import CANDIDATES, Candidate
from comparisons.judging.ladder.cost import methods_of
from comparisons.judging.ladder.study import RUNGS
from comparisons.judging.model_error.show import effects_table
from comparisons.models.problem import Levels
from comparisons.runs.run import Known, run

LINEAR = {"roller": {"radius": 8e-3, "rigid": True}, "body": STEEL | {"law": "linear"}}
NARROW = LINEAR | {
    "load": {"hertz_peak_pressure": 8e9},
    "finite_element": {"roller_shape": "circle"},
    "tolerance": {"peak_pressure": 3e-4},
    "resolution": {"elements": 20},
}


def test_a_new_model_is_one_entry(monkeypatch):
    circle = Candidate("round", "round", lambda problem, effects, peak: effects & {"exact_circle"})
    monkeypatch.setattr(candidates, "CANDIDATES", (circle, *CANDIDATES[1:]))
    run = run_of(NARROW, levels=Levels(2, 2))
    figure = run.figures.one(study="ladder", source="round", quantity="peak_pressure")
    half_plane = run.figures.one(study="ladder", source="half_plane", quantity="peak_pressure")
    assert abs(figure.value) <= figure.numerical < abs(half_plane.value)
    rows = {row["rung"]: row for row in run.findings["ladder"].table(RUNGS).rows()}
    assert rows["round"]["model"] == "half-plane with exact circle"
    assert "half-plane, round" in [model.label for model in methods_of(run.problem)]


THIN = {"block": 10.0}
SIZES = {"peak_pressure": 0.1}  # its estimate
FEW = Known(levels=Levels(2, effects=2))
SCENE = LINEAR | {
    "load": {"hertz_peak_pressure": 5e8},
    "resolution": {"elements": 4},
    "tolerance": {"peak_pressure": 0.01},
}


@pytest.fixture
def known(monkeypatch):
    effect = Effect("thin body", "a body that ends nearby", lambda *shown: SIZES, sets=THIN)
    monkeypatch.setitem(EFFECTS, "thin_body", effect)


def test_it_is_selected_computed_and_listed(known):
    beside = run(resolved(SCENE), None, MODELS, known=FEW)
    assert beside.data("model_error").selection.added == {"thin_body"}
    error = beside.model_errors.one(quantity="peak_pressure")
    assert error.part("thin_body").value != 0.0
    [effects, _] = beside.findings["model_error"].series
    [row] = [row for row in effects.rows() if row["effect"] == "thin_body"]
    assert (row["status"], row["peak_pressure"]) == ("computed", 0.1)
    assert "a body that ends nearby" in str(effects_table(beside))
    # what the switch gives the scene's own finite elements
    switched = run(resolved(changed(SCENE, finite_element=THIN)), None, MODELS, known=FEW)
    assert switched.data("model_error").selection.contained == {"thin_body"}
    own = switched.model_errors.one(quantity="peak_pressure")
    assert error.scale == pytest.approx(own.scale, rel=1e-9)
