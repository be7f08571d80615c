"""A model's quantities of interest on one level, which can be added and subtracted.

Effects are differences of them, on the same pressure elements and the same field points. A largest
value is one of each asperity (`Problem.asperities`): effects may move the largest of all from one
to another, and the difference of two largest values at different places would measure neither."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from comparisons.figures.quantity import QUANTITIES
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.comparison import pair_norms
from comparisons.studies.contact import boundary_rise

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
    pressure: np.ndarray  # (n,) [Pa] at the nodes of the level's pressure elements
    tau1: np.ndarray | None  # (m, k) [Pa] at the window's sparse points, None without [stress]
    # of a model: x [m] of its largest values, undeformed, as `figures`
    places: dict[str, np.ndarray] = field(default_factory=dict)

    def __add__(self, other: QuantitiesOfInterest) -> QuantitiesOfInterest:
        return QuantitiesOfInterest(
            {name: value + other.figures[name] for name, value in self.figures.items()},
            self.pressure + other.pressure,
            None if self.tau1 is None else self.tau1 + other.tau1,
        )

    def __sub__(self, other: QuantitiesOfInterest) -> QuantitiesOfInterest:
        return QuantitiesOfInterest(
            {name: value - other.figures[name] for name, value in self.figures.items()},
            self.pressure - other.pressure,
            None if self.tau1 is None else self.tau1 - other.tau1,
        )

    def leading(self, name: str) -> int:
        """The asperity of the largest value that a figure belongs to; 0 where it is none."""
        return int(np.argmax(self.figures[LARGEST[name]])) if name in LARGEST else 0

    def largest(self) -> QuantitiesOfInterest:
        """The same with the leading asperity alone."""
        leading = {name: values[[self.leading(name)]] for name, values in self.figures.items()}
        return QuantitiesOfInterest(leading, self.pressure, self.tau1)


def quantities_of(level: Level, problem: Problem, friction: float) -> QuantitiesOfInterest:
    """Of a solved level; `problem` is the one that it solves."""
    level = level.under(friction)
    x = level.grid.x if level.material is None else level.material
    cell, pressure = np.searchsorted(problem.asperities, x), level.solution.pressure
    peaks = [
        mine[np.argmax(pressure[mine])] if len(mine := np.flatnonzero(cell == k)) else -1
        for k in range(len(problem.asperities) + 1)
    ]
    length = np.array([level.contact_length])
    figures = {
        "peak_pressure": pressure[peaks],
        "contact_length": length,
        "contact_ratio": length / (2.0 * problem.hertz.half_width),
    }
    places, stress = {"peak_pressure": x[peaks]}, level.stress(friction)
    if stress is not None:
        for name, key in (("tau1_max", "tau1"), ("txz_max_abs", "txz")):
            figures[name], places[name], depth = stress.of_asperities(key, problem.asperities)
            if name == "tau1_max":
                rise = boundary_rise(problem, level, places[name])
                figures["tau1_max_depth"] = depth + rise
    tau1 = None if stress is None else stress.sparse_tau1
    return QuantitiesOfInterest(figures, pressure, tau1, places)


def relative_sizes(
    difference: QuantitiesOfInterest,
    reference: QuantitiesOfInterest,
    problem: Problem,
    window: Window | None,
) -> dict[str, float]:
    """A difference relative to a reference, by quantity in the order of QUANTITIES. Figures keep
    their sign, largest values are those of the reference's leading asperity; norms are relative L2.
    What vanishes is measured by the Hertz contact."""
    values = {}
    for name, value in difference.figures.items():
        at = reference.leading(name)
        scale = abs(reference.figures[name][at]) or QUANTITIES[name].scale(problem.hertz)
        values[name] = float(value[at] / scale)
    moved = reference + difference
    pressures, tau1 = (moved.pressure, reference.pressure), (moved.tau1, reference.tau1)
    values |= pair_norms(pressures, tau1, problem, window)
    return {name: values[name] for name in QUANTITIES if name in values}
