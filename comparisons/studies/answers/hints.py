"""What would explain that an answer's pressures differ: other axes, signs, units, a factor of two.

Each explanation is tried on the pressures. It is named where the relative L2 norm of the difference
that it leaves is at most EXPLAINS of that before, and no other leaves clearly less. Units and signs
come first, since nothing else can be seen before them."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from analytic.contact.problem import ContactError
from comparisons.judging.comparison import relative_l2
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
    """What explains a difference in the pressures: its kind, by how much [SI], in words, and the
    relative L2 norm of the difference that it leaves."""

    kind: str
    value: float
    text: str
    left: float


@dataclass(frozen=True)
class Curve:
    """Pressures (n,) [Pa] at x (n,) [m], zero beyond."""

    x: np.ndarray
    pressure: np.ndarray

    def on(self, x: np.ndarray) -> np.ndarray:
        return np.interp(x, self.x, self.pressure, left=0.0, right=0.0)

    def off(self, reference: "Curve", shift: float = 0.0) -> float:
        """Relative L2 norm of the difference to a reference that lies `shift` [m] towards -x."""
        return relative_l2(self.on(reference.x + shift), reference.pressure)

    def times(self, length: float, pressure: float) -> "Curve":
        """Stretched along x, mirrored by a negative length."""
        way = 1 if length > 0.0 else -1
        return Curve(length * self.x[::way], pressure * self.pressure[::way])

    @property
    def ends(self) -> np.ndarray:
        """First and last contact [m]."""
        return self.x[self.pressure > 0.0][[0, -1]]


def hints(answer: Answer, problem: Problem, level: Level) -> tuple[Hint, ...]:
    """What explains the difference of an answer's pressures to a model's, where there is one."""
    reference = Curve(level.grid.x, level.solution.pressure)
    curve = Curve(answer.x, np.where(answer.touching, answer.pressure, 0.0))
    before, named = curve.off(reference), []
    if before <= DISTINCT:
        return ()
    if -answer.pressure.min() > answer.pressure.max():
        curve = Curve(answer.x, np.maximum(-answer.pressure, 0.0))
        named.append(Hint("sign", -1.0, "the other sign of the pressures", curve.off(reference)))
    units = _units(curve, reference)
    curve = curve.times(units["length"], units["stress"])
    now = curve.off(reference)
    for kind, factor in units.items():
        power = round(np.log10(factor) / 3.0)
        text = f"a factor of 1e{3 * power} in the {kind} unit"
        if power in UNITS[kind]:
            text = f"a {kind} unit of {UNITS[kind][power]} in place of the SI unit"
        named += [Hint(f"{kind} unit", factor, text, now)] if power else []
    tried = [*_moved(curve, problem, reference), *_other_problems(curve, problem, level)]
    least = min(hint.left for hint in tried)
    best = next(hint for hint in tried if hint.left <= AS_WELL * least + ROUNDING)
    if now > DISTINCT and best.left <= EXPLAINS * now:
        named.append(best)
    if named and min(hint.left for hint in named) <= max(EXPLAINS * before, DISTINCT):
        return tuple(replace(hint, text=f"{hint.text} explains it") for hint in named)
    text = "no other axes, sign, unit or factor of two explains it: another contact"
    return (Hint("unexplained", before, text, before),) if before > ANOTHER else ()


def _units(curve: Curve, reference: Curve) -> dict[str, float]:
    """Powers of a thousand that bring lengths and pressures next to the reference's."""
    extents = [max(np.ptp(one.ends), 1e-300) for one in (reference, curve)]
    peaks = reference.pressure.max(), curve.pressure.max()
    sizes = {"length": extents, "stress": peaks}
    return {n: 10.0 ** (3 * round(np.log10(one / own) / 3.0)) for n, (one, own) in sizes.items()}


def _moved(curve: Curve, problem: Problem, reference: Curve) -> Iterator[Hint]:
    """Other axes, and a factor of two in the pressures."""
    mirrored = curve.times(-1.0, 1.0)
    for kind, words, turned in (("", "", curve), ("mirrored ", "mirrored in x, ", mirrored)):
        if kind:
            yield Hint("mirrored", -1.0, "mirrored in x", turned.off(reference))
        shift = _shift(turned, reference)
        text = f"{words}shifted by {shift / problem.hertz.half_width:.3g} a"
        yield Hint(f"{kind}shift", shift, text, turned.off(reference, shift))
    for factor, words in ((2.0, "twice"), (0.5, "half")):
        left = curve.times(1.0, 1.0 / factor).off(reference)
        yield Hint("factor", factor, f"{words} the pressure", left)
    nearest, farthest = np.sort(np.abs(curve.ends))
    if nearest < 0.1 * farthest:  # one side alone
        x, half = reference.x, curve.on(reference.x)
        whole = half + np.where(np.abs(x) < 0.5 * (x[1] - x[0]), 0.0, mirrored.on(x))
        left = relative_l2(whole, reference.pressure)
        yield Hint("half model", 0.5, "half of the model alone", left)


def _shift(curve: Curve, reference: Curve) -> float:
    """By how much [m] the curve lies towards +x of the reference."""
    middle, reach = curve.ends.mean() - reference.ends.mean(), FARTHEST * np.ptp(reference.ends)
    tried = np.append(np.linspace(-0.5, 0.5, TRIED) * reach, 0.0) + np.array([[0.0], [middle]])

    def left(shift: float) -> float:
        return curve.off(reference, shift)

    start, step = min(tried.ravel(), key=left), 1.5 * reach / TRIED
    bounds, options = (start - step, start + step), {"xatol": 1e-3 * step}
    return float(minimize_scalar(left, bounds=bounds, method="bounded", options=options).x)


def _other_problems(curve: Curve, problem: Problem, level: Level) -> Iterator[Hint]:
    """The scene with twice or half its load, or its radius, on the half-plane."""
    load, radius, grid = problem.hertz.load_per_length, problem.scene.roller.radius, level.grid
    operator = operator_of(problem, grid, frozenset())
    for kind, factor, words in PROBLEMS:
        fields = {"roller.radius": factor * radius} if kind == "radius" else {}
        changed = replace(problem, scene=problem.scene.unchecked(fields))
        constraints = problem.constraints(factor * load if kind == "load" else load)
        with suppress(ContactError):  # more than the hardness carries
            solution = pressed_on(changed, grid, operator, constraints)
            yield Hint(kind, factor, words, curve.off(Curve(grid.x, solution.pressure)))
