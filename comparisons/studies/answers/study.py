"""Answers from outside beside the models.

In: the scene's answers, read from their files or before, and the solved models. Out: each one's
figures and judged differences from the last model, the finite elements or the only one; how well
its pressures solve the scene's problem, what would explain a difference, its files; and, of
measured data, the validation comparison of ASME V&V 20 (2009)

    E = S - D        u_val = sqrt(u_num^2 + u_input^2 + u_D^2)

S is a model's figure, D the measured one; all are relative to D, and expanded uncertainties. The
model error lies within E +- u_val."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from itertools import pairwise
from operator import itemgetter

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import (
    Figure,
    Figures,
    Findings,
    Series,
    columns_of,
    figures_of,
    grouped,
)
from comparisons.figures.quantity import COMPARED, NORMS, Quantity
from comparisons.figures.uncertainty import Uncertainty, difference_of_figures, peak_resolution
from comparisons.judging.rule import judged, norms, norms_of, relative_differences, values_of
from comparisons.judging.study import SCATTER, Case, Solved
from comparisons.models.level import Level
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.conditions import conditions, operators_of
from comparisons.studies.answers.hints import hints

NAME = "answers"
CONDITIONS, HINTS, VALIDATION = "contact conditions", "hints", "validation"  # series
QUANTITIES = COMPARED | {
    "load_balance": Quantity("load off the scene's"),
    "spacing": Quantity("distance from point to point in contact", "m"),
}
ITSELF = Uncertainty({"itself": 1.0})  # an error is as sure as its order of size
LEAST_RATIO = 1.2  # of the spacings of two resolutions that show how a figure converges
COVERED = 0.5  # of the window: on less of it two fields are not compared


def begin(solved: Solved, tasks: Tasks) -> None:
    """Raises InputError for a file that cannot be read, before anything is solved."""
    _read(solved, tasks)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    problem, answers = solved.problem, _read(solved, tasks)
    operators = operators_of(problem, solved.runs)
    scattered = Figures(before[SCATTER].figures if SCATTER in before else ())
    figures, series = [], []
    for name, source in problem.scene.answers.items():
        finest, validation = answers[name][-1], []
        frictions = problem.scene.load.friction if source.friction is None else (source.friction,)
        cases = [solved.case(friction) for friction in frictions]
        for case in cases:
            figures += _figures(case, name, answers[name])
            if source.scatter is not None:
                known = scattered.of(friction=case.friction)
                validation += _validation(case, finest, source.scatter, known)
        balance = finest.load / problem.hertz.load_per_length - 1.0
        figures += figures_of(NAME, name, {"load_balance": balance}, ITSELF)
        figures += figures_of(NAME, name, {"spacing": finest.spacing})
        *_, model = cases[0].runs.values()
        known = conditions(finest, problem, operators).items()
        by_quantity = grouped(validation, itemgetter("quantity"))
        tables = {
            CONDITIONS: [{"model": model} | residuals for model, residuals in known],
            HINTS: [asdict(hint) for hint in hints(finest, problem, model.finest)],
            VALIDATION: [row for rows in by_quantity for row in rows],
        }
        series += [_errors(key, name, rows) for key, rows in tables.items() if rows]
        files = columns_of([{"file": a.file, "sha256": a.sha256} for a in answers[name]])
        series.append(Series("files", files, name, is_account=True))
    return Findings(tuple(figures), tuple(series), data=answers)


def _read(solved: Solved, tasks: Tasks) -> Mapping[str, tuple[Answer, ...]]:
    if solved.answers is not None:
        return solved.answers
    from comparisons.studies.answers.read import read_answers

    return tasks.held(NAME, NAME, lambda: read_answers(solved.problem))


def _errors(name: str, answer: str, rows: list[dict]) -> Series:
    """Rows whose numbers are errors, as sure as their order of size."""
    sizes = {
        key: [abs(row[key]) for row in rows]
        for key in rows[0]
        if key != "friction" and all(isinstance(row[key], float) for row in rows)
    }
    return Series(name, columns_of(rows, uncertainties=sizes), answer)


def _on_level(answer: Answer, level: Level, friction: float) -> Level:
    """An answer in place of a model's level, its pressures on the same elements; no stresses of
    another friction coefficient, and no field of too little of the window."""
    stress = answer.stress
    if stress is not None and stress.friction != friction:
        stress = None
    if stress is not None and np.isfinite(stress.tau1).mean() < COVERED:
        stress = replace(stress, field=None)
    solution = replace(level.solution, pressure=answer.on(level.grid.x))
    shown = {"solution": solution, "patches": answer.patches, "stress": stress}
    return replace(level, mesh=None, **shown)


def _values(answer: Answer, case: Case) -> dict[str, float]:
    """Compared quantities of an answer; its largest pressure as given, wherever elements are."""
    *_, model = case.runs.values()
    values = values_of(_on_level(answer, model.finest, case.friction), case.problem)
    return values | {"peak_pressure": float(answer.pressure.max())}


def _figures(case: Case, name: str, answers: tuple[Answer, ...]) -> Iterator[Figure]:
    """An answer's figures in a case, where it has them, and their differences from the last
    model's, (answer - model) / model, or norms, in the order of COMPARED. Uncertain is a difference
    by the model and by the answer's own, or else by how finely its points are read."""
    problem, finest, (*_, model) = case.problem, answers[-1], case.runs.values()
    scatter, tolerances = problem.scene.answers[name].scatter, problem.scene.tolerances
    values, reference = _values(finest, case), values_of(model.finest, problem)
    levels = tuple(_on_level(finest, level, case.friction) for level in model.levels)
    of_norms = norms_of(replace(model, name=name, levels=levels), problem, model)
    stated = judged(model, problem) | {figure.quantity: figure for figure in of_norms}
    by_answer = [
        relative_differences(_values(answer, case), reference, problem)
        | norms(_on_level(answer, model.finest, case.friction), model.finest, problem.window)
        for answer in answers
    ]
    for quantity in COMPARED:
        if (difference := by_answer[-1].get(quantity)) is None:
            continue
        scale, size = abs(reference.get(quantity, 0.0)) or 1.0, 1.0 + difference
        size = 1.0 if quantity in NORMS else size
        reading = _reading(finest, quantity) / scale
        sure = _stated(quantity, [one.get(quantity) for one in by_answer], answers, reading)
        if scatter is not None:
            sure = (sure or 0.0) + scatter * abs(size)
        own = None if sure is None else {"own": sure}
        common = {"study": NAME, "quantity": quantity, "source": name, "at": case.at}
        if (value := values.get(quantity)) is not None:
            unsure = own and Uncertainty(own)
            yield Figure(value=value, scale=abs(value) or 1.0, uncertainty=unsure, **common)
        tolerance = tolerances.get(quantity)
        by_model = difference_of_figures(0.0, size, stated[quantity].numerical)
        yield Figure(
            value=difference,
            against=model.name,
            scale=scale,
            uncertainty=Uncertainty({"model": by_model} | (own or {"reading": reading})),
            bounds=(-tolerance, tolerance) if tolerance else None,
            **common,
        )


