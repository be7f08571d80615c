"""What normal-tangential coupling changes in the half-plane's figures.

Sliding traction on bodies of different elastic constants also moves their surfaces normally, by
friction times Dundurs' beta (`analytic.operators.tangential`). The published method neglects this.
The half-plane is solved with and without it on its finest pressure elements."""

from dataclasses import asdict, dataclass, replace

import numpy as np

from analytic.contact.patches import CLEAR
from analytic.grid import HatGrid
from comparisons.common.progress import ProgressCallback, Stages
from comparisons.models.half_plane import half_plane_on
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import no_coupling
from comparisons.models.problem import Problem, surface_ends
from comparisons.models.window import Window
from comparisons.studies.contact import figures, norms

SHIFT = "contact_shift"
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

    def as_dict(self) -> dict | None:
        """For result.json; None without changes."""
        if not self.changes:
            return None
        own = asdict(self)
        return own["changes"] | {n: own[n] for n in ("converged", "iterations", "seconds")}


def couplings(
    problem: Problem, run: ModelRun, window: Window | None, callback: ProgressCallback
) -> tuple[Coupling, ...]:
    """One for each friction coefficient, from the finished half-plane."""
    found = []
    for friction in problem.scene.load.friction:
        why = no_coupling(problem, friction)
        if why is None:
            found.append(_coupling(problem, run.finest, friction, window, callback))
        else:
            found.append(Coupling(friction, {}, why=why))
    return tuple(found)


def _coupling(
    problem: Problem, own: Level, friction: float, window: Window | None, callback: ProgressCallback
) -> Coupling:
    stages = Stages(lambda _: callback("half-plane: surfaces moved by friction"))
    size = friction * problem.dundurs_beta
    # the level itself was solved with coupling or without; solve the other way
    other_size = 0.0 if problem.coupling else size
    # friction moves the contact by at most about mu beta of its own half-length
    more = int(np.ceil(0.5 * abs(size) * own.grid.count))
    while True:
        grid = _stretched(problem, own.grid, more)
        other = half_plane_on(problem, grid, other_size, (friction,), window, stages)
        pressure = other.solution.pressure
        if not (pressure[:CLEAR].any() or pressure[-CLEAR:].any()):
            break
        more *= 2
        if _stretched(problem, own.grid, more) == grid:
            return Coupling(friction, {}, why=BEYOND_THE_END)
    own = _spread(own, grid)
    moved, still = (own, other) if problem.coupling else (other, own)
    return Coupling(
        friction=friction,
        changes=_changes(problem, moved, still, friction, window),
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


def _changes(
    problem: Problem, moved: Level, still: Level, friction: float, window: Window | None
) -> dict[str, Change]:
    one, other = figures(moved, problem, friction), figures(still, problem, friction)
    found = {name: Change(one[name], _relative(one[name], other[name])) for name in one}
    shift = _centroid(moved) - _centroid(still)
    found[SHIFT] = Change(shift, shift / problem.hertz.half_width)
    between = norms(moved, still, problem, friction, window)
    return found | {name: Change(None, size) for name, size in between.items()}


def _relative(value: float, before: float) -> float | None:
    if value == before:
        return 0.0
    return value / before - 1.0 if before else None


def _centroid(level: Level) -> float:
    pressure = level.solution.pressure
    return float(level.grid.x @ pressure / pressure.sum())
