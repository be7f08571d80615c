"""Extreme scenes, given as tables as a file would, solved by finite elements on one level."""

from functools import lru_cache
from pathlib import Path
from typing import Any

from comparisons.common.progress import Stages
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.level import Level
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import window_of
from comparisons.scenes.resolve import resolve_tables

Tables = dict[str, dict[str, Any]]

STEEL = {"youngs_modulus": 207e9, "poissons_ratio": 0.3}
RIGID = {"radius": 8e-3, "rigid": True}
LOAD = {"per_length": 1e6}
ORDINARY: Tables = {"roller": RIGID, "body": STEEL, "load": LOAD}


def problem_from(tables: Tables) -> Problem:
    """The problem of a scene given as tables."""
    scene = resolve_tables(tables, name="stability", folder=Path("."), source="stability")
    return problem_of(scene)


def finite_level(problem: Problem, refinement: int = 0) -> Level:
    """The finite elements on the coarsest level, or one of `refinement` levels finer."""
    plan = make_plan(problem, ("finite_element",))
    pitch = problem.pitches[0] / 2.0**refinement
    window = None if problem.scene.stress is None else window_of(problem)
    return finite_element_level(problem, plan, Refinement(pitch), window, Stages())


@lru_cache
def ordinary_level() -> tuple[Problem, Level]:
    """A rigid roller on steel: what the others are compared with in steps."""
    problem = problem_from(ORDINARY)
    return problem, finite_level(problem)
