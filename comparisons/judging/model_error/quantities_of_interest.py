"""A model's quantities of interest on one level, which can be added and subtracted.

Effects are differences of them, on the same pressure elements. A largest value is one of each
asperity (`Problem.asperities`): effects may move the largest of all from one to another, and the
difference of two largest values at different places would measure neither."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from comparisons.figures.uncertainty import peak_resolution
from comparisons.judging.rule import boundary_rise
from comparisons.models.level import Level
from comparisons.models.problem import Problem

# By figure, the one whose largest value it is or belongs to.
LARGEST = {
    "peak_pressure": "peak_pressure",
    "tau1_max": "tau1_max",
    "tau1_max_depth": "tau1_max",
    "txz_max_abs": "txz_max_abs",
}


@dataclass(frozen=True)
class QuantitiesOfInterest:
    """Of one model at one friction coefficient, or a difference of such."""

    # by compared quantity, SI: (k,) one an asperity, (1,) where it is no largest value
    figures: dict[str, np.ndarray]
    # of a model: x [m] of its largest values, undeformed, as `figures`
    places: dict[str, np.ndarray] = field(default_factory=dict)
    # of a model: how finely its peak pressure is read from the nodes, relative
    peak_resolution: float = 0.0

    def __sub__(self, other: QuantitiesOfInterest) -> QuantitiesOfInterest:
        return QuantitiesOfInterest(
            {name: value - other.figures[name] for name, value in self.figures.items()}
        )

    def leading(self, name: str) -> int:
        """The asperity of the largest value that a figure belongs to; 0 where it is none."""
        return int(np.argmax(self.figures[LARGEST[name]])) if name in LARGEST else 0

    def largest(self) -> dict[str, float]:
        """The figures of the leading asperity alone."""
        return {name: float(values[self.leading(name)]) for name, values in self.figures.items()}


def quantities_of(level: Level, problem: Problem) -> QuantitiesOfInterest:
    """Of a solved level; `problem` is the one that it solves."""
    x = level.grid.x if level.material is None else level.material
    cell, pressure = np.searchsorted(problem.asperities, x), level.solution.pressure
    peaks = [
        mine[np.argmax(pressure[mine])] if len(mine := np.flatnonzero(cell == k)) else -1
        for k in range(len(problem.asperities) + 1)
    ]
    figures = {"peak_pressure": pressure[peaks], "contact_length": np.array([level.contact_length])}
    places = {"peak_pressure": x[peaks]}
    if (stress := level.stress) is not None:
        for name, key in (("tau1_max", "tau1"), ("txz_max_abs", "txz")):
            figures[name], places[name], depth = stress.maxima[key]
            if name == "tau1_max":
                rise = boundary_rise(problem, level, places[name])
                figures["tau1_max_depth"] = depth + rise
    return QuantitiesOfInterest(figures, places, peak_resolution(pressure))
