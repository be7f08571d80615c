"""What a reader meets in the pictures: words apart, parts that differ in grey."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib.transforms import Bbox

from comparisons.drawing.curves import distinct
from comparisons.drawing.style import (
    LINES,
    REFERENCE,
    drawing,
    figure,
    hatch,
    stacked,
    svg,
)
from comparisons.output.page.pictures.answer import judged_picture
from comparisons.output.page.pictures.problem import problem_picture
from comparisons.output.page.tables.problem import problem_sheet
from comparisons.scenes.sections import CoatingSection
from comparisons.studies.study import Run

HARD = CoatingSection(thickness=20e-6, youngs_modulus=400e9, poissons_ratio=0.22)
FLOWS = {"body.yield_stress": 1e9, "body.hardening_modulus": 20e9}


def rows_of(outcome: Run) -> dict[str, str]:
    return {name: text for _, rows in problem_sheet(outcome) for name, text in rows}


def test_a_coating_and_a_yield_stress_are_described(smooth_outcome, with_scene, drawn_by):
    changed = {"coating": {"coating": HARD}, "yielding": FLOWS}
    rows = rows_of(with_scene(smooth_outcome, {"coating": HARD} | FLOWS))
    assert rows["coating"] == "20 µm thick, E = 400 GPa, ν = 0.22"
    assert rows["body yields"] == "at 1 GPa, hardening by 20 GPa"
    assert not {"coating", "body yields"} & set(rows_of(smooth_outcome))
    for name, fields in changed.items():
        [figure], picture = drawn_by(problem_picture, with_scene(smooth_outcome, fields))
        words = " ".join(text.get_text() for text in figure.axes[0].texts)
        for said in (words, picture.alternative):
            assert ("coating 20 µm thick" in said) == (name == "coating")
            assert ("yields at 1 GPa" in said) == (name == "yielding")


def lines_of(text) -> list[Bbox]:
    """The box of each line of a text in a figure."""
    whole, lines = text.get_window_extent(), text.get_text().split("\n")
    tall = whole.height / len(lines)
    boxes = []
    for number, line in enumerate(lines):
        alone = text.axes.text(0.0, 0.0, line, fontsize=text.get_fontsize())
        wide = alone.get_window_extent().width
        alone.remove()
        left = whole.x1 - wide if text.get_ha() == "right" else whole.x0
        top = whole.y1 - number * tall
        # lines of one text may touch
        boxes.append(Bbox.from_extents(left, top - 0.99 * tall, left + wide, top))
    return boxes


@pytest.mark.parametrize("friction", [(0.1,), (0.0, 0.1), (0.05, 0.2, 0.4)])
@pytest.mark.parametrize("thickness", [None, 2e-3])
def test_words_in_the_drawing_stand_apart(wavy_outcome, drawn_by, with_scene, friction, thickness):
    fields = {"coating": HARD, "load.friction": friction, "body.thickness": thickness}
    fields["body.base"] = None if thickness is None else "frictionless"
    [figure], _ = drawn_by(problem_picture, with_scene(wavy_outcome, fields))
    axes = figure.axes[0]
    texts = [text for text in axes.texts if text.get_text()]
    assert len(texts) == 4  # load, roller, body, traction
    boxes = [line for text in texts for line in lines_of(text)]
    for one, other in combinations(boxes, 2):
        assert not one.overlaps(other)
    for box in boxes:
        assert axes.bbox.x0 <= box.x0 and box.x1 <= axes.bbox.x1 + 1.0
        assert axes.bbox.y0 <= box.y0


def words_of(axes) -> list:
    """Every text of the axes, those of ticks where they are in view."""
    texts = [axes.title, axes._left_title, *axes.texts]
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        room = 1e-9 * (high - low)
        ticks = [t for t in axis.get_major_ticks() if low - room <= t.get_loc() <= high + room]
        texts += [axis.label, *(text for t in ticks for text in (t.label1, t.label2))]
    texts += axes.get_legend().get_texts() if axes.get_legend() else []
    return texts + [text for inner in axes.child_axes for text in words_of(inner)]


def test_no_words_are_cut_or_stand_on_each_other(wavy):
    for name, figures in wavy.items():
        for drawn in figures:
            texts = [text for axes in drawn.axes for text in words_of(axes)]
            texts += [text for legend in drawn.legends for text in legend.get_texts()]
            shown = [text for text in texts if text.get_visible() and text.get_text().strip()]
            assert len(shown) > 7
            boxes = {text: text.get_window_extent() for text in shown}
            paper = drawn.bbox.padded(0.5)
            for text, box in boxes.items():
                assert Bbox.union([paper, box]).bounds == paper.bounds, (name, text)
            for one, other in combinations(shown, 2):  # lines of one legend may touch
                shared = Bbox.intersection(boxes[one], boxes[other])
                apart = shared is None or shared.width < 0.5 or shared.height < 1.5
                assert apart, (name, one, other)


def test_the_name_of_a_bar_and_its_error_stand_apart(wavy_outcome, drawn_by, with_scene):
    """Where several friction coefficients make the names long."""
    outcome = with_scene(wavy_outcome, {"load.friction": (0.05, 0.125)})
    [figure], _ = drawn_by(judged_picture, outcome)
    texts = [text for text in figure.axes[0].texts if text.get_text()]
    assert len(texts) == 2 * len(outcome.model_errors)
    for one, other in combinations(texts, 2):
        assert not one.get_window_extent().overlaps(other.get_window_extent())


def test_curves_apart_by_less_than_a_picture_shows_are_one_line():
    x = np.linspace(0.0, 1.0, 9)
    flat = {"half_plane": (x, 0.0 * x), "finite_element": (x, 1e-9 * np.cos(9.0 * x))}
    assert [*distinct(flat, least=1.0)] == [("half_plane", "finite_element")]
    assert [*distinct(flat)] == [("half_plane",), ("finite_element",)]  # seen in a close-up


def test_models_and_signs_differ_in_grey():
    for one, other in combinations((*LINES.values(), REFERENCE), 2):
        assert one["linestyle"] != other["linestyle"]


def test_hatches_are_lines_on_bars_alone():
    with drawing():
        drawn = figure(4.0, 2.0)
        [axes] = stacked(drawn, [(0.2, 1.4)], 0.5)
        bars = axes.barh([0, 1], [2.0, 3.0], left=1.0, height=0.5)
        hatch(axes, [bars[0]], "black")
        axes.set(xlim=(0.0, 10.0), ylim=(-1.0, 2.0))
        drawn.draw_without_rendering()
        [lines] = [line for line in axes.lines if line.get_gid() == "hatch"]
        clip = lines.get_clip_path().get_fully_transformed_path().get_extents()
        assert clip.extents == pytest.approx(bars[0].get_window_extent().extents)
        x = drawn.dpi * np.asarray(lines.get_xdata(), dtype=float)
        assert np.count_nonzero((x > clip.x0) & (x < clip.x1)) > 5
        assert "<pattern" not in svg(drawn)
