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
from dataclasses import asdict
from itertools import pairwise
from operator import itemgetter

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import (
    Column,
    Figure,
    Figures,
    Findings,
    Series,
    columns_of,
    figures_of,
    grouped,
)
from comparisons.figures.quantity import COMPARED, NORMS, Quantity
from comparisons.figures.uncertainty import (
    Uncertainty,
    iteration,
    length_resolution,
    peak_resolution,
)
from comparisons.judging.comparison import norms, pair_norms, relative_differences
from comparisons.judging.contact import by_repetition, uncertainties, values_of
from comparisons.judging.study import SCATTER, Case, Solved
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.conditions import conditions, operators_of
from comparisons.studies.answers.hints import hints
from comparisons.studies.scatter.study import by_inputs

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
    operators = operators_of(problem, solved.plan, solved.runs)
    scattered = Figures(before[SCATTER].figures if SCATTER in before else ())
    figures, series = [], []
    for name, source in problem.scene.answers.items():
        finest, validation = answers[name][-1], []
        frictions = problem.scene.load.friction if source.friction is None else (source.friction,)
        for friction in frictions:
            case = solved.case(friction)
            figures += _figures(case, solved.window, name, answers[name])
            if source.scatter is not None:
                measured = figures_of_answer(finest, problem, friction)
                known = scattered.of(friction=friction)
                validation += _validation(case, measured, source.scatter, known)
        balance = finest.load / problem.hertz.load_per_length - 1.0
        figures += figures_of(NAME, name, {"load_balance": balance}, ITSELF)
        figures += figures_of(NAME, name, {"spacing": finest.spacing})
        *_, model = solved.case(frictions[0]).runs.values()
        by_model = [
            {"model": model} | residuals
            for model, residuals in conditions(finest, problem, operators).items()
        ]
        by_quantity = grouped(validation, itemgetter("quantity"))
        tables = {
            CONDITIONS: by_model,
            HINTS: [asdict(h) for h in hints(finest, problem, model.finest)],
            VALIDATION: [row for rows in by_quantity for row in rows],
        }
        series += _tables_of(name, tables)
        files = columns_of([{"file": a.file, "sha256": a.sha256} for a in answers[name]])
        series.append(Series("files", files, name, is_account=True))
    return Findings(tuple(figures), tuple(series), data=answers)


def _read(solved: Solved, tasks: Tasks) -> Mapping[str, tuple[Answer, ...]]:
    if solved.answers is not None:
        return solved.answers
    from comparisons.studies.answers.read import read_answers

    return tasks.held(NAME, NAME, lambda: read_answers(solved.problem, solved.window))


def _tables_of(answer: str, tables: Mapping[str, list[dict]]) -> Iterator[Series]:
    """Those that have rows; numbers are errors, as sure as their order of size."""
    for name, rows in tables.items():
        columns = columns_of(rows)
        for key, column in columns.items():
            if key != "friction" and all(isinstance(value, float) for value in column.values):
                columns[key] = Column(column.values, "", tuple(map(abs, column.values)))
        if rows:
            yield Series(name, columns, answer)


def figures_of_answer(answer: Answer, problem: Problem, friction: float) -> dict[str, float]:
    """The compared quantities of an answer, as `values_of` has those of a model."""
    length = float(np.ptp(answer.patches, axis=1).sum())
    values = {"peak_pressure": float(answer.pressure.max()), "contact_length": length}
    stress = answer.stress
    if stress is not None and stress.friction == friction:
        values["tau1_max"] = stress.extremes["tau1"].value
        values["tau1_max_depth"] = stress.depth
        values["txz_max_abs"] = stress.extremes["txz"].value
    return values


