"""A sweep from its request to its files: every point solved, the figures, and how they scatter.

In: a request. Out: sweep.json, a table, pictures; and the scatter for the terminal."""

from collections.abc import Iterable
from math import isfinite
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.grid import SOLVED, Point, failures, solved_in
from comparisons.campaigns.sweep.request import SweepRequest
from comparisons.common.errors import InputError
from comparisons.common.files import publish
from comparisons.common.numbers import percent, with_unit
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json, versions
from comparisons.figures.figure import Figure, Findings, grouped
from comparisons.figures.quantity import QUANTITIES
from comparisons.output.flat_csv import COLUMNS, csv_text, harmless, rows_of
from comparisons.output.result_json import result_of
from comparisons.studies import bulge, quiescent_zone

if TYPE_CHECKING:
    from rich.console import Group

SWEEP, TABLE, PICTURE = "sweep.json", "sweep.csv", "sweep.svg"
PICTURES = {quiescent_zone.NAME: "quiescent_zone.svg", bulge.NAME: "bulge.svg"}  # by study
FILES = (SWEEP, TABLE, PICTURE, *PICTURES.values())
SCHEMA = 1
SCATTERED = ("half_plane", "finite_element", "model_error")  # figures whose scatter is stated
UNCERTAIN = {"height": "uncertainty", "end": "end_uncertainty", "energy": "energy_uncertainty"}


def make_sweep(
    request: SweepRequest,
    out: Path,
    workers: int | str | None = None,
    callback: ProgressCallback = no_progress,
) -> dict | None:
    """Solve the points that `out` does not have, write table and pictures there, return the
    content; None in processes that only work for the first one under mpirun.

    workers  as `tasks_by` takes them
    Raises InputError for what cannot be written, and where no point has an answer."""
    answers = solved_in(out, FILES, request.points, solved, workers, callback)
    if answers is None:
        return None
    content = sweep_content(request, [answer for answer, _ in answers])
    whys = failures(content["points"])
    if whys.total() == len(content["points"]):
        raise InputError(next(iter(whys)))
    from comparisons.campaigns.sweep.pictures import bulge_curve, sweep_picture, zone_map

    files = {TABLE: sweep_csv(content), PICTURE: sweep_picture(content), SWEEP: as_json(content)}
    for name, picture in ((quiescent_zone.NAME, zone_map), (bulge.NAME, bulge_curve)):
        if any(name in point for point in content["points"]):
            files[PICTURES[name]] = picture(content)
    publish(out, files, FILES)
    return content


def solved(point: Point) -> dict:
    """The answer at a point: the rows of its figures, its quiescent zones and its bulges."""
    from comparisons.runs.run import run

    outcome = run(point.scene, None, point.asked)
    answer = {"status": SOLVED, "rows": tuple(rows_of(result_of(outcome), point.scene.name))}
    if zones := _zones(outcome.found.get(quiescent_zone.NAME)):
        answer[quiescent_zone.NAME] = zones
    if bulges := bulge.bulges_of(outcome.found.get(bulge.NAME)):
        answer[bulge.NAME] = list(map(_bulge, bulges))
    return answer


def _zones(findings: Findings | None) -> dict[str, list[dict]]:
    """By model, then by friction coefficient."""
    by_model: dict[str, list[dict]] = {}
    for zone in quiescent_zone.zones_of(findings):
        figures = {n: _stated(zone.figures.get(n)) for n in quiescent_zone.QUANTITIES}
        counts = {"bridged": zone.bridged, "asperities": zone.asperities}
        entry = {"friction": zone.friction, "status": zone.state, **figures, **counts}
        by_model.setdefault(zone.model, []).append(entry)
    return by_model


def _bulge(raised: bulge.Bulge) -> dict:
    """Its figures by name, with the uncertainty of three of them."""
    values = {name: raised.value(name) for name in bulge.QUANTITIES}
    sizes = {k: _stated(raised.figures.get(name))["uncertainty"] for name, k in UNCERTAIN.items()}
    return {"friction": raised.friction} | values | sizes | {"energy_ahead": raised.energy_ahead}


