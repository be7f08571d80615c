"""Cells of tables: units, signs and digits as the figures have them."""

from dataclasses import replace
from math import inf

from comparisons.drawing.blocks import compared_cells, judged_cells, stated
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty

PEAK = Figure("contact", "peak_pressure", "half_plane", 1.25e9, scale=1.25e9)
OFF = Figure(
    *("comparison", "peak_pressure", "half_plane", -0.01234),
    against="finite_element",
    uncertainty=Uncertainty({"numerical": 0.001}),
    bounds=(-0.02, 0.02),
)


def test_a_difference_has_the_digits_that_are_certain():
    assert judged_cells(OFF) == ("−1.2 %", "0.10 %", "2 %", "agree")
    assert judged_cells(replace(OFF, value=0.01234))[0] == "+1.2 %"
    assert judged_cells(replace(OFF, bounds=None))[2:] == ("", "")


def test_values_stand_in_one_unit_and_norms_have_neither_values_nor_sign():
    other = replace(PEAK, source="finite_element", value=0.9e9)
    assert compared_cells(OFF, (PEAK, other), "Pa")[:3] == ("1.250 GPa", "0.9000 GPa", "−1.2 %")
    norm = replace(OFF, quantity="pressure_l2", value=0.01234)
    assert compared_cells(norm, (None, None), "")[:3] == ("", "", "1.2 %")


def test_a_figure_is_shown_with_its_uncertainty_where_that_is_known():
    figure = replace(PEAK, uncertainty=Uncertainty({"numerical": 0.016}))
    assert stated(figure, 1e9) == "1.25 ± 0.02"
    small = replace(figure, uncertainty=Uncertainty({"numerical": 1e-9}))
    assert stated(small, 1e9) == "1.2500 ± 0.0001"
    assert stated(replace(figure, uncertainty=Uncertainty({"numerical": inf})), 1e9) == "1.25"
    assert stated(None) == ""
