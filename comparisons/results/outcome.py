"""What a finished run holds: everything that its files, table and report are made of."""

from dataclasses import dataclass
from pathlib import Path

from comparisons.assessment.comparison import PairHistory
from comparisons.assessment.effects.error_budget import ErrorBudget
from comparisons.assessment.normal_tangential_coupling import Coupling
from comparisons.assessment.verdict import Comparison
from comparisons.common.errors import ExitStatus
from comparisons.models.level import ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window


@dataclass(frozen=True)
class Outcome:
    """A finished run.

    runs         by model name, half_plane and/or finite_element
    window       points of the common field, None without [stress]
    comparisons  in the order of friction coefficients, then of quantities; empty for one model
    result       the content of result.json
    record       the content of record.json
    directory    where the files are, None for a run without files
    couplings    what friction changes on the half-plane by moving the surfaces, one a friction
                 coefficient; empty where it moves nothing
    budget       of the difference, None for one model
    pairs        the norms of the difference on all levels, one a friction coefficient; empty for
                 one model
    """

    problem: Problem
    plan: Plan
    window: Window | None
    runs: dict[str, ModelRun]
    comparisons: tuple[Comparison, ...]
    result: dict
    record: dict
    directory: Path | None
    couplings: tuple[Coupling, ...] = ()
    budget: ErrorBudget | None = None
    pairs: tuple[PairHistory, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether every level of every model met its contact conditions, and running-in did."""
        run_in = self.problem.scene.run_in
        solutions = [level.solution for run in self.runs.values() for level in run.levels]
        solutions += self.couplings if run_in is None else (*self.couplings, run_in)
        return all(each.converged for each in solutions)

    @property
    def exit_status(self) -> ExitStatus:
        """3: a solver did not converge; 1: the models differ by more than a tolerance; else 0,
        whatever the model error of the half-plane."""
        if not self.converged:
            return ExitStatus.NOT_CONVERGED
        if any(c.verdict == "differ" for c in self.comparisons):
            return ExitStatus.OUTSIDE_TOLERANCE
        return ExitStatus.DONE
