"""The benchmark of stresses: its direct sums are right, and it prints what it says."""

import numpy as np
import pytest

from analytic.stress.points import stress_at
from comparisons.benchmarks.stress_field.__main__ import (
    Row,
    field_rows,
    main,
    rough_load,
    table,
    verdicts,
)
from comparisons.benchmarks.stress_field.direct import FRICTION, direct, hats, shared_nodes, strips

NAMES = ("sx", "sz", "txz")


@pytest.mark.parametrize(
    ("terms", "element"), [(hats, "hat"), (shared_nodes, "hat"), (strips, "strip")]
)
def test_direct_sums_are_those_of_the_elements(terms, element):
    """In blocks and on nodes of the surface too; strips off their ends, where sx is infinite."""
    nodes, load = rough_load(50)
    rng = np.random.default_rng(3)
    x = np.concatenate([rng.uniform(-1.5, 1.5, 900), nodes[:5]])
    z = np.concatenate([rng.uniform(0.0, 1.0, 900), np.zeros(5)])
    found = direct(terms, nodes, load, x, z)
    expected = stress_at(nodes, load, FRICTION, x, z, element)
    for row, name in zip(found, NAMES, strict=True):
        np.testing.assert_allclose(row, getattr(expected, name), rtol=0.0, atol=2e-13)


def test_the_field_agrees_with_the_sums_that_it_is_timed_against():
    rows = {row.name: row for row in field_rows(64, 7, 1)}
    assert rows["convolution"].difference < 1e-13
    assert rows["direct sum, hats"].difference < 1e-12
    assert rows["direct sum, strips"].difference is None


def test_table_names_the_ratio_to_the_quickest():
    text = table("Some", [Row("slow", 3.0, 2e-15), Row("quick", 0.01)], "quick")
    assert text.splitlines()[0] == "Some"
    assert text.splitlines()[2].split() == ["slow", "3", "300", "2.0e-15"]
    assert text.splitlines()[3].split() == ["quick", "0.01", "1"]


@pytest.mark.parametrize(
    ("seconds", "difference", "holds"),
    [
        (3.0, 1e-12, [True, True]),
        (2.99, 1e-14, [False, True]),
        (9.0, 1.1e-12, [True, False]),
        (9.0, float("nan"), [True, False]),
    ],
)
def test_verdicts_ask_for_the_ratio_and_the_digits(seconds, difference, holds):
    rows = [
        Row("direct sum, hats", seconds, 2e-12),
        Row("direct sum, nodes", 1e-3, 2e-12),
        Row("convolution", 0.01, difference),
    ]
    found = verdicts(rows)
    assert [verdict.holds for verdict in found] == holds
    assert "direct sum, hats: 2.0e-12" in found[1].text


def test_prints_both_tables_and_what_they_show(capsys):
    """A field so small that it is not 300 times faster."""
    sizes = ["--elements=64", "--levels=5", "--point-elements=80", "--points=400"]
    status = main([*sizes, "--repeats=1"])
    said = capsys.readouterr().out
    assert "Field of 64 x 5 points from 64 elements" in said
    assert "400 scattered points from 80 elements; direct sums scaled from 400 of them" in said
    assert said.count("direct sum") == 9
    assert "FAILS  field: " in said
    assert "1 demands fail" in said
    assert status == 1
