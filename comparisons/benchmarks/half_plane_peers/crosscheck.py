"""This project's solver under comparison.

Strips are what the peers' points are nearest to: one pressure a cell, the contact conditions at its
middle. Hats, which the rest of the project uses, bound the stresses at every element's edge, and
are shown beside them.
"""

from functools import cache
from typing import Literal

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.periodic import PeriodicHalfPlane
from comparisons.benchmarks.half_plane_peers.cases import Case
from comparisons.benchmarks.half_plane_peers.code import Answer, Code, decades

Element = Literal["strip", "hat"]


def codes() -> list[Code]:
    """Ours with strips, then with hats."""
    return [
        Code(
            f"crosscheck, {element}s",
            element,
            lambda case, tolerance, _, element=element: _solved(case, tolerance, element),
            decades(-7, -12),
        )
        for element in ("strip", "hat")
    ]


@cache
def _operator(periodic: bool, count: int, pitch: float, element: Element) -> ModelOperator:
    kind = PeriodicHalfPlane if periodic else HalfPlane
    return kind(count, pitch, 1.0, element=element)


def _solved(case: Case, tolerance: float, element: Element) -> Answer:
    operator = _operator(case.periodic, case.count, case.pitch, element)
    gap = case.averages if element == "hat" else case.gaps
    weights = np.full(case.count, case.pitch)
    constraints = Constraints(load=case.load)
    solution = solve_contact(operator, case.pitch * gap, weights, constraints, tolerance=tolerance)
    return Answer(solution.pressure, solution.iterations["applications"])
