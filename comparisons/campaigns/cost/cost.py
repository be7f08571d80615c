"""Error against time of every method that solves a scene, and the cheapest for its tolerances.

In: a scene. Out: a row for each method and resolution, solved once, with errors, seconds and
memory; a picture and a line a tolerance.

Errors are those of exact values, or of the best solution. Hertz's contact is exact where the scene
is smooth and both models solve the same problem. On a rough half-plane both models have the same
limit, and the finest half-plane is the reference. Where the finite elements drop an assumption of
the half-plane, the finest of them are, for each quantity those of the smallest uncertainty; the
half-plane's model error then counts as error. No error below the reference's uncertainty is known.

Seconds are processor time on one thread, gmsh's process included. Each method has a process of its
own, from coarse to fine, so that memory is its own."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING

from analytic.contact.problem import ContactError
from analytic.exact.hertz import hertz_extremes
from comparisons.campaigns.cost.methods import (
    HALF_PLANE,
    P1,
    P2,
    P3,
    SolutionMethod,
    is_half_plane_problem,
    methods_of,
    solved,
)
from comparisons.common.cache import Cache, kinds_of
from comparisons.common.errors import InputError, SceneError, SolverError, one_line
from comparisons.common.files import check_writable, publish
from comparisons.common.numbers import percent, percent_as_written, with_unit
from comparisons.common.processes import ProcessWorker
from comparisons.common.progress import ProgressCallback, Step, no_progress, processor_seconds
from comparisons.common.provenance import (
    LEVEL_CODE,
    as_json,
    key_of,
    machine,
    program_code,
    versions,
)
from comparisons.common.tasks import Here, Tasks
from comparisons.drawing.style import REFERENCE, THIRD, figure, svgs
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.runs.run import posed
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import scene_key, surface_of
from comparisons.studies.contact import uncertainties, values_of
from fem.solver.mumps import FemError
from meshes.block import MeshError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn
    from rich.console import RenderableType

SCHEMA = 3
FILES = COST, PICTURE = "cost.json", "cost.svg"
FOLDER = "cost_points"  # in `out`, of what is solved
# What shapes what is solved, beside versions of libraries and the machine.
CODE = (*LEVEL_CODE, "comparisons/campaigns/cost/methods.py")
SHOWN = ("peak_pressure", "contact_length", "tau1_max")
FLOOR = 1e-12  # of exact values: rounding
FEWEST = 3  # levels that show an uncertainty
LEAST = 1e-7  # smaller errors are drawn there
HEIGHT = 4.0  # inches, of the picture
MARKS = "oDv^<sP"  # of methods
UNKNOWN = "reference uncertain"
Values = tuple[dict[str, float], ...]  # [SI] by quantity, one a friction coefficient


@dataclass(frozen=True, eq=False)
class CostRow:
    """A method at a pitch."""

    method: SolutionMethod
    pitch: float  # [m] of the pressure elements
    level: Level
    values: Values
    seconds: float  # of the processor
    # of a reference's coarsest: with the far boundary at half its distance, where that counts
    half_block: Level | None = None
    # relative, the largest of any friction, by quantity; once they are known, and without those
    # that it is the reference of
    errors: Mapping[str, float] = field(default_factory=dict)

    @property
    def label(self) -> str:
        return with_unit(self.pitch, "m", 3)


@dataclass(frozen=True)
class Reference:
    """The best known solution."""

    source: str  # in words
    floors: dict[str, float]  # relative uncertainty, the largest of any friction, by quantity
    values: Values
    row: CostRow | None = None  # that it is, None where it is exact


@dataclass(frozen=True)
class Cost:
    """A scene by all methods."""

    problem: Problem
    rows: tuple[CostRow, ...]  # by method, from coarse to fine
    references: Mapping[str, Reference]  # by quantity
    left_out: tuple[str, ...]  # what has no row, and why

    @property
    def aims(self) -> list[dict[str, float]]:
        """Each of the scene's tolerances that is known to be met or not, and all at once."""
        tolerances = self.problem.scene.tolerances
        known = {name: tolerances[name] for name in self.references if name in tolerances}
        return [{name: value} for name, value in known.items()] + [known] * (len(known) > 1)

    def cheapest(self, aim: Mapping[str, float]) -> list[CostRow]:
        """Of each model the row of the fewest seconds that meets the tolerances as all finer ones
        of its method do: not by chance. None where none does."""
        met: list[CostRow] = []
        for method in dict.fromkeys(row.method for row in self.rows):
            known = [r for r in self.rows if r.method == method and aim.keys() <= r.errors.keys()]
            met += takewhile(lambda row: self._meets(row, aim), reversed(known))
        by_model = ([row for row in met if row.method.model == model] for model in MODELS)
        return [min(rows, key=lambda row: row.seconds) for rows in by_model if rows]

    def _meets(self, row: CostRow, aim: Mapping[str, float]) -> bool:
        floors = {name: self.references[name].floors[name] for name in aim}
        return all(row.errors[name] + floors[name] <= aim[name] for name in aim)


