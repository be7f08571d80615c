"""The budget as a reader meets it: rows, waterfalls, the terminal's lines."""

from dataclasses import replace

import pytest
from scenes import budgeted, judged, refound

from comparisons.figures.figure import Part
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.model_error.model_error import INTERACTION, JUMP
from comparisons.judging.model_error.refinement import ErrorBudget
from comparisons.judging.model_error.show import (
    NUMERICAL,
    effects_table,
    error_table,
    not_modelled_line,
    steps_of,
    waterfalls,
)
from comparisons.judging.study import Run

ESTIMATES = {
    "exact_circle": {"peak_pressure": 0.001, "tau1_max": 0.0015},
    "plastic_flow": {"peak_pressure": 0.08},
    "finite_roller": {"peak_pressure": 0.02},
}
SELECTION = EffectSelection(
    frozenset({"finite_size"}),
    frozenset({"finite_roller", "finite_strain"}),
    {"plastic_flow": "the body has no yield stress"},
    ESTIMATES,
)
PARTS = (
    Part("finite_size", 0.04, 0.001),
    Part("finite_roller", -0.012, 0.0005),
    Part("finite_strain", 0.0001, 0.0001),
    Part(INTERACTION, 0.002),
)


@pytest.fixture
def split(wavy_outcome: Run) -> Run:
    """A run whose peak pressures were split; equal at both frictions; and one length."""
    errors = (
        judged("peak_pressure", -0.031, 0.0012, friction=0.0, parts=PARTS),
        judged("peak_pressure", -0.031, 0.0012, friction=0.1, parts=PARTS),
        judged("contact_length", 0.05, 0.01, friction=0.0, parts=PARTS),
    )
    budget = ErrorBudget(SELECTION, 2, None, errors)
    rows = tuple(
        row
        for row in wavy_outcome.figures.of(study="comparison")
        if (row.quantity, row.friction) in {(o.quantity, o.friction) for o in errors}
    )
    return budgeted(refound(wavy_outcome, "comparison", figures=rows), budget)


def rows_of(run: Run, **how) -> list[dict[str, str]]:
    """Rows of the table of errors by their heads."""
    table = error_table(run, **how)
    return [dict(zip(table.head, row, strict=True)) for row in table.rows]


def test_rows_join_equal_frictions_and_list_what_counts(split: Run):
    peak, length = rows_of(split)
    name, made_of, *_ = peak["quantity"].split("\n")
    assert name == "peak pressure" and peak["friction"] == "0, 0.1"
    # an effect that raises the finite elements' figure makes the half-plane's too low
    parts = "finite thickness or width −4.0 %, finite roller +1.2 %"
    assert list(peak.values())[4:7] == ["−3.1 %", "0.12 %", "2 %"]
    assert made_of == parts
    assert length["difference"] == "+5.0 %" and length["friction"] == "0"


def test_a_maximum_that_moves_is_named_with_its_places(split: Run):
    first, second = split.data("model_error").model_errors[:2]
    parts, place = (*second.parts, Part(JUMP, 0.02)), (-1.5e-4, 2.5e-5)
    errors = first, replace(second, parts=parts, place=place)
    moves = budgeted(split, replace(split.data("model_error"), model_errors=errors))
    first, second = rows_of(moves)
    assert "at x" not in first["quantity"]
    assert second["quantity"].endswith("\nat x = 25.00 µm, of the half-plane at −150.0 µm")
    assert "another asperity +2.0 %" in second["quantity"].split("\n")[1].split(", ")


def test_a_row_says_what_may_exceed_its_tolerance(split: Run):
    names = [row["quantity"].split("\n")[2:] for row in rows_of(split)]
    assert names == [["8.0 % not modelled"], []]


def test_what_is_not_modelled_stands_with_its_size_and_reason(split: Run):
    assert not_modelled_line(split) == (
        "plastic flow (at most 8.0 %): the body has no yield stress"  # the circle is negligible
    )
    why = dict.fromkeys(("exact_circle", "plastic_flow"), "not asked for")
    selection = replace(split.data("model_error").selection, impossible=why)
    both = budgeted(split, replace(split.data("model_error"), selection=selection))
    said = "exact circle (at most 0.15 %), plastic flow (at most 8.0 %): not asked for"
    assert not_modelled_line(both) == said


def test_every_effect_that_applies_is_in_the_table(split: Run):
    table = effects_table(split)
    status = {row[0]: row[2] for row in table.rows}
    assert status == {
        "finite thickness or width": "contained",
        "finite roller": "computed",
        "exact circle": "negligible",
        "finite deformation": "computed",
        "plastic flow": "not computed",
    }
    said = {row[0]: row[4] for row in table.rows}
    assert said["plastic flow"] == "the body has no yield stress"
    assert {row[0]: row[1] for row in table.rows}["exact circle"] == EFFECTS["exact_circle"].words


def test_steps_of_a_waterfall_add_up_to_the_error_with_its_sign(split: Run):
    error = waterfalls(split)["peak pressure"]  # equal at both frictions
    steps = steps_of(error)
    assert (error.value, error.numerical, error.tolerance) == (-0.031, 0.0012, 0.02)
    assert steps["finite thickness or width"] == -0.04
    assert steps["finite roller"] == 0.012 and steps["interaction"] == -0.002
    assert sum(steps.values()) == pytest.approx(error.value)
    assert steps[NUMERICAL] == pytest.approx(-0.0009)
    assert error.not_modelled == pytest.approx((0.001**2 + 0.08**2) ** 0.5)
