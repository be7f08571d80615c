"""Numbers as the report writes them."""

import math

import pytest

from comparisons.common.numbers import (
    as_written,
    decimal,
    integer,
    percent,
    percent_as_written,
    plain,
    scale_of,
    significant,
    with_unit,
)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (4.15e9, "Pa", "4.150 GPa"),
        (999.97e6, "Pa", "1.000 GPa"),
        (-2.5e6, "Pa", "−2.500 MPa"),
        (5.446e-4, "m", "544.6 µm"),
        (2.236e-3, "m", "2.236 mm"),
        (1e-10, "m", "100.0 pm"),
        (3.55e6, "N/m", "3550 N/mm"),
        (0.0123, "s", "12.30 ms"),
        (412.0, "s", "412.0 s"),
        (1.5e9, "byte", "1.500 GB"),
        (0.0, "m", "0 m"),
        (0.69, "", "0.6900"),
        (None, "Pa", "–"),
        (math.inf, "Pa", "–"),
        (math.nan, "", "–"),
    ],
)
def test_a_figure_gets_the_unit_that_keeps_it_short(value, unit, text):
    assert with_unit(value, unit) == text


def test_the_largest_of_several_figures_chooses_the_unit_of_all():
    scale = scale_of([2e-6, None, 5e-3], "m")
    assert scale.name == "mm"
    assert scale.text(2e-6) == "0.002000 mm"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (12345.6, "12346"),
        (123456.0, "1.235e5"),
        (1234.5, "1234"),
        (0.00012345, "0.0001234"),
        (0.000012345, "1.234e−5"),
        (1.5e7, "1.500e7"),
        (-0.5, "−0.5000"),
    ],
)
def test_significant_digits_are_kept_and_no_more(value, text):
    assert significant(value) == text


@pytest.mark.parametrize(
    ("value", "uncertainty", "text"),
    [
        (0.00123, None, "+0.12 %"),
        (12.0, None, "+1200 %"),
        (0.0, None, "0 %"),
        (1e-9, None, "< 0.0001 %"),
        (0.00999999, None, "+1.0 %"),
        (math.inf, None, "–"),
        (-0.000049, 0.0038, "0.00 %"),  # 0.0049 % known to 0.38 %
        (-0.000051, 0.0038, "−0.01 %"),
        (0.0123, 0.00001, "+1.2 %"),  # an uncertainty adds no digit
        (0.00123, 0.00996, "+0.1 %"),  # an uncertainty of 1.0 %, as it is printed
        (1e-9, 1e-12, "< 0.0001 %"),
        (0.123, 3.4, "+10 %"),
        (0.04, 3.4, "0 %"),
        (0.00123, math.inf, "+0.12 %"),
    ],
)
def test_a_percentage_keeps_two_digits_and_ends_where_its_uncertainty_does(
    value, uncertainty, text
):
    assert percent(value, signed=True, uncertainty=uncertainty) == text


def test_figures_of_the_scene_come_back_as_they_were_typed():
    assert as_written(7.5706e-3, "m") == "7.5706 mm"
    assert as_written(207e9, "Pa") == "207 GPa"
    assert percent_as_written(0.02) == "2 %"
    assert percent_as_written(0.005) == "0.5 %"
    assert plain(0.1) == "0.1"


def test_small_helpers():
    assert decimal(-0.0004) == "0"
    assert decimal(-0.866) == "−0.866"
    assert integer(252372) == "252\u202f372"
