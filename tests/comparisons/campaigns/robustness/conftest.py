"""Rows of `stability`, run by their module and name."""

from collections.abc import Callable
from types import ModuleType

import pytest

from comparisons.campaigns.cases import Row, carried_out
from comparisons.campaigns.robustness.run import all_cases


@pytest.fixture
def row_of() -> Callable[[ModuleType, str], Row]:
    def run(module: ModuleType, name: str) -> Row:
        functions = vars(module).values()
        cases = (case for case in all_cases() if case.solve.func in functions)
        return carried_out(next(case for case in cases if case.name == name))

    return run
