"""Pairs of stated uncertainty and true error, their coverage, and observed orders."""

from collections.abc import Iterable
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from comparisons.campaigns.checks import CheckedCase, CheckedRow, study_junit
from comparisons.campaigns.verify.coverage import (
    MODEL_ERROR,
    ExactFindings,
    Pair,
    Verification,
    coverage,
    coverage_cases,
    observed_order,
    verification,
)
from comparisons.campaigns.verify.pages import coverage_line, verify_page
from comparisons.common.errors import ExitStatus
from comparisons.figures.convergence import Convergence
from comparisons.figures.uncertainty import numerical


def pair(error: float = 1e-3, stated: float = 2e-3, **others) -> Pair:
    known = Convergence(2.0, 2.0, 0.0, 1.0, 1.0, "monotone")
    made = Pair(
        *("case <&>", "source", "Hertz", "half_plane", "contact_length"),
        levels=(1.9, 1.95, 2.0 * (1.0 + error)),
        exact=2.0,
        scale=2.0,
        uncertainty=numerical(0.0, stated, 0.0, convergence=known),
        converged=True,
    )
    return replace(made, **others)


def whole(pairs: Iterable[Pair], error: str | None = None) -> Verification:
    """The verification of one row with these pairs."""
    case = CheckedCase("Hertz", "case <&>", "half_plane", lambda: None)
    return verification((CheckedRow(case, ExactFindings.of(pairs), error, 0.0),), 0.0, 200, 0)


ENOUGH = [pair()] * 200


def test_an_error_within_the_uncertainty_is_covered():
    assert pair(1e-3, 1.001e-3).covered and not pair(1e-3, 0.999e-3).covered
    assert not pair(-1e-3, 0.999e-3).covered
    assert pair(-1e-3, 2e-3).overestimation == pytest.approx(2.0)
    three = numerical(1e-3, 2e-3, 4e-3)
    assert pair(-1e-3, uncertainty=three).overestimation == pytest.approx(7.0)


def test_an_error_of_rounding_is_not_informative():
    rounded = pair(1e-14, 0.0)
    assert rounded.covered and not rounded.informative and rounded.overestimation is None
    found = coverage([rounded, pair(), pair(stated=0.5e-3)])
    assert (found.count, found.informative, found.covered) == (3, 2, 0.5)
    assert found.median_overestimation == pytest.approx(1.25)


def test_a_wrong_figure_is_seen_however_large_its_uncertainty():
    assert pair().figure.holds
    assert not pair(error=0.1, stated=1.0).figure.holds
    assert not pair(converged=False).figure.holds
    assert not pair(error=0.03, quantity="tau1_max").figure.holds


@pytest.mark.parametrize(
    ("pairs", "holds"),
    [
        ([pair()] * 95 + [pair(stated=0.0)] * 5, True),
        ([pair()] * 94 + [pair(stated=0.0)] * 6, False),
        ([pair(stated=6e-3)] * 100, False),
        ([], False),
    ],
)
def test_coverage_needs_both_a_share_and_a_ratio(pairs, holds):
    [case] = coverage_cases(pairs, fewest=0, fewest_rough=0)
    figures = case.solve().figures
    assert all(figure.holds for figure in figures) is holds


@pytest.mark.parametrize(
    ("pairs", "error"),
    [
        (ENOUGH, "no solution"),
        (ENOUGH[1:], None),
        ([*ENOUGH, pair(error=0.1, stated=1.0)], None),
        ([pair(stated=0.0)] * 200, None),
        ([pair(stated=1.0)] * 200, None),
    ],
)
def test_all_must_hold(pairs, error):
    assert whole(ENOUGH).holds
    broken = whole(pairs, error)
    assert not broken.holds and len(broken.faults) == 1
    assert broken.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    [suite] = ElementTree.fromstring(study_junit(broken).encode())
    assert suite.get("failures") == str(len(suite.findall("testcase/failure"))) == "1"
    assert "Does not hold" in verify_page(broken)


def test_one_miss_among_many_is_reported_but_does_not_fail():
    missed = whole([*ENOUGH, pair(stated=0.0)])
    [suite] = ElementTree.fromstring(study_junit(missed).encode())
    assert missed.holds and suite.get("failures") == "0"
    assert "NOT covered" in suite[200].find("system-out").text
    assert "case &lt;&amp;&gt;" in verify_page(missed)


def test_rough_contacts_have_demands_of_their_own():
    rough = [pair(kind="rough")] * 94 + [pair(kind="rough", stated=0.0)] * 6
    every, of_rough = coverage_cases([*ENOUGH, *rough], 200, 100)
    assert all(figure.holds for figure in every.solve().figures)
    assert [figure.holds for figure in of_rough.solve().figures] == [False, True, True]
    _, absent = coverage_cases(ENOUGH, 200, 1)
    assert not any(figure.holds for figure in absent.solve().figures)


def test_coverage_is_shown_by_table_model_quantity_and_kind():
    error = pair(kind="layer", table=MODEL_ERROR, quantity="peak_pressure")
    found = whole([*ENOUGH, pair(kind="rough"), error])
    assert found.groups("table", "kind")[MODEL_ERROR, "layer"].count == 1
    assert found.groups("table", "kind")["figure", "rough"].count == 1
    assert found.groups("kind")["Hertz",].count == 200
    assert error.figure.name == "model error, peak_pressure"
    page = verify_page(found)
    assert "Coverage by table, kind" in page and "<td>model error</td>" in page


def test_coverage_is_rounded_down():
    assert coverage_line(whole([pair()] * 1999 + [pair(stated=0.0)])) == "coverage 99 %"
    assert coverage_line(whole(ENOUGH)) == "coverage 100 %"
    assert coverage_line(whole([])) == "coverage 0 %"


def test_an_observed_order_is_of_the_root_mean_square():
    assert observed_order([[16.0, -4.0, 1.0], [-32.0, 7.0, -2.0]]) == pytest.approx(2.0)
