"""Demands of an elastic half-plane on the body, and where it cannot stand for it."""

import numpy as np
import pytest
from scenes import STEADY, STEEL, run_of

from analytic.material import Material
from comparisons.common.errors import ExitStatus
from comparisons.judging.presentation import parts_of
from comparisons.judging.verdict.headline import headline, kind_of
from comparisons.judging.yielding import STUDY, flow_assessment, flow_sentence, note
from comparisons.output.junit import run_cases_of

GOLDEN = 0.5 * (1.0 + 5.0**0.5)
SHEAR = GOLDEN**-2.5  # largest principal shear over the peak pressure, without friction


def outcome_of(peak=1e9, friction=0.0, stress=True, **body):
    tables = {
        "roller": {"radius": 8e-3, **STEEL},
        "body": {**STEEL, **body},
        "load": {"hertz_peak_pressure": peak, "friction": friction},
        "budget": {"effects": False, "time": 1.0},
    }
    return run_of(tables | ({"stress": {"points": [60, 20]}} if stress else {}), "half_plane")


def items(outcome):
    """Items of its part of the page, after the pictures that it has none of."""
    [block] = parts_of(STUDY, outcome)
    return block.items[1:]


def test_first_flow_of_a_smooth_contact_by_both_criteria():
    """tau1 is 0.300 p0; von Mises' stress 0.558 p0 at nu = 0.3: first flow at p0 = 1.794 Y."""
    outcome = outcome_of(yield_stress=0.5e9)
    over = (f"over_first_flow_{criterion}" for criterion in ("tresca", "von_mises"))
    tresca, mises = map(outcome.data("yield").there, over)
    assert tresca == pytest.approx(2.0 * SHEAR * 2.0, rel=1e-4)
    assert mises == pytest.approx(2.0 / 1.794, rel=1e-3)
    assert outcome.data("yield").ratio == tresca > mises


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_the_peak_pressure_stands_for_a_field_that_is_not_asked_for(friction):
    by_field, by_peak = (
        outcome_of(friction=friction, stress=s).data("yield") for s in (True, False)
    )
    assert by_field.there("von_mises_max") is not None
    assert by_peak.worst.value == pytest.approx(by_field.worst.value, rel=2e-3)
    assert by_peak.there("von_mises_max") is None


def test_without_a_strength_the_sentence_says_what_it_takes():
    outcome = outcome_of(friction=[0.0, 0.4])
    said = "taken as elastic: it flows if its shear yield is below 400 MPa at friction 0.4"
    assert flow_sentence(outcome) == said
    assert "no [stress]" in flow_sentence(outcome_of(stress=False))
    assert outcome.data("yield").beyond_doubt == ""
    known = outcome.figures.of(study="yield")
    assert known.one(quantity="yield_stress") is None
    assert [figure.friction for figure in known.of(quantity="tau1_max")] == [0.0, 0.4]
    table, _, _ = items(outcome)
    assert len(table.rows) == 4  # two stresses under two friction coefficients


def test_beyond_the_ideal_strength_nothing_is_elastic_but_rubber():
    """G/2 pi of steel is 12.7 GPa: a shear of 0.300 p0 is there at p0 = 42 GPa."""
    strength = Material(**STEEL).shear_modulus / (2.0 * np.pi)
    below, above = (outcome_of(peak=f * strength / SHEAR) for f in (0.98, 1.02))
    assert below.data("yield").beyond_doubt == ""
    assert "ideal strength of a crystal, G/2π = 13 GPa" in above.data("yield").beyond_doubt
    rubber = {
        "roller": {"radius": 8e-3, "rigid": True},
        "body": {"youngs_modulus": 1e6, "poissons_ratio": 0.3},
        "load": {"hertz_peak_pressure": 0.9e6},
    }
    assert run_of(rubber, "half_plane").data("yield").beyond_doubt == ""


def test_flow_is_beyond_doubt_where_both_criteria_are_exceeded():
    """k is Y/2 by Tresca and Y/sqrt(3) by von Mises: between them it is open."""
    for over, sure in ((0.99, False), (1.1, False), (1.2, True)):
        outcome = outcome_of(yield_stress=2e9 * SHEAR / over)
        assert outcome.data("yield").ratio == pytest.approx(over, rel=1e-3)
        assert bool(outcome.data("yield").beyond_doubt) == sure
        assert headline(outcome).kind == "not compared"
        assert ("the elastic half-plane does not apply" in flow_sentence(outcome)) == sure


def test_a_rough_body_at_its_cap(wavy_outcome, finish):
    assert wavy_outcome.data("yield").flow == "cap"
    tables = wavy_outcome.problem.scene.tables
    low = finish({**tables, "body": {**tables["body"], "hardness": 1.2e9}})
    pressure = low.runs["half_plane"].finest.solution.pressure
    share = (pressure > 1.2e9 * (1.0 - 1e-12)).sum() / (pressure > 0.0).sum()
    assert 0.05 < share < 1.0
    assert low.data("yield").there("share_at_hardness") == pytest.approx(share, rel=1e-12)
    assert flow_sentence(low).startswith("flow is the hardness alone")
    assert low.data("yield").beyond_doubt == ""
    assert "only roughly: 2.4 Y to 3 Y, here 960 MPa to 1.2 GPa, fit" in note(low)


def test_plasticity_indices_of_a_wave(wavy_outcome):
    """Its summits are all as high; its rms slope is 2 pi/sqrt(2) amplitude/wavelength."""
    known = wavy_outcome.figures.of(study="yield")
    slope = np.sqrt(2.0) * np.pi * 0.2e-6 / 50e-6
    assert known.one(quantity="plasticity_index_summits") is None
    # the trace is no whole number of waves
    index = known.one(quantity="plasticity_index_slope").value
    assert index == pytest.approx(wavy_outcome.problem.modulus / 4e9 * slope, rel=1e-2)


def test_the_verdict_fails_where_nothing_stands_for_flow(smooth_outcome, finish):
    weak = finish({**STEADY, "body": {**STEEL, "yield_stress": 1e8}})
    said = headline(weak)
    assert said.kind == "fails" and said.within.size is None
    assert said.within.said.startswith("the elastic half-plane does not apply: its largest shear")
    assert weak.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    [figure] = weak.judged.of(study="yield")  # which has a case for continuous integration, too
    assert figure.verdict == "fails"
    assert "made.yield" in {
        case.classname for case in run_cases_of(weak) if case.result != "passed"
    }
    strong = finish({**STEADY, "body": {**STEEL, "yield_stress": 5e9}})
    assert kind_of(strong) != "fails"


def test_shakedown_is_said_beside_a_yield_stress(smooth_outcome, finish):
    outcome = finish({**STEADY, "body": {**STEEL, "yield_stress": 1e9}})
    known = outcome.figures.of(study="yield")
    assert known.one(quantity="shakedown_limit").value == pytest.approx(4.0, rel=1e-5)
    peak = float(outcome.runs["half_plane"].finest.solution.pressure.max())
    over = known.one(quantity="peak_pressure_over_shear_yield").value
    assert over == pytest.approx(3.0**0.5 * peak / 1e9)
    _, facts, _ = items(outcome)
    assert dict(facts.rows)["elastic shakedown up to"] == "4.000"
    assert flow_assessment(smooth_outcome.solved).ratio is None
