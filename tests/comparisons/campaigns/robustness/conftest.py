"""Rows of `stability`, carried out by their model and name."""

from collections.abc import Callable

import pytest

from comparisons.campaigns.cases import Row, carried_out
from comparisons.campaigns.robustness import all_cases


@pytest.fixture
def row_of() -> Callable[[str, str], Row]:
    def row(model: str, name: str) -> Row:
        named = (case for case in all_cases() if (case.model, case.name) == (model, name))
        return carried_out(next(named))

    return row
