"""The models of a scene from the cheapest to the whole, each with its errors against the whole.

In: an error budget, whose finite elements are solved already. Out: a rung a model. Hertz's contact
is a closed form; every other rung is what the run has solved for its verdict."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.progress import Stages
from comparisons.common.tasks import LAST, Tasks, called
from comparisons.figures.figure import Figure, deciding
from comparisons.figures.quantity import MODELS, WHOLE
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.model_error.account import ErrorBudget, figure_of
from comparisons.judging.model_error.model_error import ModelError, Solutions
from comparisons.judging.model_error.quantities_of_interest import QuantitiesOfInterest
from comparisons.judging.rule import judged
from comparisons.judging.study import LADDER, Case, Solved
from comparisons.judging.yielding import FlowAssessment
from comparisons.models.analytic import (
    CAP,
    analytic_level,
    carried_deformed,
    carried_linear,
    why_no_stresses,
)
from comparisons.models.level import ModelRun
from comparisons.models.problem import COUPLED, TABOR, Problem
from comparisons.models.smooth import closed_form
from comparisons.models.window import Window

HERTZ, HALF_PLANE, OPERATORS, DEFORMED = "hertz", "half_plane", "operators", "deformed"
LINEAR, FINITE, FLOW = "linear", "finite", "flow"
OTHER = MODELS[1]  # the finite elements of the scene
# Kinds of rungs, from the cheapest on.
KINDS = {
    HERTZ: "Hertz's closed form",
    HALF_PLANE: "half-plane",
    OPERATORS: "half-plane with what an operator carries",
    DEFORMED: "half-plane on the deformed surface",
    LINEAR: "linear finite elements",
    FINITE: "finite deformation",
    FLOW: "elastic-plastic finite elements",
    WHOLE: "whole model",
}
WORDS = {
    "finite_size": "layer",
    "coating": "coating",
    COUPLED: "coupling",
    "exact_circle": "exact circle",
    CAP: f"pressures up to {TABOR:g} Y",
}
NONLINEAR = {"finite_strain": FINITE, "plastic_flow": FLOW}  # kinds by effect; others are linear


def carried(problem: Problem, effects: Iterable[str], flow: FlowAssessment) -> frozenset[str]:
    """What an operator can carry of the whole's effects, and a cap where the body yields."""
    scene = problem.scene
    held = set(carried_linear(scene, effects))
    yields = scene.body.yield_stress is not None and scene.body.hardness is None
    if yields and not scene.periodic and flow.worst.peak > TABOR * scene.body.yield_stress:
        held.add(CAP)
    return frozenset(held)


def words_of(held: frozenset[str]) -> str:
    where = "half-plane on the deformed surface" if "finite_strain" in held else "half-plane"
    beside = ", ".join(words for name, words in WORDS.items() if name in held)
    return f"{where} with {beside}" if beside else where


def may_suffice(errors: Iterable[Figure]) -> bool:
    """Whether no error of a rung fails, or is less certain than its tolerance."""
    return all(e.verdict != "fails" and e.total <= e.tolerance for e in errors)


@dataclass(frozen=True)
class Rung:
    """One model and its errors in what the scene judges."""

    name: str  # source of its figures
    kind: str  # of KINDS
    words: str
    figures: tuple[Figure, ...]  # (rung - whole) / whole
    seconds: float
    memory: float  # [bytes] largest of the process that solved it; 0 of a closed form
    effects: frozenset[str] = frozenset()  # that it has beside the half-plane's assumptions

    @property
    def verdict(self) -> str:
        return deciding(self.figures).verdict


