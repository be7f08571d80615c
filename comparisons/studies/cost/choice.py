"""What to take: the rows that nothing beats, and the cheapest setting for each tolerance."""

from collections.abc import Iterable
from dataclasses import dataclass

from comparisons.common.numbers import given_percent, integer, percent, with_unit
from comparisons.common.quantities import QUANTITIES
from comparisons.models.finite_element.mesh import COARSER_GROWTH, STEEPEST_GROWTH
from comparisons.models.problem import FEWEST_ELEMENTS, Problem
from comparisons.studies.cost.methods import FINEST, METHODS
from comparisons.studies.cost.reference import Reference
from comparisons.studies.cost.study import OK, Row, Study

ALL = "all"
# What `run` solves with, and can be told to by the scene.
IN_RUN = (FINEST.name, "P1", "P2", "P3")


@dataclass(frozen=True)
class Assessed:
    """A row with its errors by quantity, relative; None where the row has none, or is itself what
    it would be measured by."""

    row: Row
    errors: dict[str, float | None]

    def worst(self, floors: dict[str, float], tolerances: dict[str, float]) -> float | None:
        """Largest error with its floor over its tolerance; None where one is unknown."""
        found = [self.errors.get(name) for name in tolerances]
        if any(error is None for error in found):
            return None
        pairs = zip(found, tolerances.items(), strict=True)
        return max((error + floors[name]) / tolerance for error, (name, tolerance) in pairs)


@dataclass(frozen=True)
class Choice:
    """For one tolerance, or for all at once, the cheapest row of each model that `run` has, and
    the cheapest of all; None where nothing meets it."""

    quantity: str
    tolerance: float | None
    half_plane: Assessed | None
    finite_element: Assessed | None
    cheapest: Assessed | None
    sentence: str


def needs_stress(quantities: Iterable[str]) -> bool:
    """Whether any of them takes the stresses."""
    return any(QUANTITIES[name].needs_stress for name in quantities)


def pareto(assessed: list[Assessed], quantity: str, floor: float) -> list[Assessed]:
    """Rows than which none is both cheaper and closer, from cheap to dear."""
    stresses, best, found = needs_stress([quantity]), float("inf"), []
    known = [a for a in assessed if a.row.status == OK and a.errors.get(quantity) is not None]
    for each in sorted(known, key=lambda a: a.row.seconds(stresses)):
        error = max(each.errors[quantity], floor)
        if error < best:
            best = error
            found.append(each)
    return found


def choices(
    study: Study,
    assessed: list[Assessed],
    references: dict[str, Reference],
    tolerances: dict[str, float],
) -> list[Choice]:
    """One for each tolerance of the scene, and one for all of them together."""
    floors = {name: reference.floor for name, reference in references.items()}
    known = {name: value for name, value in tolerances.items() if name in floors}
    found = [_choice(assessed, floors, {name: value}) for name, value in known.items()]
    return found + ([_choice(assessed, floors, known)] if len(known) > 1 else [])


def _choice(
    assessed: list[Assessed], floors: dict[str, float], tolerances: dict[str, float]
) -> Choice:
    def cheapest(names: Iterable[str]) -> Assessed | None:
        candidates = [
            each for name in names for each in _meeting(assessed, name, floors, tolerances)
        ]
        stresses = needs_stress(tolerances)
        return min(candidates, key=lambda a: a.row.seconds(stresses), default=None)

    one, finite = cheapest([FINEST.name]), cheapest(IN_RUN[1:])
    best = cheapest([method.name for method in METHODS])
    name, tolerance = ALL, None
    if len(tolerances) == 1:
        [(name, tolerance)] = tolerances.items()
    sentence = _sentence(tolerances, floors, one, finite, best)
    return Choice(name, tolerance, one, finite, best, sentence)


def _meeting(
    assessed: list[Assessed], name: str, floors: dict[str, float], tolerances: dict[str, float]
) -> list[Assessed]:
    """Rows of a method that meet the tolerances as all finer ones do: not by chance."""
    found = []
    for each in reversed([a for a in assessed if a.row.method.name == name]):
        if each.row.status != OK:
            continue
        worst = each.worst(floors, tolerances)
        if worst is None:  # itself the reference
            continue
        if worst > 1.0:
            break
        found.append(each)
    return found


def followed(row: Row, problem: Problem) -> dict[str, dict]:
    """The sections of a scene whose first levels end at a row's setting.

    Three of them, which state an uncertainty; two where the coarsest of three would be too coarse.
    Elements grow at that level as they did when it was measured; in a stress window they are as
    small as on the scene's own third level. `run` refines on only while a tolerance is open.
    """
    levels = 3
    low, high = problem.extent
    while high - low < FEWEST_ELEMENTS * row.setting * 2.0 ** (levels - 1) and levels > 2:
        levels -= 1
    sections: dict[str, dict] = {
        "resolution": {"pitch": row.setting * 2.0 ** (levels - 1), "levels": levels}
    }
    if row.method.model == "finite_element":
        growth = problem.scene.finite_element.growth * COARSER_GROWTH ** problem.coarser(
            row.setting
        )
        growth = min(growth, STEEPEST_GROWTH) / COARSER_GROWTH ** (3 - levels)
        sections["finite_element"] = {
            "element": row.method.element,
            "growth": float(f"{growth:.4g}"),
        }
    return sections


def _sentence(
    tolerances: dict[str, float],
    floors: dict[str, float],
    one: Assessed | None,
    finite: Assessed | None,
    best: Assessed | None,
) -> str:
    aim = "all tolerances of the scene"
    if len(tolerances) == 1:
        [(name, tolerance)] = tolerances.items()
        aim = f"{given_percent(tolerance)} of the {QUANTITIES[name].label}"
    unclear = [name for name, tolerance in tolerances.items() if floors[name] >= tolerance]
    if unclear:
        names = ", ".join(f"{QUANTITIES[n].label} ({percent(floors[n])})" for n in unclear)
        return f"For {aim} nothing can be said: the reference itself is that uncertain: {names}."
    parts = []
    if one is not None:
        parts.append(f"take the half-plane ({_taken(one, tolerances)})")
    if finite is not None:
        parts.append(
            f"{'of' if parts else 'take of'} the finite elements {_taken(finite, tolerances)}"
        )
    if not parts and best is None:
        return f"For {aim} no measured setting will do."
    missing = [
        name for name, row in (("half-plane", one), ("finite elements", finite)) if row is None
    ]
    text = f"For {aim} {'; '.join(parts)}"
    if missing and parts:
        text += f"; no setting of the {' or the '.join(missing)} will do"
    if best is not None and best not in (one, finite):
        lead = "; cheapest of all is" if parts else "nothing that run has will do, but"
        text += f"{lead} {_taken(best, tolerances)}"
    return text + "."


def _taken(assessed: Assessed, tolerances: dict[str, float]) -> str:
    row = assessed.row
    seconds = row.seconds(needs_stress(tolerances))
    size = (
        ""
        if row.method.model == "half_plane"
        else (f", {integer(row.measured.answer.unknowns)} unknowns")
    )
    setting = row.label if row.method.adapted else f"at a pitch of {row.label}"
    return f"{row.method.name} {setting}{size}: expect {with_unit(seconds, 's', 2)}"
