"""Verdicts on single quantities and on the half-plane as a whole."""

import math

import pytest

from comparisons.figures.figure import Figure, is_within, judge
from comparisons.figures.uncertainty import Uncertainty
from comparisons.output.headline import validity

LITTLE = 1e-15  # more than rounding of numbers below 1 loses


@pytest.mark.parametrize(
    ("difference", "uncertainty", "tolerance", "verdict"),
    [
        (0.001, 0.002, 0.02, "agree"),
        (-0.019, 0.0009, 0.02, "agree"),
        (-0.019, 0.002, 0.02, "inconclusive"),
        (0.03, 0.002, 0.02, "differ"),
        (-0.03, 0.002, 0.02, "differ"),
        (0.03, 0.025, 0.02, "inconclusive"),  # by its size alone it would differ
        (0.01, 0.03, 0.02, "inconclusive"),
        (0.06, 0.03, 0.02, "differ"),
        (0.015, 0.019, 0.02, "inconclusive"),
        (0.5, math.inf, 0.02, "inconclusive"),
        (math.inf, 0.001, 0.02, "inconclusive"),
    ],
)
def test_judge(difference, uncertainty, tolerance, verdict):
    assert judge(difference, uncertainty, tolerance) == verdict


@pytest.mark.parametrize(
    ("value", "uncertainty", "within"),
    [
        (2.0, 1.0, True),  # from 1 to 3, bounds included
        (2.0, 1.5, None),
        (4.0, 1.0, None),  # touches the bound
        (4.0, 0.75, False),
        (0.0, 0.75, False),
        (2.0, math.nan, None),
    ],
)
def test_an_interval_lies_within_bounds_beyond_them_or_across(value, uncertainty, within):
    assert is_within(value, uncertainty, 1.0, 3.0) is within


@pytest.mark.parametrize("value", [0.0, 0.01, -0.019, 0.021, -0.05])
@pytest.mark.parametrize("uncertainty", [0.0, 0.001, 0.0011, 0.015, 0.03, math.inf])
def test_both_tables_are_judged_alike(value, uncertainty):
    words = {"agree": "holds", "differ": "fails", "inconclusive": "inconclusive"}
    expected = words[judge(value, uncertainty, 0.02)]
    figure = judged(value=value, uncertainty=uncertainty)
    assert figure.verdict == validity([figure])[0] == expected


def judged(
    quantity="peak_pressure", value=0.001, uncertainty=0.002, not_modelled=None, tolerance=0.02
):
    """A model error."""
    return Figure(
        study="model_error",
        quantity=quantity,
        source="half_plane",
        value=value,
        at={"friction": 0.0},
        against="whole",
        uncertainty=Uncertainty({"numerical": uncertainty}),
        unknown=not_modelled or {},
        bounds=(-tolerance, tolerance),
    )


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_rule_turns_at_its_bounds_and_nowhere_else(sign):
    """|e| + U + E on the tolerance holds, |e| - U - E on it does not fail; numbers are exact."""

    def verdict(value, uncertainty):
        not_modelled = {"exact_circle": 0.0, "coating": 0.125}
        return validity(
            [judged("peak_pressure", sign * value, uncertainty, not_modelled, tolerance=0.5)]
        )[0]

    inside, outside = 0.5 - 0.125 - 0.0625, 0.5 + 0.125 + 0.0625
    assert verdict(inside, 0.0625) == "holds"
    assert verdict(inside + LITTLE, 0.0625) == "inconclusive"
    assert verdict(outside, 0.0625) == "inconclusive"
    assert verdict(outside + LITTLE, 0.0625) == "fails"


def test_holds_names_the_quantity_nearest_to_its_tolerance():
    verdict, why = validity([judged(), judged("tau1_max", -0.015)])
    assert verdict == "holds"
    assert "tau1_max -1.50%" in why and "peak_pressure" not in why


def test_one_error_outside_fails_it():
    rows = [judged(), judged("contact_length", 0.04), judged("tau1_max", 0.01, 0.05)]
    verdict, why = validity(rows)
    assert verdict == "fails"
    assert "contact_length +4.00%" in why
    assert "peak_pressure" not in why and "tau1_max" not in why


def test_an_uncertain_error_leaves_it_open():
    verdict, why = validity([judged(), judged("tau1_max", 0.01, 0.015)])
    assert verdict == "inconclusive"
    assert "tau1_max +1.00% +- 1.50%" in why and "peak_pressure" not in why


def test_what_no_model_shows_can_move_an_error_either_way():
    rows = [
        judged(not_modelled={"plastic_flow": 0.03}),
        judged("tau1_max", not_modelled={"finite_roller": 0.001}),
    ]
    verdict, why = validity(rows)
    assert verdict == "inconclusive"
    assert "plastic flow 3.0%" in why and "finite roller" not in why
    beyond = judged(value=-0.04, not_modelled={"plastic_flow": 0.03})
    assert validity([beyond])[0] == "inconclusive"
    assert validity([judged(value=-0.06, not_modelled={"plastic_flow": 0.03})])[0] == "fails"


def test_an_error_outside_but_for_what_no_model_shows_is_laid_to_that():
    outside = judged("tau1_max", -0.026, 0.0035, {"finite_strain": 0.046})
    verdict, why = validity([outside])
    assert verdict == "inconclusive"
    assert "finite deformation 4.6%" in why and "cannot be told" not in why
    blurred = judged("tau1_max", -0.026, 0.0065, {"finite_strain": 0.006})
    assert "cannot be told from its tolerance" in validity([blurred])[1]


def test_effects_that_are_not_shown_add_as_squares():
    both = {"exact_circle": 0.012, "coating": 0.012}  # 0.024 by sum, 0.0170 by squares
    assert judged(not_modelled=both).total == pytest.approx(0.002 + 0.012 * math.sqrt(2.0))
    assert validity([judged(value=0.001, not_modelled=both)])[0] == "holds"
    assert validity([judged(value=0.0015, not_modelled=both)])[0] == "inconclusive"


def test_nothing_judged_decides_nothing():
    assert validity([])[0] == "inconclusive"
