"""Linear elasticity, and elastic bodies, as the question; flow that does nothing or is unknown."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, asked_in_python, changed, half_plane_at, resolved, run_of

from analytic.grid import roller_gap
from comparisons.judging.effects.catalogue import FLOW, LAW
from comparisons.judging.model_error.show import error_table
from comparisons.judging.verdict.headline import headline, within_of
from comparisons.judging.yielding import lines
from comparisons.models.operators import operator_of, pressed_on
from comparisons.models.problem import Levels
from comparisons.scenes.scene import with_law

# a/R = 0.2: the exact circle counts, and finite strain by far more
SOFT = {"youngs_modulus": 1e9, "poissons_ratio": 0.3, "law": "linear"}
DEEP = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": SOFT,
    "load": {"hertz_peak_pressure": 1.1e8},
    "resolution": {"levels": 2},
    "budget": {"time": 10.0},
    "tolerance": {"peak_pressure": 0.01, "contact_length": 0.02},
}
GEAR = {  # Hertz's contact at 4.65 GPa: beyond any typical yield stress of its solid
    "roller": {"radius": 12e-3, "material": "100Cr6"},
    "body": {"material": "alloy steel"},
    "load": {"hertz_peak_pressure": 4.65e9},
    "resolution": {"elements": 10, "levels": 2},
    "budget": {"time": 5.0},
}
# Ripples on a smooth contact: peaks as of a body that flows, below first flow everywhere.
RIPPLED = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": {**STEEL, "law": "hencky", "yield_stress": 6.2e8},
    "profile": {"kind": "sinusoid", "wavelength": 40e-6, "amplitude": 2e-8},
    "load": {"hertz_peak_pressure": 1e9},
    "stress": {"points": [60, 20]},
    "resolution": {"levels": 2},
    "tolerance": {"contact_length": 0.1},
}


def test_within_linear_elasticity_the_error_is_that_of_the_circle():
    """The half-plane's own operator presses the circle, which knows no finite elements."""
    run = run_of(DEEP)
    selection = run.data("model_error").selection
    assert "exact_circle" in selection.added
    assert not {"finite_strain", LAW, FLOW} & (selection.whole | selection.estimates.keys())
    level = half_plane_at(run.problem, run.runs["half_plane"].finest.grid.pitch)
    circle = replace(
        run.problem, scene=run.problem.scene.unchecked({"finite_element.roller_shape": "circle"})
    )
    circle.__dict__["gap"] = roller_gap(run.problem.scene.roller.radius, None, "circle")
    exact = pressed_on(circle, level.grid, operator_of(circle, level.grid)).pressure.max()
    error = run.model_errors.one(quantity="peak_pressure")
    known = level.solution.pressure.max() / exact - 1.0
    assert abs(known) > 0.002
    assert error.value == pytest.approx(known, abs=error.numerical)
    said = headline(run)
    assert "within linear elasticity" in said.sentence
    assert within_of(run).sentence.startswith("Within linear elasticity, ")
    assert any("within linear elasticity" in text for text in run.plan.assumptions)


def test_every_other_effect_stays_beside_a_linear_law():
    body = {"thickness": 2e-3, "base": "bonded"}
    run = run_of(changed(DEEP, body=body, budget={"effects": False}))
    assert run.data("model_error").selection.whole == {"finite_size"}
    assert run.model_errors.one(quantity="peak_pressure").unknown.keys() == {"exact_circle"}


def test_one_law_of_all_bodies_replaces_their_own():
    scene = resolved(GEAR | {"body": {"material": "rail steel"}})
    asked = with_law(scene, "linear")
    assert (asked.body.law, asked.body.murnaghan, asked.roller.law) == ("linear", None, "linear")
    assert asked.linear and asked.asks_elastic and not scene.asks_elastic


def test_a_solid_that_typically_flows_is_not_judged_without_its_yield_stress():
    run = run_of(GEAR, levels=Levels(3))
    said, within = headline(run), within_of(run)
    assert said.kind == "inconclusive" and within.size is None
    assert "it flows at such stresses: alloy steel typically flows at" in within.sentence
    assert said.sentence == "Nothing said of an elastic body will hold."
    assert said.next.startswith("the flow is computed with body.yield_stress; 1080 MPa is typical")
    for row in error_table(run, brief=True).rows:
        *_, whole, error, _, _, _, note = row
        assert (whole, error, note) == ("–", "–", "plastic flow not modelled")
    assert run.data("model_error").selection.added == frozenset()
    named, linear = (asked_in_python(line, run.problem.scene) for line in said.paste)
    assert named.body.yield_stress == pytest.approx(1.08e9) and linear.linear
    linear = run_of(linear, levels=Levels(3))
    assert within_of(linear).size < 0.01 and headline(linear).kind == "holds"
    assert "it flows at such stresses" in dict(lines(linear))["flow"]


@pytest.mark.parametrize("pressure, flows", [(2.45e9, False), (2.55e9, True)])
def test_it_flows_where_the_highest_typical_yield_stress_is_exceeded(pressure, flows):
    """Alloy steel's 1.3 GPa over sqrt(3) is 0.300 p0 at 2.50 GPa."""
    run = run_of(changed(GEAR, load={"hertz_peak_pressure": pressure}), "half_plane")
    said = run.findings["yield"].said("at such stresses")
    assert bool(said) == flows


def test_flow_that_does_nothing_leaves_an_elastic_whole():
    run = run_of(RIPPLED, levels=Levels(2))
    mises = run.figures.one(study="yield", quantity="over_first_flow_von_mises").value
    selection = run.data("model_error").selection
    assert mises < 1.0 and selection.estimates["finite_strain"]
    assert FLOW in selection.found and FLOW not in selection.whole
    elastic = run_of(RIPPLED, levels=Levels(2), finite_element={"plastic": False})
    for error in run.model_errors:
        known = elastic.model_errors.one(quantity=error.quantity)
        assert error.value == pytest.approx(known.value, rel=1e-9)
        assert error.total == pytest.approx(known.total, rel=1e-6)
    assert "flow was computed and moves no judged figure" in headline(run).sentence
    assert np.isfinite(within_of(run).size)


def test_elastic_bodies_are_asked_for_by_a_switch():
    elastic = changed(GEAR, finite_element={"plastic": False}, budget={"effects": False})
    run = run_of(elastic, levels=Levels(2))
    assert "For elastic bodies, " in within_of(run).sentence
    assert within_of(run).size is not None
    assert "it flows at such stresses" in dict(lines(run))["flow"]
