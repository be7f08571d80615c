"""What to take: the rows on the Pareto front, and the cheapest setting for each tolerance.

In: what was measured. Out: every row with its errors, and a sentence for each tolerance."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import takewhile
from operator import itemgetter

from comparisons.campaigns.cost.measure import OK, CostRow, measuring_machine
from comparisons.campaigns.cost.methods import DEFORMED, FINEST, LINEAR, OPERATOR
from comparisons.campaigns.cost.reference import Reference, errors_of, references
from comparisons.common.errors import SceneError
from comparisons.common.numbers import integer, percent, percent_as_written, with_unit
from comparisons.common.provenance import versions
from comparisons.figures.quantity import QUANTITIES
from comparisons.models.finite_element.mesh import COARSER_GROWTH, STEEPEST_GROWTH
from comparisons.models.posing import FEWEST_ELEMENTS
from comparisons.models.problem import Problem
from comparisons.models.window import window_of

ALL = "all"
RUNGS = (OPERATOR, DEFORMED, LINEAR)  # models that `run` compares beside the scene's own
ELEMENTS_OF_RUN = ("P1", "P2", "P3")  # finite elements that a scene can have `run` solve with

Tolerances = dict[str, float]


@dataclass(frozen=True)
class Recommendation:
    """For one tolerance, or for all at once, the cheapest row of each model that `run` can solve
    with, and the cheapest of all; None where none meets it."""

    quantity: str
    tolerance: float | None
    half_plane: CostRow | None
    finite_element: CostRow | None
    cheapest: CostRow | None
    sentence: str


@dataclass(frozen=True)
class Cost:
    """A finished study."""

    problem: Problem
    rows: list[CostRow]  # with their errors
    references: dict[str, Reference]  # by quantity
    # the rows on the Pareto front by quantity, the cheapest first
    fronts: dict[str, list[CostRow]]
    recommendations: list[Recommendation]  # one a tolerance, the last one for all of them
    versions: dict
    machine: dict


def assess(problem: Problem, measured: list[CostRow]) -> Cost:
    """Errors, Pareto fronts and recommendations of what was measured. Raises SceneError without a
    reference."""
    scene = problem.scene
    window = window_of(problem) if scene.stress is not None else None
    known = references(problem, measured, window)
    if not known:
        failed = next((row.because for row in measured if row.because), "nothing was solved")
        raise SceneError(f"{scene.source}: there is no reference for errors: {failed}")
    rows = [replace(row, errors=errors_of(row, known)) for row in measured]
    floors = {name: reference.floors[name] for name, reference in known.items()}
    return Cost(
        problem=problem,
        rows=rows,
        references=known,
        fronts={name: pareto(rows, name, floor) for name, floor in floors.items()},
        recommendations=recommendations(rows, floors, scene.tolerances),
        versions=versions(),
        machine=measuring_machine(),
    )


def needs_stress(quantities: Iterable[str]) -> bool:
    return any(QUANTITIES[name].needs_stress for name in quantities)


def pareto(rows: list[CostRow], quantity: str, floor: float) -> list[CostRow]:
    """Rows than which none is both cheaper and closer, the cheapest first."""
    stresses, best, front = needs_stress([quantity]), float("inf"), []
    known = [row for row in rows if row.status == OK and quantity in row.errors]
    for row in sorted(known, key=lambda row: row.seconds(stresses)):
        error = max(row.errors[quantity].value, floor)
        if error < best:
            best = error
            front.append(row)
    return front


def recommendations(
    rows: list[CostRow], floors: dict[str, float], tolerances: Tolerances
) -> list[Recommendation]:
    """By quantities of a known floor of errors; at last for all of them."""
    known = {name: value for name, value in tolerances.items() if name in floors}
    aims = [{name: value} for name, value in known.items()] + [known] * (len(known) > 1)
    return [_recommendation(rows, floors, aim) for aim in aims]


def _recommendation(
    rows: list[CostRow], floors: dict[str, float], aim: Tolerances
) -> Recommendation:
    stresses = needs_stress(aim)
    judged = [(row, row.meets(aim)) for row in rows if row.status == OK]

    def cheapest(candidates: Iterable[CostRow]) -> CostRow | None:
        return min(candidates, key=lambda row: row.seconds(stresses), default=None)

    def steady(*names: str) -> CostRow | None:
        """The cheapest of methods that meets the tolerances as all finer ones do: not by chance."""
        candidates = []
        for name in names:
            finest_first = reversed([pair for pair in judged if pair[0].method.name == name])
            # None: itself the reference
            known = (pair for pair in finest_first if pair[1] is not None)
            candidates += [row for row, _ in takewhile(itemgetter(1), known)]
        return cheapest(candidates)

    half_plane, finite_element = steady(FINEST.name), steady(*ELEMENTS_OF_RUN)
    best = steady(*dict.fromkeys(row.method.name for row, _ in judged))
    below = float("inf") if best is None else best.seconds(stresses)
    lucky = cheapest(row for row, meets in judged if meets and row.seconds(stresses) < below)
    name, tolerance = next(iter(aim.items())) if len(aim) == 1 else (ALL, None)
    sentence = _sentence(aim, floors, lucky, half_plane, finite_element, best)
    return Recommendation(name, tolerance, half_plane, finite_element, best, sentence)


def scene_sections(row: CostRow, problem: Problem) -> dict[str, dict]:
    """The sections of a scene whose first levels end at a row's setting. There are three levels,
    which state an uncertainty, or two where the coarsest of three would be too coarse. The mesh
    grows at that level as it did when it was measured; in a stress window its elements are as small
    as on the scene's own third level. `run` refines on only while a tolerance is open."""
    low, high = problem.extent
    levels = 2 if high - low < FEWEST_ELEMENTS * row.setting * 4.0 else 3
    sections = {"resolution": {"pitch": row.setting * 2.0 ** (levels - 1), "levels": levels}}
    if row.method.model == "finite_element":
        coarser = problem.coarser(row.setting)
        growth = problem.scene.finite_element.growth * COARSER_GROWTH**coarser
        growth = min(growth, STEEPEST_GROWTH) / COARSER_GROWTH ** (3 - levels)
        finite_element = {"element": row.method.element, "growth": float(f"{growth:.4g}")}
        sections["finite_element"] = finite_element
    return sections


