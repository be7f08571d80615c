"""What pictures draw, read from the figures before they become images."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from matplotlib import pyplot
from scenes import posed

from comparisons.drawing.style import collected_figures
from comparisons.output.page.pictures.answer import judged_picture, overview_picture
from comparisons.output.page.pictures.contact import (
    close_up_picture,
    pressure_picture,
    surface_picture,
)
from comparisons.output.page.pictures.mesh import mesh_pictures
from comparisons.output.page.pictures.problem import problem_picture
from comparisons.output.page.pictures.refinement import convergence_picture
from comparisons.output.page.pictures.stresses import (
    field_pictures,
    near_surface_pictures,
    section_pictures,
)
from comparisons.studies.ladder import cost
from comparisons.studies.model_error.show import model_error_picture
from comparisons.studies.study import Run

DRAWN = (
    overview_picture,
    judged_picture,
    model_error_picture,
    convergence_picture,
    problem_picture,
    pressure_picture,
    close_up_picture,
    surface_picture,
    field_pictures,
    near_surface_pictures,
    section_pictures,
    mesh_pictures,
    cost.picture,
)


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
    return {draw.__name__: drawn(draw, wavy_outcome)[0] for draw in DRAWN}


@pytest.fixture(scope="session")
def with_scene() -> Callable[..., Run]:
    """`with_scene(outcome, fields)`: a run that says so of its scene."""

    def changed(outcome: Run, fields: dict[str, object]) -> Run:
        scene = outcome.problem.scene.unchecked(fields)
        return posed(outcome, problem=replace(outcome.problem, scene=scene))

    return changed
