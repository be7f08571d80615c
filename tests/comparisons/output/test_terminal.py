"""The terminal's table: every figure in 80 columns, in a pipe, on any terminal."""

import io
import math
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import replace

import pytest
from rich.console import Console
from scenes import STEADY, refound, with_fields

from comparisons.common.numbers import rounded_up
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import within_of
from comparisons.output.terminal import SHORT, summary

UNITS = {"GPa": 1e9, "MPa": 1e6, "kPa": 1e3, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "": 1.0}


def printed(outcome: Run, width: int = 80, encoding: str = "utf-8", details: bool = True) -> str:
    """Text that goes into a file or a pipe."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    Console(file=stream, width=width).print(summary(outcome, details))
    stream.seek(0)
    return stream.read()


def rows(text: str) -> dict[tuple[str, str], str]:
    """Lines of the first table by the quantity's short name and its friction."""
    by_name = {}
    for line in text.partition("difference: ")[0].splitlines():
        name = next((s for s in sorted(SHORT.values(), key=len)[::-1] if line.startswith(s)), None)
        if name and "L2 " not in line[: len(name)]:
            rest = line[len(name) :].replace("|", " ").split()
            frictions = [rest.pop(0)]
            while frictions[-1].endswith(","):
                frictions.append(rest.pop(0))
            for friction in frictions:
                by_name[name, friction.strip(",")] = " ".join(rest)
    return by_name


def test_every_figure_stands_in_80_columns_without_colour(wavy_outcome: Run, finish: Callable):
    tolerance = {"contact_length": 0.007}  # less than its uncertainty
    outcome = finish({**wavy_outcome.problem.scene.tables, "tolerance": tolerance})
    text = printed(outcome)
    assert "\x1b" not in text
    assert "…" not in text
    assert max(map(len, text.splitlines())) <= 80
    assert "inconclusive" in text  # the longest verdict
    lines = rows(text)
    compared = outcome.figures.of(study="comparison")
    assert len(lines) == len(compared)
    for entry in compared:
        words = lines[SHORT[entry.quantity], f"{entry.friction:g}"].split()
        assert (words[-1] if entry.verdict else None) == entry.verdict
        wanted = {"quantity": entry.quantity, "source": "half_plane", "friction": entry.friction}
        half_plane = outcome.figures.one(study="contact", **wanted)
        if half_plane is not None:
            unit = words[1] if words[1] in UNITS else ""
            assert float(words[0]) * UNITS[unit] == pytest.approx(half_plane.value, rel=1e-3)
            words = words[4 if unit else 2 :]
        expected = 100.0 * entry.value
        last = 10.0 ** (math.floor(math.log10(100.0 * entry.numerical)) - 1)
        shown_to = max(0.51 * last, 0.051 * abs(expected))
        assert float(words[0]) == pytest.approx(expected, abs=shown_to)


def test_a_difference_below_its_uncertainty_is_shown_as_nothing(wavy_outcome: Run):
    first, *rest = wavy_outcome.figures.of(study="comparison")
    changed = replace(first, value=-0.000049, uncertainty=Uncertainty({"numerical": 0.0038}))
    outcome = refound(wavy_outcome, "comparison", figures=(changed, *rest))
    words = rows(printed(outcome))["peak pressure", "0"].split()
    assert words[4:6] == ["0.00", "0.38"]


def test_a_narrow_terminal_breaks_figures_but_cuts_none(wavy_outcome: Run):
    def letters(width: int) -> Counter:
        return Counter(re.sub(r"[\s─]", "", printed(wavy_outcome, width)))

    assert letters(50) == letters(160)


def test_where_the_models_agree_one_line_says_how_well(wavy_outcome: Run):
    text = printed(wavy_outcome, details=False)
    judged = [row for row in wavy_outcome.figures.of(study="comparison") if row.bounds]
    assert all(row.verdict == "agree" for row in judged)
    apart = max(judged, key=lambda row: abs(row.value))
    flat = " ".join(text.split())
    assert "finite elements that assume the same agree: largest difference" in flat
    assert f"({SHORT[apart.quantity]}), uncertainty" in flat
    assert "finite elements) / finite elements" not in text
    [first, *others] = wavy_outcome.findings["comparison"].figures
    apart = refound(wavy_outcome, "comparison", figures=(replace(first, value=0.5), *others))
    assert printed(apart, details=False) == printed(apart)  # the whole table, then


def test_what_is_judged_stands_before_the_tables_and_time_after_them(smooth_outcome: Run):
    _title, *lines = printed(smooth_outcome).splitlines()
    text, within = " ".join(" ".join(lines).split()), within_of(smooth_outcome).size
    right = f"{100.0 * rounded_up(within):.2g} %"
    assert text.startswith(f"The half-plane is right within {right} here")
    rest = text.rpartition(list(SHORT.values())[-1])[2]
    places = [text.index(part) for part in ("INCONCLUSIVE", " Next: ", " mu ", rest)]
    assert places == sorted(set(places))
    # three levels of 0.4683 s and of 3 s
    assert "half-plane 1.40 s, finite elements 9.00 s" in rest


def test_one_model_is_shown_without_a_comparison(finish: Callable[..., Run]):
    text = printed(finish(STEADY, ("half_plane",)))
    assert "NOT COMPARED" in text
    assert "verdict" not in text
    assert ("peak pressure", "0") in rows(text)
    assert "finite elements" not in text and "\ncrosscheck.run(scene)\n" in text


def test_titles_are_not_taken_for_markup(smooth_outcome: Run):
    title = {"title": "[red]Roller[/red] [/] and more"}
    said = printed(with_fields(smooth_outcome, title))
    assert said.startswith("[red]Roller[/red] [/] and more\n")