@dataclass(frozen=True)
class Ladder:
    """What the rungs of one scene are made of."""

    solved: Solved
    budget: ErrorBudget
    tasks: Tasks  # that solve what only the ladder asks for
    compared: tuple[Figure, ...]  # the models' comparison, those that are judged
    flow: FlowAssessment

    def rungs(self) -> list[Rung]:
        """From the cheapest to the whole."""
        made = [self._hertz(), self._half_plane(), *self._effects(), self._own(), self._whole()]
        made = [rung for rung in made if rung is not None]
        by_half_plane = HERTZ, HALF_PLANE, OPERATORS
        for make in (self._operators, self._deformed):
            if any(rung.verdict == "holds" for rung in made if rung.kind in by_half_plane):
                break
            made += [rung for rung in [make(made)] if rung is not None]
        order = list(KINDS)
        return sorted(made, key=lambda rung: order.index(rung.kind))

    @property
    def flows(self) -> str:
        """That the body flows beyond doubt, and no model of the run does: nothing can suffice."""
        return "" if "plastic_flow" in self.budget.selection.whole else self.flow.beyond_doubt

    def _operators(self, made: list[Rung]) -> Rung | None:
        """Solved here, where it has anything that the half-plane has not and could be the answer:
        the same effects in finite elements are not refuted."""
        problem, window, selection = self.solved.problem, self.solved.window, self.budget.selection
        held = carried(problem, selection.whole, self.flow)
        same = [rung for rung in made if rung.effects == held]
        refuted = self.flows or any(rung.verdict == "fails" for rung in same)
        if not held or refuted or why_no_stresses(problem, window) is not None:
            return None
        return self._by_half_plane(OPERATORS, held)

    def _deformed(self, made: list[Rung]) -> Rung | None:
        """Where the whole deforms finitely, and does not flow."""
        held = carried_deformed(self.solved.problem, self.budget.selection.whole)
        flows = self.flows or "plastic_flow" in self.budget.selection.whole
        return self._by_half_plane(DEFORMED, held) if held and not flows else None

    def _by_half_plane(self, name: str, held: frozenset[str]) -> Rung | None:
        """The half-plane with some of the effects, on the finite elements' pressure elements."""
        runs = operator_runs(self.solved, held, self.tasks)
        if runs is None:
            return None
        every = self.budget.solutions
        errors = [e for one in every for e in self._errors(one, runs[one.case.friction])]
        figures = self._figures(name, errors)
        run = next(iter(runs.values()))  # which took what all took together
        return replace(_rung_of(run, name, words_of(held), figures), effects=held)

    def _errors(self, solutions: Solutions, run: ModelRun) -> list[ModelError]:
        """Errors against the whole of a model that was solved on the half-plane's pressures."""
        case = solutions.case
        rows = judged(run, case.problem, case.runs[OTHER])
        runs = {"half_plane": run, OTHER: case.runs[OTHER]}
        solutions = replace(solutions, case=replace(case, runs=runs))
        return [solutions.error(rows[row.quantity]) for row in self._rows(case)]

    def _figures(self, name: str, errors: Iterable[ModelError]) -> tuple[Figure, ...]:
        """Model errors as figures of a rung."""
        tolerances = self.solved.problem.scene.tolerances
        judged = (figure_of(error, self.budget.selection, tolerances) for error in errors)
        rung = {"study": LADDER, "source": name, "parts": (), "place": None}
        return tuple(replace(figure, **rung) for figure in judged)

    def _hertz(self) -> Rung | None:
        if (smooth := closed_form(self.solved.problem)) is None:
            return None
        began, problem, window = perf_counter(), self.solved.problem, self.solved.window
        errors = []
        for solutions in self.budget.solutions:
            exact = hertz_quantities(problem, solutions.case.friction, window)
            stated = judged(solutions.runs[OTHER], problem)
            errors += [
                solutions.of_exact(row.quantity, exact, stated[row.quantity].numerical)
                for row in self._rows(solutions.case)
            ]
        seconds = perf_counter() - began
        figures = self._figures(HERTZ, errors)
        return Rung(HERTZ, HERTZ, f"{smooth.name}'s closed form", figures, seconds, 0.0)

    def _half_plane(self) -> Rung:
        run = self.solved.runs["half_plane"]
        errors = [self.budget.of(row.quantity, row.friction) for row in self.compared]
        return _rung_of(run, HALF_PLANE, KINDS[HALF_PLANE], self._figures(HALF_PLANE, errors))

    def _effects(self) -> Iterator[Rung]:
        """Finite elements with one effect each, where they are neither the whole nor the scene's
        own."""
        every = self.budget.solutions
        for name in dict.fromkeys(name for solutions in every for name in solutions.effects):
            kind = NONLINEAR.get(name, LINEAR)
            levels = [level for solutions in every for level in solutions.split_levels]
            pairs = [(level.pairs[name][0], level.whole) for level in levels if name in level.pairs]
            is_whole = all(with_it is whole for with_it, whole in pairs)
            if self.budget.selection.contained == {name} or is_whole:
                continue
            errors = []
            for solutions in every:
                # with the effect, or where it does nothing, without any
                levels = [lv.pairs.get(name, (lv.nothing,))[0] for lv in solutions.split_levels]
                rows = self._rows(solutions.case)
                errors += [solutions.of_variants(row.quantity, levels) for row in rows]
            words = f"{KINDS[kind]} alone"
            if kind == LINEAR:
                words = f"finite elements with {EFFECTS[name].label}"
            figures = self._figures(name, errors)
            yield Rung(name, kind, words, figures, *self.budget.took[name], frozenset({name}))

    def _own(self) -> Rung | None:
        """The scene's own finite elements, where they have effects and are not the whole."""
        contained, every = self.budget.selection.contained, self.budget.solutions
        lacking = (solutions.missing[-1].figures.values() for solutions in every)
        if not contained or not any(np.any(change) for figures in lacking for change in figures):
            return None
        kind = kind_of(contained)
        errors = [
            solutions.of_variants(row.quantity, [level.of_scene for level in solutions.history])
            for solutions in every
            for row in self._rows(solutions.case)
        ]
        run, words = self.solved.runs[OTHER], words_of_kind(contained)
        rung = _rung_of(run, OTHER, words, self._figures(OTHER, errors), kind)
        return replace(rung, effects=contained)

    def _whole(self) -> Rung:
        """What is not known of the reference itself."""
        run, errors = self.solved.runs[OTHER], []
        for solutions in self.budget.solutions:
            stated = judged(solutions.runs[OTHER], solutions.problem)
            errors += [
                solutions.of_whole(row.quantity, stated[row.quantity].numerical)
                for row in self._rows(solutions.case)
            ]
        inside = words_of_kind(self.budget.selection.whole)
        rung = _rung_of(run, WHOLE, f"whole model: {inside}", self._figures(WHOLE, errors))
        seconds, memory = self.budget.took.get(WHOLE, (0.0, 0))
        return replace(rung, seconds=rung.seconds + seconds, memory=max(rung.memory, memory))

    def _rows(self, case: Case) -> list[Figure]:
        return [row for row in self.compared if row.friction == case.friction]