def _figures(
    case: Case, window: Window | None, name: str, answers: tuple[Answer, ...]
) -> Iterator[Figure]:
    """An answer's figures in a case, where it has them, and their differences from the last
    model's, (answer - model) / model, or norms, in the order of COMPARED. Uncertain is a difference
    by the model and by the answer's own, or else by how finely its points are read."""
    problem, friction, (*_, model) = case.problem, case.friction, case.runs.values()
    scatter, tolerances = problem.scene.answers[name].scatter, problem.scene.tolerances
    finest, first = answers[-1], model.levels[0]

    def against(answer: Answer, level: Level) -> dict[str, float]:
        return _differences(answer, level, problem, friction, window)

    by_level = [against(finest, level) for level in model.levels]
    by_file = [against(answer, model.finest) for answer in answers]
    repeated = by_repetition(model, lambda level: against(finest, level))
    repeated |= by_repetition(model, lambda level: norms(level, first, window))
    values = figures_of_answer(finest, problem, friction)
    reference = values_of(model.finest, problem)
    for quantity, difference in by_level[-1].items():
        order, size = COMPARED[quantity].formal_order, abs(1.0 + difference)
        resolution, scale = 0.0, abs(reference.get(quantity, 0.0)) or 1.0
        reading = _reading(finest, quantity) / scale
        if quantity == "contact_length":
            grid, patches = model.finest.grid, model.finest.patches
            resolution = length_resolution(grid.pitch, len(patches)) / scale
        history = [differences[quantity] for differences in by_level]
        unsure = grid_convergence(history, order, resolution).uncertainty
        unsure += max(1.0, size) * iteration(model.finest.solution)
        unsure += sum(repeated[quantity])
        by_answer = [differences.get(quantity) for differences in by_file]
        stated = _stated(quantity, by_answer, answers, reading)
        if scatter is not None:
            stated = (stated or 0.0) + scatter * (1.0 if quantity in NORMS else size)
        own = None if stated is None else {"own": stated}
        common = {"study": NAME, "quantity": quantity, "source": name}
        common["at"] = case.at
        if (value := values.get(quantity)) is not None:
            sure = own and Uncertainty(own)
            yield Figure(value=value, scale=abs(value) or 1.0, uncertainty=sure, **common)
        tolerance = tolerances.get(quantity)
        yield Figure(
            value=difference,
            against=model.name,
            scale=scale,
            uncertainty=Uncertainty({"model": unsure} | (own or {"reading": reading})),
            bounds=(-tolerance, tolerance) if tolerance else None,
            **common,
        )


def _reading(answer: Answer, name: str) -> float:
    """How finely a figure can be read off the answer's points, in its unit."""
    match name:
        case "contact_length":
            return answer.spacing * float(np.sqrt(len(answer.patches)))
        case "peak_pressure":
            return peak_resolution(answer.pressure) * float(answer.pressure.max())
        case "tau1_max_depth":
            return answer.stress.spacing
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


def _differences(
    answer: Answer, level: Level, problem: Problem, friction: float, window: Window | None
) -> dict[str, float]:
    """(answer - level) / level of every figure that both have, and the norms."""
    stress, other = answer.stress, level.stress
    tau1 = None
    if stress is not None and stress.friction == friction and other is not None:
        tau1 = stress.field.tau1
        tau1 = tau1 if np.isfinite(tau1).mean() >= COVERED else None
    differences = pair_norms(
        (answer.on(level.grid.x), level.solution.pressure),
        (tau1, None if other is None else other.tau1),
        window,
    )
    reference = values_of(level, problem)
    values = figures_of_answer(answer, problem, friction)
    both = {name: value for name, value in values.items() if name in reference}
    differences |= relative_differences(both, reference, problem)
    return {name: differences[name] for name in COMPARED if name in differences}


def _validation(
    case: Case,
    measured: Mapping[str, float],
    u_data: float,
    scattered: Figures,
) -> Iterator[dict]:
    """Rows by model and quantity.

    measured   the data's figures by quantity, SI; `u_data` is their relative scatter
    scattered  the half-plane's by uncertain inputs; where one is not known, u_input is None and
               counts as none"""
    friction = case.friction
    for name, run in case.runs.items():
        stated = uncertainties(run, case.problem)
        for quantity, value in values_of(run.finest, case.problem).items():
            if not measured.get(quantity):
                continue
            ratio, inputs = value / measured[quantity], scattered.one(quantity=quantity)
            u_num = abs(ratio) * stated[quantity].total
            u_input = abs(ratio) * by_inputs(inputs) if inputs else None
            u_val = math.hypot(u_num, u_input or 0.0, u_data)
            row = {"quantity": quantity, "friction": friction, "model": name, "E": ratio - 1.0}
            yield row | {"u_num": u_num, "u_input": u_input, "u_D": u_data, "u_val": u_val}
