"""Answers from outside against a model of the run: the finite elements, or the only one."""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import (
    LENGTHS,
    iteration,
    length_resolution,
    peak_resolution,
)
from comparisons.figures.verdict import judge
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.scenes.studies.answers import AnswerSection
from comparisons.studies.answers.answer import Answer, AnswerRow, ComparedAnswer
from comparisons.studies.answers.conditions import balance, conditions, operators_of
from comparisons.studies.answers.hints import hints
from comparisons.studies.answers.validation import validation_rows
from comparisons.studies.contact import (
    by_repetition,
    figures,
    norms,
    pair_norms,
    relative_differences,
)
from comparisons.studies.scatter.figures import InputScatter

LEAST_RATIO = 1.2  # of the spacings of two resolutions that show how a figure converges
COVERED = 0.5  # of the window: on less of it two fields are not compared


def compare_answers(
    problem: Problem,
    plan: Plan,
    runs: Mapping[str, ModelRun],
    window: Window | None,
    answers: Mapping[str, tuple[Answer, ...]],
    scatter: InputScatter | None,
) -> tuple[ComparedAnswer, ...]:
    """Every answer of the scene; `answers` are its resolutions by its name.

    scatter  of the scene's figures by uncertain inputs; None: not known"""
    run, found = list(runs.values())[-1], []
    operators = operators_of(problem, plan, runs)
    for name, source in problem.scene.answers.items():
        given = answers[name]
        frictions = problem.scene.load.friction if source.friction is None else (source.friction,)
        measured = {mu: own_figures(given[-1], problem, mu) for mu in frictions}
        rows = [
            row for mu in frictions for row in _compared(problem, run, mu, window, source, given)
        ]
        found.append(
            ComparedAnswer(
                name=name,
                reference=run.name,
                answers=given,
                measured=source.scatter is not None,
                rows=tuple(rows),
                balance=balance(given[-1], problem),
                conditions=conditions(given[-1], problem, operators),
                hints=hints(given[-1], problem, run.finest),
                validation={}
                if source.scatter is None
                else validation_rows(problem, runs, measured, source.scatter, scatter),
            )
        )
    return tuple(found)


def own_figures(answer: Answer, problem: Problem, friction: float) -> dict[str, float]:
    """The compared quantities of an answer, as `figures` has those of a model."""
    length = float(np.ptp(answer.patches, axis=1).sum())
    found = {
        "peak_pressure": float(answer.pressure.max()),
        "contact_length": length,
        "contact_ratio": length / (2.0 * problem.hertz.half_width),
    }
    stress = answer.stress
    if stress is not None and stress.friction == friction:
        found["tau1_max"] = stress.extremes["tau1"].value
        found["tau1_max_depth"] = stress.depth
        found["txz_max_abs"] = stress.extremes["txz"].value
    return found


def _compared(
    problem: Problem,
    run: ModelRun,
    friction: float,
    window: Window | None,
    source: AnswerSection,
    answers: tuple[Answer, ...],
) -> list[AnswerRow]:
    """At one friction coefficient, in the order of QUANTITIES."""

    def against(answer: Answer, level: Level) -> dict[str, float]:
        return _differences(answer, level, problem, friction, window)

    finest, first = answers[-1], run.levels[0]
    history = [against(finest, level) for level in run.levels]
    of_files = [against(each, run.finest) for each in answers]
    repeated = by_repetition(run, lambda level: against(finest, level))
    repeated |= by_repetition(run, lambda level: norms(level, first, problem, friction, window))
    own, reference = own_figures(finest, problem, friction), figures(run.finest, problem, friction)
    rows = []
    for name, difference in history[-1].items():
        resolution, read = 0.0, _read_off(finest, name) / abs(reference.get(name) or 1.0)
        if name in LENGTHS:
            grid, length = run.finest.grid, run.finest.contact_length
            resolution = length_resolution(grid.pitch, len(run.finest.patches)) / length
            read = _read_off(finest, name) / length
        values = [each[name] for each in history]
        model = grid_convergence(values, QUANTITIES[name].formal_order, resolution).uncertainty
        model += max(1.0, abs(1.0 + difference)) * iteration(run.finest)
        model += sum(repeated[name])
        stated = _own_uncertainty(name, [each.get(name) for each in of_files], answers, read)
        if source.scatter is not None:
            size = 1.0 if QUANTITIES[name].of_pair else abs(1.0 + difference)
            stated = (stated or 0.0) + source.scatter * size
        total = model + (read if stated is None else stated)
        tolerance = problem.scene.tolerances.get(name)
        verdict = judge(difference, total, tolerance) if tolerance else None
        values = own.get(name), reference.get(name)
        known = total if np.isfinite(total) else None
        rows.append(
            AnswerRow(name, friction, *values, difference, known, stated, tolerance, verdict)
        )
    return rows


def _read_off(answer: Answer, name: str) -> float:
    """How finely a figure can be read off the answer's points, in its unit."""
    match name:
        case "contact_length" | "contact_ratio":  # of the length
            return answer.spacing * float(np.sqrt(len(answer.patches)))
        case "peak_pressure":
            return peak_resolution(answer.pressure) * float(answer.pressure.max())
        case "tau1_max_depth":
            return answer.stress.spacing
    return 0.0


def _own_uncertainty(
    name: str, values: list[float | None], answers: tuple[Answer, ...], read: float
) -> float | None:
    """By the house's fit of levels, whose ratio is 2: of another ratio r an order p counts as
    p log2 r; None where one resolution alone is given, or none that differ."""
    ratios = [one.spacing / other.spacing for one, other in pairwise(answers)]
    if not ratios or min(ratios) < LEAST_RATIO or None in values:
        return None
    order = QUANTITIES[name].formal_order * float(np.log2(min(ratios)))
    return grid_convergence(values, order, read).uncertainty


def _differences(
    answer: Answer, level: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """(answer - level) / level of every figure that both have, and the norms."""
    stress, other = answer.stress, level.stress(friction)
    tau1 = None
    if stress is not None and stress.friction == friction and other is not None:
        tau1 = stress.field.tau1
        tau1 = tau1 if np.isfinite(tau1).mean() >= COVERED else None
    found = pair_norms(
        (answer.on(level.grid.x), level.solution.pressure),
        (tau1, None if other is None else other.field.tau1),
        problem,
        window,
    )
    reference = figures(level, problem, friction)
    own = own_figures(answer, problem, friction)
    both = {name: value for name, value in own.items() if name in reference}
    found |= relative_differences(both, reference, problem)
    return {name: found[name] for name in QUANTITIES if name in found}
