"""A sweep: scenes, values and traces as a user asks for them, every point a run, and the scatter.

In: scenes, and "FIELD=…" as `crosscheck sweep` takes them. Out: sweep.json, a table, pictures."""

import glob
import os
import re
import shlex
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.common.files import csv_text
from comparisons.common.numbers import is_whole
from comparisons.common.progress import ProgressCallback
from comparisons.common.provenance import JUDGING_CODE, LEVEL_CODE, versions
from comparisons.common.units import DIMENSIONLESS, UnitError, to_si
from comparisons.grid.points import (
    SCENE,
    SOLVED,
    TRACE,
    Grid,
    Point,
    Request,
    Value,
    failures,
    points_of,
    solved_in,
)
from comparisons.grid.sweep_picture import FRICTION, POSITION, sweep_figure, zone_map_figure
from comparisons.grid.table import points_table, scatter, scatter_table
from comparisons.models.posing import problem_of
from comparisons.output.flat_csv import harmless
from comparisons.output.plausibility import warnings_about, warnings_about_result
from comparisons.output.records import COLUMNS, Records
from comparisons.output.result import result_of
from comparisons.output.terminal import plain_text
from comparisons.scenes.files import value_of
from comparisons.scenes.scene import Scene, assignments, dimension_of
from comparisons.scenes.surface import surface_of
from comparisons.studies import quiescent_zone
from meshes.block import MeshError

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Group

