"""Answers from outside against a model of the run: the finite elements, or the only one."""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figures
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import (
    LENGTHS,
    iteration,
    length_resolution,
    peak_resolution,
)
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.scenes.studies.answers import AnswerSection
from comparisons.studies.answers.answer import Answer, AnswerRow, ComparedAnswer
from comparisons.studies.answers.conditions import balance, conditions, operators_of
from comparisons.studies.answers.hints import hints
from comparisons.studies.answers.validation import validation_rows
from comparisons.studies.comparison import norms, pair_norms, relative_differences
from comparisons.studies.contact import by_repetition, values_of
from comparisons.studies.study import Solved

LEAST_RATIO = 1.2  # of the spacings of two resolutions that show how a figure converges
COVERED = 0.5  # of the window: on less of it two fields are not compared


def compare_answers(
    solved: Solved, answers: Mapping[str, tuple[Answer, ...]], scattered: Figures
) -> tuple[ComparedAnswer, ...]:
    """Every answer of the scene; `answers` are its resolutions by its name.

    scattered  the half-plane's figures by uncertain inputs, as far as they are known"""
    problem, run = solved.problem, list(solved.runs.values())[-1]
    operators, compared = operators_of(problem, solved.plan, solved.runs), []
    for name, source in problem.scene.answers.items():
        levels = answers[name]
        finest, validation = levels[-1], {}
        frictions = problem.scene.load.friction if source.friction is None else (source.friction,)
        rows = [row for mu in frictions for row in _compared(solved, run, mu, source, levels)]
        if source.scatter is not None:
            measured = {mu: own_figures(finest, problem, mu) for mu in frictions}
            validation = validation_rows(problem, solved.runs, measured, source.scatter, scattered)
        compared.append(
            ComparedAnswer(
                name=name,
                reference=run.name,
                answers=levels,
                measured=source.scatter is not None,
                rows=tuple(rows),
                balance=balance(finest, problem),
                conditions=conditions(finest, problem, operators),
                hints=hints(finest, problem, run.finest),
                validation=validation,
            )
        )
    return tuple(compared)


def own_figures(answer: Answer, problem: Problem, friction: float) -> dict[str, float]:
    """The compared quantities of an answer, as `values_of` has those of a model."""
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
    solved: Solved,
    run: ModelRun,
    friction: float,
    source: AnswerSection,
    answers: tuple[Answer, ...],
) -> list[AnswerRow]:
    """At one friction coefficient, in the order of QUANTITIES."""
    problem, window = solved.problem, solved.window

    def against(answer: Answer, level: Level) -> dict[str, float]:
        return _differences(answer, level, problem, friction, window)

    finest, first = answers[-1], run.levels[0]
    history = [against(finest, level) for level in run.levels]
    of_files = [against(each, run.finest) for each in answers]
    repeated = by_repetition(run, lambda level: against(finest, level))
    repeated |= by_repetition(run, lambda level: norms(level, first, problem, friction, window))
    own = own_figures(finest, problem, friction)
    reference = values_of(run.finest, problem, friction)
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
        values = own.get(name), reference.get(name)
        unsure = model, read, stated
        tolerance = problem.scene.tolerances.get(name)
        rows.append(AnswerRow(name, friction, *values, difference, *unsure, tolerance))
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
    reference = values_of(level, problem, friction)
    own = own_figures(answer, problem, friction)
    both = {name: value for name, value in own.items() if name in reference}
    found |= relative_differences(both, reference, problem)
    return {name: found[name] for name in QUANTITIES if name in found}
