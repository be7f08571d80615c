"""One level of one model on one surface, in units of the smooth contact, and numbers read off it.

Symbols: a, p0 half-width and peak pressure of the smooth (Hertz) contact under the same load.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from analytic.exact.hertz import hertz_stress
from analytic.stress_state import Extremum, StressState
from comparisons.assessment.comparison import PRESSURE_PER_RESIDUAL
from comparisons.assessment.uncertainty import DOMAIN, grid_convergence
from comparisons.common.quantities import layer_thickness
from comparisons.models.level import Level, Window
from comparisons.models.problem import Problem
from comparisons.results.outcome import Outcome

ORDER = 1.0  # formal, of what is read: with it a regular sequence gets the widest margin


@dataclass(frozen=True)
class View:
    """What a number is read off: lengths in a, stresses in p0.

    model  half_plane | finite_element
    every  n-th row and column of the window is read, x = 0 among them
    """

    model: str
    problem: Problem
    level: Level
    window: Window
    every: int = 1

    @property
    def columns(self) -> slice:
        return slice((len(self.window.x) // 2) % self.every, None, self.every)

    @property
    def rows(self) -> slice:
        return slice(None, None, self.every)

    @property
    def x(self) -> np.ndarray:
        """(k,) x/a of the window's columns."""
        return self.window.x[self.columns] / self.problem.hertz.half_width

    @property
    def z(self) -> np.ndarray:
        """(m,) z/a of the window's rows."""
        return self.window.z[self.rows] / self.problem.hertz.half_width

    @property
    def weights(self) -> np.ndarray:
        """(m, 1) depth [a] that each row stands for."""
        return layer_thickness(self.z)[:, None]

    @property
    def smooth_maximum(self) -> float:
        """Largest tau1 of the smooth contact without friction [p0]."""
        return self.problem.hertz.tau1_max / self.problem.hertz.peak_pressure

    def stress(self, friction: float) -> StressState:
        """(m, k) on the window [p0]."""
        field, p0 = self.level.stress(friction).field, self.problem.hertz.peak_pressure
        parts = (field.sx, field.sz, field.txz)
        return StressState(*(part[self.rows, self.columns] / p0 for part in parts))

    def smooth(self, friction: float) -> StressState:
        """(m, k) of the smooth contact, exact [p0]."""
        hertz = self.problem.hertz
        x, z = self.window.x[self.columns], self.window.z[self.rows, None]
        exact = hertz_stress(hertz, x, z, friction)
        return StressState(
            *(part / hertz.peak_pressure for part in (exact.sx, exact.sz, exact.txz))
        )

    def extreme(self, name: str, friction: float) -> Extremum:
        """Largest tau1 | |txz|, found off the grid: value [p0], x and z [a]."""
        found, hertz = self.level.stress(friction).extremes[name], self.problem.hertz
        a = hertz.half_width
        return Extremum(abs(found.value) / hertz.peak_pressure, found.x / a, found.z / a)


Reading = Callable[[View], float]


@dataclass(frozen=True)
class Measured:
    """A number of one model with what numerical error may account for, both in its unit.

    uncertainty  0 where the number is itself an error against an exact value; infinite where
                 fewer than three levels are known
    converged    all levels met their contact conditions
    """

    value: float
    uncertainty: float
    converged: bool = True


def measured(outcome: Outcome, model: str, reading: Reading, exact: bool = False) -> Measured:
    """A number on the finest level of a model, with its uncertainty from all levels.

    Discretisation, far boundary and iteration as for a run's figures; besides, what reading only
    every second row and column of the window changes.
    exact  the number is an error against an exact value: it has no uncertainty of its own
    """
    run = outcome.runs[model]
    views = [View(model, outcome.problem, level, outcome.window) for level in run.levels]
    values = [reading(view) for view in views]
    value = values[-1]
    converged = all(level.solution.converged for level in run.levels)
    if exact:
        return Measured(value, 0.0, converged)
    uncertainty = grid_convergence(values, ORDER).uncertainty
    uncertainty += PRESSURE_PER_RESIDUAL * run.finest.solution.residuals.worst * abs(value)
    uncertainty += abs(reading(replace(views[-1], every=2)) - value)
    if run.far_boundary_check is not None:
        check = View(model, outcome.problem, run.far_boundary_check, outcome.window)
        uncertainty += DOMAIN * abs(reading(check) - values[0])
    return Measured(value, float(uncertainty), converged)
