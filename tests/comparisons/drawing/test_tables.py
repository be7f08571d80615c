"""Figures in tables, facts and lines: units, signs and digits as they have them."""

from dataclasses import replace
from math import inf

import pytest

from comparisons.common.numbers import Scale
from comparisons.drawing.tables import facts_of, figure_table, line_of, stated
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import COMPARED
from comparisons.figures.uncertainty import Uncertainty

SURE = Uncertainty({"numerical": 0.016})
PEAK = Figure("contact", "peak_pressure", "half_plane", 1.25e9, {"friction": 0.1}, scale=1.25e9)
PEAK = replace(PEAK, uncertainty=SURE)
OTHER = replace(PEAK, source="finite_element", value=0.9e9)
OFF = Figure(
    *("comparison", "peak_pressure", "half_plane", -0.01234, {"friction": 0.1}),
    against="finite_element",
    uncertainty=Uncertainty({"numerical": 0.001}),
    bounds=(-0.02, 0.02),
)
LENGTH = replace(OFF, quantity="contact_length", value=0.031)
NORM = replace(OFF, quantity="pressure_l2", value=0.01234, bounds=None)
GIGA = Scale(1e9, "GPa")


def table(*figures, **how):
    """Rows of the table of these figures by their heads."""
    made = figure_table(figures, COMPARED, **how)
    return [dict(zip(made.head, row, strict=True)) for row in made.rows]


def test_a_figure_is_shown_with_its_uncertainty_where_that_is_known():
    assert stated(PEAK, GIGA) == "1.25 ± 0.02 GPa"
    small = replace(PEAK, uncertainty=Uncertainty({"numerical": 1e-9}))
    assert stated(small, GIGA) == "1.2500 ± 0.0001 GPa"
    assert stated(replace(PEAK, uncertainty=Uncertainty({"numerical": inf})), GIGA) == "1.25 GPa"
    assert stated(replace(PEAK, uncertainty=Uncertainty()), GIGA) == "1.250 GPa"
    residual = replace(PEAK, value=3.21e-9, scale=1.0, uncertainty=Uncertainty({"iteration": 1e-8}))
    assert stated(residual) == "3.2e−9 ± 1e−8"
    assert stated(None) == ""


def test_a_row_has_both_values_in_one_unit_and_what_is_judged():
    [row] = table(PEAK, OTHER, OFF)
    assert row == {
        "quantity": "peak pressure",
        "friction": "0.1",
        "half-plane": "1.25 ± 0.02 GPa",
        "finite elements": "0.90 ± 0.02 GPa",
        "difference": "−1.2 %",
        "uncertainty": "0.10 %",
        "tolerance": "2 %",
        "verdict": "agree",
    }
    [row] = table(PEAK, OTHER, OFF, brief=True)
    assert (row["half-plane"], row["finite elements"]) == ("1.250 GPa", "0.9000 GPa")
    [row] = table(PEAK, OTHER, replace(OFF, value=0.01234, bounds=None))
    assert (row["difference"], list(row)[-1]) == ("+1.2 %", "uncertainty")


def test_a_norm_has_neither_values_nor_sign():
    _, row = table(PEAK, OFF, NORM)
    assert (row["half-plane"], row["difference"], row["verdict"]) == ("", "1.2 %", "")


def test_what_is_neither_compared_nor_judged_has_values_alone():
    assert list(table(PEAK)[0]) == ["quantity", "friction", "half-plane"]
    most = replace(PEAK, bounds=(0.0, 1.2))
    [row] = table(most)
    assert (row["tolerance"], row["verdict"]) == ("at most 1.50 GPa", "holds")
    assert list(table(replace(PEAK, at={}))[0]) == ["quantity", "half-plane"]


def test_coefficients_that_change_nothing_share_a_row():
    same, moved = (replace(PEAK, at={"friction": mu}) for mu in (0.2, 0.3))
    rows = table(PEAK, same, replace(moved, value=1.4e9))
    assert [row["friction"] for row in rows] == ["0.1, 0.2", "0.3"]


def test_several_differences_of_a_quantity_have_a_row_each():
    third = replace(OFF, source="measured", value=0.05)
    first, second = table(PEAK, OTHER, OFF, third)
    assert first["quantity"] == "peak pressure\nhalf-plane against finite elements"
    assert second["quantity"] == "peak pressure\nmeasured against finite elements"
    assert (first["verdict"], second["verdict"]) == ("agree", "differ")


def test_what_is_below_and_beside_stands_there():
    [row] = table(PEAK, OFF, below=lambda f: f.source, beside={"why": lambda f: f.against or ""})
    assert row["half-plane"].endswith("GPa\nhalf_plane") and row["why"] == "finite_element"


def test_facts_name_who_says_them():
    rough = replace(PEAK, source="trace", at={})
    assert facts_of([rough], COMPARED) == [("peak pressure, trace", "1.25 ± 0.02 GPa")]
    assert facts_of([rough], COMPARED, {"trace": ""})[0][0] == "peak pressure"


@pytest.mark.parametrize(
    ("figures", "line"),
    [
        ((), ""),
        (
            (PEAK, OTHER),
            "peak pressure 1.25 ± 0.02 GPa (half-plane), 900 ± 20 MPa (finite elements)",
        ),
        (
            (PEAK, OFF),
            "peak pressure 1.25 ± 0.02 GPa (half-plane): −1.2 ± 0.10 %, agree at 2 %",
        ),
        (
            (OFF, replace(LENGTH, value=0.0)),
            "peak pressure −1.2 ± 0.10 %, agree at 2 %; all 2 agree",
        ),
        ((OFF, LENGTH), "1 of 2 differ: contact length +3.1 ± 0.10 %, differ at 2 %"),
        (
            (replace(OFF, value=-0.04), LENGTH),
            "2 of 2 differ; the farthest outside: peak pressure −4.0 ± 0.10 %, differ at 2 %",
        ),
        (
            (replace(PEAK, bounds=(0.0, 0.5)),),
            "peak pressure 1.25 ± 0.02 GPa (half-plane) (at most 625 MPa: fails)",
        ),
    ],
)
def test_a_line_says_what_decides(figures, line):
    assert line_of(figures, COMPARED) == line
