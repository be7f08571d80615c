"""What pictures draw, read from the figures before they become images."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from scenes import posed

from comparisons.output.page.page import PICTURES, drawn_of
from comparisons.studies.study import Run


@pytest.fixture(scope="session")
def wavy(wavy_outcome: Run, drawn_by) -> dict[str, list]:
    """Every figure of the rough run's report, by the function that drew it."""
    draws = [PICTURES[name] for name in drawn_of(wavy_outcome)]
    return {draw.__name__: drawn_by(draw, wavy_outcome)[0] for draw in draws}


@pytest.fixture(scope="session")
def with_scene() -> Callable[..., Run]:
    """`with_scene(outcome, fields)`: a run that says so of its scene."""

    def changed(outcome: Run, fields: dict[str, object]) -> Run:
        scene = outcome.problem.scene.unchecked(fields)
        return posed(outcome, problem=replace(outcome.problem, scene=scene))

    return changed