def _sentence(
    tolerances: Tolerances,
    floors: dict[str, float],
    lucky: CostRow | None,
    *rows: CostRow | None,
) -> str:
    """What to take, and why not the cheapest row.

    lucky  a cheaper row that meets the tolerances by chance
    rows   the cheapest half-plane, the cheapest finite elements, the cheapest of all"""
    half_plane, finite_element, best = rows
    aim = "all tolerances of the scene"
    if len(tolerances) == 1:
        [(name, tolerance)] = tolerances.items()
        aim = f"{percent_as_written(tolerance)} of the {QUANTITIES[name].label}"
    uncertain = [name for name, tolerance in tolerances.items() if floors[name] >= tolerance]
    if uncertain:
        names = ", ".join(f"{QUANTITIES[n].label} ({percent(floors[n])})" for n in uncertain)
        return f"For {aim} nothing can be said: the reference itself is that uncertain: {names}."
    chance = "" if lucky is None else f"{_words(lucky, tolerances)}, but a finer one does not"
    if best is None:
        met = f"; by chance it is met by {chance}" if chance else ""
        return f"For {aim} no measured setting will do{met}."
    parts = []
    if half_plane is not None:
        parts.append(f"take the half-plane ({_words(half_plane, tolerances)})")
    if finite_element is not None:
        lead = "of" if parts else "take of"
        parts.append(f"{lead} the finite elements {_words(finite_element, tolerances)}")
    pairs = (("half-plane", half_plane), ("finite elements", finite_element))
    missing = [name for name, row in pairs if row is None]
    if missing and parts:
        parts.append(f"no setting of the {' or the '.join(missing)} will do")
    if best not in (half_plane, finite_element):
        lead = "cheapest of all is" if parts else "nothing that run has will do, but"
        parts.append(f"{lead} {_words(best, tolerances)}")
        if lead.startswith("cheapest"):
            rung = best.method.element
            how = "run compares it" if rung in RUNGS else "run cannot solve by it"
            parts[-1] += f" ({how})"
    if chance:
        parts.append(f"by chance it is met cheaper by {chance}")
    return f"For {aim} {'; '.join(parts)}."


def _words(row: CostRow, tolerances: Tolerances) -> str:
    seconds = row.seconds(needs_stress(tolerances))
    setting = f"at a pitch of {row.label}"
    if row.method.model == "finite_element":
        setting += f", {integer(row.measured.level.unknowns)} unknowns"
    return f"{row.method.name} {setting}: expect {with_unit(seconds, 's', 2)}"
