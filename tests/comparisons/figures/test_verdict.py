"""Verdicts on single quantities and on the half-plane as a whole."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import judged

from comparisons.figures.figure import is_within
from comparisons.judging.verdict.headline import validity

LITTLE = 1e-15  # more than rounding of numbers below 1 loses


@pytest.mark.parametrize(
    ("difference", "uncertainty", "tolerance", "verdict"),
    [
        (0.001, 0.002, 0.02, "agree"),
        (-0.019, 0.0009, 0.02, "agree"),
        (-0.019, 0.002, 0.02, "inconclusive"),
        (0.03, 0.002, 0.02, "differ"),
        (0.03, 0.025, 0.02, "inconclusive"),  # by its size alone it would differ
        (0.01, 0.03, 0.02, "inconclusive"),
        (0.06, 0.03, 0.02, "differ"),
        (0.5, math.inf, 0.02, "inconclusive"),
        (math.inf, 0.001, 0.02, "inconclusive"),
    ],
)
def test_judge(difference, uncertainty, tolerance, verdict):
    """Models that are compared, and the half-plane's errors."""
    words = {"agree": "holds", "differ": "fails", "inconclusive": "inconclusive"}
    figure = judged("peak_pressure", difference, uncertainty, tolerance=tolerance)
    assert figure.verdict == validity([figure]) == words[verdict]
    assert replace(figure, against="finite_element").verdict == verdict


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


SIZES = st.floats(0.0, 0.2)


@given(value=SIZES, uncertainty=SIZES, unknown=SIZES)
def test_a_figure_holds_at_its_reach_and_nothing_finer_turns_that(value, uncertainty, unknown):
    sizes = value, uncertainty, {"coating": unknown}
    at_reach = judged("peak_pressure", *sizes, max(judged("peak_pressure", *sizes).reach, 1e-9))
    assert at_reach.verdict == "holds" and at_reach.is_fixed


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_rule_turns_at_its_bounds_and_nowhere_else(sign):
    """|e| + U + E on the tolerance holds, |e| - U - E on it does not fail; numbers are exact."""

    def verdict(value, uncertainty):
        not_modelled = {"exact_circle": 0.0, "coating": 0.125}
        error = judged("peak_pressure", sign * value, uncertainty, not_modelled, tolerance=0.5)
        return validity([error])

    inside, outside = 0.5 - 0.125 - 0.0625, 0.5 + 0.125 + 0.0625
    assert verdict(inside, 0.0625) == "holds"
    assert verdict(inside + LITTLE, 0.0625) == "inconclusive"
    assert verdict(outside, 0.0625) == "inconclusive"
    assert verdict(outside + LITTLE, 0.0625) == "fails"


def test_effects_that_are_not_shown_add_as_squares():
    both = {"exact_circle": 0.012, "coating": 0.012}  # 0.024 by sum, 0.0170 by squares
    assert judged(not_modelled=both).total == pytest.approx(0.002 + 0.012 * math.sqrt(2.0))
    assert validity([judged(value=0.001, not_modelled=both)]) == "holds"
    assert validity([judged(value=0.0015, not_modelled=both)]) == "inconclusive"


def test_what_the_trace_does_not_show_keeps_from_holding_and_excuses_no_failure():
    unknown = {"trace_sampling": 0.03}
    assert judged(value=0.001, not_modelled=unknown).verdict == "inconclusive"
    assert judged(value=0.03, not_modelled=unknown).verdict == "fails"
    assert judged(value=0.03, not_modelled={"coating": 0.03}).verdict == "inconclusive"
    assert judged(value=0.03, not_modelled={"trace_sampling": math.inf}).verdict == "fails"
