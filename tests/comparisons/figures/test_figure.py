"""A figure: what names it, and the one rule by which it and the half-plane are judged."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scenes import judged

from comparisons.figures.figure import (
    Figure,
    Figures,
    Findings,
    Series,
    Statement,
    figures_of,
    is_within,
)
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.verdict.headline import validity

BOUNDED = Figure("comparison", "peak_pressure", "half_plane", 0.01, {"friction": 0.1}, "other")


def test_two_figures_of_one_name_are_refused():
    other = replace(BOUNDED, value=0.02, bounds=(-1.0, 1.0))
    with pytest.raises(ValueError, match="two figures are called"):
        Figures([BOUNDED, other])


@pytest.mark.parametrize(
    "change",
    [
        {"study": "contact"},
        {"quantity": "tau1_max"},
        {"source": "whole"},
        {"against": None},
        {"at": {"friction": 0.2}},
    ],
)
def test_each_part_of_the_name_tells_them_apart(change):
    assert len(Figures([BOUNDED, replace(BOUNDED, **change)])) == 2


def test_figures_of_a_kind_keep_their_order():
    figures = Figures(replace(BOUNDED, at={"friction": mu}) for mu in (0.3, 0.0, 0.1))
    assert [f.friction for f in figures.of(study="comparison")] == [0.3, 0.0, 0.1]
    assert figures.one(friction=0.0) is figures[1]
    assert figures.one(friction=0.2) is None


def test_what_has_no_bounds_is_not_judged():
    """And bounded, but without a stated uncertainty, it is inconclusive."""
    assert replace(judged(), bounds=None).verdict is None
    assert replace(judged(), uncertainty=None).verdict == "inconclusive"


@given(
    value=st.floats(-1.0, 1.0),
    size=st.floats(0.0, 1.0),
    unknown=st.floats(0.0, 1.0),
    most=st.floats(1e-6, 1.0),
)
def test_a_verdict_that_is_fixed_survives_a_finer_solution(value, size, unknown, most):
    """Wherever within its uncertainty the value comes to lie, with none left."""
    beside = {"flow": unknown}, most
    figure = judged("peak_pressure", value, size, *beside)
    if not figure.is_fixed or figure.verdict == "inconclusive":
        return
    for moved in (-size, 0.0, size):
        finer = judged("peak_pressure", value + moved * (1.0 - 1e-12), 0.0, *beside)
        assert finer.verdict == figure.verdict


def test_parts_are_bounds_and_add():
    stated = Uncertainty({"iteration": 1e-3, "domain": 2e-3, "increments": 4e-3, "reading": 8e-3})
    assert stated.total == pytest.approx(15e-3)
    assert Uncertainty().total == 0.0
    assert Uncertainty({"discretisation": math.inf}).total == math.inf


def test_a_value_is_judged_over_its_scale_and_a_difference_as_it_is():
    value = judged(value=2e9, uncertainty=0.0, tolerance=3.0)
    value = replace(value, against=None, scale=1e9)
    assert (value.relative, value.verdict) == (2.0, "holds")
    assert replace(judged(value=0.02), scale=1e9).relative == 0.02


def test_plain_figures_leave_out_what_is_not_known():
    made = figures_of("problem", "hertz", {"a": 2.0, "b": None, "c": math.nan, "d": 0.0})
    assert [(f.quantity, f.scale, f.numerical) for f in made] == [("a", 2.0, 0.0), ("d", 1.0, 0.0)]


def test_series_and_statements_are_found_by_name_source_and_place():
    series = Series("patches", {}, "half_plane"), Series("patches", {}, "whole", {"friction": 0.1})
    said = (Statement("converged", "yes", "half_plane"),)
    findings = Findings(series=series, statements=said)
    assert findings.table("patches", "whole", friction=0.1) is series[1]
    assert findings.table("patches", "whole", friction=0.2) is None
    assert findings.said("converged", "half_plane") == "yes"
    assert findings.said("converged", "whole") is None


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
    """Models that are compared agree or differ, the half-plane's errors and values hold or fail."""
    words = {"agree": "holds", "differ": "fails", "inconclusive": "inconclusive"}
    figure = judged("peak_pressure", difference, uncertainty, tolerance=tolerance)
    assert figure.verdict == validity([figure]) == words[verdict]
    assert replace(figure, against="finite_element").verdict == verdict
    if math.isfinite(difference):
        assert replace(figure, against=None).verdict == words[verdict]


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
