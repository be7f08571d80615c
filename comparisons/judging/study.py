"""A study: one question to one solved scene, and all that becomes of its result.

In: a solved scene, and what earlier studies found. Out: figures, series and statements, and how the
page and the terminal show them. A new study is a module with a STUDY, which is named in
`comparisons.studies.STUDIES`: it appears in result.json, tables, JUnit, page and rerun by itself.
Its physics is imported inside `solve`, so that reading a scene stays fast."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.errors import ExitStatus
from comparisons.drawing.blocks import Block
from comparisons.figures.figure import FAILED, Figure, Figures, Findings, Statement
from comparisons.figures.quantity import WHOLE, Quantity
from comparisons.models.level import Level, Solution
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window

if TYPE_CHECKING:
    from comparisons.common.tasks import Opens, Tasks

# Names of statements: why a study was not done, and whether a solution converged, "yes" or "no".
WHY_NOT, CONVERGED = "not done", "converged"
MODEL_ERROR = "model_error"  # the study that judges the half-plane
SCATTER = "scatter"  # the study of uncertain inputs
CONTACT = "contact"  # the study of each model by itself
COMPARISON = "comparison"  # the study that judges the models against each other
LAYERED = "layered"  # the study that does so for the analytic model of a layer or a coating
LADDER = "ladder"  # the study that judges other models beside it, which no run answers for


@dataclass(frozen=True, eq=False)
class Case:
    """A scene at one friction coefficient, as far as it is solved."""

    problem: Problem  # at that coefficient alone
    runs: Mapping[str, Solution] = field(default_factory=dict)  # by model

    @property
    def friction(self) -> float:
        return self.problem.scene.load.friction[0]

    @property
    def at(self) -> dict[str, float]:
        """Friction coefficient of the case, for the names of figures."""
        return {"friction": self.friction}


@dataclass(frozen=True)
class Solved:
    """A scene as far as it is solved: its cases, which share what friction does not move."""

    problem: Problem
    plan: Plan
    cases: tuple[Case, ...]  # in the order of the scene's friction coefficients
    refinement: str = ""  # why it stopped
    # from outside, read before, each on its resolutions; None: the scene's files are read
    answers: "Mapping[str, tuple] | None" = None
    opens: "Opens | None" = None  # workers for samples; None: those of the run's tasks
    all_methods: bool = False  # solve it by every method and resolution, for what they cost

    @property
    def runs(self) -> Mapping[str, Solution]:
        """The models of the first case, by name; empty before anything is solved. Their sizes and
        costs are those of all cases, which are solved together."""
        return self.cases[0].runs

    def case(self, friction: float) -> Case:
        return next(case for case in self.cases if case.friction == friction)

    def contacts(self, model: str) -> list[tuple[dict[str, float], Level]]:
        """The finest contacts of a model and their friction coefficients: each one's, or the only
        one, which has none, where friction does not move it."""
        finest = [(case.at, case.runs[model].finest) for case in self.cases]
        first = finest[0][1]
        moves = any(not level.shares_contact(first) for _, level in finest)
        return finest if moves else [({}, first)]


def unsolved(problem: Problem, plan: Plan) -> Solved:
    """A scene of which nothing is solved yet."""
    frictions = problem.scene.load.friction
    cases = tuple(Case(problem.under(friction)) for friction in frictions)
    return Solved(problem, plan, cases)


class Found:
    """Findings of a run's studies, and the figures that it answers for."""

    findings: Mapping[str, Findings]  # by the study's name, in the order in which they are shown
    frictions: Sequence[float]  # the scene's coefficients

    @cached_property
    def figures(self) -> Figures:
        """Every number that is a result."""
        return Figures(f for findings in self.findings.values() for f in findings.figures)

    @cached_property
    def judged(self) -> Figures:
        """Figures that the run answers for."""
        judged = (figure for figure in self.figures if figure.bounds is not None)
        beside = {LADDER, COMPARISON} if self.compared.of(study=LAYERED) else {LADDER}
        return Figures(figure for figure in judged if figure.study not in beside)

    @cached_property
    def compared(self) -> Figures:
        """Differences of an analytic model from the scene's own finite elements: of the layered
        one, where it is the same problem, else of the half-plane."""
        differences = [figure for figure in self.figures if figure.against == "finite_element"]
        layered = Figures(figure for figure in differences if figure.study == LAYERED)
        return layered or Figures(figure for figure in differences if figure.study == COMPARISON)

    @cached_property
    def model_errors(self) -> Figures:
        """The half-plane's, those that are judged."""
        return self.judged.of(study=MODEL_ERROR)

    @property
    def converged(self) -> bool:
        """Whether every solution met its contact conditions, and running-in did."""
        said = (words for findings in self.findings.values() for words in findings.statements)
        return all(words.text == "yes" for words in said if words.name == CONVERGED)

    @property
    def deciding_friction(self) -> float:
        """The coefficient at which a judged model error exceeds its tolerance most, or comes
        nearest to it; the last one without any."""
        errors = self.model_errors
        worst = max(errors, key=lambda error: abs(error.value) / error.tolerance, default=None)
        return self.frictions[-1] if worst is None else worst.friction

    @property
    def exit_status(self) -> ExitStatus:
        """3: a solver did not converge; 1: a judged figure differs or fails; 4: none does, but one
        is inconclusive; else 0."""
        if not self.converged:
            return ExitStatus.NOT_CONVERGED
        verdicts = {figure.verdict for figure in self.judged}
        if verdicts & set(FAILED):
            return ExitStatus.OUTSIDE_TOLERANCE
        return ExitStatus.INCONCLUSIVE if "inconclusive" in verdicts else ExitStatus.DONE


