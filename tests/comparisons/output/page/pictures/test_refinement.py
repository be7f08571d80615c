"""The pictures of convergence: distances, slopes and stated uncertainties are those of the run."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import judging, posed

from comparisons.output.page.pictures.refinement import convergence_picture
from comparisons.output.page.tables.verification import judged_sequences
from comparisons.studies import contact
from comparisons.studies.study import Run


def shown(axes) -> str:
    return axes.get_title(loc="left").replace("\n", " ")


def moving(outcome: Run) -> list:
    """Judged sequences but those that the hardness holds on every level."""
    moved = [e for e in judged_sequences(outcome) if e.known.behaviour != "settled"]
    assert len(moved) >= 2
    return moved


@pytest.fixture(scope="module")
def panels(wavy_outcome: Run, drawn_by) -> list:
    [figure], _ = drawn_by(convergence_picture, wavy_outcome)
    return figure.axes


def test_every_judged_figure_has_a_panel_with_both_models(wavy_outcome: Run, panels):
    sequences = judged_sequences(wavy_outcome)
    names = [shown(axes) for axes in panels]
    assert names == list(dict.fromkeys(sequence.name for sequence in sequences))
    assert len(sequences) == 3 * len(names) >= 6  # both models and their difference
    for sequence in moving(wavy_outcome):
        axes = panels[names.index(sequence.name)]
        assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
        limit = sequence.known.limit
        scale = 1.0 if sequence.source == "difference" else abs(sequence.figure.levels[-1])
        wanted = [100.0 * abs(value - limit) / scale for value in sequence.figure.levels]
        drawn = [line.get_ydata() for line in axes.lines if len(line.get_ydata()) == len(wanted)]
        assert any(np.allclose(y, wanted, rtol=1e-9) for y in drawn), sequence.name


def test_the_dotted_slope_is_that_of_the_formal_order(wavy_outcome: Run, panels):
    orders = {e.name: e.known.formal_order for e in moving(wavy_outcome)}
    for axes in panels:
        if shown(axes) not in orders:
            continue
        order = orders[shown(axes)]
        [line] = [line for line in axes.lines if str(line.get_label()).startswith("slope")]
        x, y = np.log(line.get_xdata()), np.log(line.get_ydata())
        assert (y[1] - y[0]) / (x[1] - x[0]) == pytest.approx(order)
        assert line.get_label() == f"slope of order {order:g}"


def test_the_bar_is_the_stated_uncertainty(wavy_outcome: Run, panels):
    for axes in panels:
        stated = [
            100.0 * sequence.figure.uncertainty.parts["discretisation"]
            for sequence in moving(wavy_outcome)
            if sequence.name == shown(axes)
        ]
        bars = [float(line.get_ydata()[0]) for line in axes.lines if line.get_marker() == "_"]
        assert bars == pytest.approx(stated)


def test_the_difference_is_seen_around_the_models_lines(panels):
    for axes in panels:
        [behind] = [v for v in axes.lines if v.get_label() == "difference of both models"]
        models = [v for v in axes.lines if v.get_label() in ("half-plane", "finite elements")]
        assert behind.get_zorder() < min(line.get_zorder() for line in models)
        assert behind.get_linewidth() > 2.0 * max(line.get_linewidth() for line in models)


def test_nothing_judged_is_no_picture(wavy_outcome: Run, drawn_by):
    scene = judging(wavy_outcome.problem.scene, {})
    problem = replace(wavy_outcome.problem, scene=scene)
    figures, picture = drawn_by(convergence_picture, posed(wavy_outcome, problem=problem))
    assert figures == [] and picture is None


def test_levels_that_are_equal_are_said_to_be(smooth_outcome: Run, drawn_by):
    runs = {
        name: replace(run, levels=(run.finest,) * 3) for name, run in smooth_outcome.runs.items()
    }
    solved = replace(smooth_outcome.solved, runs=runs)
    alone = {"contact": contact.solve(solved, {}, None)}  # of each model
    settled = replace(smooth_outcome, solved=solved, findings=alone)
    [figure], picture = drawn_by(convergence_picture, settled)
    words = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert "no change but rounding" in words and "settled" in picture.alternative
