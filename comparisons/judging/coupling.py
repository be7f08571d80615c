"""Changes of the half-plane's figures by normal-tangential coupling.

Sliding traction on bodies of different elastic constants also moves their surfaces normally, by
friction times Dundurs' beta (`analytic.operators.tangential`). The published method neglects this.
The half-plane is solved with and without it on its finest pressure elements.

In: the half-plane's levels. Out: its figures with coupling, and their differences from those
without, by friction coefficient."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from analytic.contact.patches import CLEAR
from analytic.grid import HatGrid
from comparisons.common.progress import ProgressCallback, Stages
from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Findings, Series, Statement, columns_of
from comparisons.figures.quantity import COMPARED, NORMS, Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging import contact
from comparisons.judging.rule import relative_differences, relative_l2, values_of
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
class Coupling:
    """Changes by coupling at one friction coefficient."""

    friction: float
    figures: dict[str, float] = field(default_factory=dict)  # with it [SI], by quantity
    # over the figures without it, or Hertz's where these vanish; the shift over the half-width
    changes: dict[str, float] = field(default_factory=dict)
    other: Level | None = None  # the half-plane solved the other way than the model's own
    converged: bool = True  # whether both solutions met their contact conditions
    why: str | None = None  # why there are no changes, None where there are


def coupled(solved: Solved, tasks: Tasks) -> tuple[Coupling, ...]:
    """Changes of the half-plane as far as it is refined, one a friction coefficient, computed once;
    none where there is no coupling."""
    if not solved.plan.coupling:
        return ()
    levels = len(solved.runs["half_plane"].levels)
    return tasks.held(
        NAME, levels, lambda: tuple(coupling_of(case, tasks.callback) for case in solved.cases)
    )


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """Changes by friction coefficient. A change is as uncertain as the half-plane's figure that
    changes, a shift as the contact's length, a norm as the worst."""
    changed, known = coupled(solved, tasks), before[contact.NAME].figures
    figures, series, said = [], [], []
    for coupling in changed:
        at = {"friction": coupling.friction}
        if coupling.why is not None:
            said.append(Statement(WHY_NOT, coupling.why, "half_plane", at))
            continue
        figures += figures_of_changes(coupling, solved.problem, known)
        said.append(Statement(CONVERGED, "yes" if coupling.converged else "no", "half_plane", at))
        seconds = sum(coupling.other.seconds.values())
        counts = coupling.other.solution.iterations | {"seconds": seconds}
        series.append(Series("cost", columns_of([counts]), "half_plane", at, is_account=True))
    return Findings(tuple(figures), tuple(series), tuple(said), changed)


def figures_of_changes(
    coupling: Coupling, problem: Problem, known: Iterable[Figure]
) -> Iterator[Figure]:
    """Figures with coupling and their changes; `known` are the models' own."""
    at = {"friction": coupling.friction}
    without = (f for f in known if f.source == "half_plane" and f.at == at and f.levels)
    stated = {figure.quantity: figure for figure in without}
    worst = max(stated.values(), key=lambda f: f.numerical)
    for name, change in coupling.changes.items():
        value = coupling.figures.get(name)  # a norm has none
        figure = stated.get("contact_length" if name == SHIFT else name, worst)
        scale = problem.hertz.half_width if name == SHIFT else abs(value or 0.0) or 1.0
        common = scale, Uncertainty(figure.uncertainty.parts)
        if value is not None:
            yield Figure(NAME, name, "half_plane", value, at, None, *common)
        yield Figure(NAME, name, "half_plane", change, at, UNCOUPLED, *common)


def coupling_of(case: Case, callback: ProgressCallback) -> Coupling:
    """Changes from the finished half-plane of a case."""
    problem, friction, level = case.problem, case.friction, case.runs["half_plane"].finest
    if (why := no_coupling(problem, friction)) is not None:
        return Coupling(friction, why=why)
    other = _other_way(problem, level, callback)
    if other is None:
        return Coupling(friction, why=BEYOND_THE_END)
    level = _spread(level, other.grid)
    moved, still = (level, other) if problem.coupling else (other, level)
    figures, before = (values_of(one, problem) for one in (moved, still))
    changes = relative_differences(figures, before, problem)
    shift = _centroid(moved) - _centroid(still)
    changes[SHIFT] = shift / problem.hertz.half_width
    changes["pressure_l2"] = relative_l2(moved.solution.pressure, still.solution.pressure)
    both = moved.converged and still.converged
    return Coupling(friction, figures | {SHIFT: shift}, changes, other, both)


def _other_way(problem: Problem, level: Level, callback: ProgressCallback) -> Level | None:
    """Solve with coupling where the level has none, without it where it has, on a grid that the
    contact moved by friction stays on; None where the surface ends before."""
    stages = Stages(lambda _: callback("half-plane: surfaces moved by friction"))
    effects = frozenset({COUPLED}) - problem.half_plane_effects
    # friction moves the contact by at most about mu beta of its own half-length
    more = int(
        np.ceil(0.5 * abs(problem.largest_friction * problem.dundurs_beta) * level.grid.count)
    )
    before = None
    while (grid := _stretched(problem, level.grid, more)) != before:
        [other] = analytic_level(problem, effects, grid, stages).values()
        pressure = other.solution.pressure
        if not (pressure[:CLEAR].any() or pressure[-CLEAR:].any()):
            return other
        more, before = 2 * more, grid
    return None


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
