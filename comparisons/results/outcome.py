"""What a finished run holds: everything that its files, table and report are made of."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from comparisons.common.errors import ExitStatus
from comparisons.figures.quantity import WHOLE
from comparisons.figures.verdict import Comparison, ToleranceCheck
from comparisons.models.forecast import Forecast, forecast
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.answers.answer import ComparedAnswer
from comparisons.studies.contact import PairHistory
from comparisons.studies.coupling import Coupling
from comparisons.studies.heat.figures import HeatStudy
from comparisons.studies.model_error.error_budget import ErrorBudget
from comparisons.studies.scatter.figures import InputScatter
from comparisons.studies.statistics.figures import RoughContactStatistics
from comparisons.studies.yielding import FlowAssessment, flow_assessment


@dataclass(frozen=True)
class Outcome:
    """A finished run."""

    problem: Problem
    plan: Plan
    window: Window | None  # points of the common field, None without [stress]
    runs: dict[str, ModelRun]  # by model name, half_plane and/or finite_element
    # in the order of friction coefficients, then of quantities; empty for one model
    comparisons: tuple[Comparison, ...]
    result: dict  # the content of result.json
    record: dict  # the content of record.json
    directory: Path | None  # where the files are, None for a run without files
    # what friction that moves the surfaces changes on the half-plane, by coefficient, if anything
    couplings: tuple[Coupling, ...] = ()
    budget: ErrorBudget | None = None  # of the difference, None for one model
    # the norms of the difference on all levels, one a friction coefficient; empty for one model
    pairs: tuple[PairHistory, ...] = ()
    scatter: InputScatter | None = None  # what uncertain inputs do, None without [scatter]
    statistics: RoughContactStatistics | None = None  # of rough contact, None without [statistics]
    # from outside, beside a model; empty where the scene has none
    answers: tuple[ComparedAnswer, ...] = ()
    heat: HeatStudy | None = None  # None without [heat]

    @cached_property
    def forecast(self) -> Forecast:
        """What the laws of cost said before anything was solved."""
        return forecast(self.problem, self.plan)

    @cached_property
    def flow(self) -> FlowAssessment:
        """Whether the body would flow."""
        return flow_assessment(self.problem, self.runs)

    @property
    def converged(self) -> bool:
        """Whether every level of every model met its contact conditions, and running-in did."""
        run_in = self.problem.surface.run_in
        solutions = [level.solution for run in self.runs.values() for level in run.levels]
        solutions += self.couplings if run_in is None else (*self.couplings, run_in)
        return all(each.converged for each in solutions)

    def levels(self, friction: float) -> dict[str, Level]:
        """The finest level of every model at a friction coefficient, last of the whole model where
        it is not the scene's own finite elements."""
        found = {name: run.finest for name, run in self.runs.items()}
        whole = None if self.budget is None else self.budget.wholes.get(friction)
        own = self.runs.get("finite_element")
        if whole is not None and all(whole is not level for level in own.levels):
            found[WHOLE] = whole
        return found

    def pair(self, friction: float) -> dict[str, Level]:
        """The half-plane and the last of `levels` on the same elements, or the only model."""
        name, last = list(self.levels(friction).items())[-1]
        first = next(iter(self.runs.values()))
        return {first.name: first.beside(last), name: last}

    @property
    def deciding_friction(self) -> float:
        """The coefficient at which a judged model error exceeds its tolerance most, or comes
        nearest to it; the last one without any."""
        scene = self.problem.scene
        checks = [] if self.budget is None else self.budget.tolerance_checks(scene.tolerances)
        worst = max(checks, key=lambda check: abs(check.value) / check.tolerance, default=None)
        return scene.load.friction[-1] if worst is None else worst.friction

    @property
    def tolerance_checks(self) -> list[ToleranceCheck]:
        """Every judged model error of the half-plane; none for one model."""
        budget = self.budget
        return budget.tolerance_checks(self.problem.scene.tolerances) if budget else []

    @property
    def exit_status(self) -> ExitStatus:
        """3: a solver did not converge; 1: a judged figure differs, of a model or of an answer from
        outside, the half-plane fails in it, or the body flows beyond doubt; 4: none does, but one
        is inconclusive; else 0."""
        if not self.converged:
            return ExitStatus.NOT_CONVERGED
        outside = [row for answer in self.answers for row in answer.rows]
        outside += self.heat.figures if self.heat else ()
        verdicts = {r.verdict for r in (*self.comparisons, *self.tolerance_checks, *outside)}
        flows = self.budget is not None and self.flow.beyond_doubt
        if flows or verdicts & {"differ", "fails"}:
            return ExitStatus.OUTSIDE_TOLERANCE
        return ExitStatus.INCONCLUSIVE if "inconclusive" in verdicts else ExitStatus.DONE
