"""Scenes that budgets are made for, and model variants without finite elements."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from scenes import STEEL, changed, problem

from comparisons.assessment.effects.quantities_of_interest import QuantitiesOfInterest
from comparisons.assessment.effects.variants import ModelVariant
from comparisons.models.problem import Problem

BASE = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 2e9},
}


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
    """Solutions drawn at random, the same whenever the same variant is asked for."""

    own: ModelVariant
    asked: list[ModelVariant] = field(default_factory=list)

    def solution(self, variant: ModelVariant, number: int, friction: float) -> QuantitiesOfInterest:
        self.asked.append(variant)
        seed = abs(
            hash((tuple(sorted(variant.effects)), variant.friction, variant.stand_in, number))
        )
        rng = np.random.default_rng(seed)
        figures = {"peak_pressure": rng.normal(), "contact_length": rng.normal()}
        return QuantitiesOfInterest(figures, rng.normal(size=5), rng.normal(size=(2, 3)))

    def scene_solution(self, number: int, friction: float) -> QuantitiesOfInterest:
        return self.solution(self.own, number, friction)


@pytest.fixture
def made_solutions() -> type[MadeSolutions]:
    return MadeSolutions
