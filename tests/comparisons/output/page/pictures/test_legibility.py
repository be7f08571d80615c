"""Legibility of the pictures: words apart, parts that differ in grey."""

from itertools import combinations

import pytest
from matplotlib.transforms import Bbox
from scenes import with_fields

from comparisons.output.page.pictures.answer import judged_picture
from comparisons.output.page.pictures.problem import problem_picture
from comparisons.scenes.sections import CoatingSection

SEEN = 358.0 / 440.0  # of a narrow picture on 390 pixels, before anything is moved
HARD = CoatingSection(thickness=20e-6, youngs_modulus=400e9, poissons_ratio=0.22)


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
def test_words_in_the_drawing_stand_apart(wavy_outcome, drawn_by, friction, thickness):
    fields = {"coating": HARD, "load.friction": friction, "body.thickness": thickness}
    fields["body.base"] = None if thickness is None else "frictionless"
    [figure], _ = drawn_by(problem_picture, with_fields(wavy_outcome, fields))
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


def test_names_of_lines_stand_inside_the_frame_and_words_of_bars_on_a_telephone(wavy):
    for name in ("overview_picture", "pressure_picture", "close_up_picture"):
        axes = wavy[name][0].axes[0]
        frame, names = axes.bbox, axes.get_legend().get_window_extent()
        assert frame.x0 < names.x0 and names.x1 < frame.x1 and names.y1 < frame.y1
    [judged] = wavy["judged_picture"]
    for text in judged.axes[0].texts:
        assert text.get_window_extent().x1 < SEEN * judged.bbox.width


def test_the_name_of_a_bar_and_its_error_stand_apart(wavy_outcome, drawn_by):
    """Where several friction coefficients make the names long."""
    outcome = with_fields(wavy_outcome, {"load.friction": (0.05, 0.125)})
    [figure], _ = drawn_by(judged_picture, outcome)
    texts = [text for text in figure.axes[0].texts if text.get_text()]
    assert len(texts) == 2 * len(outcome.model_errors)
    for one, other in combinations(texts, 2):
        assert not one.get_window_extent().overlaps(other.get_window_extent())
