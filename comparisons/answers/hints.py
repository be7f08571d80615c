"""What would explain that an answer's pressures differ: other axes, signs, units, a factor of two.

Each explanation is tried on the pressures. It is named where the relative L2 norm of the difference
that it leaves is at most EXPLAINS of that before, and no other leaves clearly less. Units and signs
come first, since nothing else can be seen before them.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar

from analytic.contact.problem import ContactError
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane
from analytic.profile import surface
from comparisons.answers.answer import Answer, Hint
from comparisons.assessment.comparison import relative_l2
from comparisons.models.level import Level
from comparisons.models.nearest_operator import solve_on
from comparisons.models.problem import Problem

DISTINCT = 0.02  # relative L2 norm of a difference that asks for an explanation
EXPLAINS = 0.25  # of it: what an explanation may leave
AS_WELL, ROUNDING = (
    1.1,
    1e-3,
)  # an explanation that leaves little more than the best, and is simpler
ANOTHER = 0.5  # relative L2 norm of a difference that something must explain
LENGTHS = {-3: "nm", -2: "µm", -1: "mm", 0: "m", 1: "km"}
STRESSES = {0: "Pa", 1: "kPa", 2: "MPa", 3: "GPa"}
FARTHEST = 2.0  # extents of the contact: a shift that is searched
TRIED = 400  # shifts, before the best is refined


@dataclass(frozen=True)
class Curve:
    """Pressures (n,) [Pa] at x (n,) [m], zero beyond."""

    x: np.ndarray
    pressure: np.ndarray

    def on(self, x: np.ndarray) -> np.ndarray:
        return np.interp(x, self.x, self.pressure, left=0.0, right=0.0)

    def mirrored(self) -> "Curve":
        return Curve(-self.x[::-1], self.pressure[::-1])

    def times(self, length: float, pressure: float) -> "Curve":
        return Curve(length * self.x, pressure * self.pressure)

    @property
    def ends(self) -> tuple[float, float]:
        """First and last contact [m]."""
        touching = self.x[self.pressure > 0.0]
        return float(touching[0]), float(touching[-1])


def hints(answer: Answer, problem: Problem, level: Level) -> tuple[Hint, ...]:
    """What explains the difference of an answer's pressures to a model's; empty where they hardly
    differ, or nothing does."""
    grid, reference = level.grid, level.solution.pressure

    def left(curve: Curve) -> float:
        return relative_l2(curve.on(grid.x), reference)

    curve = Curve(answer.x, np.where(answer.touching, answer.pressure, 0.0))
    before = left(curve)
    if before <= DISTINCT:
        return ()
    found = []
    if -answer.pressure.min() > answer.pressure.max():
        curve = Curve(answer.x, np.maximum(-answer.pressure, 0.0))
        found.append(Hint("sign", -1.0, "the other sign of the pressures", left(curve)))
    curve, units = _in_units(curve, grid, reference)
    found += [replace(hint, left=left(curve)) for hint in units]
    now = left(curve)
    tried = [*_moved(curve, problem, grid, reference), *_other_problems(curve, problem, grid)]
    least = min(hint.left for hint in tried)
    best = next(hint for hint in tried if hint.left <= AS_WELL * least + ROUNDING)
    if now > DISTINCT and best.left <= EXPLAINS * now:
        found.append(best)
    explains = found and min(hint.left for hint in found) <= max(EXPLAINS * before, DISTINCT)
    if not explains and before > ANOTHER:
        text = "no other axes, sign, unit or factor of two explains it: another contact"
        return (Hint("unexplained", before, text, before),)
    return tuple(replace(h, text=f"{h.text} explains it") for h in found) if explains else ()


def _in_units(curve: Curve, grid: HatGrid, reference: np.ndarray) -> tuple[Curve, list[Hint]]:
    """The curve in SI, if lengths or pressures are off by powers of a thousand."""
    own = Curve(grid.x, reference)
    sizes = (
        np.ptp(own.ends) / max(np.ptp(curve.ends), 1e-300),
        reference.max() / curve.pressure.max(),
    )
    length, stress = (round(float(np.log10(size)) / 3.0) for size in sizes)
    found = []
    for kind, power, names in (("length", length, LENGTHS), ("stress", stress, STRESSES)):
        if power:
            unit = names.get(power)
            word = f"a {kind} unit of {unit} in place of the SI unit" if unit else ""
            text = word or f"a factor of 1e{3 * power} in the {kind} unit"
            found.append(Hint(f"{kind} unit", 10.0 ** (3 * power), text, 0.0))
    return curve.times(10.0 ** (3 * length), 10.0 ** (3 * stress)), found


def _moved(curve: Curve, problem: Problem, grid: HatGrid, reference: np.ndarray) -> Iterator[Hint]:
    """Other axes, and a factor of two in the pressures."""
    half_width = problem.hertz.half_width
    for kind, words, each in (("", "", curve), ("mirrored", "mirrored in x, ", curve.mirrored())):
        if kind:
            yield Hint(kind, -1.0, "mirrored in x", relative_l2(each.on(grid.x), reference))
        shift, left = _shift(each, grid, reference)
        text = f"{words}shifted by {shift / half_width:.3g} a"
        yield Hint(f"{kind} shift".strip(), shift, text, left)
    for factor in (2.0, 0.5):
        values = curve.on(grid.x) / factor
        words = "twice" if factor > 1.0 else "half"
        yield Hint("factor", factor, f"{words} the pressure", relative_l2(values, reference))
    first, last = curve.ends
    if min(abs(first), abs(last)) < 0.1 * max(abs(first), abs(last)):  # one side alone
        values = curve.on(grid.x) + curve.mirrored().on(grid.x)
        values = np.where(np.abs(grid.x) < 0.5 * grid.pitch, curve.on(grid.x), values)
        yield Hint("half model", 0.5, "half of the model alone", relative_l2(values, reference))


def _shift(curve: Curve, grid: HatGrid, reference: np.ndarray) -> tuple[float, float]:
    """By how much [m] the curve lies towards +x of the reference, and what is left without that."""

    def left(shift: float) -> float:
        return relative_l2(curve.on(grid.x + shift), reference)

    own, other = curve.ends, Curve(grid.x, reference).ends
    middle, reach = 0.5 * (sum(own) - sum(other)), FARTHEST * float(np.ptp(other))
    tried = np.append(np.linspace(-0.5, 0.5, TRIED) * reach, 0.0) + np.array([[0.0], [middle]])
    start = min(tried.ravel(), key=left)
    step = 1.5 * reach / TRIED
    bounds, options = (start - step, start + step), {"xatol": 1e-3 * step}
    found = minimize_scalar(left, bounds=bounds, method="bounded", options=options)
    return float(found.x), float(found.fun)


def _other_problems(curve: Curve, problem: Problem, grid: HatGrid) -> Iterator[Hint]:
    """The scene with twice or half its load, or its radius, on the half-plane."""
    scene, load = problem.scene, problem.hertz.load_per_length
    heights = None if scene.profile is None else surface(scene.profile)
    half_plane = HalfPlane(grid.count, grid.pitch, problem.modulus)
    for kind, factor, words in (
        ("load", 2.0, "twice the load"),
        ("load", 0.5, "half the load"),
        ("radius", 2.0, "the roller's diameter for its radius (or half of E*)"),
        ("radius", 0.5, "half of the roller's radius (or twice E*)"),
    ):
        loaded = factor * load if kind == "load" else load
        radius = factor * scene.roller_radius if kind == "radius" else scene.roller_radius
        gap = grid.hat_integrals(roller_gap(radius, heights), problem.knots)
        try:
            solution = solve_on(half_plane, gap, grid.weights, problem.constraints(loaded))
        except ContactError:  # more than the hardness carries
            continue
        left = relative_l2(curve.on(grid.x), solution.pressure)
        yield Hint(kind, factor, words, left)
