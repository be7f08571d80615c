"""Contents of the report's pictures: axes, pressures, surfaces, sections, mesh, problem, cost."""

import numpy as np
import pytest

from analytic.exact.hertz import hertz_stress
from comparisons.judging.study import Run


def line(axes, label: str) -> np.ndarray:
    """Points (n, 2) of the line of that label."""
    [wanted] = [line for line in axes.lines if line.get_label() == label]
    return wanted.get_xydata()


def test_every_axis_says_what_it_shows_and_in_which_unit(wavy: dict[str, list]):
    for name, figures in wavy.items():
        for figure in figures:
            plots = [axes for axes in figure.axes if axes.get_ylim() != (0.0, 1.0)]  # no colour bar
            left = min(axes.get_position().x0 for axes in plots)
            assert any(axes.get_xlabel() for axes in plots)
            for axes in plots:
                for label in filter(None, (axes.get_xlabel(), axes.get_ylabel())):
                    assert "[" in label or "/" in label, (name, label)
                rows = name in ("judged_picture", "model_error_picture")  # with names
                assert axes.get_ylabel() or rows or axes.get_position().x0 > left + 0.01, name


def test_pressures_are_drawn_over_x_in_units_of_hertz(wavy: dict[str, list], wavy_outcome: Run):
    [wide] = wavy["pressure_picture"]
    [close] = wavy["close_up_picture"]
    p0 = wavy_outcome.problem.hertz.peak_pressure
    for name, label in (("half_plane", "half-plane"), ("finite_element", "finite elements")):
        level = wavy_outcome.runs[name].finest
        points = line(wide.axes[0], label)
        assert points[1:-1, 1] == pytest.approx(level.solution.pressure / p0)
        assert points[1:-1, 0] == pytest.approx(level.grid.x / 1e-6)  # micrometres
        assert points[0, 1] == points[-1, 1] == 0.0
        nodes = line(close.axes[0], label)
        assert np.max(nodes[:, 1]) == pytest.approx(np.max(level.solution.pressure) / p0)
    assert wide.axes[-1].get_xlabel() == "x [µm]"
    hertz = line(wide.axes[0], "Hertz, smooth")
    exact = wavy_outcome.problem.hertz.pressure(hertz[:, 0] * 1e-6) / p0
    assert hertz[:, 1] == pytest.approx(exact, abs=1e-6)
    hardness = line(wide.axes[0], "hardness")
    assert hardness[:, 1] == pytest.approx(wavy_outcome.problem.scene.body.hardness / p0)


def test_the_difference_of_pressures_is_half_plane_minus_finite_elements(wavy, wavy_outcome):
    one, other = (run.finest.solution.pressure for run in wavy_outcome.runs.values())
    drawn = wavy["pressure_picture"][0].axes[1].lines[0].get_ydata()[1:-1]
    assert drawn == pytest.approx((one - other) / wavy_outcome.problem.hertz.peak_pressure)


def test_deformed_surfaces_coincide_where_there_is_pressure(wavy, wavy_outcome):
    axes = wavy["pressure_picture"][0].axes[2]
    level = wavy_outcome.runs["half_plane"].finest
    roller, body = axes.lines[0].get_ydata(), axes.lines[1].get_ydata()
    touching = level.solution.pressure > 0.0
    assert np.all(roller >= body - 1e-9)
    assert np.max(np.abs(roller - body)[touching]) < 1e-6 * np.ptp(roller)
    assert np.max(roller - body) == pytest.approx(np.max(level.solution.gap) / 1e-6, rel=1e-6)


def test_sections_hold_both_fields_and_the_exact_smooth_one(wavy, wavy_outcome):
    hertz, window = wavy_outcome.problem.hertz, wavy_outcome.window
    through_edge = wavy["section_pictures"][1]
    column = int(np.argmin(np.abs(window.x - hertz.half_width)))
    whole = [axes for axes in through_edge.axes if axes.get_xlim()[1] > 0.5]
    for axes, friction in zip(whole, wavy_outcome.problem.scene.load.friction, strict=True):
        for name, label in (("half_plane", "half-plane"), ("finite_element", "finite elements")):
            field = wavy_outcome.solved.case(friction).runs[name].finest.stress.field
            drawn = line(axes, label)
            assert drawn[:, 1] == pytest.approx(field.tau1[:, column] / hertz.peak_pressure)
            assert drawn[:, 0] == pytest.approx(window.z / hertz.half_width)
        exact = hertz_stress(hertz, window.x[column], window.z, friction).tau1
        assert line(axes, "Hertz, exact")[:, 1] == pytest.approx(exact / hertz.peak_pressure)


def test_the_mesh_is_drawn_downwards_with_every_edge(wavy, wavy_outcome):
    mesh = wavy_outcome.runs["finite_element"].finest.mesh
    whole = wavy["mesh_pictures"][0].axes[0]
    low, high = whole.get_ylim()
    assert low > high  # z downwards
    assert whole.get_xlabel() == "x [mm]"
    [edges] = whole.collections
    drawn = 1e-3 * np.concatenate(edges.get_segments()).reshape(-1, 2, 2)
    lengths = np.hypot(*(drawn[:, 1] - drawn[:, 0]).T)
    corners = mesh.triangles[:, :3]
    pairs = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2))
    ends = mesh.points[np.unique(pairs, axis=0)]
    every = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    assert np.sort(lengths) == pytest.approx(np.sort(every))
