"""Scenes that budgets are made for, and model variants without finite elements."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from scenes import STEEL_PAIR, changed, problem

from comparisons.judging.model_error.refinement import NotComputedError
from comparisons.judging.rule import QuantitiesOfInterest
from comparisons.models.model import Model
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


@dataclass
class MadeSolutions:
    """Solutions drawn at random, the same whenever a variant of the same name is asked for.

    without  names of variants that have no solution
    """

    of_scene: str
    without: tuple[str, ...] = ()
    asked: list[str] = field(default_factory=list)

    def __call__(self, variant: Model | None) -> QuantitiesOfInterest:
        name = self.of_scene if variant is None else variant.name
        self.asked.append(name)
        if name in self.without:
            raise NotComputedError("no mesh")
        rng = np.random.default_rng(abs(hash(name)))
        figures = {"peak_pressure": rng.normal(size=3), "contact_length": rng.normal(size=1)}
        return QuantitiesOfInterest(figures)


@pytest.fixture
def made_solutions() -> type[MadeSolutions]:
    return MadeSolutions
