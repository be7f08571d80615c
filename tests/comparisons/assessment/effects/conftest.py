"""Scenes that budgets are made for, and bodies without finite elements."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from comparisons.assessment.effects.quantities_of_interest import QuantitiesOfInterest
from comparisons.assessment.effects.variants import Body
from comparisons.models.problem import Problem, problem_of
from comparisons.scenes.resolve import resolve_tables

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
SMOOTH = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 2e9},
}


def scene_from(tables: dict):
    return resolve_tables(tables, name="made", folder=Path("."), source="made.toml")


@pytest.fixture(scope="session")
def problem_with() -> Callable[..., Problem]:
    """`problem_with(body={…}, load={…}, …)`: smooth steel bodies, with other or further tables."""

    def made(**tables: dict) -> Problem:
        merged = {
            name: {**SMOOTH.get(name, {}), **tables.get(name, {})} for name in SMOOTH | tables
        }
        if merged["roller"].get("rigid"):
            merged["roller"] = {"radius": merged["roller"]["radius"], "rigid": True}
        return problem_of(scene_from(merged))

    return made


@dataclass
class MadeBodies:
    """Answers that are drawn at random, the same whenever the same body is asked for."""

    own: Body
    asked: list[Body] = field(default_factory=list)

    def answer(self, body: Body, number: int, friction: float) -> QuantitiesOfInterest:
        self.asked.append(body)
        seed = abs(hash((tuple(sorted(body.effects)), body.friction, body.stand_in, number)))
        rng = np.random.default_rng(seed)
        figures = {"peak_pressure": rng.normal(), "contact_length": rng.normal()}
        return QuantitiesOfInterest(figures, rng.normal(size=5), rng.normal(size=(2, 3)))

    def own_answer(self, number: int, friction: float) -> QuantitiesOfInterest:
        return self.answer(self.own, number, friction)


@pytest.fixture
def made_bodies() -> type[MadeBodies]:
    return MadeBodies
