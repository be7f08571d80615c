"""Verdicts on single quantities and on the half-plane as a whole."""

import pytest

from comparisons.verdict import Comparison, half_space_verdict, judge


@pytest.mark.parametrize(
    ("difference", "uncertainty", "tolerance", "verdict"),
    [
        (0.001, 0.002, 0.02, "agree"),
        (-0.019, 0.002, 0.02, "agree"),
        (0.03, 0.002, 0.02, "differ"),
        (-0.03, 0.002, 0.02, "differ"),
        (0.01, 0.03, 0.02, "indistinct"),
        (0.025, 0.03, 0.02, "indistinct"),
        (0.05, 0.03, 0.02, "differ"),
        (0.015, 0.019, 0.02, "agree"),
    ],
)
def test_judge(difference, uncertainty, tolerance, verdict):
    assert judge(difference, uncertainty, tolerance) == verdict


def row(quantity="peak_pressure", difference=0.001, verdict="agree", tolerance=0.02):
    return Comparison(quantity, 0.0, 1.0, 1.0, difference, 0.001, tolerance, verdict)


def test_holds_names_the_quantity_nearest_to_its_tolerance():
    verdict, why = half_space_verdict([row(), row("tau1_max", -0.015)], {})
    assert verdict == "holds"
    assert "tau1_max -1.50%" in why


def test_one_difference_fails_it():
    rows = [row(), row("contact_length", 0.04, "differ"), row("tau1_max", 0.01, "indistinct")]
    verdict, why = half_space_verdict(rows, {})
    assert verdict == "fails"
    assert "contact_length +4.00%" in why and "peak_pressure" not in why


def test_an_indistinct_quantity_leaves_it_open():
    verdict, why = half_space_verdict([row(), row("tau1_max", 0.01, "indistinct")], {})
    assert verdict == "undecided"
    assert "tau1_max" in why


def test_agreement_does_not_prove_what_neither_model_shows():
    unshown = {"peak_pressure": {"finite rotation": 0.03}, "tau1_max": {"finite strain": 0.5}}
    verdict, why = half_space_verdict([row()], unshown)
    assert verdict == "undecided"
    assert "finite rotation 3.0%" in why and "finite strain" not in why


def test_effects_add_as_squares_and_each_quantity_has_its_own_tolerance():
    effects = {"peak_pressure": {"one": 0.015, "other": 0.015}}
    assert half_space_verdict([row()], effects)[0] == "undecided"
    assert half_space_verdict([row(tolerance=0.03)], effects)[0] == "holds"
    assert half_space_verdict([row("contact_length")], effects)[0] == "holds"


def test_a_difference_that_a_missing_effect_could_explain_is_no_failure():
    rows = [row("tau1_max", -0.08, "differ")]
    unflattened = {"tau1_max": {"asperities that do not flatten": 0.14}}
    verdict, why = half_space_verdict(rows, unflattened)
    assert verdict == "undecided" and "do not flatten" in why
    assert half_space_verdict(rows, {"tau1_max": {"finite strain": 0.01}})[0] == "fails"


def test_nothing_judged_decides_nothing():
    assert half_space_verdict([row(verdict=None, tolerance=None)], {})[0] == "undecided"
