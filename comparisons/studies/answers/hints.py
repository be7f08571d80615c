"""Hints on why an answer's pressures differ: other axes, signs, units, a factor of two.

Each explanation is tried on the pressures. It is named where the relative L2 norm of the difference
that it leaves is at most EXPLAINS of that before, and no other leaves clearly less. Units and signs
come first, since nothing else can be seen before them."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.optimize import minimize_scalar

from analytic.contact.problem import ContactError
from comparisons.judging.rule import relative_l2
from comparisons.models.level import Level
from comparisons.models.operators import operator_of, pressed_on
from comparisons.models.problem import Problem
from comparisons.studies.answers.answer import Answer

DISTINCT = 0.02  # relative L2 norm of a difference that asks for an explanation
EXPLAINS = 0.25  # of it: what an explanation may leave
# An explanation that leaves little more than the best, and is simpler.
AS_WELL, ROUNDING = 1.1, 1e-3
ANOTHER = 0.5  # relative L2 norm of a difference that something must explain
UNITS = {
    "length": {-3: "nm", -2: "µm", -1: "mm", 0: "m", 1: "km"},
    "stress": {0: "Pa", 1: "kPa", 2: "MPa", 3: "GPa"},
}
FARTHEST = 2.0  # extents of the contact: a shift that is searched
TRIED = 400  # shifts, before the best is refined
PROBLEMS = (  # with another load, or another radius
    ("load", 2.0, "twice the load"),
    ("load", 0.5, "half the load"),
    ("radius", 2.0, "the roller's diameter for its radius (or half of E*)"),
    ("radius", 0.5, "half of the roller's radius (or twice E*)"),
)


@dataclass(frozen=True)
class Hint:
    """Hint on a difference in the pressures: its kind, by how much [SI], in words, and the relative
    L2 norm of the difference that it leaves."""

    kind: str
    value: float
    text: str
    left: float


def hints(answer: Answer, problem: Problem, level: Level) -> tuple[Hint, ...]:
    """Hints that explain the difference of an answer's pressures to a model's, if there are any."""
    before, named = _off(answer, level), []
    if before <= DISTINCT:
        return ()
    if -answer.pressure.min() > answer.pressure.max():
        answer = _times(answer, 1.0, -1.0)
        named.append(Hint("sign", -1.0, "the other sign of the pressures", _off(answer, level)))
    sizes = {
        "length": np.ptp(_ends(level.grid.x, level.solution.pressure))
        / max(np.ptp(_ends(answer.x, answer.pressure)), 1e-300),
        "stress": level.solution.pressure.max() / answer.pressure.max(),
    }
    powers = {kind: round(np.log10(size) / 3.0) for kind, size in sizes.items()}
    answer = _times(answer, *(10.0 ** (3 * power) for power in powers.values()))
    now = _off(answer, level)
    for kind, power in powers.items():
        text = f"a factor of 1e{3 * power} in the {kind} unit"
        if power in UNITS[kind]:
            text = f"a {kind} unit of {UNITS[kind][power]} in place of the SI unit"
        named += [Hint(f"{kind} unit", 10.0 ** (3 * power), text, now)] if power else []
    tried = [*_moved(answer, problem, level), *_other_problems(answer, problem, level)]
    least = min(hint.left for hint in tried)
    best = next(hint for hint in tried if hint.left <= AS_WELL * least + ROUNDING)
    if now > DISTINCT and best.left <= EXPLAINS * now:
        named.append(best)
    if named and min(hint.left for hint in named) <= max(EXPLAINS * before, DISTINCT):
        return tuple(replace(hint, text=f"{hint.text} explains it") for hint in named)
    text = "no other axes, sign, unit or factor of two explains it: another contact"
    return (Hint("unexplained", before, text, before),) if before > ANOTHER else ()


def _off(answer: Answer, level: Level, shift: float = 0.0) -> float:
    """Relative L2 norm of the difference to a level that lies `shift` [m] towards -x."""
    return relative_l2(answer.on(level.grid.x + shift), level.solution.pressure)


def _times(answer: Answer, length: float, pressure: float) -> Answer:
    """Stretched along x, mirrored by a negative length."""
    way = 1 if length > 0.0 else -1
    return replace(answer, x=length * answer.x[::way], pressure=pressure * answer.pressure[::way])


def _ends(x: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """First and last contact [m]."""
    return x[pressure > 0.0][[0, -1]]


def _moved(answer: Answer, problem: Problem, level: Level) -> Iterator[Hint]:
    """Other axes, and a factor of two in the pressures."""
    mirrored = _times(answer, -1.0, 1.0)
    for kind, words, turned in (("", "", answer), ("mirrored ", "mirrored in x, ", mirrored)):
        if kind:
            yield Hint("mirrored", -1.0, "mirrored in x", _off(turned, level))
        shift = _shift(turned, level)
        text = f"{words}shifted by {shift / problem.hertz.half_width:.3g} a"
        yield Hint(f"{kind}shift", shift, text, _off(turned, level, shift))
    for factor, words in ((2.0, "twice"), (0.5, "half")):
        left = _off(_times(answer, 1.0, 1.0 / factor), level)
        yield Hint("factor", factor, f"{words} the pressure", left)
    nearest, farthest = np.sort(np.abs(_ends(answer.x, answer.pressure)))
    if nearest < 0.1 * farthest:  # one side alone
        x = level.grid.x
        beside = np.where(np.abs(x) < 0.5 * level.grid.pitch, 0.0, mirrored.on(x))
        left = relative_l2(answer.on(x) + beside, level.solution.pressure)
        yield Hint("half model", 0.5, "half of the model alone", left)


def _shift(answer: Answer, level: Level) -> float:
    """Shift [m] of the answer towards +x of a level."""
    ends = _ends(level.grid.x, level.solution.pressure)
    middle, reach = _ends(answer.x, answer.pressure).mean() - ends.mean(), FARTHEST * np.ptp(ends)
    tried = np.append(np.linspace(-0.5, 0.5, TRIED) * reach, 0.0) + np.array([[0.0], [middle]])
    left = partial(_off, answer, level)
    start, step = min(tried.ravel(), key=left), 1.5 * reach / TRIED
    bounds, options = (start - step, start + step), {"xatol": 1e-3 * step}
    return float(minimize_scalar(left, bounds=bounds, method="bounded", options=options).x)


def _other_problems(answer: Answer, problem: Problem, level: Level) -> Iterator[Hint]:
    """The scene with twice or half its load, or its radius, on the half-plane."""
    load, radius, grid = problem.hertz.load_per_length, problem.scene.roller.radius, level.grid
    operator = operator_of(problem, grid, frozenset())
    for kind, factor, words in PROBLEMS:
        fields = {"roller.radius": factor * radius} if kind == "radius" else {}
        changed = replace(problem, scene=problem.scene.unchecked(fields))
        constraints = problem.constraints(factor * load if kind == "load" else load)
        with suppress(ContactError):  # more than the hardness carries
            solution = pressed_on(changed, grid, operator, constraints)
            yield Hint(kind, factor, words, _off(answer, replace(level, solution=solution)))
