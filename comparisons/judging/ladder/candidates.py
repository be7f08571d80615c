"""The analytic models that a run may judge beside its own: half-planes with some of the effects.

A new one is an entry of CANDIDATES: the ladder then says whether it suffices, `crosscheck cost`
what it takes."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.tasks import LAST, Tasks
from comparisons.judging.study import Solved
from comparisons.models.analytic import CAP
from comparisons.models.level import Solution
from comparisons.models.model import Model
from comparisons.models.operators import LAYERS, is_layered, layered_body
from comparisons.models.problem import COUPLED, TABOR, Problem

Effects = frozenset[str]
NONE: Effects = frozenset()
THINNEST = 1.0 / 40.0  # of the search window's reach: layers whose stresses are worth their waves
WORDS = {
    "finite_size": "layer",
    "coating": "coating",
    COUPLED: "coupling",
    "exact_circle": "exact circle",
    CAP: f"pressures up to {TABOR:g} Y",
}


@dataclass(frozen=True)
class Candidate:
    """One model."""

    name: str  # source of its figures
    label: str  # where costs are compared
    # which of the effects it has in a problem, under the half-plane's largest pressure [Pa]; none
    # where it cannot be solved, or is the half-plane
    carries: Callable[[Problem, Effects, float], Effects]
    # whether finite elements with the same effects solve the same problem
    has_elements: bool = True


def _by_operator(problem: Problem, effects: Effects, peak: float) -> Effects:
    """Effects that an operator and a gap can have; with `CAP` where the body yields."""
    scene, body = problem.scene, problem.scene.body
    if scene.periodic or why_no_stresses(problem) is not None:
        return NONE
    held = effects & (LAYERS | {COUPLED, "exact_circle"})
    held -= {"finite_size"} if body.thickness is None else NONE
    yields = body.yield_stress is not None and body.hardness is None
    return held | {CAP} if yields and peak > TABOR * body.yield_stress else held


def _deformed(problem: Problem, effects: Effects, peak: float) -> Effects:
    """Effects that the half-plane has on its deformed surface: what is quadratic there is known of
    elastic half-planes alone. Friction moves these surfaces as it does the whole model's."""
    scene = problem.scene
    bounded = is_layered(scene) or scene.periodic or scene.body.width is not None
    if "finite_strain" not in effects or "plastic_flow" in effects or bounded:
        return NONE
    moves = any(scene.load.friction) and problem.dundurs_beta != 0.0
    return effects & {"finite_strain", "exact_circle"} | ({COUPLED} if moves else NONE)


OPERATORS = "operators"
CANDIDATES = (
    Candidate(OPERATORS, "layered", _by_operator),
    Candidate("deformed", "deformed", _deformed, has_elements=False),
)


def words_of(held: Effects) -> str:
    """A half-plane with effects."""
    where = "half-plane on the deformed surface" if "finite_strain" in held else "half-plane"
    beside = ", ".join(words for name, words in WORDS.items() if name in held)
    return f"{where} with {beside}" if beside else where


def why_no_stresses(problem: Problem) -> str | None:
    """Why there are no stresses of a layered body, or None."""
    body = layered_body(problem.scene)
    if problem.window is None or body is None or body.thickness > THINNEST * np.ptp(problem.extent):
        return None
    return "the layer is too thin for the waves of its stresses"


def announce(solved: Solved, held: Effects, levels: int, tasks: Tasks) -> list[str]:
    """The keys of the tasks that solve the half-plane with some of the effects."""
    model = Model(f"{OPERATORS}-{'+'.join(sorted(held))}", "analytic", held, label=words_of(held))
    numbers = range(1, levels + 1)
    return [model.announce(tasks, solved.problem, number, urgency=LAST) for number in numbers]


def solutions(solved: Solved, held: Effects, tasks: Tasks) -> dict[float, Solution] | None:
    """The half-plane with some of the effects, by friction coefficient, on the pressure elements of
    the finite elements; None where it has no solution."""
    keys = announce(solved, held, len(solved.runs["finite_element"].levels), tasks)
    try:
        levels = list(map(tasks.result, keys))
    except ContactError:  # with a hardness the contact needs more than the pressures' extent
        return None
    if not all(level.converged for of_pitch in levels for level in of_pitch.values()):
        return None
    frictions = [case.friction for case in solved.cases]
    return {mu: Solution(OPERATORS, tuple(of_pitch[mu] for of_pitch in levels)) for mu in frictions}
