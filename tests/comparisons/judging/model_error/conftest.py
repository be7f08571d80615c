"""Scenes that budgets are made for."""

from collections.abc import Callable

import pytest
from scenes import STEEL_PAIR, changed, problem

from comparisons.models.problem import Problem

BASE = STEEL_PAIR | {"load": {"hertz_peak_pressure": 2e9}}


@pytest.fixture(scope="session")
def problem_with() -> Callable[..., Problem]:
    """`problem_with(body={…}, load={…}, …)`: smooth steel bodies, with other or further tables."""

    def made(**tables: dict) -> Problem:
        merged = changed(BASE, **tables)
        if merged["roller"].get("rigid"):
            merged["roller"] = {"radius": merged["roller"]["radius"], "rigid": True}
        return problem(merged)

    return made