def cost(scene: Scene, out: Path, callback: ProgressCallback = no_progress) -> Cost:
    """Solve, compare, and write cost.json and cost.svg in `out`, whole or not at all. What is
    solved stays beside them: the same command goes on from there. Raises InputError for a scene
    that cannot be solved or a folder that cannot be written."""
    if scene.periodic:
        why = "is true; allowed is a roller, whose contact every method of `cost` solves"
        raise SceneError(f"{scene.source}: profile.periodic: {why}")
    check_writable(out, FILES)
    surface = surface_of(scene)
    try:
        problem, _ = posed(scene, surface, ("finite_element",), callback=callback)
    except (ContactError, FemError, MeshError) as error:
        raise SceneError(f"{scene.source}: {error}") from error
    key = key_of(scene_key(scene, surface), machine(), versions(), program_code(*CODE))
    cache = Cache(out / FOLDER, key, kinds_of(Level))
    cache.remove_leftovers()
    known = assessed(problem, *rows_of(problem, methods_of(problem), cache, callback))
    drawn = svgs({PICTURE: lambda: cost_figure(known)})
    publish(out, {COST: as_json(content_of(known)), **drawn}, FILES)
    return known


def rows_of(
    problem: Problem,
    methods: Sequence[SolutionMethod],
    cache: Cache,
    callback: ProgressCallback = no_progress,
) -> tuple[list[CostRow], list[str]]:
    """A row for each method and pitch, from coarse to fine, and what is left out. Each method of
    finite elements has an equal part of the scene's budget of time."""
    rows: list[CostRow] = []
    left_out: list[str] = []
    meshed = [method for method in methods if method.model == "finite_element"]
    unbounded = problem.scene.body.thickness is None or problem.scene.body.width is None
    checked = meshed if unbounded and not is_half_plane_problem(problem) else ()
    for number, method in enumerate(methods):
        pitches, left = method.pitches(problem), problem.scene.budget.time / max(len(meshed), 1)
        with Tasks(ProcessWorker, 1, cache) as tasks:
            for place, pitch in enumerate(pitches):
                named = f"{method.name} at {with_unit(pitch, 'm', 3)}"
                callback(Step(named, (number + place / len(pitches)) / len(methods)))
                left -= method.expected_seconds(problem, pitch)
                if left < 0.0:
                    left_out.append(f"{named} and finer: there is no time (budget.time)")
                    break
                halved = (False, True) if method in checked and place == 0 else (False,)
                try:
                    (level, seconds), *check = (
                        _result(tasks, method, problem, pitch, half) for half in halved
                    )
                except Exception as error:
                    told = isinstance(error, InputError | SolverError)
                    why = error if told else one_line(f"{type(error).__name__}: {error}")
                    left_out.append(f"{named} and finer: {why}")
                    break
                if not level.converged:
                    left_out.append(f"{named}: did not converge")
                    continue
                frictions = problem.scene.load.friction
                values = tuple(values_of(level, problem, friction) for friction in frictions)
                half_block = check[0][0] if check else None
                rows.append(CostRow(method, pitch, level, values, seconds, half_block))
    return rows, left_out


