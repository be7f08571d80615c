"""A model's quantities of interest on one level, which can be added and subtracted.

Effects are differences of them, on the same pressure elements and the same field points.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from comparisons.assessment.comparison import figures, pair_norms
from comparisons.common.quantities import QUANTITIES
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import Window


@dataclass(frozen=True)
class QuantitiesOfInterest:
    """Of one model at one friction coefficient, or a difference of such.

    figures    by compared quantity, SI
    pressure   (n,) [Pa] at the nodes of the level's pressure elements
    tau1       (m, k) [Pa] on the common window, None without [stress]
    """

    figures: dict[str, float]
    pressure: np.ndarray
    tau1: np.ndarray | None

    def __add__(self, other: QuantitiesOfInterest) -> QuantitiesOfInterest:
        return QuantitiesOfInterest(
            {name: value + other.figures[name] for name, value in self.figures.items()},
            self.pressure + other.pressure,
            None if self.tau1 is None else self.tau1 + other.tau1,
        )

    def __mul__(self, factor: float) -> QuantitiesOfInterest:
        return QuantitiesOfInterest(
            {name: factor * value for name, value in self.figures.items()},
            factor * self.pressure,
            None if self.tau1 is None else factor * self.tau1,
        )

    def __sub__(self, other: QuantitiesOfInterest) -> QuantitiesOfInterest:
        return self + other * -1.0


def quantities_of(level: Level, problem: Problem, friction: float) -> QuantitiesOfInterest:
    """Of a solved level; `problem` is the one that it solves."""
    stress = level.stress(friction)
    return QuantitiesOfInterest(
        figures(level, problem, friction),
        level.solution.pressure,
        None if stress is None else stress.field.tau1,
    )


def relative_sizes(
    difference: QuantitiesOfInterest,
    reference: QuantitiesOfInterest,
    problem: Problem,
    window: Window | None,
) -> dict[str, float]:
    """A difference relative to a reference, by quantity in the order of QUANTITIES.

    Figures keep their sign; norms are relative L2. What vanishes is measured by the Hertz contact.
    """
    found = {
        name: value / (abs(reference.figures[name]) or QUANTITIES[name].scale(problem.hertz))
        for name, value in difference.figures.items()
    }
    moved = reference + difference
    pressures, tau1 = (moved.pressure, reference.pressure), (moved.tau1, reference.tau1)
    found |= pair_norms(pressures, tau1, problem, window)
    return {name: found[name] for name in QUANTITIES if name in found}
