"""Subsurface fields as they are drawn: the values, one scale for both models, round bands."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import with_levels
from scipy.interpolate import RegularGridInterpolator

from comparisons.drawing.curves import COINCIDE
from comparisons.drawing.field import ColourScale, FieldPanel, draw_field, layout, round_bands
from comparisons.drawing.style import drawing
from comparisons.judging.study import Run
from comparisons.output.page.pictures.stresses import field_pictures


def test_fields_of_both_models_share_one_scale_and_the_difference_has_its_own(wavy):
    for figure in wavy["field_pictures"]:
        both, difference = (scale.norm.boundaries for scale in scales_of(figure))
        assert difference == pytest.approx(-difference[::-1])
        assert difference[-1] < 0.5 * both[-1]
        assert len({scale.get_cmap().name for scale in scales_of(figure)}) == 2


def scales_of(figure) -> list:
    """Scales of the colour bars: that of the models, then that of their difference."""
    return [axes._colorbar.mappable for axes in figure.axes if hasattr(axes, "_colorbar")]


@pytest.mark.parametrize("apart", [0.9, 1.1])
def test_fields_that_coincide_are_drawn_once(wavy_outcome: Run, drawn_by, apart: float):
    """Up to 1 %, or the uncertainty of what the largest shears differ by."""
    error = wavy_outcome.figures.one(study="model_error", quantity="tau1_max", friction=0.0)
    factor = 1.0 - apart * max(COINCIDE, error.numerical)
    elements = wavy_outcome.pair(0.0)["finite_element"].stress.field
    run = wavy_outcome.runs["half_plane"]
    stress = run.finest.stress
    field = replace(elements, **{n: factor * getattr(elements, n) for n in ("sx", "sz", "txz")})
    finest = replace(run.finest, stress=replace(stress, field=field))
    runs = {**wavy_outcome.runs, "half_plane": replace(run, levels=(*run.levels[:-1], finest))}
    [figure, *_], [made, *_] = drawn_by(field_pictures, with_levels(wavy_outcome, runs))
    alone = apart < 1.0
    assert len(scales_of(figure)) == (1 if alone else 2)
    assert ("both models: largest" in made.alternative) == alone
    assert ("Both models coincide" in made.caption) == alone
    assert "largest difference at a point of the grid" in made.caption


def test_fields_and_their_difference_are_those_of_the_run(wavy: dict[str, list], wavy_outcome: Run):
    hertz, window = wavy_outcome.problem.hertz, wavy_outcome.window
    one, other = (
        run.finest.stress.field.tau1 / hertz.peak_pressure for run in wavy_outcome.runs.values()
    )
    figure = wavy["field_pictures"][0]
    both, difference = scales_of(figure)
    shown = [axes for axes in figure.axes if axes.images]
    drawn = (one, both), (other, both), (one - other, difference)
    for axes, (values, scale) in zip(shown, drawn, strict=True):
        pixels = colours_of(axes)
        rows, columns = ((np.arange(n) + 0.5) / n for n in pixels.shape[:2])
        at = RegularGridInterpolator((window.z / hertz.half_width, window.x), values)
        x = window.x[0] + columns * np.ptp(window.x)
        expected = scale.to_rgba(at(tuple(np.meshgrid(rows, x, indexing="ij"))), bytes=True)
        struck = np.any(pixels != expected, axis=-1)
        if scale is both:  # but for rounding at the bounds of bands
            assert np.mean(struck) < 1e-3
        else:
            assert np.all(pixels[struck] <= expected[struck])


def test_a_field_stands_the_right_way_up_on_depths_that_are_not_even():
    x, z = np.linspace(-1.5, 1.5, 31), np.linspace(0.0, 1.0, 20) ** 3
    with drawing():
        _, [[axes, _]] = layout([1], 1.5)
        panel = FieldPanel("depth", z[:, None] + 0.0 * x)
        fine = ColourScale("z", np.linspace(0.0, 1.0, 51), "viridis", False)
        scale = draw_field(axes, x, z, panel, fine)
        pixels = colours_of(axes)
        rows = (np.arange(len(pixels)) + 0.5) / len(pixels)
        expected = np.broadcast_to(scale.to_rgba(rows, bytes=True)[:, None], pixels.shape)
        assert np.mean(np.any(pixels != expected, axis=-1)) < 0.01
        assert list(axes.get_ylim()) == [1.0, 0.0]  # depth downwards
        left, right, bottom, top = axes.images[0].get_extent()
        assert (left, right, bottom, top) == (-1.5, 1.5, 1.0, 0.0)


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


def colours_of(axes) -> np.ndarray:
    [image] = axes.images
    return np.asarray(image.get_array())
