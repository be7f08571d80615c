"""Cells of tables: units, signs and digits as the figures have them."""

from dataclasses import replace

from comparisons.drawing.blocks import compared_cells, judged_cells
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
