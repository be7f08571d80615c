"""What pictures draw, read from the figures before they become images."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from matplotlib import pyplot
from scenes import posed

from comparisons.drawing.style import collected_figures
from comparisons.output.page.page import PICTURES, drawn_of
from comparisons.studies.study import Run


def drawn(draw: Callable, outcome: Run) -> tuple[list, object]:
    """The figures that a function draws of a run, and what it returns."""
    with collected_figures() as figures:
        made = draw(outcome)
        for figure in figures:
            figure.draw_without_rendering()
    for figure in figures:
        pyplot.close(figure)
    return figures, made


@pytest.fixture(scope="session")
def drawn_by() -> Callable:
    return drawn


@pytest.fixture(scope="session")
def wavy(wavy_outcome: Run) -> dict[str, list]:
    """Every figure of the rough run's report, by the function that drew it."""
    draws = [PICTURES[name] for name in drawn_of(wavy_outcome)]
    return {draw.__name__: drawn(draw, wavy_outcome)[0] for draw in draws}


@pytest.fixture(scope="session")
def with_scene() -> Callable[..., Run]:
    """`with_scene(outcome, fields)`: a run that says so of its scene."""

    def changed(outcome: Run, fields: dict[str, object]) -> Run:
        scene = outcome.problem.scene.unchecked(fields)
        return posed(outcome, problem=replace(outcome.problem, scene=scene))

    return changed
