"""The budget as a reader meets it: rows, bars, the terminal's lines."""

import io
import re
from collections.abc import Callable
from dataclasses import replace

import pytest
from rich.console import Console

from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.assessment.effects.error_budget import ErrorBudget
from comparisons.assessment.effects.model_error import Estimate, ModelError
from comparisons.assessment.effects.selection import EffectSelection
from comparisons.report.figures.model_error import (
    NOT_MODELLED,
    PART_LOOKS,
    error_bars,
    model_error_picture,
)
from comparisons.report.figures.style import drawing
from comparisons.report.page import render
from comparisons.report.tables.model_error import effects_table, model_error_rows, not_modelled_line
from comparisons.report.terminal import summary
from comparisons.results.outcome import Outcome
from comparisons.results.result_json import error_budget_content, model_error_content

ESTIMATES = {
    "exact_circle": {"peak_pressure": 0.001, "tau1_max": 0.0015},
    "plastic_flow": {"peak_pressure": 0.08},
    "deformed_gap": {"peak_pressure": 0.02},
}
SELECTION = EffectSelection(
    frozenset({"finite_size"}),
    frozenset({"deformed_gap", "finite_strain"}),
    {"exact_circle": ESTIMATES["exact_circle"]},
    {"plastic_flow": "the body has no yield stress"},
    ESTIMATES,
)
EFFECTS_HERE = {
    "finite_size": Estimate(0.04, 0.001),
    "deformed_gap": Estimate(-0.012, 0.0005),
    "finite_strain": Estimate(0.0001, 0.0001),
}


@pytest.fixture
def split(wavy_outcome: Outcome) -> Outcome:
    """A run whose peak pressures were split; equal at both frictions, and one norm."""
    own = (
        ModelError("peak_pressure", 0.0, EFFECTS_HERE, 0.002, -0.031, 0.0012),
        ModelError("peak_pressure", 0.1, EFFECTS_HERE, 0.002, -0.031, 0.0012),
        ModelError("pressure_l2", 0.0, EFFECTS_HERE, 0.002, 0.05, 0.01),
    )
    budget = ErrorBudget(SELECTION, 2, None, own, {0.0: {"peak_pressure": 0.003}}, 1.5)
    rows = tuple(
        row
        for row in wavy_outcome.comparisons
        if (row.quantity, row.friction) in {(o.quantity, o.friction) for o in own}
    )
    problem = wavy_outcome.problem
    result = wavy_outcome.result | {
        "error_budget": error_budget_content(problem, wavy_outcome.runs, rows, budget),
        "model_error": model_error_content(problem, budget),
    }
    return replace(wavy_outcome, budget=budget, comparisons=rows, result=result)


def test_rows_join_equal_frictions_and_list_what_counts(split: Outcome):
    peak, norm = model_error_rows(split)
    assert (peak.quantity, peak.friction) == ("peak_pressure", "0, 0.1")
    assert (peak.error, peak.uncertainty, peak.tolerance) == ("−3.1 %", "0.12 %", "2 %")
    # an effect that raises the finite elements' figure makes the half-plane's too low
    assert peak.contributions == ("finite thickness or width −4.0 %", "deformed gap +1.2 %")
    assert (
        norm.error == "5.0 %" and "finite thickness or width 4.0 %" in norm.contributions
    )  # norms have no sign
    assert [row.quantity for row in model_error_rows(split, judged=True)] == ["peak_pressure"]


def test_what_is_not_modelled_stands_with_its_size_and_reason(split: Outcome):
    assert not_modelled_line(split) == (
        "plastic flow (at most 8.0 %): the body has no yield stress; exact circle (at most 0.15 %)"
    )
    why = dict.fromkeys(("exact_circle", "plastic_flow"), "not asked for")
    selection = replace(split.budget.selection, impossible=why, negligible=())
    both = replace(split, budget=replace(split.budget, selection=selection))
    assert not_modelled_line(both) == (
        "exact circle (at most 0.15 %), plastic flow (at most 8.0 %): not asked for"
    )


def test_every_effect_that_applies_is_in_the_table(split: Outcome):
    table = effects_table(split)
    status = {row[0]: row[2] for row in table.rows}
    assert status == {
        "finite thickness or width": "contained",
        "deformed gap": "computed",
        "exact circle": "negligible",
        "finite strain": "computed",
        "plastic flow": "not computed",
    }
    said = {row[0]: row[4] for row in table.rows}
    assert said["plastic flow"] == "the body has no yield stress"
    assert {row[0]: row[1] for row in table.rows}["exact circle"] == EFFECTS["exact_circle"].words


def test_one_model_has_no_budget(finish: Callable[..., Outcome], smooth_tables: dict):
    outcome = finish(smooth_tables, ("half_plane",))
    assert outcome.budget is None and outcome.result["error_budget"] is None
    assert effects_table(outcome) is None
    with drawing():
        assert model_error_picture(outcome) is None


class TestBars:
    def test_they_are_as_long_as_their_parts(self, split: Outcome):
        peak = next(bar for bar in error_bars(split) if bar.parts["sampling"])
        assert peak.parts["finite_size"] == 0.04 and peak.parts["deformed_gap"] == 0.012
        assert peak.parts["interaction"] == 0.002 and peak.parts["sampling"] == 0.003
        assert peak.parts[NOT_MODELLED] == pytest.approx((0.001**2 + 0.08**2) ** 0.5)
        numerical = split.result["error_budget"]["quantities"]["peak_pressure"][0]["numerical"]
        for model, name in (
            ("half_plane", "half-plane's discretisation"),
            ("finite_element", "finite elements' discretisation"),
        ):
            assert peak.parts[name] == numerical[model]["discretisation"]
        assert (peak.error, peak.uncertainty, peak.tolerance) == (-0.031, 0.0012, 0.02)

    def test_every_part_has_a_look_of_its_own(self, split: Outcome):
        for bar in error_bars(split):
            assert set(bar.parts) <= set(PART_LOOKS)
        assert set(EFFECTS) <= set(PART_LOOKS)
        assert len(set(PART_LOOKS.values())) == len(PART_LOOKS)

    def test_the_picture_says_what_is_judged(self, split: Outcome):
        with drawing():
            picture = model_error_picture(split)
        assert "peak pressure" in picture.alternative and "−3.1 %" in picture.alternative
        assert picture.source.startswith("data:image/svg+xml;base64,")


def test_the_page_lists_contributions_where_errors_were_split(
    split: Outcome, wavy_page, page_of, no_pictures, monkeypatch
):
    monkeypatch.setattr("comparisons.report.page.draw", no_pictures)
    [table] = [table for table in page_of(render(split)).tables if "model error" in table[0]]
    assert table[1][-1] == "finite thickness or width −4.0 %, deformed gap +1.2 %"
    [table] = [table for table in wavy_page.tables if "model error" in table[0]]
    assert "dominant contributions" not in table[0]  # no effect was computed


def test_the_terminal_shows_it_in_80_columns(split: Outcome):
    stream = io.StringIO()
    Console(file=stream, width=80).print(summary(split))
    text = stream.getvalue()
    assert max(map(len, text.splitlines())) <= 80
    flat = " ".join(text.split())
    assert re.search(
        r"peak pressure 0, 0\.1 -3\.1 0\.12 2 finite thickness or width -4\.0 deformed gap", flat
    )
    assert "not modelled plastic flow (at most 8.0%" in flat
