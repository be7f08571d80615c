"""Every figure of a run is on the page, with its unit, and says what supports it."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from scenes import PROJECT, refound, with_levels

from comparisons.cli import app
from comparisons.figures.quantity import COMPARED, MODELS, label
from comparisons.judging import contact
from comparisons.judging.study import Run
from comparisons.output.page.page import render
from comparisons.output.page.tables.comparison import comparison_table, reference_of

COMPARED_HEADS = {"half-plane", "finite elements", "verdict"}
UNITS = {"GPa": 1e9, "MPa": 1e6, "kPa": 1e3, "Pa": 1.0, "m": 1.0, "mm": 1e-3, "µm": 1e-6}
UNITS |= {"nm": 1e-9, "%": 1e-2, "": 1.0}


def number(text: str) -> float:
    """A figure with its unit as printed, in SI."""
    text = text.replace("−", "-").replace("\u202f", "")
    value, _, unit = text.partition(" ")
    return float(value) * UNITS[unit]


def test_every_number_of_the_comparison_is_on_the_page(wavy_page, wavy_outcome: Run):
    [table] = [table for table in wavy_page.tables if set(table[0]) > COMPARED_HEADS]
    shown = {}
    for name, frictions, *cells in table[1:]:
        for friction in frictions.split(", "):
            assert (name, float(friction)) not in shown
            shown[name, float(friction)] = [cell.partition(" | ")[0] for cell in cells[:-1]] + [
                cells[-1].removeprefix(" | ")
            ]
    compared = wavy_outcome.figures.of(study="comparison")
    assert len(shown) == len(compared)
    for row in compared:
        wanted = {"study": "contact", "quantity": row.quantity, "friction": row.friction}
        figures = [wavy_outcome.figures.one(source=model, **wanted) for model in MODELS]
        one, other, difference, uncertainty, tolerance, verdict = shown[
            label(row.quantity), row.friction
        ]
        for text, value, digits in ((uncertainty, row.numerical, 2), (tolerance, row.tolerance, 6)):
            if value is None:
                assert text == ""
            elif abs(value) < 1e-6 and text.startswith("<"):
                assert text == "< 0.0001 %"
            else:
                assert number(text) == pytest.approx(value, rel=0.51 * 10.0 ** (1 - digits))
        for text, figure in zip((one, other), figures, strict=True):
            if figure is None:
                assert text == ""
            else:  # to the last digit of its uncertainty
                value, size, unit = re.fullmatch(r"(.+) ± (\S+) ?(.*)", text).groups()
                digit = 10.0 ** -len(value.partition(".")[2]) * UNITS[unit]
                assert number(f"{value} {unit}") == pytest.approx(figure.value, abs=0.51 * digit)
                unsure = max(figure.numerical * figure.scale, digit)
                assert number(f"{size} {unit}") == pytest.approx(unsure, abs=0.51 * digit)
        supported = 0.51 * 10.0 ** (math.floor(math.log10(row.numerical)) - 1)
        shown_to = max(supported, 0.051 * abs(row.value))
        assert number(difference) == pytest.approx(row.value, abs=shown_to)
        assert verdict == (row.verdict or "")


def test_figures_are_also_given_over_those_of_hertz(wavy_page, wavy_outcome: Run):
    peaks = wavy_outcome.figures.of(quantity="peak_pressure")
    peak = peaks.one(study="contact", source="half_plane").value
    p0 = peaks.one(study="problem").value
    [table] = [table for table in wavy_page.tables if set(table[0]) > COMPARED_HEADS]
    relative = table[1][2].partition(" | ")[2]
    assert relative.endswith(" p₀")
    assert float(relative.split()[0]) == pytest.approx(peak / p0, rel=1e-3)


def test_every_row_says_what_problem_the_finite_elements_solve(wavy_outcome: Run):
    selection = wavy_outcome.data("model_error").selection

    def references(**changed) -> dict[str, str]:
        budget = replace(wavy_outcome.data("model_error"), selection=replace(selection, **changed))
        outcome = refound(wavy_outcome, "model_error", data=budget)
        return {name: reference_of(outcome, name) for name in COMPARED}

    assert set(references().values()) == {"the same problem"}
    both = frozenset({"exact_circle", "finite_size"})
    assert set(references(contained=both).values()) == {"exact circle, finite thickness or width"}
    sizes = {"finite_size": {"peak_pressure": 0.1}, "exact_circle": {"tau1_max": 0.1}}
    by_quantity = references(contained=both, estimates=sizes)
    assert by_quantity["peak_pressure"] == "finite thickness or width"
    assert by_quantity["tau1_max"] == "exact circle"
    assert by_quantity["pressure_l2"] == "exact circle, finite thickness or width"
    assert by_quantity["contact_length"] == "the same problem"


def capped(outcome: Run, one: float, other: float) -> Run:
    """The run with these peaks over the hardness."""
    levels, hardness = {}, outcome.problem.scene.body.hardness
    for (name, run), size in zip(outcome.runs.items(), (one, other), strict=True):
        pressure = np.minimum(run.finest.solution.pressure, size * hardness)
        pressure[pressure.argmax()] = size * hardness
        finest = replace(run.finest, solution=replace(run.finest.solution, pressure=pressure))
        levels[name] = replace(run, levels=(*run.levels[:-1], finest))
    figures = contact.solve(with_levels(outcome, levels).solved, {}, None).figures
    return refound(outcome, "contact", figures=figures)


def test_peaks_that_the_hardness_limits_are_no_evidence(wavy_outcome, smooth_outcome, drawn_only):
    def notes(outcome: Run) -> list[str]:
        rows = comparison_table(outcome, brief=True).rows
        return [note for name, *_ in rows for note in name.split("\n")[1:]]

    held = capped(wavy_outcome, 1.0, 1.0 - 1e-12)
    assert notes(held) == ["capped in both"]
    with drawn_only():
        assert render(held).count('<span class="relative">capped in both') == 1
    assert notes(capped(wavy_outcome, 1.0, 0.999)) == []
    assert notes(capped(wavy_outcome, 0.999, 1.0)) == []
    assert notes(smooth_outcome) == []  # without a hardness


def test_convergence_shows_every_level_of_every_model(wavy_page, wavy_outcome: Run):
    tables = [table for table in wavy_page.tables if "order" in table[0]]
    assert len(tables) == 3  # one a model, one of the norms of the difference
    for table, run in zip(tables, wavy_outcome.runs.values(), strict=False):
        rows = {row[0]: row[1:] for row in table[1:]}
        for k, level in enumerate(run.levels):
            pitch = number(rows["pitch of the pressure elements"][k])
            assert pitch == pytest.approx(level.grid.pitch, rel=1e-3)
            assert int(number(rows["unknowns"][k])) == level.unknowns
            peak = number(rows["peak pressure"][k])
            assert peak == pytest.approx(level.solution.pressure.max(), rel=1e-4)


def test_skipped_steps_stand_with_their_reasons(wavy_page, wavy_outcome: Run):
    assert wavy_outcome.plan.skipped
    for item in wavy_outcome.plan.skipped.items():
        assert list(item) in [row for table in wavy_page.tables for row in table]
    for assumption in wavy_outcome.plan.assumptions:
        assert assumption in wavy_page.text


def test_the_record_names_versions_hashes_and_the_command(wavy_page, wavy_outcome: Run):
    assert f"numpy {wavy_outcome.record['versions']['numpy']}" in wavy_page.text
    for value in wavy_outcome.record["hashes"].values():
        assert value in wavy_page.text
    assert "crosscheck run made.toml" in wavy_page.text
    commands = [command.callback.__name__.strip("_") for command in app.registered_commands]
    for named in re.findall(r"crosscheck (\w+) [^ ]*\.toml", wavy_page.text):
        assert named in commands
    assert f"{PROJECT}/crosscheck rerun ." in wavy_page.text
