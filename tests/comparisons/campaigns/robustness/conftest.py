"""Rows of `stability`, run by their module and name."""

from collections.abc import Callable
from types import ModuleType

import pytest

from comparisons.campaigns.checks import CheckedRow, run_case
from comparisons.campaigns.robustness.run import all_cases


@pytest.fixture
def row_of() -> Callable[[ModuleType, str], CheckedRow]:
    def run(module: ModuleType, name: str) -> CheckedRow:
        functions = vars(module).values()
        cases = (case for case in all_cases() if case.solve.func in functions)
        return run_case(next(case for case in cases if case.name == name))

    return run