def _result(
    tasks: Tasks, method: SolutionMethod, problem: Problem, pitch: float, half_block: bool
) -> tuple[Level, float]:
    key = f"{re.sub(r'[^A-Za-z0-9]+', '-', method.name)}_{pitch!r}{'_half_block' * half_block}"
    tasks.add(key, _timed, method, problem, pitch, half_block)
    return tasks.result(key)


def _timed(
    here: Here, method: SolutionMethod, problem: Problem, pitch: float, half_block: bool
) -> tuple[Level, float]:
    """A level and its seconds of the processor. What a process solves first loads libraries, and
    does not count."""
    here.held("libraries", method, lambda: solved(method, problem, method.pitches(problem)[0]))
    begin = processor_seconds()
    level = solved(method, problem, pitch, half_block)
    return level, processor_seconds() - begin


def assessed(problem: Problem, rows: Sequence[CostRow], left_out: Sequence[str]) -> Cost:
    """What is solved, with its errors. Raises SceneError without a reference."""
    known = references(problem, rows)
    if not known:
        why = next(iter(left_out), "too few levels are solved")
        raise SceneError(f"{problem.scene.source}: there is no reference for errors: {why}")
    rows = [replace(row, errors=_errors(row, known)) for row in rows]
    return Cost(problem, tuple(rows), known, tuple(left_out))


def references(problem: Problem, rows: Sequence[CostRow]) -> dict[str, Reference]:
    """By quantity; without those that no solved row has."""
    if is_exact(problem):
        exact = _exact(problem)
        return dict.fromkeys(exact.floors, exact)
    best: dict[str, Reference] = {}
    for method in (HALF_PLANE,) if is_half_plane_problem(problem) else (P1, P2, P3):
        solved_by = [row for row in rows if row.method == method]
        if len(solved_by) < FEWEST:
            continue
        reference = _finest(problem, solved_by)
        for name, floor in reference.floors.items():
            if name not in best or floor < best[name].floors[name]:
                best[name] = reference
    return {name: best[name] for name in SHOWN if name in best}


def is_exact(problem: Problem) -> bool:
    scene = problem.scene
    capped = scene.body.hardness is not None and scene.body.hardness <= problem.hertz.peak_pressure
    smooth = scene.profile is None and not problem.coupling and not capped
    return smooth and is_half_plane_problem(problem)


def _exact(problem: Problem) -> Reference:
    hertz, frictions = problem.hertz, problem.scene.load.friction
    contact = {"peak_pressure": hertz.peak_pressure, "contact_length": 2.0 * hertz.half_width}
    values = [contact] * len(frictions)
    if problem.scene.stress is not None:
        largest = [hertz_extremes(hertz, friction).tau1.value for friction in frictions]
        values = [contact | {"tau1_max": tau1} for tau1 in largest]
    return Reference("exact (Hertz)", dict.fromkeys(values[0], FLOOR), tuple(values))


def _finest(problem: Problem, rows: Sequence[CostRow]) -> Reference:
    """The finest of a method's rows, with the uncertainty that its levels show."""
    row, levels = rows[-1], tuple(row.level for row in rows)
    run = ModelRun(row.method.model, levels, rows[0].half_block)
    stated = [uncertainties(run, problem, friction) for friction in problem.scene.load.friction]
    floors = {name: float(max(by_name[name].total for by_name in stated)) for name in stated[0]}
    return Reference(f"{row.method.name} at {row.label}", floors, row.values, row)


def _errors(row: CostRow, known: Mapping[str, Reference]) -> dict[str, float]:
    errors = {}
    for name, best in known.items():
        if row is not best.row and all(name in values for values in row.values):
            pairs = zip(row.values, best.values, strict=True)
            errors[name] = max(abs(values[name] / exact[name] - 1.0) for values, exact in pairs)
    return errors


