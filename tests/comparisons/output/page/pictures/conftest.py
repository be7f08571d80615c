"""Contents of pictures, read from the figures before they become images."""

import pytest

from comparisons.judging.study import Run
from comparisons.output.page.page import PICTURES, drawn_of


@pytest.fixture(scope="session")
def wavy(wavy_outcome: Run, drawn_by) -> dict[str, list]:
    """Every figure of the rough run's report, by the function that drew it."""
    draws = [PICTURES[name] for name in drawn_of(wavy_outcome)]
    return {draw.__name__: drawn_by(draw, wavy_outcome)[0] for draw in draws}
