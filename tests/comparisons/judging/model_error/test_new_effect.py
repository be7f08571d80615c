"""An effect is one entry of EFFECTS: what selects, computes, splits and lists has it from there.

The effect is a body that ends ten half-widths below and beside the contact."""

import pytest
from scenes import STEEL, changed, resolved

from comparisons.figures.quantity import MODELS
from comparisons.judging.effects.catalogue import EFFECTS, Effect
from comparisons.judging.model_error.show import effects_table
from comparisons.models.problem import Levels
from comparisons.runs.run import Known, run

THIN = {"block": 10.0}
SIZES = {"peak_pressure": 0.1}  # its estimate
FEW = Known(levels=Levels(2, effects=2))
SCENE = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": {**STEEL, "law": "linear"},
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
