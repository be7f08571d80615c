"""What normal-tangential coupling changes in the half-plane's figures.

Sliding traction on bodies of different elastic constants also moves their surfaces normally, by
friction times Dundurs' beta (`analytic.operators.tangential`). The published method neglects this.
The half-plane is solved with and without it on its finest pressure elements.

In: the half-plane's levels. Out: its figures with coupling, and their differences from those
without, by friction coefficient."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.patches import CLEAR
from analytic.grid import HatGrid
from comparisons.common.progress import ProgressCallback, Stages
from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Findings, Series, Statement, columns_of
from comparisons.figures.quantity import COMPARED, NORMS, Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging import contact
from comparisons.judging.rule import relative_l2, values_of
from comparisons.judging.study import CONVERGED, WHY_NOT, Case, Solved, Study
from comparisons.models.analytic import analytic_level
from comparisons.models.level import Level
from comparisons.models.plan import no_coupling
from comparisons.models.posing import surface_ends
from comparisons.models.problem import COUPLED, Problem

NAME = "coupling"
SHIFT = "contact_shift"
QUANTITIES = contact.QUANTITIES | {
    SHIFT: Quantity("shift of the pressure's centroid", "m"),
    "pressure_l2": NORMS["pressure_l2"],
}
UNCOUPLED = "uncoupled"  # the half-plane without it
NOTE = """Normal-tangential coupling: sliding traction also moves the surfaces of unlike bodies up
and down, in proportion to friction times Dundurs' β. {}; of the shift over the Hertz half-width.
Solved on the finest pressure elements."""
CONTAINED = "The half-plane's figures contain that; the change is against those without"
NOT_CONTAINED = """The figures above do not contain that, as the method was published; the change is
against them"""
BEYOND_THE_END = "moved by friction, the contact reaches the end of the body"


@dataclass(frozen=True)
class Change:
    """A figure with coupling."""

    value: float | None  # [SI]; None for the norm of a difference
    # relative to the figure without coupling, None where only that is zero; of a shift over a
    difference: float | None


@dataclass(frozen=True)
class Coupling:
    """At one friction coefficient."""

    friction: float
    # by quantity; contact_shift is that of the pressure's centroid along x
    changes: dict[str, Change]
    converged: bool = True  # whether both solutions met their contact conditions
    # iterations and seconds of the solution that the model's own is compared with
    iterations: dict[str, int] | None = None
    seconds: float = 0.0
    why: str | None = None  # why there are no changes, None where there are


def coupled(solved: Solved, tasks: Tasks) -> tuple[Coupling, ...]:
    """Of the half-plane as far as it is refined, computed once; none where there is no coupling."""
    if not solved.plan.coupling:
        return ()
    levels = len(solved.runs["half_plane"].levels)
    return tasks.held(NAME, levels, lambda: couplings(solved, tasks.callback))


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """Of every friction coefficient. A change is as uncertain as the half-plane's figure that
    changes, a shift as the contact's length, a norm as the worst."""
    changed, known = coupled(solved, tasks), before[contact.NAME].figures
    figures, series, said = [], [], []
    for coupling in changed:
        at = {"friction": coupling.friction}
        figures += figures_of_changes(coupling, solved.problem, known)
        if coupling.why is not None:
            said.append(Statement(WHY_NOT, coupling.why, "half_plane", at))
            continue
        said.append(Statement(CONVERGED, "yes" if coupling.converged else "no", "half_plane", at))
        counts = coupling.iterations | {"seconds": coupling.seconds}
        series.append(Series("cost", columns_of([counts]), "half_plane", at, is_account=True))
    return Findings(tuple(figures), tuple(series), tuple(said), changed)


