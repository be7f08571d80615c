"""Named cases of a module, run."""

from collections.abc import Callable
from types import ModuleType

import pytest

from comparisons.studies.checks import CheckedRow, named_cases, run_case


@pytest.fixture
def row_of() -> Callable[[ModuleType, str], CheckedRow]:
    def run(module: ModuleType, name: str) -> CheckedRow:
        case = next(c for c in named_cases("any", module.cases()) if c.name == name)
        return run_case(case)

    return run