def content_of(cost: Cost) -> dict:
    """The content of cost.json: SI units, errors relative."""
    return {
        "schema": SCHEMA,
        "scene": cost.problem.surface.as_dict(cost.problem.scene),
        "reference": {
            name: {
                "source": best.source,
                "values": [values[name] for values in best.values],
                "uncertainty": best.floors[name],
            }
            for name, best in cost.references.items()
        },
        "rows": [
            {
                "method": row.method.name,
                "model": row.method.model,
                "pitch": row.pitch,
                "elements": row.level.grid.count,
                "unknowns": row.level.unknowns,
                "seconds": row.seconds,
                "peak_memory": row.level.peak_memory,
                "figures": list(row.values),
                "errors": row.errors,
            }
            for row in cost.rows
        ],
        "cheapest": [
            {"tolerances": aim, "row": cost.rows.index(row)}
            for aim in cost.aims
            for row in cost.cheapest(aim)
        ],
        "left_out": list(cost.left_out),
        "versions": versions(),
        "machine": machine(),
    }


def cost_table(cost: Cost) -> "RenderableType":
    """All rows, the cheapest for each tolerance, and by what errors are measured."""
    from rich.console import Group
    from rich.text import Text

    from comparisons.output.terminal import PLAIN, plain_table

    names = list(cost.references)
    heads = [QUANTITIES[name].short for name in names]
    table = plain_table("method", numbers=("pitch", *heads, "seconds", "memory"))
    for row in cost.rows:
        errors = (_error_text(cost, row, name) for name in names)
        costs = with_unit(row.seconds, "s", 2), with_unit(row.level.peak_memory, "byte", 3)
        table.add_row(*(t.translate(PLAIN) for t in (row.method.name, row.label, *errors, *costs)))
    sources = "; ".join(
        f"{QUANTITIES[name].short} {best.source}, known to {percent(best.floors[name])}"
        for name, best in cost.references.items()
    )
    notes = f"Errors are relative, the largest of any friction coefficient, against: {sources}."
    lines = [*(f"cheapest for {_cheapest_words(cost, aim)}" for aim in cost.aims), "", notes]
    lines += [f"left out: {line}" for line in cost.left_out]
    title = Text(cost.problem.scene.title, style="bold")
    return Group(title, "", table, "", *(Text(line.translate(PLAIN)) for line in lines))


def _error_text(cost: Cost, row: CostRow, name: str) -> str:
    if name not in row.errors:
        return "reference" if name in row.values[0] else ""
    return percent(row.errors[name])


def _cheapest_words(cost: Cost, aim: Mapping[str, float]) -> str:
    wanted = ", ".join(f"{QUANTITIES[n].short} to {percent_as_written(t)}" for n, t in aim.items())
    rows = cost.cheapest(aim)
    words = (f"{row.method.name} at {row.label}, {with_unit(row.seconds, 's', 2)}" for row in rows)
    return f"{wanted}: {'; '.join(words) or 'none that is solved'}"


def cost_figure(cost: Cost) -> "Drawn":
    """Error against seconds, a panel a quantity: a line a method, the tolerance, what the
    reference leaves unknown."""
    names = list(cost.references)
    drawn = figure(THIRD * len(names), HEIGHT)
    panels = drawn.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    for axes, name in zip(panels, names, strict=True):
        _draw(axes, cost, name)
    panels[0].set_ylabel("relative error")
    drawn.subplots_adjust(left=0.65 / drawn.get_figwidth(), right=0.985, bottom=0.13, top=0.78)
    entries: dict[str, object] = {}
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
    drawn.legend(entries.values(), entries.keys(), loc="upper left", ncols=2 * len(names) - 1)
    return drawn


def _draw(axes: "Axes", cost: Cost, name: str) -> None:
    for method, mark in zip(dict.fromkeys(row.method for row in cost.rows), MARKS, strict=False):
        rows = [row for row in cost.rows if row.method == method and name in row.errors]
        errors = [max(row.errors[name], LEAST) for row in rows]
        look = {"linestyle": "-" if method.model == "half_plane" else "--", "marker": mark}
        axes.plot([row.seconds for row in rows], errors, label=method.name, **look)
    tolerance = cost.problem.scene.tolerances.get(name)
    if tolerance is not None:
        axes.axhline(tolerance, label="tolerance", **REFERENCE)
    floor = cost.references[name].floors[name]
    if LEAST < floor < math.inf:
        axes.axhspan(LEAST, floor, facecolor="#eceff1", zorder=0, label=UNKNOWN)
    axes.set(xscale="log", yscale="log", xlabel="processor time [s]")
    axes.set_title(QUANTITIES[name].label)
