"""A sweep: the values that a user asks for, every point solved, the figures, and how they scatter.

In: a scene, and "FIELD=…" as `crosscheck sweep` takes them. Out: sweep.json, a table, pictures."""

import re
import shlex
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from operator import itemgetter
from pathlib import Path

import numpy as np

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.common.files import csv_text, publish
from comparisons.common.numbers import is_whole
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import JUDGING_CODE, LEVEL_CODE, as_json, versions
from comparisons.common.units import DIMENSIONLESS, UnitError, to_si
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import MODELS, QUANTITIES, WHOLE
from comparisons.grid.points import SOLVED, Point, Value, failures, points_of, solved_in
from comparisons.grid.sweep_picture import FRICTION, PICTURE, POSITION, ZONES, drawn
from comparisons.judging import contact
from comparisons.judging.study import MODEL_ERROR
from comparisons.models.posing import problem_of
from comparisons.output.flat_csv import COLUMNS, Row, harmless, rows_of
from comparisons.output.plausibility import warnings_about, warnings_about_result
from comparisons.output.result import result_of
from comparisons.scenes.files import value_of
from comparisons.scenes.scene import Scene, assignments, dimension_of
from comparisons.scenes.surface import surface_of
from comparisons.studies import quiescent_zone
from comparisons.studies.friction import PARTIAL_SLIP
from comparisons.studies.heat import STUDY as HEAT
from meshes.block import MeshError

SWEEP, TABLE = "sweep.json", "sweep.csv"
FILES = (SWEEP, TABLE, PICTURE, ZONES)
SCHEMA = 2
MOST = 10_000  # points
ALLOWED = "FIELD=A,B,C, FIELD=FROM:TO:N or position=N"
MARGIN = 1.1  # of the contact's reach, that a placement keeps from the ends of the trace
# What shapes the answer at a point, beside versions of libraries.
CODE = (*LEVEL_CODE, *JUDGING_CODE, "comparisons/output")
CODE += tuple(f"comparisons/grid/{name}.py" for name in ("points", "sweep"))
NAMED = ("study", "quantity", "source", "friction")  # of the figures whose scatter is stated
_RANGE = re.compile(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([^:\d]*?)\s*", re.ASCII)


@dataclass(frozen=True)
class SweepRequest:
    """A sweep: every combination of the values, those of the last field inside."""

    scene: Scene
    models: tuple[str, ...]
    over: tuple[str, ...]  # FIELD=…, as asked
    fields: dict[str, tuple[Value, ...]]  # values by "table.field", as TOML would have them
    points: tuple[Point, ...]

    @property
    def command(self) -> str:
        options = (word for text in self.over for word in ("--over", text))
        return f"crosscheck sweep {self.scene.named} {shlex.join(options)}"


def sweep_request(scene: Scene, over: Sequence[str], models: tuple[str, ...]) -> SweepRequest:
    """The sweep that "FIELD=…" ask for.

    over     "position=40" placements along the trace, "FIELD=FROM:TO:N" or "FIELD=A,B,C"
    Raises InputError for anything that is wrong with them, SceneError for a value that is."""
    if not over:
        raise InputError(f"--over: is missing; allowed is {ALLOWED}")
    asked = assignments("--over", over, scene, ALLOWED)
    fields = {name: _distinct(name, _swept(name, text, scene)) for name, text in asked.items()}
    if (count := int(np.prod([len(values) for values in fields.values()]))) > MOST:
        raise InputError(f"--over: asks for {count} scenes; allowed are {MOST}")
    points = points_of(fields, scene.changed, models, CODE)
    return SweepRequest(scene, models, tuple(over), fields, points)


def _distinct(name: str, values: tuple[Value, ...]) -> tuple[Value, ...]:
    """The values that differ; 1000 MPa is 1 GPa."""
    dimension, known = dimension_of(name) or DIMENSIONLESS, {}
    for value in values:
        size = str(value)
        with suppress(UnitError):  # a word, or wrong
            size = to_si(value, dimension)
        known.setdefault(size, value)
    return tuple(known.values())


def _swept(name: str, text: str, scene: Scene) -> tuple[Value, ...]:
    """Values of a field."""
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 3:
        return _between(name, *parts)
    if name == POSITION and len(parts) == 1 and is_whole(text):
        return _placements(int(text), scene)
    values = [part.strip() for part in text.split(",")]
    if len(parts) != 1 or "" in values:
        raise InputError(
            f"--over: is {f'{name}={text}'!r}; allowed is FIELD=A,B,C or FIELD=FROM:TO:N"
        )
    return tuple(map(value_of, values))


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


def _placements(count: int, scene: Scene) -> tuple[float, ...]:
    """Positions [m] of the roller, evenly over those where the contact stays on the trace."""
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
    request: SweepRequest,
    out: Path,
    workers: int | str | None = None,
    callback: ProgressCallback = no_progress,
) -> dict:
    """Solve the points that `out` does not have, write table and pictures there, return the
    content.

    workers  as `tasks_by` takes them
    Raises InputError for what cannot be written, for a value with which no scene can be posed, and
    where no point has an answer."""
    answers = solved_in(out, FILES, request.points, solved, workers, callback, why_not)
    content = sweep_content(request, answers)
    whys = failures(content["points"])
    if whys.total() == len(content["points"]):
        raise InputError(next(iter(whys)))
    files = {TABLE: sweep_csv(content), SWEEP: as_json(content)}
    publish(out, files | drawn(content), FILES)
    return content


