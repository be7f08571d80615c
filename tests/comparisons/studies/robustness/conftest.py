"""Named cases of a module, run."""

from collections.abc import Callable
from types import ModuleType

import pytest

from comparisons.studies.checks import CheckedRow, run_case


@pytest.fixture
def row_of() -> Callable[[ModuleType, str], CheckedRow]:
    def run(module: ModuleType, name: str) -> CheckedRow:
        case = next(case for case in module.cases() if case.name == name)
        return run_case(case)

    return run