def _stated(figure: Figure | None) -> dict[str, float | None]:
    if figure is None:
        return {"value": None, "uncertainty": None}
    size = figure.numerical * figure.scale
    return {"value": figure.value, "uncertainty": size if isfinite(size) else None}


def sweep_content(request: SweepRequest, answers: list[dict]) -> dict:
    """sweep.json: points in their order, and the scatter of every figure over all of them."""
    points = [
        {"values": list(point.at.values()), **answer, "rows": list(answer.get("rows", ()))}
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
        "scatter": scatter(points, "load.friction" in request.fields),
        "versions": versions(),
    }


def scatter(points: Iterable[dict], over_friction: bool) -> list[dict]:
    """By quantity, friction coefficient (None where it is swept) and figure: number of values,
    mean, standard deviation of the sample, smallest and largest."""
    order = {name: number for number, name in enumerate(QUANTITIES)}
    known = [
        (row["quantity"], None if over_friction else row["friction"], figure, row[figure])
        for point in points
        for row in point["rows"]
        for figure in SCATTERED
        if row[figure] is not None
    ]
    groups = grouped(known, itemgetter(slice(3)))
    groups.sort(key=lambda group: (order.get(group[0][0], len(order)), group[0][1] or 0.0))
    return [_spread(*group[0][:3], [value for *_, value in group]) for group in groups]


def _spread(quantity: str, friction: float | None, figure: str, values: list[float]) -> dict:
    return {
        "quantity": quantity,
        "friction": friction,
        "figure": figure,
        "count": len(values),
        "mean": float(np.mean(values)),
        "standard_deviation": float(np.std(values, ddof=1)) if len(values) > 1 else None,
        "smallest": min(values),
        "largest": max(values),
    }


def sweep_csv(content: dict) -> str:
    """A row for each point, friction coefficient and quantity: the swept fields, and the columns of
    `comparisons.output.flat_csv`."""
    fields = [axis["field"] for axis in content["over"]]
    rows = (
        map(harmless, [*point["values"], *(row[name] for name in COLUMNS)])
        for point in content["points"]
        for row in point["rows"]
    )
    return csv_text([[*fields, *COLUMNS], *rows])


def sweep_table(content: dict, out: Path | None) -> "Group":
    from rich.console import Group
    from rich.text import Text

    from comparisons.output.terminal import PLAIN, plain_table

    table = plain_table("quantity", "", numbers=("mu", "mean", "std", "smallest", "largest"))
    for row in content["scatter"]:
        table.add_row(*(cell.translate(PLAIN) for cell in _cells(row)))
    points = content["points"]
    whys = failures(points)
    pictures = [file for name, file in PICTURES.items() if any(name in p for p in points)]
    files = TABLE, PICTURE, *pictures, SWEEP
    over = " x ".join(f"{len(axis['values'])} of {axis['field']}" for axis in content["over"])
    return Group(
        table,
        Text(f"{len(points)} scenes ({over}), {whys.total()} failed"),
        *(Text(f"failed, {count}: {why}") for why, count in whys.items()),
        *([] if out is None else [Text(f"sweep: {', '.join(str(out / name) for name in files)}")]),
    )


def _cells(row: dict) -> tuple[str, ...]:
    """The scatter of an error in its per cent, of a figure in per cent of the mean."""
    quantity, deviation, mean = QUANTITIES[row["quantity"]], row["standard_deviation"], row["mean"]
    relative = row["figure"] == "model_error" or quantity.of_pair
    spread = ""
    if deviation is not None:
        spread = percent(deviation if relative or mean == 0.0 else deviation / abs(mean))
    mean, *ends = (
        percent(value, signed=True) if relative else with_unit(value, quantity.unit)
        for value in (mean, row["smallest"], row["largest"])
    )
    friction = "" if row["friction"] is None else f"{row['friction']:g}"
    return quantity.short, row["figure"].replace("_", " "), friction, mean, spread, *ends
