"""Which model suffices where no whole is solved: by estimates that bound what a model leaves out.

In: the half-plane alone. Out: rungs up to it, to what an operator carries, or to its deformed
surface. The dearest of them is the reference, and the estimates of all that it leaves out are a
part of every error's uncertainty, added up: so a rung may hold, or be refuted by a better one, and
nothing is said of the whole that an estimate does not bound."""

from collections.abc import Mapping
from math import inf
from time import perf_counter

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Findings
from comparisons.figures.quantity import QUANTITIES, WHOLE
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.smooth import closed_form
from comparisons.studies.contact import uncertainties, values_of
from comparisons.studies.friction import coupling
from comparisons.studies.ladder.operators import (
    carried,
    carried_deformed,
    why_no_stresses,
    words_of,
)
from comparisons.studies.ladder.rungs import (
    DEFORMED,
    HALF_PLANE,
    HERTZ,
    KINDS,
    OPERATORS,
    Rung,
    closed_form_words,
    cost_of,
    hertz_quantities,
    operator_runs,
    verdict_of,
)
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.estimates import Sizes, beyond_second_order, estimates
from comparisons.studies.study import LADDER, Solved
from comparisons.studies.subsurface.yielding import FlowAssessment

Values = dict[float, dict[str, float]]  # [SI] by friction coefficient and quantity


def estimated_rungs(
    solved: Solved, before: Mapping[str, Findings], flow: FlowAssessment, tasks: Tasks
) -> list[Rung]:
    """From the cheapest on, as far as the scene's budget goes."""
    problem, half_plane = solved.problem, solved.runs[HALF_PLANE]
    sizes = sizes_of(solved, before)
    began = perf_counter()
    smooth, frictions = closed_form(problem) is not None, problem.scene.load.friction
    hertz = {mu: _hertz(solved, mu) for mu in frictions} if smooth else {}
    seconds = perf_counter() - began
    runs = dict.fromkeys(problem.scene.load.friction, half_plane)
    values, left = _values(solved, runs), list(sizes.values())
    figures = _figures(solved, HALF_PLANE, values, (runs, values), left)
    rungs, (rung, held) = [], _better(solved, sizes, flow)
    if held and verdict_of(figures) != "holds":
        better = operator_runs(problem, held, half_plane, solved.window, tasks)
        if better is not None:
            runs, left = better, [size for name, size in sizes.items() if name not in held]
            if rung == DEFORMED:
                left.append(beyond_second_order(problem, _peak(half_plane)))
            reference = runs, _values(solved, runs)
            judged = _figures(solved, rung, reference[1], reference, left)
            rungs = [Rung(rung, rung, words_of(held), judged, *cost_of(runs), held)]
            figures = _figures(solved, HALF_PLANE, values, reference, left)
    reference = runs, _values(solved, runs)
    cost = sum(half_plane.seconds.values()), half_plane.finest.peak_memory
    rungs.insert(0, Rung(HALF_PLANE, HALF_PLANE, KINDS[HALF_PLANE], figures, *cost))
    if smooth:
        by_hertz = _figures(solved, HERTZ, hertz, reference, left)
        words = closed_form_words(problem)
        rungs.insert(0, Rung(HERTZ, HERTZ, words, by_hertz, seconds, 0.0))
    return rungs


def hertz_alone(problem: Problem) -> tuple[bool, str]:
    """Whether the closed form is known to hold where nothing is solved, and a line that says so: of
    a smooth surface everything else is bounded by estimates."""
    tolerances, line = problem.scene.tolerances, "cheapest that holds: "
    if problem.scene.profile is not None or problem.coupling:
        what = "roughness" if problem.scene.profile is not None else "coupling (load.coupled)"
        return False, f"{line}not known: no estimate bounds what the {what} does"
    if not tolerances:
        return False, f"{line}not known: no quantity is judged"
    peak = problem.hertz.peak_pressure
    every = estimates(problem, peak, peak, ()).items()
    applying = [sizes for name, sizes in every if EFFECTS[name].applies(problem)]
    bounds = {name: sum(sizes.get(name, 0.0) for sizes in applying) for name in tolerances}
    worst = max(bounds, key=lambda name: bounds[name] / tolerances[name])
    said = f"{QUANTITIES[worst].short} 0 +- {100.0 * bounds[worst]:.2g}%, by estimates"
    if bounds[worst] <= tolerances[worst]:
        return True, f"{line}{KINDS[HERTZ]} ({said})"
    return False, f"{line}not known up to {KINDS[HERTZ]} ({said})"


def _better(
    solved: Solved, sizes: Mapping[str, Sizes], flow: FlowAssessment
) -> tuple[str, frozenset[str]]:
    """The best rung that the budget allows beyond the half-plane, and what it has; nothing where
    there is none."""
    problem, up_to = solved.problem, solved.problem.scene.budget.up_to
    deformed = carried_deformed(problem, sizes)
    if deformed and up_to not in ("half-plane", "operators") and not flow.beyond_doubt:
        return DEFORMED, deformed
    possible = up_to != "half-plane" and why_no_stresses(problem, solved.window) is None
    return OPERATORS, carried(problem, sizes, flow) if possible else frozenset()


def _peak(run: ModelRun) -> float:
    return float(run.finest.solution.pressure.max())


def sizes_of(solved: Solved, before: Mapping[str, Findings]) -> dict[str, Sizes]:
    """Estimates of all that the half-plane leaves out, by effect and quantity."""
    problem, pressure = solved.problem, solved.runs[HALF_PLANE].finest.solution.pressure
    known = before.get(coupling.NAME)
    moved = () if known is None or known.data is None else known.data.changes
    mean = float(pressure @ pressure / pressure.sum())
    every = estimates(problem, float(pressure.max()), mean, (), moved)
    return {name: sizes for name, sizes in every.items() if EFFECTS[name].applies(problem)}


def _values(solved: Solved, runs: Mapping[float, ModelRun]) -> Values:
    return {mu: values_of(run.finest, solved.problem, mu) for mu, run in runs.items()}


def _hertz(solved: Solved, friction: float) -> dict[str, float]:
    [known] = hertz_quantities(
        solved.problem, [solved.runs[HALF_PLANE].finest.grid.x], friction, solved.window
    )
    return {name: float(value[0]) for name, value in known.figures.items()}


def _figures(
    solved: Solved,
    rung: str,
    values: Values,
    reference: tuple[Mapping[float, ModelRun], Values],
    left: list[Sizes],
) -> tuple[Figure, ...]:
    """Errors against the whole, as far as the reference and estimates of what it leaves out tell;
    of norms, which take two models, nothing is known."""
    made, (runs, best) = [], reference
    for friction, known in values.items():
        stated = uncertainties(runs[friction], solved.problem, friction)
        for name, tolerance in solved.problem.scene.tolerances.items():
            parts = {"numerical": inf}
            difference, scale = 0.0, 1.0
            if name in stated:
                scale = abs(best[friction][name]) or QUANTITIES[name].scale(solved.problem.hertz)
                difference = (known[name] - best[friction][name]) / scale
                bound = sum(sizes.get(name, 0.0) for sizes in left)
                grown = (1.0 + abs(difference)) * bound / (1.0 - bound) if bound < 1.0 else inf
                parts = {"numerical": stated[name].total, "effects": grown}
            made.append(
                Figure(
                    study=LADDER,
                    quantity=name,
                    source=rung,
                    value=difference,
                    at={"friction": friction},
                    against=WHOLE,
                    scale=scale,
                    uncertainty=Uncertainty(parts),
                    bounds=(-tolerance, tolerance),
                )
            )
    return tuple(made)