@dataclass(frozen=True, eq=False)
class Run(Found):
    """A finished run: all that its files, tables and page are made of."""

    solved: Solved
    findings: Mapping[str, Findings]  # by the study's name, in the order in which they are shown
    record: dict  # of result.json
    directory: Path | None  # where the files are, None for a run without files
    studies: "tuple[Study, ...]" = ()  # those that the run has

    @property
    def problem(self) -> Problem:
        return self.solved.problem

    @property
    def plan(self) -> Plan:
        return self.solved.plan

    @property
    def frictions(self) -> Sequence[float]:
        return self.problem.scene.load.friction

    @property
    def window(self) -> Window | None:
        return self.problem.window

    @property
    def runs(self) -> Mapping[str, Solution]:
        return self.solved.runs

    def data(self, study: str) -> object | None:
        """Data that the pictures of a study are drawn from; None where the run has not done it."""
        return self.findings[study].data if study in self.findings else None

    def levels(self, friction: float) -> dict[str, Level]:
        """The finest level of every model at a friction coefficient, last of the whole model where
        it is not the scene's own finite elements."""
        case, budget = self.solved.case(friction), self.data(MODEL_ERROR)
        finest = {name: run.finest for name, run in case.runs.items()}
        if budget is not None and budget.wholes:
            whole = budget.wholes[self.solved.cases.index(case)]
            if all(whole is not level for level in case.runs["finite_element"].levels):
                finest[WHOLE] = whole
        return finest

    def pair(self, friction: float) -> dict[str, Level]:
        """The half-plane and the last of `levels` on the same elements, or the only model."""
        name, last = list(self.levels(friction).items())[-1]
        first = next(iter(self.solved.case(friction).runs.values()))
        return {first.name: first.beside(last), name: last}


@dataclass(frozen=True)
class Study:
    """One question, by the functions that answer it."""

    name: str  # of its figures
    quantities: Mapping[str, Quantity]
    # what it finds; the second argument holds the findings of earlier studies by name
    solve: "Callable[[Solved, Mapping[str, Findings], Tasks], Findings]"
    # whether the scene asks for it; before anything is solved, as the next one
    applies: Callable[[Solved], bool] = lambda solved: True
    # why it cannot be done, though asked for
    needs: Callable[[Solved], str | None] = lambda solved: None
    # makes known to the tasks what `solve` will ask for; again once more is solved, and known tasks
    # stay as they are
    begin: "Callable[[Solved, Tasks], None]" = lambda solved, tasks: None
    # how `comparisons.judging.presentation` shows it
    title: str = ""  # of its part of the page; a study without one has none, and no line
    section: str = ""  # of another study, which it is shown in; "": its own
    caption: Callable[[Run], str] = lambda run: ""  # of its table
    note: str | Callable[[Run], str] = ""  # how to read what is shown
    # names of quantities and statements that are shown, in their order; None: all
    shown: Sequence[str] | None = None
    # who says what no model does, in words
    sources: Mapping[str, str] = field(default_factory=dict)
    # further names and values, after what it states
    facts: Callable[[Run], list[tuple[str, str]]] = lambda run: []
    advice: Callable[[Run], str] = lambda run: ""  # a clause at the end of its line
    # its parts of the page, and its lines of the terminal, each with its name, where that does not
    # do
    blocks: Callable[[Run], list[Block]] | None = None
    lines: Callable[[Run], list[tuple[str, str]]] | None = None
    # what draws its pictures, by name; None where there is nothing to draw
    pictures: Mapping[str, Callable[[Run], object]] = field(default_factory=dict)
    # files of its own in the run's folder, by path: columns (n,) of a CSV by their headings
    files: Callable[[Run], Mapping[str, Mapping[str, np.ndarray]]] = lambda run: {}
    # verdicts of its own beside that on the half-plane: a word or two, and a sentence
    verdicts: Callable[[Run], list[tuple[str, str]]] = lambda run: []
    # a sentence after the verdict on the model error that is nearest to its tolerance, or nothing
    remark: Callable[[Run, Figure], str] = lambda run, error: ""


def studied(studies: tuple[Study, ...], solved: Solved, tasks: "Tasks") -> dict[str, Findings]:
    """Findings of each of these in turn, which later ones get."""
    found: dict[str, Findings] = {}
    for study in studies:
        if study.applies(solved):
            if (why_not := study.needs(solved)) is None:
                found[study.name] = study.solve(solved, found, tasks)
            else:
                found[study.name] = Findings(statements=(Statement(WHY_NOT, why_not),))
    return found
