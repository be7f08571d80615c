"""The models of a scene from the cheapest to the whole, each with its errors against the whole.

In: an error budget, whose finite elements are solved already. Out: a rung a model. Hertz's contact
is a closed form; every other rung is what the run has solved for its verdict."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.tasks import LAST, Tasks
from comparisons.figures.figure import Figure, Figures, deciding
from comparisons.figures.quantity import MODELS, WHOLE
from comparisons.judging.effects.catalogue import EFFECTS, FINITE, FLOW, NONLINEAR
from comparisons.judging.model_error.model_error import Solutions, figure_of
from comparisons.judging.model_error.refinement import ErrorBudget
from comparisons.judging.rule import judged
from comparisons.judging.study import LADDER, Case, Solved
from comparisons.judging.yielding import FlowAssessment
from comparisons.models.analytic import CAP, carried_deformed, carried_linear, why_no_stresses
from comparisons.models.level import ModelRun
from comparisons.models.model import Model
from comparisons.models.problem import COUPLED, TABOR, Problem
from comparisons.models.smooth import closed_form
from comparisons.models.window import Window

HERTZ, HALF_PLANE, OPERATORS, DEFORMED = "hertz", "half_plane", "operators", "deformed"
ANALYTIC = HERTZ, HALF_PLANE, OPERATORS, DEFORMED
OTHER = MODELS[1]  # the finite elements of the scene
# Finite elements by the dearest effect that they have, from the cheapest on.
ELEMENTS = {
    "": "linear finite elements",
    FINITE: "finite deformation",
    FLOW: "elastic-plastic finite elements",
}
ORDER = (*ANALYTIC, *ELEMENTS, WHOLE)  # of rungs
WORDS = {
    "finite_size": "layer",
    "coating": "coating",
    COUPLED: "coupling",
    "exact_circle": "exact circle",
    CAP: f"pressures up to {TABOR:g} Y",
}
# Of a quantity, by its row of the models' comparison, at one friction coefficient.
Error = Callable[[Solutions, Figure], Figure]


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
    effects: frozenset[str]  # that it has beside the half-plane's assumptions
    words: str
    seconds: float
    memory: float  # [bytes] largest of the process that solved it; 0 of a closed form
    figures: tuple[Figure, ...]  # (rung - whole) / whole

    @property
    def verdict(self) -> str:
        return deciding(self.figures).verdict

    @property
    def place(self) -> int:
        """In the order of rungs."""
        return ORDER.index(self.name if self.name in ORDER else _dearest(self.effects))


def rungs(
    solved: Solved,
    budget: ErrorBudget,
    compared: Iterable[Figure],
    flow: FlowAssessment,
    tasks: Tasks,
) -> list[Rung]:
    """Every model, from the cheapest to the whole.

    compared  rows of the models' comparison, those that are judged
    tasks     that solve what only the ladder asks for: half-planes with some of the effects, where
              nothing cheaper holds, and the same effects in finite elements are not refuted"""
    rung, problem = partial(_judged, budget, tuple(compared)), solved.problem
    made, effects = list(_solved(solved, budget, rung)), budget.selection.whole
    flows = bool(nothing_suffices(budget, flow))
    linear = frozenset() if flows else carried(problem, effects, flow)
    if any(one.verdict == "fails" for one in made if one.effects == linear):
        linear = frozenset()
    deformed = () if flows or FLOW in effects else carried_deformed(problem, effects)
    possible = why_no_stresses(problem, solved.window) is None
    for name, held in ((OPERATORS, linear if possible else ()), (DEFORMED, deformed)):
        if any(one.verdict == "holds" for one in made if one.name in ANALYTIC):
            break
        runs = operator_runs(solved, held, tasks) if held else None
        if runs is not None:
            took = _took(next(iter(runs.values())))  # what all took together
            made.append(rung(name, held, words_of(held), took, _against(budget, runs)))
    return sorted(made, key=lambda one: one.place)


def nothing_suffices(budget: ErrorBudget, flow: FlowAssessment) -> str:
    """That the body flows beyond doubt, and no model of the run does."""
    return "" if FLOW in budget.selection.whole else flow.beyond_doubt


def _solved(solved: Solved, budget: ErrorBudget, rung: Callable[..., Rung]) -> Iterator[Rung]:
    """What the run has for its verdict, and a closed form."""
    selection, every, none = budget.selection, budget.solutions, frozenset()
    if (smooth := closed_form(solved.problem)) is not None:
        began = perf_counter()
        exact = {case.friction: _closed_form(case, solved.window) for case in solved.cases}
        took = perf_counter() - began, 0.0

        def of_hertz(one: Solutions, row: Figure) -> Figure:
            return one.of_exact(row.quantity, exact[row.friction][row.quantity])

        yield rung(HERTZ, none, f"{smooth.name}'s closed form", took, of_hertz)
    known = Figures(budget.model_errors)

    def of_half_plane(one: Solutions, row: Figure) -> Figure:
        return known.one(quantity=row.quantity, friction=row.friction)

    yield rung(HALF_PLANE, none, "half-plane", _took(solved.runs[HALF_PLANE]), of_half_plane)
    own = selection.contained
    for name in dict.fromkeys(name for one in every for name in one.effects):
        levels = [level for one in every for level in one.split_levels if name in level.pairs]
        is_whole = all(level.pairs[name][0] is level.whole for level in levels)
        if own != {name} and not is_whole:

            def of_effect(one: Solutions, row: Figure, name: str = name) -> Figure:
                # with the effect, or where it does nothing, without any
                levels = [lv.pairs.get(name, (lv.nothing,))[0] for lv in one.split_levels]
                return one.of_levels(row.quantity, levels)

            words = f"finite elements with {EFFECTS[name].label}"
            words = f"{ELEMENTS[name]} alone" if name in ELEMENTS else words
            yield rung(name, frozenset({name}), words, budget.took[name], of_effect)
    lacking = (change for one in every for change in one.missing[-1].figures.values())
    if own and any(map(np.any, lacking)):

        def of_own(one: Solutions, row: Figure) -> Figure:
            return one.of_levels(row.quantity, [level.of_scene for level in one.history])

        yield rung(OTHER, own, _words_of_elements(own), _took(solved.runs[OTHER]), of_own)
    seconds, memory = _took(solved.runs[OTHER])
    more, most = budget.took.get(WHOLE, (0.0, 0))
    words, took = _words_of_elements(selection.whole), (seconds + more, max(memory, most))

    def of_whole(one: Solutions, row: Figure) -> Figure:
        return one.of_exact(row.quantity)

    yield rung(WHOLE, selection.whole, f"whole model: {words}", took, of_whole)


def _against(budget: ErrorBudget, runs: dict[float, ModelRun]) -> Error:
    """Errors of a model that was solved on the pressure elements of the finite elements."""
    known = {}
    for one in budget.solutions:
        run, elements = runs[one.case.friction], one.case.runs[OTHER]
        case = replace(one.case, runs={HALF_PLANE: run, OTHER: elements})
        rows = judged(run, case.problem, elements)
        known[case.friction] = replace(one, case=case), rows

    def error(one: Solutions, row: Figure) -> Figure:
        solutions, rows = known[row.friction]
        return solutions.error(rows[row.quantity])

    return error


def _judged(
    budget: ErrorBudget,
    compared: tuple[Figure, ...],
    name: str,
    effects: frozenset[str],
    words: str,
    took: tuple[float, float],
    error: Error,
) -> Rung:
    """A rung by its errors; `took` seconds, and memory [bytes]."""
    pairs = [(o, row) for o in budget.solutions for row in compared if row.at == o.case.at]
    errors = (
        figure_of(error(one, row), budget.selection, {row.quantity: row.tolerance})
        for one, row in pairs
    )
    mine = {"study": LADDER, "source": name, "parts": (), "place": None}
    return Rung(name, effects, words, *took, tuple(replace(figure, **mine) for figure in errors))


def announce_operators(
    solved: Solved, held: frozenset[str], levels: int, tasks: Tasks
) -> list[str]:
    """The keys of the tasks that solve the half-plane with some of the effects."""
    model = Model(f"{OPERATORS}-{'+'.join(sorted(held))}", "analytic", held, label=words_of(held))
    where = [(solved.problem, number, solved.window) for number in range(1, levels + 1)]
    return [model.announce(tasks, *one, urgency=LAST) for one in where]


def operator_runs(
    solved: Solved, held: frozenset[str], tasks: Tasks
) -> dict[float, ModelRun] | None:
    """The half-plane with some of the effects, by friction coefficient, on the pressure elements of
    the finite elements; None where it has no solution."""
    keys = announce_operators(solved, held, len(solved.runs[OTHER].levels), tasks)
    try:
        levels = list(map(tasks.result, keys))
    except ContactError:  # the cap takes a contact that the pressures' extent does not hold
        return None
    if not all(level.converged for of_pitch in levels for level in of_pitch.values()):
        return None
    frictions = [case.friction for case in solved.cases]
    return {mu: ModelRun(OPERATORS, tuple(of_pitch[mu] for of_pitch in levels)) for mu in frictions}


def _closed_form(case: Case, window: Window | None) -> dict[str, float]:
    """The smooth contact's figures [SI]; largest stresses with a window."""
    smooth = closed_form(case.problem)
    values = {"peak_pressure": smooth.peak_pressure, "contact_length": smooth.contact_length}
    if window is not None:
        largest = smooth.extremes(case.friction)
        values |= {"tau1_max": largest["tau1"].value, "tau1_max_depth": largest["tau1"].z}
        values["txz_max_abs"] = abs(largest["txz"].value)
    return values


def _took(run: ModelRun) -> tuple[float, float]:
    """Seconds of a model's levels, and the largest memory of their processes [bytes]."""
    return sum(run.seconds.values()), max(level.peak_memory for level in run.levels)


def _dearest(effects: Iterable[str]) -> str:
    """The effect that says what kind of finite elements these are, of ELEMENTS."""
    return next((name for name in (FLOW, FINITE) if name in effects), "")


def _words_of_elements(effects: Iterable[str]) -> str:
    """The kind of finite elements that have the effects, and the linear ones beside it."""
    kind, beside = _dearest(effects), set(effects) - set(NONLINEAR)
    words = ELEMENTS[kind] + " at finite deformation" * (kind == FLOW and FINITE in effects)
    beside = ", ".join(EFFECTS[name].label for name in EFFECTS if name in beside)
    return f"{words} with {beside}" if beside else words