TABLE = "sweep.csv"
SCHEMA = 2
MOST = 10_000  # points
ALLOWED = "FIELD=A,B,C, FIELD=FROM:TO:N, position=N or profile.file=FOLDER"
MARGIN = 1.1  # of the contact's reach, that a placement keeps from the ends of the trace
# What shapes the result at a point, beside versions of libraries.
CODE = (*LEVEL_CODE, *JUDGING_CODE, "comparisons/output")
CODE += tuple(f"comparisons/grid/{name}.py" for name in ("points", "sweep"))
_RANGE = re.compile(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([^:\d]*?)\s*", re.ASCII)


def joined_name(scenes: Sequence[Scene]) -> str:
    """That of a scene, or of the first and the last."""
    return "-to-".join(dict.fromkeys(scene.name for scene in (scenes[0], scenes[-1])))


def sweep_request(scenes: Sequence[Scene], over: Sequence[str], models: tuple[str, ...]) -> Request:
    """The sweep of scenes that "FIELD=…" ask for.

    over     "position=40" placements along the trace, "FIELD=FROM:TO:N", "FIELD=A,B,C", or
             "profile.file=FOLDER" or a pattern of files; nothing where there are several scenes
    Raises InputError for anything that is wrong with them, SceneError for a value that is."""
    if not over and len(scenes) == 1:
        raise InputError(f"--over: is missing; allowed is {ALLOWED}, or several scenes")
    named = _named(scenes)
    asked = assignments("--over", over, scenes[0], ALLOWED)
    axes = {name: _distinct(name, _swept(name, text, scenes)) for name, text in asked.items()}
    axes = ({SCENE: tuple(named)} if len(named) > 1 else {}) | axes
    if (count := prod(map(len, axes.values()))) > MOST:
        raise InputError(f"--over: asks for {count} scenes; allowed are {MOST}")

    def scene_at(at: Mapping[str, Value]) -> Scene:
        fields = {name: value for name, value in at.items() if name != SCENE}
        return named[at.get(SCENE, next(iter(named)))].changed(fields)

    options = (word for text in over for word in ("--over", text))
    command = "crosscheck", "sweep", *(scene.named for scene in scenes), shlex.join(options)
    title = scenes[0].title if len(scenes) == 1 else f"{len(scenes)} scenes"
    content = {
        "schema": SCHEMA,
        "command": " ".join(command).rstrip(),
        "scene": {"name": joined_name(scenes), "title": title},
        "models": list(models),
        "over": [{"field": name, "values": list(values)} for name, values in axes.items()],
    }
    return Request(content, points_of(axes, scene_at, models, CODE))


def _named(scenes: Sequence[Scene]) -> dict[str, Scene]:
    """Scenes by what tells them apart: their names, else their files, else their numbers."""
    ways = [scene.name for scene in scenes], [scene.source for scene in scenes]
    names = next((names for names in ways if len(set(names)) == len(names)), None)
    names = names or [f"{scene.name} {number}" for number, scene in enumerate(scenes, start=1)]
    return dict(zip(names, scenes, strict=True))


def _distinct(name: str, values: tuple[Value, ...]) -> tuple[Value, ...]:
    """The values that differ; 1000 MPa is 1 GPa."""
    dimension, known = dimension_of(name) or DIMENSIONLESS, {}
    for value in values:
        size = str(value)
        with suppress(UnitError):  # a word, or wrong
            size = to_si(value, dimension)
        known.setdefault(size, value)
    return tuple(known.values())


def _swept(name: str, text: str, scenes: Sequence[Scene]) -> tuple[Value, ...]:
    """Values of a field."""
    if name == POSITION and is_whole(text):
        return _placements(int(text), scenes)
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 3:
        return _between(name, *parts)
    values = [part.strip() for part in text.split(",")]
    if len(parts) != 1 or "" in values:
        raise InputError(
            f"--over: is {f'{name}={text}'!r}; allowed is FIELD=A,B,C or FIELD=FROM:TO:N"
        )
    if name == TRACE:
        return tuple(file for value in values for file in _files(value, scenes))
    return tuple(map(value_of, values))


def _files(text: str, scenes: Sequence[Scene]) -> list[str]:
    """Files of a folder or of a pattern, by name. They count from the scenes' folder, as any file
    that a scene names, or else from the working folder."""

    def found(start: Path) -> list[str]:
        pattern = os.path.join(text, "*") if (start / text).is_dir() else text
        files = glob.glob(pattern, root_dir=start)
        return sorted(file for file in files if (start / file).is_file())

    folders = {scene.folder for scene in scenes}
    files = found(folders.pop()) if len(folders) == 1 else []
    files = files or [os.path.abspath(file) for file in found(Path())]
    if not files and glob.has_magic(text):
        raise InputError(f"--over: {TRACE}={text}: matches no file; allowed are traces that exist")
    return files or [text]


def _between(name: str, first: str, last: str, count: str) -> tuple[Value, ...]:
    ends = _RANGE.fullmatch(first), _RANGE.fullmatch(last)
    units = {end[2] for end in ends if end} - {""}
    if not all(ends) or len(units) > 1 or not is_whole(count) or not 2 <= int(count) <= MOST:
        raise InputError(
            f"--over: is '{name}={first}:{last}:{count}'; allowed is FROM:TO:N, two numbers of one "
            f"unit and how many values, from 2 to {MOST}"
        )
    values = np.linspace(float(ends[0][1]), float(ends[1][1]), int(count))
    unit = "".join(units)
    return tuple(f"{value:.10g} {unit}" if unit else value_of(f"{value:.10g}") for value in values)


def _placements(count: int, scenes: Sequence[Scene]) -> tuple[float, ...]:
    """Positions [m] of the roller, evenly over those where the contact stays on the trace."""
    scene, *others = scenes
    if others:
        raise InputError("--over: position: several scenes have each their own; allowed is one "
                         "scene, or position=A,B,C")  # fmt: skip
    if scene.profile is None:
        raise InputError("--over: position: a smooth scene is the same everywhere; allowed is a "
                         "scene with a profile")  # fmt: skip
    if not 2 <= count <= MOST:
        raise InputError(f"--over: position={count}; allowed are from 2 to {MOST} placements")
    problem = problem_of(scene)
    surface = problem.surface
    ends = surface.position + surface.profile.x[0], surface.position + surface.profile.x[-1]
    reach = np.multiply(MARGIN, problem.extent)
    first, last = ends[0] - reach[0], ends[1] - reach[1]
    if first >= last:
        raise InputError("--over: position: the contact is as wide as the trace; allowed is a "
                         "longer trace or a lighter load")  # fmt: skip
    return tuple(float(f"{place:.10g}") for place in np.linspace(first, last, count))


def make_sweep(
    request: Request, out: Path, workers: int | str | None, callback: ProgressCallback
) -> "Sweep":
    """The sweep, in `out`, where the points are solved that it does not have.

    workers  as `tasks_by` takes them
    Raises InputError for what cannot be written, for a value with which no scene can be posed, and
    where no point has a result."""
    answers = solved_in(out, Sweep.FILES, request.points, solved, workers, callback, why_not)
    whys = failures(answers)
    if whys.total() == len(answers):
        raise InputError(next(iter(whys)))
    points = [
        {"values": list(point.at.values()), "rows": (), **answer}
        for point, answer in zip(request.points, answers, strict=True)
    ]
    found = {"points": points, "scatter": scatter(points, FRICTION in request.points[0].at)}
    made = Sweep(request.content | found | {"versions": versions()}, out)
    made.write(out)
    return made


def why_not(point: Point) -> str | None:
    """Why there is no scene at a point, or it cannot be posed. A load that finite elements find is
    not known before."""
    from comparisons.runs.run import posed

    scene = point.scene
    if scene is None or (scene.load.kind == "approach" and "finite_element" in point.asked):
        return point.why
    try:
        posed(scene, surface_of(scene, standard=False), point.asked)
    except (ContactError, InputError, MeshError) as error:
        return str(error)
    return None


def solved(point: Point) -> dict:
    """The result at a point: its verdict, the rows of its figures, plausibility warnings, and its
    quiescent zones."""
    from comparisons.runs.run import Known, run

    surface = surface_of(point.scene)
    outcome = run(point.scene, None, point.asked, known=Known(surface))
    result = result_of(outcome)
    warnings = *warnings_about(point.scene, surface), *warnings_about_result(outcome)
    answer = {"status": SOLVED, "verdict": result.verdict, "within": result.within}
    answer |= {"warnings": warnings, "rows": tuple(result.figures.rows)}
    zones: dict[str, list[dict]] = {}  # by model, then by friction
    for zone in quiescent_zone.zones_of(outcome.findings.get(quiescent_zone.NAME)):
        entry = {"friction": zone.friction, "status": zone.state}
        entry |= {"level": zone.figures["level"].value}
        entry |= {"bridged": zone.bridged, "asperities": zone.asperities}
        zones.setdefault(zone.model, []).append(entry)
    return answer | ({quiescent_zone.NAME: zones} if zones else {})


@dataclass(frozen=True, repr=False)
class Sweep(Grid):
    """Scenes at many values of their fields."""

    FILES = "sweep.json", TABLE, "sweep.svg", f"{quiescent_zone.NAME}.svg"

    @property
    def figures(self) -> Records:
        """Those of every point, each with the values of the swept fields first, as records."""
        names, rows = [axis["field"] for axis in self.content["over"]], []
        for point in self.content["points"]:
            at = dict(zip(names, point["values"], strict=True))
            rows += [at | row | at for row in point["rows"]]
        return Records(rows)

    def pictures(self) -> "dict[str, Callable[[], Figure]]":
        """Each figure over the first swept field; quiescent zones, where there are any."""
        draws = {"sweep": sweep_figure}
        if any(quiescent_zone.NAME in point for point in self.content["points"]):
            draws |= {quiescent_zone.NAME: zone_map_figure}
        return {name: partial(draw, self.content) for name, draw in draws.items()}

    def texts(self) -> dict[str, str]:
        columns = dict.fromkeys((*(axis["field"] for axis in self.content["over"]), *COLUMNS))
        rows = ([harmless(row[name]) for name in columns] for row in self.figures.rows)
        return super().texts() | {TABLE: csv_text([columns, *rows])}

    def tables(self) -> "Group":
        """The points, the scatter over all of them, and how many failed, by why."""
        from rich.console import Group

        points, over = self.content["points"], self.content["over"]
        values = " x ".join(f"{len(axis['values'])} of {axis['field']}" for axis in over)
        many = f"{len(points)} scenes ({values}), {failures(points).total()} failed"
        tables = *points_table(self.content), "", scatter_table(self.content)
        return Group(*tables, *map(plain_text, (many, *self.told())))
