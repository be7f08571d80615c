"""The models of a scene from the cheapest to the whole, each with its errors against the whole.

In: an error budget, whose finite elements are solved already. Out: a rung a model. Hertz's contact
is a closed form; every other rung is what the run has solved for its verdict."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Figures, deciding
from comparisons.figures.quantity import MODELS, WHOLE
from comparisons.judging.effects.catalogue import EFFECTS, FINITE, FLOW, NONLINEAR
from comparisons.judging.ladder import candidates
from comparisons.judging.model_error.model_error import Solutions, figure_of
from comparisons.judging.model_error.refinement import ErrorBudget
from comparisons.judging.rule import judged
from comparisons.judging.study import LADDER, Case, Solved
from comparisons.judging.yielding import FlowAssessment
from comparisons.models.level import Solution
from comparisons.models.model import Model
from comparisons.models.smooth import closed_form

HERTZ, HALF_PLANE = "hertz", "half_plane"
OTHER = MODELS[1]  # the finite elements of the scene
# Finite elements by the dearest effect that they have, from the cheapest on.
ELEMENTS = {
    "": "linear finite elements",
    FINITE: "finite deformation",
    FLOW: "elastic-plastic finite elements",
}


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


def rungs(solved: Solved, budget: ErrorBudget, flow: FlowAssessment, tasks: Tasks) -> list[Rung]:
    """Every model, from the cheapest to the whole. The tasks solve what only the ladder asks for:
    half-planes with some of the effects, where nothing cheaper holds, and the same effects in
    finite elements are not refuted."""
    rung, effects = partial(_rung, solved, budget), budget.selection.whole
    made, analytic = [rung(*one) for one in _solved(solved, budget)], [HERTZ, HALF_PLANE]
    finest = (case.runs[HALF_PLANE].finest.solution.pressure for case in solved.cases)
    peak, every = max(float(pressure.max()) for pressure in finest), candidates.CANDIDATES
    for candidate in () if flow.beyond_doubt else every:  # and no model of the run does
        if any(one.verdict == "holds" for one in made if one.name in analytic):
            break
        held = candidate.carries(solved.problem, effects, peak)
        same = [one for one in made if one.effects == held and candidate.has_elements]
        refuted = any(one.verdict == "fails" for one in same)
        runs = candidates.solutions(solved, held, tasks) if held and not refuted else None
        if runs is not None:
            took = _took(next(iter(runs.values())))  # what all took together
            named = candidate.name, held, candidates.words_of(held)
            made.append(rung(*named, took, partial(_beside, runs)))
            analytic.append(candidate.name)
    order = [HERTZ, HALF_PLANE, *(candidate.name for candidate in every), *ELEMENTS, WHOLE]

    def place(one: Rung) -> int:
        return order.index(one.name if one.name in order else _dearest(one.effects))

    return sorted(made, key=place)


def _solved(solved: Solved, budget: ErrorBudget) -> Iterator[tuple]:
    """What the run has for its verdict, and a closed form: what a `_rung` is made of."""
    own, every, none = budget.selection.contained, budget.solutions, frozenset()
    if (smooth := closed_form(solved.problem)) is not None:
        began = perf_counter()
        exact = {one.case.friction: _closed_form(one.case) for one in every}
        took, words = (perf_counter() - began, 0.0), f"{smooth.name}'s closed form"
        yield HERTZ, none, words, took, lambda one: one.of_exact(exact[one.case.friction])
    errors = Figures(budget.model_errors)
    yield (
        *(HALF_PLANE, none, "half-plane", _took(solved.runs[HALF_PLANE])),
        lambda one: errors.of(at=one.case.at),
    )
    for name in dict.fromkeys(name for one in every for name in one.effects):
        split = [one.split for one in every if name in one.split.pairs]
        if own != {name} and any(one.pairs[name][0] != one.whole for one in split):
            words = f"finite elements with {EFFECTS[name].label}"
            words = f"{ELEMENTS[name]} alone" if name in ELEMENTS else words
            took = _took_by(budget, (one.pairs[name][0] for one in split))
            yield name, frozenset({name}), words, took, partial(_with, name)
    took = _took(solved.runs[OTHER])
    lacking = (one.missing[-1].figures.values() for one in every)
    if own and any(np.any(change) for figures in lacking for change in figures):
        words = _words_of_elements(own)
        yield OTHER, own, words, took, lambda one: one.of_levels(one.solved(one.split.of_scene))
    more, most = _took_by(budget, (variant for one in every for variant in one.split.wholes))
    whole, took = budget.selection.whole, (took[0] + more, max(took[1], most))
    words = f"whole model: {_words_of_elements(whole)}"
    yield WHOLE, whole, words, took, lambda one: one.of_exact()


def _with(name: str, one: Solutions) -> Iterator[Figure]:
    """Errors of finite elements with one effect, or where it does nothing, without any."""
    variant, *_ = one.split.pairs.get(name, (one.split.nothing,))
    levels = one.history[: one.levels_split]
    return one.of_levels([level.get(variant, level[one.split.nothing]) for level in levels])


def _beside(runs: Mapping[float, Solution], one: Solutions) -> Iterator[Figure]:
    """Errors of a model that was solved on the pressure elements of the finite elements."""
    run, elements = runs[one.case.friction], one.case.runs[OTHER]
    known = replace(one, case=replace(one.case, runs={HALF_PLANE: run, OTHER: elements}))
    return map(known.error, judged(run, one.case.problem, elements).values())


def _rung(
    solved: Solved,
    budget: ErrorBudget,
    name: str,
    effects: frozenset[str],
    words: str,
    took: tuple[float, float],
    errors: Callable[[Solutions], Iterable[Figure]],
) -> Rung:
    """With those errors that are judged, of each case; `took` seconds, and memory [bytes]."""
    known = budget.selection, solved.problem.scene.tolerances
    mine = {"study": LADDER, "source": name, "parts": (), "place": None}
    every = (figure_of(error, *known) for one in budget.solutions for error in errors(one))
    figures = tuple(replace(error, **mine) for error in every if error.bounds is not None)
    return Rung(name, effects, words, *took, figures)


def _closed_form(case: Case) -> dict[str, float]:
    """The smooth contact's figures [SI]; largest stresses with [stress]."""
    smooth = closed_form(case.problem)
    values = {"peak_pressure": smooth.peak_pressure, "contact_length": smooth.contact_length}
    if case.problem.window is not None:
        largest = smooth.extremes(case.friction)
        values |= {"tau1_max": largest["tau1"].value, "tau1_max_depth": largest["tau1"].z}
        values["txz_max_abs"] = abs(largest["txz"].value)
    return values


def _took(run: Solution) -> tuple[float, float]:
    """Seconds of a model's levels, and the largest memory of their processes [bytes]."""
    return sum(run.seconds.values()), max(level.peak_memory for level in run.levels)


def _took_by(budget: ErrorBudget, variants: Iterable[Model]) -> tuple[float, float]:
    """Seconds of variants on all of their levels, and the largest memory [bytes]."""
    costs = [budget.took.get(variant, (0.0, 0)) for variant in dict.fromkeys(variants)]
    return math.fsum(seconds for seconds, _ in costs), max(memory for _, memory in costs)


def _dearest(effects: Iterable[str]) -> str:
    """The effect that says what kind of finite elements these are, of ELEMENTS."""
    return next((name for name in (FLOW, FINITE) if name in effects), "")


def _words_of_elements(effects: Iterable[str]) -> str:
    """The kind of finite elements that have the effects, and the linear ones beside it."""
    kind, beside = _dearest(effects), set(effects) - set(NONLINEAR)
    words = ELEMENTS[kind] + " at finite deformation" * (kind == FLOW and FINITE in effects)
    beside = ", ".join(EFFECTS[name].label for name in EFFECTS if name in beside)
    return f"{words} with {beside}" if beside else words
