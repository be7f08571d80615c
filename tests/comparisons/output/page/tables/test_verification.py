"""Tables of verification: how judged figures converged, no column unnamed, words for names."""

from dataclasses import replace

import pytest

from comparisons.common.numbers import percent
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.judging.contact import uncertainties
from comparisons.judging.study import Run
from comparisons.output.page.tables.verification import (
    judged_table,
    validation_table,
)


def test_each_judged_figure_says_how_it_converged(wavy_outcome: Run):
    table = judged_table(wavy_outcome)
    rows = {row[0]: dict(zip(table.head, row, strict=True)) for row in table.rows}
    problem = wavy_outcome.problem
    assert len(rows) == len(table.rows)
    for model, name in (("half-plane", "half_plane"), ("finite elements", "finite_element")):
        stated = uncertainties(wavy_outcome.runs[name], problem)
        for quantity in ("peak_pressure", "contact_length"):
            row, known = rows[f"{label(quantity)}, {model}"], stated[quantity].convergence
            assert float(row["formal order"]) == QUANTITIES[quantity].formal_order
            assert row["behaviour"] == known.behaviour
            assert row["safety factor"] == f"{known.safety_factor:g}"
            assert row["discretisation"] == percent(stated[quantity].parts["discretisation"])
            assert row["coverage"] == "95 %"
            assert (row["observed order"] == "none") == (known.order is None)
            number, unit = row["extrapolated"].split(" ")
            size = {"GPa": 1e9, "MPa": 1e6, "µm": 1e-6, "mm": 1e-3}[unit]
            assert float(number) * size == pytest.approx(known.limit, rel=1e-4)


def test_the_quantities_of_v_and_v_20_are_named(wavy_outcome: Run):
    table = validation_table(wavy_outcome)
    assert table.head[1:] == ("E", "u_num", "u_input", "u_D")
    assert {row[-1] for row in table.rows} == {"no data"}
    checks = wavy_outcome.model_errors
    assert len(table.rows) == len(checks) == len({row[0] for row in table.rows})
    for row, check in zip(table.rows, checks, strict=True):
        assert row[0].endswith(f"friction {check.friction:g}")
        assert row[2] == percent(check.numerical)
        assert row[3] == percent(check.unknown["trace_sampling"])


def test_one_model_has_no_comparison_error(smooth_outcome: Run):
    others = ("comparison", "model_error")
    findings = {
        name: study for name, study in smooth_outcome.findings.items() if name not in others
    }
    alone = replace(smooth_outcome, findings=findings)
    assert validation_table(alone) is None and judged_table(alone) is not None
    assert {row[3] for row in validation_table(smooth_outcome).rows} == {"no trace"}
