"""Pairs of stated uncertainty and true error, their coverage, and observed orders."""

from collections.abc import Iterable
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from comparisons.campaigns.cases import Row, Trial, holds, junit_of
from comparisons.campaigns.verify.coverage import (
    Pair,
    compared,
    coverage,
    coverage_rows,
    observed_order,
    pairs_of,
)
from comparisons.campaigns.verify.run import Verification, verification
from comparisons.common.errors import ExitStatus
from comparisons.figures.convergence import Convergence
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty, numerical
from comparisons.judging.study import MODEL_ERROR

KNOWN = Convergence(2.0, 2.0, 0.0, 1.0, 1.0, "monotone")


def row(
    error: float = 1e-3,
    stated: float = 2e-3,
    *,
    kind: str = "Hertz",
    converged: bool = True,
    uncertainty: Uncertainty | None = None,
    **fields,
) -> Row:
    """Of one case with an exact answer of 2."""
    levels = 1.9, 1.95, 2.0 * (1.0 + error)
    uncertainty = uncertainty or numerical(0.0, stated, 0.0, convergence=KNOWN)
    more = {"scale": 2.0, "uncertainty": uncertainty, "levels": levels}
    figure = Figure("contact", "contact_length", "half_plane", levels[-1], **more)
    figures = compared(replace(figure, **fields), 2.0, "source", kind, converged)
    case = Trial(kind, "case <&>", "half_plane", lambda: figures)
    return Row(case, figures, None, 0.0)


def pair(*numbers: float, **fields) -> Pair:
    (made,) = pairs_of(row(*numbers, **fields))
    return made


def whole(rows: Iterable[Row], error: str | None = None) -> Verification:
    """The verification of some rows, the first of which raised `error`."""
    first, *others = rows
    first = replace(first, error=error)
    return verification((first, *others), 0.0, (200, 0))


ENOUGH = [row()] * 200


def test_an_error_within_the_uncertainty_is_covered():
    assert pair(1e-3, 1.001e-3).covered and not pair(1e-3, 0.999e-3).covered
    assert not pair(-1e-3, 0.999e-3).covered
    assert pair(-1e-3, 2e-3).overestimation == pytest.approx(2.0)
    three = numerical(1e-3, 2e-3, 4e-3, convergence=KNOWN)
    assert pair(-1e-3, uncertainty=three).overestimation == pytest.approx(7.0)


def test_an_error_of_rounding_is_not_informative():
    rounded = pair(1e-14, 0.0)
    assert rounded.covered and not rounded.informative and rounded.overestimation is None
    shown = coverage([rounded, pair(), pair(stated=0.5e-3)])
    assert (shown.count, shown.informative, shown.covered) == (3, 2, 0.5)
    assert shown.median_overestimation == pytest.approx(1.25)


def test_a_wrong_figure_is_seen_however_large_its_uncertainty():
    assert row().holds
    assert not row(error=0.1, stated=1.0).holds
    assert not row(converged=False).holds
    assert not row(error=0.03, quantity="tau1_max").holds


@pytest.mark.parametrize(
    ("pairs", "expected"),
    [
        ([pair()] * 95 + [pair(stated=0.0)] * 5, True),
        ([pair()] * 94 + [pair(stated=0.0)] * 6, False),
        ([pair(stated=6e-3)] * 100, False),
        ([], False),
    ],
)
def test_coverage_needs_both_a_share_and_a_ratio(pairs, expected):
    [row] = coverage_rows(pairs, fewest=0, fewest_rough=0)
    assert row.holds is expected


@pytest.mark.parametrize(
    ("rows", "error"),
    [
        ([*ENOUGH, *ENOUGH], "no solution"),
        (ENOUGH[1:], None),
        ([*ENOUGH, row(error=0.1, stated=1.0)], None),
        ([row(stated=0.0)] * 200, None),
        ([row(stated=1.0)] * 200, None),
    ],
)
def test_all_must_hold(rows, error):
    assert whole(ENOUGH).holds
    broken = whole(rows, error)
    assert not broken.holds and len(broken.faults) == 1
    assert broken.exit_status == ExitStatus.OUTSIDE_TOLERANCE
    [suite] = ElementTree.fromstring(junit_of(broken).encode())
    assert suite.get("failures") == str(len(suite.findall("testcase/failure"))) == "1"


def test_one_miss_among_many_is_reported_but_does_not_fail():
    missed = whole([*ENOUGH, row(stated=0.0)])
    [suite] = ElementTree.fromstring(junit_of(missed).encode())
    assert missed.holds and suite.get("failures") == "0"
    assert "NOT covered" in suite[200].find("system-out").text
    assert "case <&>" in suite[200].get("name")


def test_rough_contacts_have_demands_of_their_own():
    smooth = [pair()] * 200
    rough = [pair(kind="rough")] * 94 + [pair(kind="rough", stated=0.0)] * 6
    every, of_rough = coverage_rows([*smooth, *rough], 200, 100)
    assert every.holds
    assert [*map(holds, of_rough.figures)] == [False, True, True]
    _, absent = coverage_rows(smooth, 200, 1)
    assert not any(map(holds, absent.figures))


def test_coverage_is_shown_by_table_model_quantity_and_kind():
    error = row(kind="layer", study=MODEL_ERROR, quantity="peak_pressure")
    verified = whole([*ENOUGH, row(kind="rough"), error])
    groups = verified.groups("table", "kind")
    assert groups["model error", "layer"].count == groups["figure", "rough"].count == 1
    assert groups["figure", "Hertz"].count == 200
    assert [figure.quantity for figure in error.judged] == ["model error, peak_pressure"]


def test_coverage_is_rounded_down():
    assert whole([row()] * 1999 + [row(stated=0.0)]).coverage_line == "coverage 99 %"
    assert whole(ENOUGH).coverage_line == "coverage 100 %"
    unsolved = replace(row(), figures=(), error="no solution")
    assert whole([unsolved]).coverage_line == "coverage 0 %"


def test_an_observed_order_is_of_the_root_mean_square():
    assert observed_order([[16.0, -4.0, 1.0], [-32.0, 7.0, -2.0]]) == pytest.approx(2.0)
