"""Tables of verification: how figures converged, and words for names."""

import pytest

from comparisons.common.numbers import percent
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.judging.rule import judged
from comparisons.judging.study import Run
from comparisons.output.page.tables.verification import WORDS, levels_tables


def test_each_judged_figure_says_how_it_converged(wavy_outcome: Run):
    tables = {table.title: table for table in levels_tables(wavy_outcome)}
    problem = wavy_outcome.problem
    for model, name in (("Half-plane", "half_plane"), ("Finite elements", "finite_element")):
        table, run = tables[model], wavy_outcome.runs[name]
        rows = {row[0]: dict(zip(table.head, row, strict=True)) for row in table.rows}
        assert len(rows) == len(table.rows)
        stated = {n: figure.uncertainty for n, figure in judged(run, problem).items()}
        for quantity in ("peak_pressure", "contact_length"):
            row, known = rows[label(quantity)], stated[quantity].convergence
            observed, formal = row["order"].split("\nformal ")
            assert float(formal) == QUANTITIES[quantity].formal_order
            assert (known.behaviour in observed) == (known.behaviour != "monotone")
            size, factor = row["discretisation"].split("\nfactor ")
            assert factor == f"{known.safety_factor:g}"
            assert size == percent(stated[quantity].parts["discretisation"])
            assert any(map(str.isdigit, observed)) == (known.order is not None)
            number, unit = row["extrapolated"].split(" ")
            size = {"GPa": 1e9, "MPa": 1e6, "µm": 1e-6, "mm": 1e-3}[unit]
            assert float(number) * size == pytest.approx(known.limit, rel=1e-4)
        counts = rows["contact: active-set steps"]
        for k, level in enumerate(run.levels):
            wanted = level.solution.iterations.get("exchanges")
            assert counts[f"level {k + 1}"] == ("" if wanted is None else str(wanted))


def test_the_quantities_of_v_and_v_20_are_named():
    assert "ASME V&V 20" in dict(WORDS)["E, u_num, u_input, u_D"]
