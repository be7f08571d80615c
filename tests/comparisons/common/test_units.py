"""Units against pint's own tables, exact factors, and whatever a user may type."""

from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from comparisons.common.units import (
    COMMON_UNITS,
    DIMENSIONLESS,
    DIMENSIONS,
    LENGTH,
    LOAD,
    MEMORY,
    PRESSURE,
    TIME,
    UnitError,
    describe,
    pint_factor,
    to_si,
)

# by definition: the inch is 25.4 mm, the kilogram-force 9.80665 N, the pound 0.45359237 kg
EXACT = {
    LENGTH: {"m": 1, "cm": Fraction(1, 100), "mm": Fraction(1, 1000), "um": Fraction(1, 10**6),
             "µm": Fraction(1, 10**6), "μm": Fraction(1, 10**6), "micron": Fraction(1, 10**6),
             "nm": Fraction(1, 10**9), "inch": Fraction(254, 10**4), "thou": Fraction(254, 10**7),
             "millimetre": Fraction(1, 1000), "km": 1000},
    PRESSURE: {"Pa": 1, "MPa": 10**6, "GPa": 10**9, "N/mm^2": 10**6, "N/mm**2": 10**6,
               "N / mm²": 10**6, "bar": 10**5, "kgf/mm^2": Fraction(980665 * 10**6, 10**5)},
    LOAD: {"N/m": 1, "N/mm": 1000, "N/um": 10**6, "kN/mm": 10**6, "MN/m": 10**6, "J/m^2": 1,
           "kg/s^2": 1, "GPa um": 1000, "Pa*m": 1},
    TIME: {"s": 1, "ms": Fraction(1, 1000), "min": 60, "h": 3600, "hours": 3600},
    MEMORY: {"byte": 1, "MB": 10**6, "GB": 10**9, "GiB": 2**30, "bit": Fraction(1, 8)},
    DIMENSIONLESS: {"%": Fraction(1, 100), "percent": Fraction(1, 100), "m/mm": 1000},
}  # fmt: skip
UNITS = [
    (dimension, unit, Fraction(f)) for dimension, us in EXACT.items() for unit, f in us.items()
]


@pytest.mark.parametrize(("unit", "entry"), COMMON_UNITS.items(), ids=COMMON_UNITS)
def test_the_table_says_what_pint_says(unit, entry):
    dimension, factor = entry
    assert pint_factor(unit, dimension, unit) == factor


@settings(deadline=None, derandomize=True)
@given(st.sampled_from(UNITS), st.decimals(-(10**6), 10**6, places=9))
def test_any_unit_gives_the_double_nearest_to_the_exact_value(unit, number):
    dimension, name, factor = unit
    exact = float(Fraction(number) * factor)
    assert to_si(f"{number} {name}", dimension) == pytest.approx(exact, rel=2.3e-16, abs=0.0)


@pytest.mark.parametrize("text", ["8.2 mm", "8.2mm", " 8.2  mm ", "+8.2 mm", "8200 um", "82e-1 mm"])
def test_ways_to_write_one_length(text):
    assert to_si(text, LENGTH) == 0.0082


def test_numbers_are_taken_as_they_are():
    assert to_si(8.2, LENGTH) == 8.2
    assert to_si(3, LENGTH) == 3.0 and isinstance(to_si(3, LENGTH), float)


@pytest.mark.parametrize("dimension", DIMENSIONS)
@pytest.mark.parametrize("other", DIMENSIONS)
def test_only_its_own_dimension_is_taken(dimension, other):
    unit = other.si_unit or "%"
    if dimension is other:
        assert to_si(f"2 {unit}", dimension) == (0.02 if unit == "%" else 2.0)
    else:
        with pytest.raises(UnitError, match=other.phrase):
            to_si(f"2 {unit}", dimension)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("8.2", "has no unit"),
        ("", "not a number and a unit"),
        ("mm", "not a number and a unit"),
        ("٣ mm", "not a number and a unit"),
        ("0x10 mm", "no known unit"),
        ("1_000 mm", "no known unit"),
        ("1 mm**9**9**9", "not a unit"),
        ("1 (mm)", "not a unit"),
        ("1 mm # note", "not a unit"),
        ("1 " + "mm*" * 40 + "mm", "not a unit"),
        ("1 m**0", "not a unit"),
        ("1 m/m", "a number without unit"),
        ("1 dB", "a number without unit"),
        ("1 degC", "temperature"),
        ("1 rad", "without dimension"),
        ("1 mm rad", "of dimension"),
        ("1e309 m", "not finite"),
        ("1e300 Ym", "not finite"),
    ],
)
def test_what_is_no_length(text, problem):
    with pytest.raises(UnitError, match=problem):
        to_si(text, LENGTH)


@pytest.mark.parametrize("text", ["1 dB", "0 dB", "-3 decibel", "2 Np", "1 octave", "1 decade"])
def test_logarithmic_units_do_not_convert(text):
    with pytest.raises(UnitError, match=f'is "{text}", which cannot be converted'):
        to_si(text, DIMENSIONLESS)


TOKENS = st.lists(
    st.sampled_from([*"0123456789.+-eE*/^%() ", "**", "mm", "um", "N", "rad", "degC", "dB", "1/"])
)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.text() | TOKENS.map("".join), st.sampled_from(DIMENSIONS))
@example("1 delta_degC", LENGTH)
@example("1 lambda", LENGTH)
@example("1 None", LENGTH)
@example("1 __class__", LENGTH)
def test_any_text_is_a_quantity_or_a_unit_error(text, dimension):
    try:
        value = to_si(text, dimension)
    except UnitError as error:
        assert describe(text) in str(error)
        assert str(error).isprintable()
    else:
        assert abs(value) < float("inf")
