"""The pictures of convergence: distances, slopes and stated uncertainties are those of the run."""

import numpy as np
import pytest

from comparisons.judging.study import Run
from comparisons.output.page.pictures.refinement import convergence_picture, judged_figures


def shown(axes) -> str:
    return axes.get_title(loc="left").replace("\n", " ")


def moving(outcome: Run) -> list:
    """Judged figures by their panels, but those that the hardness holds on every level."""
    known = ((name, figure) for name, of in judged_figures(outcome).items() for figure in of)
    moved = [one for one in known if one[1].uncertainty.convergence.behaviour != "settled"]
    assert len(moved) >= 2
    return moved


@pytest.fixture(scope="module")
def panels(wavy_outcome: Run, drawn_by) -> list:
    [figure], _ = drawn_by(convergence_picture, wavy_outcome)
    return figure.axes


def test_every_judged_figure_has_a_panel_with_both_models(wavy_outcome: Run, panels):
    figures = judged_figures(wavy_outcome)
    names = [shown(axes) for axes in panels]
    assert names == list(figures) and len(names) >= 2
    assert {len(of) for of in figures.values()} == {3}  # both models and their difference
    for name, figure in moving(wavy_outcome):
        axes = panels[names.index(name)]
        assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
        limit = figure.uncertainty.convergence.limit
        scale = 1.0 if figure.against else abs(figure.levels[-1])
        wanted = [100.0 * abs(value - limit) / scale for value in figure.levels]
        drawn = [line.get_ydata() for line in axes.lines if len(line.get_ydata()) == len(wanted)]
        assert any(np.allclose(y, wanted, rtol=1e-9) for y in drawn), name


def test_the_bar_is_the_stated_uncertainty(wavy_outcome: Run, panels):
    for axes in panels:
        stated = [
            100.0 * figure.uncertainty.parts["discretisation"]
            for name, figure in moving(wavy_outcome)
            if name == shown(axes)
        ]
        bars = [float(line.get_ydata()[0]) for line in axes.lines if line.get_marker() == "_"]
        assert bars == pytest.approx(stated)
