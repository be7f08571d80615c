"""A coated scene: the analytic operator and finite elements are two models of one problem."""

import pytest
from scenes import RIGID_PAIR, run_of

from comparisons.common.numbers import percent
from comparisons.drawing.blocks import Note
from comparisons.output.page.page import sections
from comparisons.output.page.tables.comparison import comparison_table, first_model
from comparisons.output.page.tables.verification import levels_tables

TABLES = RIGID_PAIR | {
    "coating": {"thickness": 30e-6, "youngs_modulus": 420e9, "poissons_ratio": 0.22},
    "load": {"hertz_peak_pressure": 1.5e9},
    "stress": {"points": [60, 20]},
    "resolution": {"levels": 3},
    "budget": {"effects": False},
}


@pytest.fixture
def outcome():
    return run_of(TABLES)


def test_both_agree_within_what_they_state_where_the_half_plane_differs(outcome):
    layered, alone = (
        {f.quantity: f for f in outcome.figures.of(study=study, against="finite_element")}
        for study in ("layered", "comparison")
    )
    for name in ("peak_pressure", "contact_length", "tau1_max"):
        assert abs(layered[name].value) <= layered[name].total < 2e-2, name
        assert abs(alone[name].value) > 2.0 * abs(layered[name].value), name
    assert layered["peak_pressure"].verdict == "agree"
    assert abs(layered["peak_pressure"].value) < 3e-4 < 5e-3 < abs(alone["peak_pressure"].value)


def test_they_are_the_first_table_and_what_is_judged(outcome):
    assert first_model(outcome) == "layered half-plane"
    table = comparison_table(outcome, brief=True)
    assert table.head[2:4] == ("layered half-plane", "finite elements")
    [(one, other, *_, verdict)] = [row[2:] for row in table.rows if row[0] == "peak pressure"]
    assert one == other and verdict == "agree"
    assert {figure.study for figure in outcome.judged} == {"layered", "model_error"}


def test_the_report_says_which_half_plane_has_the_coating(outcome):
    notes: dict[str, str] = {}
    for block in sections(outcome):
        made = (one(outcome) if callable(one) else one for one in block.items)
        items = [item for one in made for item in (one if isinstance(one, list) else [one])]
        notes[block.section] = " ".join(item.text for item in items if isinstance(item, Note))
    assert "layered half-plane has the body's coating" in notes["comparison"]


def test_levels_are_those_of_the_same_difference(outcome):
    [*_, difference] = levels_tables(outcome)
    rows = {row[0]: row for row in difference.rows}
    known = outcome.figures.of(study="layered", against="finite_element")
    [figure] = known.of(quantity="peak_pressure")
    assert rows["peak pressure"][-1] == percent(figure.numerical)
