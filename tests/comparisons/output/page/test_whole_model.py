"""The finite elements with all effects: drawn, and saved."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import budgeted

from comparisons.common.progress import no_progress
from comparisons.judging.study import Run
from comparisons.output.arrays import RunArrays
from comparisons.output.page.pictures.contact import pressure_picture
from comparisons.output.page.pictures.stresses import field_pictures, section_pictures
from comparisons.output.page.plots import Plots
from comparisons.runs.write import write_files

MOVED, HIGHER = 2, 1.05  # pitches, and times: the whole model's pressures


@pytest.fixture(scope="module")
def outcome(wavy_outcome: Run) -> Run:
    """At friction 0.1 the whole model has other pressures and stresses than the scene's own finite
    elements, on a coarser level; at friction 0 it is these."""
    finite_element = wavy_outcome.solved.case(0.1).runs["finite_element"]
    level = finite_element.levels[-2]
    stress = level.stress
    field = replace(stress.field, txz=1.25 * stress.field.txz)
    moved = HIGHER * np.roll(level.solution.pressure, MOVED)
    solution = replace(level.solution, pressure=moved)
    whole = replace(level, solution=solution, stress=replace(stress, field=field))
    wholes = wavy_outcome.solved.cases[0].runs["finite_element"].finest, whole
    budget = replace(wavy_outcome.data("model_error"), wholes=wholes)
    return budgeted(wavy_outcome, budget)


def labels(axes) -> list[str]:
    return [line.get_label() for line in axes.lines if not line.get_label().startswith("_")]


def test_a_whole_model_that_is_the_scenes_own_is_no_further_model(outcome: Run):
    assert list(outcome.levels(0.0)) == ["half_plane", "finite_element"]
    assert list(outcome.levels(0.1)) == ["half_plane", "finite_element", "whole"]
    grid = outcome.runs["finite_element"].levels[-2].grid
    assert [level.grid for level in outcome.pair(0.1).values()] == [grid, grid]
    assert outcome.deciding_friction in (0.0, 0.1)


def test_pressures_and_their_difference_are_those_of_the_whole(outcome, drawn_by, monkeypatch):
    monkeypatch.setattr(Run, "deciding_friction", 0.1)
    p0, whole = outcome.problem.hertz.peak_pressure, outcome.data("model_error").wholes[1]
    for figure in drawn_by(pressure_picture, outcome)[0]:
        above, difference, _ = figure.axes
        assert labels(above)[:3] == ["half-plane", "finite elements", "whole model, μ = 0.1"]
        line = next(line for line in above.lines if line.get_label() == "whole model, μ = 0.1")
        assert line.get_ydata()[1:-1] == pytest.approx(whole.solution.pressure / p0)
        half_plane = outcome.runs["half_plane"].levels[-2].solution.pressure
        apart = (half_plane - whole.solution.pressure) / p0
        assert difference.lines[0].get_ydata()[1:-1] == pytest.approx(apart)


def test_fields_are_those_of_the_whole_at_its_friction(outcome: Run, drawn_by):
    plain, sliding, *_ = drawn_by(field_pictures, outcome)[0]
    for figure, name in ((plain, "finite elements"), (sliding, "whole model")):
        assert figure.axes[1].get_title(loc="left").startswith(f"{name}: largest")
        titles = [axes.get_title(loc="left") for axes in figure.axes]
        assert f"half-plane − {name}" in titles
    [section, *_] = drawn_by(section_pictures, outcome)[0]
    names = [labels(axes) for axes in section.axes]
    assert "whole model" not in names[0] and "whole model" in names[1]


@pytest.mark.usefixtures("undrawn")
def test_it_is_saved(outcome: Run, tmp_path):
    folder = tmp_path / "run"
    write_files(replace(outcome, directory=folder), no_progress)
    rows = np.loadtxt(folder / "whole/contact.csv", delimiter=",", skiprows=3)
    whole = outcome.data("model_error").wholes[1]
    assert rows[:, 1] == pytest.approx(whole.solution.pressure)
    assert (folder / "whole/stress.vtu").is_file()
    again = RunArrays.read(folder)
    assert np.array_equal(again.contact("whole", 0.1)["pressure"], whole.solution.pressure)


def test_notebooks_reach_it(outcome: Run, monkeypatch):
    monkeypatch.setattr(Run, "deciding_friction", 0.1)
    assert Plots(outcome).view("whole", "txz") is not None
