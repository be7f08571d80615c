"""What the report's pictures draw, read from the figures before they become images."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import RegularGridInterpolator

from analytic.exact.hertz import hertz_stress
from comparisons.report.figures import cost as cost_picture
from comparisons.report.figures import fields as field_pictures
from comparisons.report.figures import mesh as mesh_picture
from comparisons.report.figures import pressures as pressure_pictures
from comparisons.report.figures import problem as problem_picture
from comparisons.report.figures import sections as section_pictures
from comparisons.report.figures import surfaces as surface_picture
from comparisons.report.figures.fields import fill, layout, round_bands
from comparisons.report.figures.style import drawing
from comparisons.report.page import draw
from comparisons.results.outcome import Outcome

MODULES = (
    cost_picture,
    field_pictures,
    mesh_picture,
    pressure_pictures,
    problem_picture,
    section_pictures,
    surface_picture,
)


@pytest.fixture(scope="module")
def figures_of() -> Iterator[Callable[[Outcome], dict[str, list]]]:
    """`figures_of(outcome)`: every figure of its report, by the module that drew it."""
    with pytest.MonkeyPatch.context() as patch:
        drawn: dict[str, list] = {}

        def keep(name: str) -> Callable:
            def uri(figure) -> str:
                drawn.setdefault(name, []).append(figure)
                return "data:"

            return uri

        for module in MODULES:
            name = module.__name__.rpartition(".")[2]
            patch.setattr(module, "data_uri", keep(name))

        def figures(outcome: Outcome) -> dict[str, list]:
            drawn.clear()
            draw(outcome)
            return dict(drawn)

        yield figures


@pytest.fixture(scope="module")
def wavy(figures_of: Callable, wavy_outcome: Outcome) -> dict[str, list]:
    return figures_of(wavy_outcome)


def line(axes, label: str) -> np.ndarray:
    """Points (n, 2) of the line of that label."""
    [found] = [line for line in axes.lines if line.get_label() == label]
    return found.get_xydata()


def test_every_axis_says_what_it_shows_and_in_which_unit(wavy: dict[str, list]):
    for name, figures in wavy.items():
        if name == "cost":
            continue  # the unit stands at every tick
        for figure in figures:
            plots = [
                axes for axes in figure.axes if axes.get_ylim() != (0.0, 1.0)
            ]  # no colour bars
            columns = {round(axes.get_position().x0, 2) for axes in plots}
            assert any(axes.get_xlabel() for axes in plots)
            for axes in plots:
                labels = [axes.get_xlabel(), axes.get_ylabel()]
                assert all("[" in label or "/" in label for label in labels if label), (
                    name,
                    labels,
                )
                if axes.get_position().x0 < min(columns) + 0.01:
                    assert axes.get_ylabel(), name


def test_pressures_are_drawn_over_x_in_units_of_hertz(wavy: dict[str, list], wavy_outcome: Outcome):
    wide, narrow, close = wavy["pressures"]
    p0 = wavy_outcome.problem.hertz.peak_pressure
    for name, label in (("half_plane", "half-plane"), ("finite_element", "finite elements")):
        level = wavy_outcome.runs[name].finest
        for figure in (wide, narrow):
            points = line(figure.axes[0], label)
            assert points[1:-1, 1] == pytest.approx(level.solution.pressure / p0)
            assert points[1:-1, 0] == pytest.approx(level.grid.x / 1e-6)  # micrometres
            assert points[0, 1] == points[-1, 1] == 0.0
        nodes = line(close.axes[0], label)
        assert np.max(nodes[:, 1]) == pytest.approx(np.max(level.solution.pressure) / p0)
    assert wide.axes[-1].get_xlabel() == "x [µm]"
    hertz = line(wide.axes[0], "Hertz, smooth")
    assert hertz[:, 1] == pytest.approx(
        wavy_outcome.problem.hertz.pressure(hertz[:, 0] * 1e-6) / p0, abs=1e-6
    )
    hardness = line(wide.axes[0], "hardness")
    assert hardness[:, 1] == pytest.approx(wavy_outcome.problem.scene.hardness / p0)


def test_the_difference_of_pressures_is_half_plane_minus_finite_elements(
    wavy: dict[str, list], wavy_outcome: Outcome
):
    one, other = (run.finest.solution.pressure for run in wavy_outcome.runs.values())
    drawn = wavy["pressures"][0].axes[1].lines[0].get_ydata()[1:-1]
    assert drawn == pytest.approx((one - other) / wavy_outcome.problem.hertz.peak_pressure)


def test_deformed_surfaces_coincide_where_there_is_pressure(
    wavy: dict[str, list], wavy_outcome: Outcome
):
    axes = wavy["pressures"][0].axes[2]
    level = wavy_outcome.runs["half_plane"].finest
    roller, body = axes.lines[0].get_ydata(), axes.lines[1].get_ydata()
    touching = level.solution.pressure > 0.0
    assert np.all(roller >= body - 1e-9)
    assert np.max(np.abs(roller - body)[touching]) < 1e-6 * np.ptp(roller)
    assert np.max(roller - body) == pytest.approx(np.max(level.solution.gap) / 1e-6, rel=1e-6)


def test_sections_hold_both_fields_and_the_exact_smooth_one(
    wavy: dict[str, list], wavy_outcome: Outcome
):
    hertz, window = wavy_outcome.problem.hertz, wavy_outcome.window
    through_edge = wavy["sections"][1]
    column = int(np.argmin(np.abs(window.x - hertz.half_width)))
    whole = [axes for axes in through_edge.axes if axes.get_xlim()[1] > 0.5]
    for axes, friction in zip(whole, wavy_outcome.problem.scene.friction, strict=True):
        for name, label in (("half_plane", "half-plane"), ("finite_element", "finite elements")):
            field = wavy_outcome.runs[name].finest.stress(friction).field
            drawn = line(axes, label)
            assert drawn[:, 1] == pytest.approx(field.tau1[:, column] / hertz.peak_pressure)
            assert drawn[:, 0] == pytest.approx(window.z / hertz.half_width)
        exact = hertz_stress(hertz, window.x[column], window.z, friction).tau1
        assert line(axes, "Hertz, exact")[:, 1] == pytest.approx(exact / hertz.peak_pressure)


def test_fields_of_both_models_share_one_scale_and_the_difference_has_its_own(
    wavy: dict[str, list],
):
    for figure in wavy["fields"]:
        shown = [axes.images[0] for axes in figure.axes if axes.images]
        one, other, difference = (image.norm.boundaries for image in shown)
        assert np.array_equal(one, other)
        assert difference == pytest.approx(-difference[::-1])
        assert difference[-1] < 0.5 * one[-1]
        assert shown[0].get_cmap().name != shown[2].get_cmap().name


def test_the_caption_says_where_the_differences_colours_end(
    wavy_outcome: Outcome, monkeypatch: pytest.MonkeyPatch
):
    p0, window = wavy_outcome.problem.hertz.peak_pressure, wavy_outcome.window

    def caption(outcome: Outcome) -> tuple[str, float]:
        drawn = []
        monkeypatch.setattr(field_pictures, "data_uri", lambda figure: drawn.append(figure) or "")
        with drawing():
            text = field_pictures.field_pictures(outcome)[0][1][0].caption
        shown = [axes.images[0] for axes in drawn[0].axes if axes.images]
        return text, float(shown[2].norm.boundaries[-1])

    text, end = caption(wavy_outcome)
    assert f"colours end at ±{end:#.2g} p₀" in text

    run = wavy_outcome.runs["half_plane"]
    found = run.finest.stress(0.0)
    sx = found.field.sx.copy()
    sx[3, 17] += 40.0 * p0  # one place far beyond what the scale must cover
    field = replace(found.field, sx=sx)
    finest = replace(run.finest, stresses=(replace(found, field=field), *run.finest.stresses[1:]))
    runs = {**wavy_outcome.runs, "half_plane": replace(run, levels=(*run.levels[:-1], finest))}
    spiked, spiked_end = caption(replace(wavy_outcome, runs=runs))
    largest = found.field.tau1[3, 17] / p0
    assert spiked_end < 1.0
    assert f"colours end at ±{spiked_end:#.2g} p₀, which covers 99.5 % of the points" in spiked
    place = f"x = {window.x[17] / wavy_outcome.problem.hertz.half_width:.3f} a".replace("-", "−")
    assert f"20 p₀, stands at {place}" in spiked and largest < 1.0


def test_fields_and_their_difference_are_those_of_the_run(
    wavy: dict[str, list], wavy_outcome: Outcome
):
    hertz, window = wavy_outcome.problem.hertz, wavy_outcome.window
    one, other = (
        run.finest.stress(0.0).field.tau1 / hertz.peak_pressure
        for run in wavy_outcome.runs.values()
    )
    figure = wavy["fields"][0]
    shown = [axes.images[0] for axes in figure.axes if axes.images]
    for image, values in zip(shown, (one, other, one - other), strict=True):
        pixels = np.asarray(image.get_array())
        rows, columns = ((np.arange(n) + 0.5) / n for n in pixels.shape)
        at = RegularGridInterpolator((window.z / hertz.half_width, window.x), values)
        x = window.x[0] + columns * np.ptp(window.x)
        expected = at(tuple(np.meshgrid(rows, x, indexing="ij")))
        np.testing.assert_allclose(pixels, expected, rtol=0.0, atol=1e-9)


def test_a_field_stands_the_right_way_up_on_depths_that_are_not_even():
    x, z = np.linspace(-1.5, 1.5, 31), np.linspace(0.0, 1.0, 20) ** 3
    with drawing():
        _, [axes], _ = layout(1, 1.5)
        image = fill(axes, x, z, z[:, None] + 0.0 * x, np.linspace(0, 1, 11), "viridis", False)
        pixels = np.asarray(image.get_array())
        rows = (np.arange(len(pixels)) + 0.5) / len(pixels)
        assert np.abs(pixels - rows[:, None]).max() < 1e-12
        assert list(axes.get_ylim()) == [1.0, 0.0]  # depth downwards
        left, right, bottom, top = image.get_extent()
        assert (left, right, bottom, top) == (-1.5, 1.5, 1.0, 0.0)
        image = fill(axes, x, z, x + 0.0 * z[:, None], np.linspace(-1, 1, 11), "viridis", True)
        pixels = np.asarray(image.get_array())
        assert np.all(np.diff(pixels, axis=1) > 0.0)


@pytest.mark.parametrize("size", [3.3e-7, 0.3, 1.0, 4.7e3])
@pytest.mark.parametrize("signed", [True, False])
def test_bands_are_round_cover_the_field_and_keep_zero_in_one_colour(size: float, signed: bool):
    values = size * np.linspace(-1.0 if signed else 0.0, 1.0, 1001)[:, None]
    bands = round_bands([values, 0.5 * values], signed)
    steps = np.diff(bands)
    mantissa = steps[0] / 10.0 ** np.floor(np.log10(steps[0]) + 1e-9)
    assert np.ptp(steps) < 1e-9 * steps[0]
    assert min(abs(mantissa - m) for m in (1.0, 2.0, 2.5, 5.0)) < 1e-6
    assert bands[-1] >= 0.995 * size
    assert 6 <= len(steps) <= 20
    if signed:
        assert bands == pytest.approx(-bands[::-1])
        assert not np.any(np.abs(bands) < 0.4 * steps[0])
    else:
        assert bands[0] == 0.0


def test_bands_survive_a_field_of_nothing():
    assert np.all(np.diff(round_bands([np.zeros((3, 4))], True)) > 0.0)


def test_bars_are_as_long_as_the_stages_took(wavy: dict[str, list], wavy_outcome: Outcome):
    [figure] = wavy["cost"]
    bars = figure.axes[0].patches
    ends = [bar.get_x() + bar.get_width() for bar in bars]
    expected = []
    for run in wavy_outcome.runs.values():
        expected += [sum(run.seconds.values()), *run.seconds.values()]
    assert ends == pytest.approx(expected)


def test_the_mesh_is_drawn_downwards_with_every_edge_or_a_dark_cell(
    wavy: dict[str, list], wavy_outcome: Outcome
):
    mesh = wavy_outcome.runs["finite_element"].finest.mesh
    whole = wavy["mesh"][0].axes[0]
    low, high = whole.get_ylim()
    assert low > high  # z downwards
    assert whole.get_xlabel() == "x [mm]"
    drawn = whole.lines[0].get_xydata() * 1e-3
    lengths = np.hypot(*np.diff(drawn, axis=0).T)
    lengths = lengths[~np.isnan(lengths)]  # where the pen was lifted
    corners = mesh.triangles[:, :3]
    pairs = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2))
    ends = mesh.points[np.unique(pairs, axis=0)]
    every = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    width = whole.get_position().width * whole.figure.get_figwidth()
    cell = mesh_picture.CELL * 2.0 * mesh.spec.half_width / width
    assert np.sort(lengths) == pytest.approx(np.sort(every[every >= cell]))
    assert np.any(every < cell)
    assert whole.images  # the finest elements as dark cells


def test_the_problem_is_drawn_to_the_scene(wavy: dict[str, list], wavy_outcome: Outcome):
    to_scale, close = wavy["problem"][0].axes
    assert to_scale.get_aspect() == 1.0
    roller = to_scale.patches[0]
    assert roller.get_radius() == pytest.approx(wavy_outcome.problem.scene.roller_radius / 1e-3)
    texts = " ".join(text.get_text() for text in to_scale.texts)
    assert "R = 10 mm" in texts and "E = 210 GPa" in texts and "µ = 0, 0.1" in texts
    surfaces = [line.get_ydata() for line in close.lines[:2]]
    assert np.min(surfaces[0] - surfaces[1]) == pytest.approx(0.0, abs=1e-9)  # first touch


def test_a_rigid_roller_and_a_base_are_told(figures_of: Callable, smooth_outcome: Outcome):
    scene = replace(smooth_outcome.problem.scene, roller=None, thickness=1e-3, base="bonded")
    outcome = replace(smooth_outcome, problem=replace(smooth_outcome.problem, scene=scene))
    with drawing():
        picture = problem_picture.problem_picture(outcome)
    assert "1 mm thick, bonded to a rigid base" in picture.alternative
