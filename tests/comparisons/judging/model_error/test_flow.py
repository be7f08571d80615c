"""Flow beside a half-plane that surely exceeds the yield stress, or why there is none."""

import pytest
from scenes import STEEL, asked_in_python, changed, resolved, run_of

from comparisons.common.errors import ExitStatus
from comparisons.judging.effects.catalogue import FLOW
from comparisons.judging.verdict.headline import headline
from comparisons.models.plan import time_with_flow
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels

SCENE = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": {**STEEL, "law": "hencky", "yield_stress": 1e9},
    "load": {"hertz_peak_pressure": 3e9},
    "resolution": {"elements": 4, "levels": 2},
    "budget": {"time": 3.0},
}


@pytest.fixture
def beside():
    return run_of(SCENE)


# between the error and what finite strain may make of it
OPEN = {"peak_pressure": 0.365, "contact_length": 0.5}


@pytest.fixture
def short():
    return run_of(SCENE, tolerance=OPEN)


@pytest.fixture
def finite(short):
    """Run with the time that the other asks for."""
    [line] = headline(short).paste
    time = asked_in_python(line, short.problem.scene).budget.time
    return run_of(SCENE, tolerance=OPEN, budget={"time": time})


def test_a_yield_stress_alone_gives_the_figures_of_the_switch(beside):
    # on as many levels
    switched_on = run_of(SCENE, finite_element={"plastic": True}, budget={"time": 2.0})
    assert beside.data("model_error").selection.added == {FLOW}
    assert beside.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    for error in beside.model_errors:
        known = switched_on.model_errors.one(quantity=error.quantity)
        assert error.scale == pytest.approx(known.scale, rel=1e-9)
        assert error.value == pytest.approx(known.value, rel=0.02)  # a finer half-plane
        # by the levels and by the increments of flow, beside a half-plane that is known better
        assert 0.4 < error.numerical / known.numerical < 1.5
    assert beside.judged.of(study="yield") == ()  # what flows is judged by its model error


def test_the_verdict_says_what_flow_takes(beside):
    said = headline(beside)
    assert said.kind == "fails"
    error = beside.model_errors.one(quantity="peak_pressure")
    taken = 100.0 * error.value / (1.0 + error.value)
    assert f"Flow takes {taken:.0f} % off the peak pressure and adds" in said.sentence
    assert said.next.startswith("peak pressure 2.") and "not known to the tolerance" in said.next


def test_finite_strain_is_chosen_where_it_decides(beside, finite):
    """Where flow at small strains leaves a verdict open; else it says what would compute it."""
    assert finite.data("model_error").selection.added == {FLOW, "finite_strain"}
    assert headline(finite).kind == "holds"
    reason = beside.data("model_error").selection.impossible["finite_strain"]
    assert reason.startswith("flow is taken at small strains: cannot change a verdict")
    for error in finite.model_errors:
        change = error.part("finite_strain")
        counted = beside.model_errors.one(quantity=error.quantity).unknown["finite_strain"]
        assert 0.002 < abs(change.value) < counted < 0.02
        assert error.part("interaction").value == pytest.approx(0.0, abs=1e-12)


def test_flow_at_finite_strain_is_the_scene_with_both_switches():
    switches, few = {"plastic": True, "deformation": "finite"}, Levels(2, effects=2)
    finite = run_of(SCENE, budget={"effects": "all"}, levels=few)
    both = run_of(SCENE, finite_element=switches, levels=few)
    assert finite.data("model_error").selection.added == {FLOW, "finite_strain"}
    for error in finite.model_errors:
        known = both.model_errors.one(quantity=error.quantity)
        assert error.scale == pytest.approx(known.scale, rel=1e-9)
        strain, wanted = (e.part("finite_strain").value for e in (error, known))
        assert strain == pytest.approx(wanted, rel=0.02)


def test_without_time_for_finite_strain_it_says_how_much(short):
    selection, said = short.data("model_error").selection, headline(short)
    assert selection.impossible["finite_strain"].endswith("s more (budget.time)")
    assert said.kind == "inconclusive" and "Finite deformation, which is" in said.sentence


def test_without_time_it_says_how_long_flow_takes(beside):
    short = run_of(SCENE, budget={"time": 2.0})
    problem = short.problem
    assert "(budget.time)" in short.data("model_error").selection.impossible[FLOW]
    said = headline(short)
    assert said.kind == "fails" and "does not apply" in said.within.sentence
    patches = short.runs["half_plane"].levels[0].patches
    time = asked_in_python(said.paste[0], problem.scene).budget.time
    assert 1.0 <= time / time_with_flow(problem, patches) < 2.0


def test_below_first_flow_nothing_changes():
    """Neither the pressure elements nor what is computed."""
    plain = {**SCENE, "load": {"hertz_peak_pressure": 1e9}}
    with_it, without = (
        problem_of(resolved({**plain, "body": body})) for body in (SCENE["body"], STEEL)
    )
    assert not with_it.flows
    assert (with_it.extent, with_it.pitches) == (without.extent, without.pitches)


def test_where_flow_would_leave_the_trace_the_half_plane_is_solved_all_the_same():
    """A trace as long as the elastic contact and a little more."""
    scene = changed(SCENE, body={"yield_stress": 5e7, "width": 1.3e-3}, load={"friction": 0.0})
    narrow = problem_of(resolved(scene))
    assert not narrow.flows
    assert problem_of(resolved(changed(scene, body={"width": 20e-3}))).flows
