"""Tables of convergence: what a reviewer asks of each judged figure, as the run has it."""

from dataclasses import replace

import pytest

from comparisons.common.numbers import percent
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.report.tables.convergence import WORDS, judged_table, validation_table
from comparisons.results.outcome import Outcome
from comparisons.studies.contact import uncertainties


def test_each_judged_figure_says_how_it_converged(wavy_outcome: Outcome):
    table = judged_table(wavy_outcome)
    rows = {row[0]: dict(zip(table.head, row, strict=True)) for row in table.rows}
    problem = wavy_outcome.problem
    assert len(rows) == len(table.rows)
    for model, name in (("half-plane", "half_plane"), ("finite elements", "finite_element")):
        stated = uncertainties(wavy_outcome.runs[name], problem, problem.scene.load.friction[0])
        for quantity in ("peak_pressure", "contact_length"):
            row, known = rows[f"{label(quantity)}, {model}"], stated[quantity].convergence
            assert float(row["formal order"]) == QUANTITIES[quantity].formal_order
            assert row["behaviour"] == known.behaviour
            assert row["safety factor"] == f"{known.safety_factor:g}"
            assert row["discretisation"] == percent(stated[quantity].discretisation)
            assert row["coverage"] == "95 %"
            assert (row["observed order"] == "none") == (known.order is None)
            number, unit = row["extrapolated"].split(" ")
            size = {"GPa": 1e9, "MPa": 1e6, "µm": 1e-6, "mm": 1e-3}[unit]
            assert float(number) * size == pytest.approx(known.limit, rel=1e-4)


def test_every_behaviour_is_explained_on_the_page(wavy_page):
    explained = " ".join(term for term, _ in WORDS)
    for word in ("monotone", "irregular", "oscillating", "diverging", "settled"):
        assert word in explained
    for term, meaning in WORDS:
        assert term in wavy_page.text and meaning.split(";")[0] in wavy_page.text


def test_the_quantities_of_v_and_v_20_are_named(wavy_outcome: Outcome):
    table = validation_table(wavy_outcome)
    assert table.head[1:] == ("E", "u_num", "u_input", "u_D")
    assert {row[-1] for row in table.rows} == {"no data"}
    checks = wavy_outcome.tolerance_checks
    assert len(table.rows) == len(checks) == len({row[0] for row in table.rows})
    for row, check in zip(table.rows, checks, strict=True):
        assert row[2] == percent(check.uncertainty)
        entry = next(
            e
            for e in wavy_outcome.result["error_budget"]["quantities"][check.quantity]
            if e["friction"] == check.friction
        )
        found = entry["validation"]
        assert (found["E"], found["u_num"]) == (check.value, check.uncertainty)
        assert found["u_input"] == entry["input"] and found["u_D"] is None
        assert row[3] == percent(found["u_input"])


def test_one_model_has_no_comparison_error(smooth_outcome: Outcome):
    alone = replace(smooth_outcome, budget=None, pairs=())
    assert validation_table(alone) is None and judged_table(alone) is not None
    assert {row[3] for row in validation_table(smooth_outcome).rows} == {"no trace"}
