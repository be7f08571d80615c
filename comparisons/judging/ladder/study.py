"""Model that suffices: the cheapest whose every judged error holds against the whole model.

In: the error budget of a finished comparison, whose finite elements are solved already. Out: a
judged figure by model, quantity and friction coefficient; what each model took; which one suffices,
and which is worth trying next. Models go from the cheapest to the whole one: Hertz's contact
is a closed form, every other one is what the run has solved for its verdict."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

import numpy as np

from comparisons.common.numbers import percent, with_unit
from comparisons.common.tasks import Tasks
from comparisons.drawing.blocks import Block, Note, TextTable
from comparisons.figures.figure import (
    Figure,
    Figures,
    Findings,
    Series,
    Statement,
    columns_of,
    deciding,
)
from comparisons.figures.quantity import MODELS, QUANTITIES, WHOLE, error_text, label
from comparisons.judging import yielding
from comparisons.judging.effects.catalogue import EFFECTS, FINITE, FLOW, NONLINEAR
from comparisons.judging.effects.selection import effects_of_run
from comparisons.judging.ladder import candidates
from comparisons.judging.model_error.model_error import Solutions, figure_of
from comparisons.judging.model_error.refinement import ErrorBudget
from comparisons.judging.rule import judged
from comparisons.judging.study import LADDER, MODEL_ERROR, WHY_NOT, Case, Run, Solved, Study
from comparisons.judging.yielding import FlowAssessment
from comparisons.models.level import Solution
from comparisons.models.model import Model
from comparisons.models.smooth import closed_form

RUNGS = "rungs"  # series: what each model took
# Statements: the cheapest model that holds; why none does; the next one to try.
SUFFICES, NONE, ESCALATE_TO = "suffices", "none", "escalate to"
NOTE = """Every model of this run against the whole one, from the cheapest on: the error in the
figure that decides, nearest to its tolerance or farthest beyond, with its uncertainty. A model
holds where every judged figure does. The last row is what is not known of the whole model itself.
Time is that of all levels, of finite elements summed over cores; memory is the largest of the
process."""
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
    figures: tuple[Figure, ...]  # (model - whole model) / whole model

    @property
    def verdict(self) -> str:
        return deciding(self.figures).verdict


def begin(solved: Solved, tasks: Tasks) -> None:
    """Announce the candidates that no finite elements refute, once the half-plane is solved, where
    the effects that this selects ask for them: they then wait for no finite elements."""
    if list(solved.runs) != [HALF_PLANE]:
        return
    whole = effects_of_run(solved, tasks).whole
    for candidate in candidates.CANDIDATES:
        held = candidate.carries(solved.problem, whole, 0.0)
        if held and not candidate.has_elements:
            candidates.announce(solved, held, len(solved.problem.pitches), tasks)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    flow, budget = before[yielding.NAME].data, before[MODEL_ERROR].data
    if not budget.solutions:
        why = budget.unsplit or "the whole model has no solution"
        return Findings(statements=(Statement(WHY_NOT, why),))
    made = rungs(solved, budget, flow, tasks)
    figures = tuple(figure for rung in made for figure in rung.figures)
    units = {"seconds": "s", "peak_memory": "byte"}
    rows = [
        {"rung": r.name, "model": r.words, "seconds": r.seconds, "peak_memory": r.memory}
        for r in made
    ]
    series = (Series(RUNGS, columns_of(rows, units), is_account=True),)
    said = _statements(made, flow.beyond_doubt)
    return Findings(figures, series, tuple(said))


def rungs(solved: Solved, budget: ErrorBudget, flow: FlowAssessment, tasks: Tasks) -> list[Rung]:
    """Every model, from the cheapest to the whole one. Tasks solve what only the ladder asks for:
    half-planes with some of the effects, where nothing cheaper holds, and the same effects in
    finite elements are not refuted."""
    rung, effects = partial(_rung, solved, budget), budget.selection.whole
    made = [rung(*one) for one in _solved(solved, budget)]
    finest = (case.runs[HALF_PLANE].finest.solution.pressure for case in solved.cases)
    peak, every = max(float(pressure.max()) for pressure in finest), candidates.CANDIDATES
    analytic = [HERTZ, HALF_PLANE, *(candidate.name for candidate in every)]
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
    order = [*analytic, *ELEMENTS, WHOLE]

    def place(one: Rung) -> int:
        return order.index(one.name if one.name in order else _dearest(one.effects))

    return sorted(made, key=place)


def _solved(solved: Solved, budget: ErrorBudget) -> Iterator[tuple]:
    """Arguments of `_rung` for all that the run has for its verdict, and for a closed form."""
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
    """Rung with those errors that are judged, of each case; `took` seconds, and memory [bytes]."""
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
    kind, beside = _dearest(effects), set(effects) - NONLINEAR
    words = ELEMENTS[kind] + " at finite deformation" * (kind == FLOW and FINITE in effects)
    beside = ", ".join(EFFECTS[name].label for name in EFFECTS if name in beside)
    return f"{words} with {beside}" if beside else words


def _statements(rungs: Sequence[Rung], flows: str) -> list[Statement]:
    holding = [] if flows else [rung for rung in rungs if rung.verdict == "holds"]
    half_plane = next(rung for rung in rungs if rung.name == HALF_PLANE)
    said = []
    if flows:
        said.append(Statement(NONE, "flow"))
    elif holding:
        said.append(Statement(SUFFICES, holding[0].name))
    elif rungs[-1].verdict == "inconclusive":
        said.append(Statement(NONE, "the whole model is not known to the tolerance"))
    dearer = rungs[rungs.index(half_plane) + 1 :]
    possible = [rung.name for rung in (*holding, *dearer) if may_suffice(rung.figures)]
    possible += [rungs[-1].name] * (rungs[-1].verdict != "fails")  # if none is known to that
    if half_plane.verdict != "holds" and not flows and possible:
        said.append(Statement(ESCALATE_TO, possible[0]))
    return said


def may_suffice(errors: Iterable[Figure]) -> bool:
    """Whether no error of a model fails, or is less certain than its tolerance."""
    return all(e.verdict != "fails" and e.total <= e.tolerance for e in errors)


def blocks(run: Run) -> list[Block]:
    rows = []
    for row, words, errors in _rungs(run):
        worst = deciding(errors)
        size, unsure = error_text(worst.value, worst.total), percent(worst.total)
        time = with_unit(row["seconds"], "s", 2)
        memory = with_unit(row["peak_memory"], "byte", 2) if row["peak_memory"] else ""
        rows.append((words, label(worst.quantity), size, unsure, worst.verdict, time, memory))
    if not rows:
        return []
    head = ("model", "quantity", "error", "uncertainty", "verdict", "time", "memory")
    line = "; ".join(f"{name}: {text}" for name, text in lines(run))
    table = TextTable(line.replace("tau1", "τ₁"), head, tuple(rows), "comparison", words=False)
    return [Block("model-error", (table, Note(NOTE)))]


def lines(run: Run) -> list[tuple[str, str]]:
    """The cheapest model that holds, or that may by an error known to its tolerance."""
    rungs, findings = _rungs(run), run.findings[LADDER]
    if not rungs:
        return []
    by_name = {row["rung"]: _text(row, words, errors) for row, words, errors in rungs}
    if (name := findings.said(SUFFICES)) is not None:
        return [("cheapest that holds", by_name[name])]
    left = [row["rung"] for row, _, errors in rungs if may_suffice(errors)]
    why = f", {said}" if (said := findings.said(NONE)) else ""
    beside = f"cheapest that may: {by_name[left[0]]}" if left else "none is known to suffice"
    return [("cheapest that holds", f"none{why}; {beside}")]


def _rungs(run: Run) -> list[tuple[dict, str, Figures]]:
    """Rows of the series by model, with its name in words, and its errors."""
    table, known = run.findings[LADDER].table(RUNGS), run.figures.of(study=LADDER)
    rows = [] if table is None else table.rows()
    return [(row, row["model"], known.of(source=row["rung"], against=WHOLE)) for row in rows]


def _text(row: dict, words: str, errors: Sequence[Figure]) -> str:
    worst, time = deciding(errors), with_unit(row["seconds"], "s", 2)
    error = f", {QUANTITIES[worst.quantity].short} {worst.sized(worst.total)}"
    return f"{words} ({time}{error if math.isfinite(worst.total) else ''})"


STUDY = Study(
    name=LADDER,
    quantities=QUANTITIES,
    solve=solve,
    begin=begin,
    applies=lambda solved: solved.plan.compares and bool(solved.problem.scene.tolerances),
    blocks=blocks,
    lines=lines,
)