def why_not(point: Point) -> str | None:
    """Why there is no scene at a point, or it cannot be posed. A load that finite elements find is
    not known before."""
    from comparisons.runs.run import posed

    scene = point.scene
    if scene is None or (scene.load.kind == "approach" and "finite_element" in point.asked):
        return point.why
    try:
        posed(scene, surface_of(scene), point.asked)
    except (ContactError, InputError, MeshError) as error:
        return str(error)
    return None


def solved(point: Point) -> dict:
    """The answer at a point: its verdict, the rows of its figures, plausibility warnings, and its
    quiescent zones."""
    from comparisons.runs.run import Known, run

    surface = surface_of(point.scene)
    outcome = run(point.scene, None, point.asked, known=Known(surface))
    result = result_of(outcome)
    warnings = *warnings_about(point.scene, surface), *warnings_about_result(outcome)
    answer = {"status": SOLVED, "verdict": result.verdict, "within": result.within}
    answer |= {"warnings": warnings, "rows": tuple(rows_of(result, point.scene.name))}
    zones: dict[str, list[dict]] = {}  # by model, then by friction
    for zone in quiescent_zone.zones_of(outcome.findings.get(quiescent_zone.NAME)):
        entry = {"friction": zone.friction, "status": zone.state}
        entry |= {"level": zone.figures["level"].value}
        entry |= {"bridged": zone.bridged, "asperities": zone.asperities}
        zones.setdefault(zone.model, []).append(entry)
    return answer | ({quiescent_zone.NAME: zones} if zones else {})


def sweep_content(request: SweepRequest, answers: list[dict]) -> dict:
    """sweep.json: points in their order, and the scatter of every figure over all of them."""
    points = [
        {"values": list(point.at.values()), "rows": (), **answer}
        for point, answer in zip(request.points, answers, strict=True)
    ]
    fields = request.fields.items()
    return {
        "schema": SCHEMA,
        "command": request.command,
        "scene": {"name": request.scene.name, "title": request.scene.title},
        "models": list(request.models),
        "over": [{"field": name, "values": list(values)} for name, values in fields],
        "points": points,
        "scatter": scatter(points, FRICTION in request.fields),
        "versions": versions(),
    }


def scatter(points: Iterable[dict], over_friction: bool) -> list[dict]:
    """By what names a figure, friction None where it is swept: number of values, mean, standard
    deviation of the sample, smallest and largest."""
    order = {name: number for number, name in enumerate(QUANTITIES)}
    swept = {"friction": None} if over_friction else {}
    known = [row | swept for point in points for row in point["rows"] if _is_scattered(row)]
    groups = grouped(known, itemgetter(*NAMED))
    groups.sort(key=lambda g: (order.get(g[0]["quantity"], len(order)), g[0]["friction"] or 0.0))
    spreads = []
    for group in groups:
        values = [row["value"] for row in group]
        deviation = float(np.std(values, ddof=1)) if len(values) > 1 else None
        spreads.append(
            {
                **{name: group[0][name] for name in NAMED},
                "count": len(values),
                "mean": float(np.mean(values)),
                "standard_deviation": deviation,
                "smallest": min(values),
                "largest": max(values),
            }
        )
    return spreads


def _is_scattered(row: Row) -> bool:
    """Whether a row is a figure by a model or a model error, of what models are compared by."""
    study, model = row["study"], row["source"] in MODELS
    if study in (PARTIAL_SLIP.name, HEAT.name):
        return model and row["against"] is None
    compared = (study, row["against"]) in ((contact.NAME, None), (MODEL_ERROR, WHOLE))
    return model and compared and row["quantity"] in QUANTITIES


def sweep_csv(content: dict) -> str:
    """A row for each figure of each point: the swept fields, and the columns of
    `comparisons.output.flat_csv`."""
    fields = [axis["field"] for axis in content["over"]]
    rows = (
        map(harmless, [*point["values"], *(row[name] for name in COLUMNS)])
        for point in content["points"]
        for row in point["rows"]
    )
    return csv_text([[*fields, *COLUMNS], *rows])
