"""An analytic model that is added as an entry of CANDIDATES is judged and its cost is shown."""

from scenes import STEEL, run_of

from comparisons.judging.ladder import candidates
from comparisons.judging.ladder.candidates import CANDIDATES, Candidate
from comparisons.judging.ladder.cost import methods_of
from comparisons.judging.ladder.study import RUNGS
from comparisons.models.problem import Levels

NARROW = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": STEEL | {"law": "linear"},
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