def _reading(answer: Answer, name: str) -> float:
    """Resolution of a figure by the answer's points, in its unit."""
    match name:
        case "contact_length":
            return answer.spacing * float(np.sqrt(len(answer.patches)))
        case "peak_pressure":
            return peak_resolution(answer.pressure) * float(answer.pressure.max())
        case "tau1_max_depth":
            return answer.depth_spacing
    return 0.0


def _stated(
    name: str, values: list[float | None], answers: tuple[Answer, ...], reading: float
) -> float | None:
    """The answer's own uncertainty by the fit of levels, whose ratio is 2: of another ratio r an
    order p counts as p log2 r; None where one resolution alone is given, or none that differ."""
    ratios = [one.spacing / other.spacing for one, other in pairwise(answers)]
    if not ratios or min(ratios) < LEAST_RATIO or None in values:
        return None
    order = COMPARED[name].formal_order * float(np.log2(min(ratios)))
    return grid_convergence(values, order, reading).uncertainty


def _validation(
    case: Case, answer: Answer, u_data: float, scattered: Figures
) -> Iterator[dict[str, object]]:
    """Rows by model and quantity of data whose relative scatter is `u_data`.

    scattered  the half-plane's figures by uncertain inputs; where one is not known, u_input is None
               and counts as none"""
    measured = _values(answer, case)
    for name, run in case.runs.items():
        stated = judged(run, case.problem)
        for quantity, value in values_of(run.finest, case.problem).items():
            if not measured.get(quantity):
                continue
            ratio, inputs = value / measured[quantity], scattered.one(quantity=quantity)
            u_num = abs(ratio) * stated[quantity].numerical
            u_input = abs(ratio) * inputs.by_inputs if inputs else None
            u_val = math.hypot(u_num, u_input or 0.0, u_data)
            row = {"quantity": quantity, "friction": case.friction, "model": name, "E": ratio - 1.0}
            yield row | {"u_num": u_num, "u_input": u_input, "u_D": u_data, "u_val": u_val}
