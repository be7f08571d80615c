"""What a reader meets in the pictures and tables: words apart, signs in grey, nothing unnamed."""

from dataclasses import replace
from itertools import combinations

import matplotlib
import numpy as np
import pytest
from matplotlib.transforms import Bbox

from analytic.material import Material
from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.report.figures import pressures as pressure_pictures
from comparisons.report.figures import problem as problem_picture
from comparisons.report.figures.fields import colour_bar, fill, layout, round_bands
from comparisons.report.figures.model_error import PART_LOOKS
from comparisons.report.figures.style import drawing
from comparisons.report.headline import headline
from comparisons.report.tables.model_error import effects_table
from comparisons.report.tables.problem import problem_sheet
from comparisons.report.tables.verification import convergence_tables, refinement_text
from comparisons.results.outcome import Outcome
from comparisons.scenes.scene import Coated, Yielding

HARD = Coated(Material(400e9, 0.22), 20e-6)
GREY = np.array([0.299, 0.587, 0.114])  # of red, green and blue, as a printer sees them


def with_scene(outcome: Outcome, **changed) -> Outcome:
    scene = replace(outcome.problem.scene, **changed)
    return replace(outcome, problem=replace(outcome.problem, scene=scene))


@pytest.fixture(scope="module")
def drawn_by(monkeypatch_module: pytest.MonkeyPatch):
    """`drawn_by(module, call)`: the figure that a picture was made of, and the picture."""

    def drawn(module, call):
        figures = []
        monkeypatch_module.setattr(module, "data_uri", lambda figure: figures.append(figure) or "")
        with drawing():
            picture = call()
            for figure in figures:
                figure.draw_without_rendering()
        return figures[-1], picture

    return drawn


@pytest.fixture(scope="module")
def monkeypatch_module():
    with pytest.MonkeyPatch.context() as patch:
        yield patch


def rows_of(outcome: Outcome) -> dict[str, str]:
    return {name: text for _, rows in problem_sheet(outcome) for name, text in rows}


def test_a_coating_and_a_yield_stress_are_told(smooth_outcome: Outcome, drawn_by):
    changed = {"coating": HARD, "yielding": Yielding(1e9, 20e9)}
    scene = with_scene(smooth_outcome, **changed)
    rows = rows_of(scene)
    assert rows["coating"] == "20 µm thick, E = 400 GPa, ν = 0.22"
    assert rows["body yields"] == "at 1 GPa, hardening by 20 GPa"
    assert not {"coating", "body yields"} & set(rows_of(smooth_outcome))
    for one in changed.items():
        outcome = with_scene(smooth_outcome, **dict([one]))
        figure, picture = drawn_by(
            problem_picture, lambda o=outcome: problem_picture.problem_picture(o)
        )
        words = " ".join(text.get_text() for text in figure.axes[0].texts)
        for said in (words, picture.alternative):
            assert ("coating 20 µm thick" in said) == (one[0] == "coating")
            assert ("yields at 1 GPa" in said) == (one[0] == "yielding")


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
def test_words_in_the_drawing_stand_apart(wavy_outcome: Outcome, drawn_by, friction, thickness):
    base = None if thickness is None else "frictionless"
    outcome = with_scene(
        wavy_outcome, coating=HARD, friction=friction, thickness=thickness, base=base
    )
    figure, _ = drawn_by(problem_picture, lambda: problem_picture.problem_picture(outcome))
    axes = figure.axes[0]
    texts = [text for text in axes.texts if text.get_text()]
    assert len(texts) == 4  # load, roller, body, traction
    boxes = [line for text in texts for line in lines_of(text)]
    for one, other in combinations(boxes, 2):
        assert not one.overlaps(other)
    for box in boxes:
        assert axes.bbox.x0 <= box.x0 and box.x1 <= axes.bbox.x1 + 1.0
        assert axes.bbox.y0 <= box.y0