def announce_operators(
    problem: Problem,
    held: frozenset[str],
    pitches: Iterable[float],
    window: Window | None,
    tasks: Tasks,
) -> list[str]:
    """Add the half-plane with what an operator carries to the tasks, on pressure elements of each
    pitch [m]: their keys."""
    keys = []
    for number, pitch in enumerate(pitches, start=1):
        keys.append(f"operators-{'+'.join(sorted(held))}-{number}")
        how = problem, held, problem.grid(pitch), window, Stages()
        tasks.add(keys[-1], called, analytic_level, *how, urgency=LAST)
    return keys


def operator_runs(
    solved: Solved, held: frozenset[str], tasks: Tasks
) -> dict[float, ModelRun] | None:
    """The half-plane with what an operator carries, by friction coefficient, on the pressure
    elements of the finite elements; None where it has no solution."""
    pitches = [level.grid.pitch for level in solved.runs[OTHER].levels]
    keys = announce_operators(solved.problem, held, pitches, solved.window, tasks)
    try:
        levels = list(map(tasks.result, keys))
    except ContactError:  # the cap takes a contact that the pressures' extent does not hold
        return None
    if not all(level.converged for of_pitch in levels for level in of_pitch.values()):
        return None
    frictions = [case.friction for case in solved.cases]
    return {mu: ModelRun(OPERATORS, tuple(of_pitch[mu] for of_pitch in levels)) for mu in frictions}


def hertz_quantities(
    problem: Problem, friction: float, window: Window | None
) -> QuantitiesOfInterest:
    """The smooth contact's closed form, where it has one; largest stresses with a window."""
    smooth = closed_form(problem)
    values = {"peak_pressure": smooth.peak_pressure, "contact_length": smooth.contact_length}
    if window is not None:
        largest = smooth.extremes(friction)
        values |= {"tau1_max": largest["tau1"].value, "tau1_max_depth": largest["tau1"].z}
        values["txz_max_abs"] = abs(largest["txz"].value)
    return QuantitiesOfInterest({name: np.array([value]) for name, value in values.items()})


def _rung_of(
    run: ModelRun, name: str, words: str, figures: tuple[Figure, ...], kind: str = ""
) -> Rung:
    """With what a model of the run took."""
    memory = max(level.peak_memory for level in run.levels)
    return Rung(name, kind or name, words, figures, sum(run.seconds.values()), memory)


def kind_of(effects: Iterable[str]) -> str:
    kinds = {NONLINEAR.get(name, LINEAR) for name in effects}
    return next(kind for kind in (FLOW, FINITE, LINEAR) if kind in kinds or kind == LINEAR)


def words_of_kind(effects: Iterable[str]) -> str:
    """The kind of finite elements that have the effects, and the linear ones beside it."""
    kind, is_finite = kind_of(effects), "finite_strain" in effects
    beside = [EFFECTS[name].label for name in EFFECTS if name in effects and name not in NONLINEAR]
    words = f"{KINDS[kind]} at finite deformation" if is_finite and kind == FLOW else KINDS[kind]
    return f"{words} with {', '.join(beside)}" if beside else words