def figures_of_changes(
    coupling: Coupling, problem: Problem, known: Iterable[Figure]
) -> Iterator[Figure]:
    """Each figure with coupling and its change; `known` are the models' own."""
    at = {"friction": coupling.friction}
    without = (f for f in known if f.source == "half_plane" and f.at == at and f.levels)
    stated = {figure.quantity: figure for figure in without}
    worst = max(stated.values(), key=lambda f: f.numerical)
    for name, change in coupling.changes.items():
        figure = stated.get("contact_length" if name == SHIFT else name, worst)
        scale = problem.hertz.half_width if name == SHIFT else abs(change.value or 0.0) or 1.0
        unsure = Uncertainty(figure.uncertainty.parts)
        for value, against in ((change.value, None), (change.difference, UNCOUPLED)):
            if value is not None:
                yield Figure(NAME, name, "half_plane", value, at, against, scale, unsure)


def couplings(solved: Solved, callback: ProgressCallback) -> tuple[Coupling, ...]:
    """One for each friction coefficient, in the order of the scene, from the finished
    half-plane."""
    return tuple(_coupling(case, callback) for case in solved.cases)


def _coupling(case: Case, callback: ProgressCallback) -> Coupling:
    problem, friction, level = case.problem, case.friction, case.runs["half_plane"].finest
    if (why := no_coupling(problem, friction)) is not None:
        return Coupling(friction, {}, why=why)
    stages = Stages(lambda _: callback("half-plane: surfaces moved by friction"))
    # the level itself was solved with coupling or without; solve the other way
    effects = frozenset({COUPLED}) - problem.half_plane_effects
    # friction moves the contact by at most about mu beta of its own half-length
    more = int(np.ceil(0.5 * abs(friction * problem.dundurs_beta) * level.grid.count))
    while True:
        grid = _stretched(problem, level.grid, more)
        [other] = analytic_level(problem, effects, grid, stages).values()
        pressure = other.solution.pressure
        if not (pressure[:CLEAR].any() or pressure[-CLEAR:].any()):
            break
        more *= 2
        if _stretched(problem, level.grid, more) == grid:
            return Coupling(friction, {}, why=BEYOND_THE_END)
    level = _spread(level, grid)
    moved, still = (level, other) if problem.coupling else (other, level)
    return Coupling(
        friction=friction,
        changes=_changes(problem, moved, still),
        converged=moved.solution.converged and still.solution.converged,
        iterations=other.solution.iterations,
        seconds=sum(stages.seconds.values()),
    )


def _stretched(problem: Problem, grid: HatGrid, more: int) -> HatGrid:
    """The grid with so many more elements at either end, as far as the surface goes."""
    start, stop = surface_ends(problem)
    first, last = grid.first - more, grid.last + more
    if np.isfinite(start):
        widest = HatGrid.within(start, stop, grid.pitch)
        first, last = max(first, widest.first), min(last, widest.last)
    return HatGrid(grid.pitch, min(first, grid.first), max(last, grid.last))


def _spread(level: Level, grid: HatGrid) -> Level:
    """The level's pressures on a longer grid of the same pitch."""
    before, after = level.grid.first - grid.first, grid.last - level.grid.last
    pressure = np.pad(level.solution.pressure, (before, after))
    return replace(level, grid=grid, solution=replace(level.solution, pressure=pressure))


def _changes(problem: Problem, moved: Level, still: Level) -> dict[str, Change]:
    values, before = (values_of(level, problem) for level in (moved, still))
    changes = {name: Change(v, _relative(v, before[name])) for name, v in values.items()}
    shift = _centroid(moved) - _centroid(still)
    changes[SHIFT] = Change(shift, shift / problem.hertz.half_width)
    between = relative_l2(moved.solution.pressure, still.solution.pressure)
    return changes | {"pressure_l2": Change(None, between)}


def _relative(value: float, before: float) -> float | None:
    if value == before:
        return 0.0
    return value / before - 1.0 if before else None


def _centroid(level: Level) -> float:
    pressure = level.solution.pressure
    return float(level.grid.x @ pressure / pressure.sum())


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.plan.coupling,
    title="Surfaces moved by friction",
    section="contact",
    note=lambda run: NOTE.format(CONTAINED if run.problem.scene.load.coupled else NOT_CONTAINED),
    advice=lambda run: "" if run.problem.scene.load.coupled else ", not in the figures above",
    shown=(SHIFT, *COMPARED),
)