def test_numbers_along_the_top_are_whole_and_clear_of_the_axis_name(wavy_outcome, drawn_by):
    for draw in (pressure_pictures.pressure_picture, pressure_pictures.close_up_picture):
        figure, _ = drawn_by(pressure_pictures, lambda call=draw: call(wavy_outcome))
        [top] = figure.axes[0].child_axes
        [name] = [text for text in figure.axes[0].texts if text.get_text() == "x/a"]
        labels = [text for text in top.get_xticklabels() if text.get_text()]
        assert 3 <= len(labels) <= pressure_pictures.TICKS + 1
        for label in labels:
            box = label.get_window_extent()
            assert figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1
            assert not box.overlaps(name.get_window_extent())


def test_parts_of_the_budget_are_told_apart_in_grey():
    assert set(EFFECTS) <= set(PART_LOOKS)
    greys = {
        name: float(np.dot(matplotlib.colors.to_rgb(colour), GREY))
        for name, (colour, _) in PART_LOOKS.items()
    }
    for one, other in combinations(PART_LOOKS, 2):
        hatched_alike = PART_LOOKS[one][1] == PART_LOOKS[other][1]
        assert not hatched_alike or abs(greys[one] - greys[other]) > 0.1, (one, other)


def test_what_is_negative_is_striped_and_nothing_else():
    x, z = np.linspace(-1.5, 1.5, 61), np.linspace(0.0, 1.0, 30)
    values = x + 0.0 * z[:, None]
    bands = round_bands([values], signed=True)
    with drawing():
        figure, [axes], [bar] = layout(1, 1.5)
        shown = fill(axes, x, z, values, bands, "RdBu_r", True)
        colour_bar(figure, bar, shown, "τxz/p₀", bands)
    pixels, shade = (np.asarray(image.get_array()) for image in axes.images)
    struck = shade[..., 3] > 0.0
    negative = pixels < bands[bands < 0.0][-1]
    assert not np.any(struck & ~negative)
    assert 0.2 < np.mean(struck[negative]) < 0.4
    [span] = [patch for patch in bar.patches if patch.get_hatch()]
    ends = span.get_path().vertices[:, 0] if span.get_path() else ()
    assert max(ends) <= 1.0
    with drawing():
        _, [axes], _ = layout(1, 1.5)
        fill(axes, x, z, np.abs(values), np.linspace(0.0, 1.5, 16), "viridis", False)
    assert len(axes.images) == 1


def test_no_column_is_unnamed_or_empty(wavy_outcome: Outcome, smooth_outcome: Outcome):
    for outcome in (wavy_outcome, smooth_outcome):
        for table in [*convergence_tables(outcome), effects_table(outcome)]:
            for number, head in enumerate(table.head):
                assert head or number == 0
                assert any(row[number] for row in table.rows), (table.title, head)
            assert {len(row) for row in table.rows} == {len(table.head)}


def test_why_refinement_ended_is_said_in_words(smooth_outcome: Outcome):
    text = (
        "tau1_max, tau1_max_depth not resolved to a third of the tolerance: 6 levels are the most"
    )
    outcome = replace(smooth_outcome, result={**smooth_outcome.result, "refinement": text})
    assert refinement_text(outcome) == (
        "largest principal shear stress τ₁, depth of the largest τ₁ not resolved to a third of the "
        "tolerance: 6 levels are the most"
    )


def test_a_level_that_did_not_converge_is_named_in_few_digits(smooth_outcome: Outcome):
    run = smooth_outcome.runs["finite_element"]
    solution = replace(run.finest.solution, converged=False)
    levels = (*run.levels[:-1], replace(run.finest, solution=solution))
    runs = {**smooth_outcome.runs, "finite_element": replace(run, levels=levels)}
    said = headline(replace(smooth_outcome, runs=runs))
    assert said.kind == "not converged"
    pitch = f"{1e6 * run.finest.grid.pitch:#.3g}".rstrip(".")
    assert f"(finite elements, pressure elements of {pitch} µm)" in said.sentence
