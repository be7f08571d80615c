"""A sweep from its request to its files: every point solved, the figures, and how they scatter."""

from collections.abc import Iterable
from math import isfinite
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.points import FAILED, SOLVED, failed, finish
from comparisons.campaigns.sweep.request import SweepPoint, SweepRequest
from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, SolverError
from comparisons.common.files import check_writable, publish
from comparisons.common.numbers import percent, with_unit
from comparisons.common.processes import ProcessWorker, cores
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json, versions
from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES
from comparisons.output.flat_csv import COLUMNS, csv_text, harmless, rows_of
from comparisons.output.result_json import result_of
from comparisons.studies.bulge import QUANTITIES as BULGE_QUANTITIES
from comparisons.studies.bulge import Bulge, bulges_of
from comparisons.studies.quiescent_zone import QUANTITIES as ZONE_QUANTITIES
from comparisons.studies.quiescent_zone import zones_of
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from rich.console import Group

SWEEP, TABLE, PICTURE = "sweep.json", "sweep.csv", "sweep.svg"
ZONE, ZONE_MAP = "quiescent_zone", "quiescent_zone.svg"
BULGE, BULGE_CURVE = "bulge", "bulge.svg"
FILES = (TABLE, PICTURE, ZONE_MAP, BULGE_CURVE, SWEEP)
FOLDER = "sweep_points"
SCHEMA = 1
GOES_ON = "finished points are kept, the same command goes on from there"
FIGURES = ("half_plane", "finite_element", "model_error")  # whose scatter is stated


def make_sweep(
    request: SweepRequest,
    out: Path,
    workers: int | None = None,
    callback: ProgressCallback = no_progress,
) -> dict:
    """Solve the points that `out` does not have, write table and picture there, return the content.

    workers  processes; None: one a core
    Raises InputError for what cannot be written, and where no point has an answer."""
    check_writable(out, FILES)
    cache = Cache(out / FOLDER, "", {})
    cache.remove_leftovers()
    try:
        with Tasks(ProcessWorker, workers or cores(), cache) as tasks:
            finish(request.points, solved, tasks, callback, "sweep")
    except KeyboardInterrupt:
        raise KeyboardInterrupt(GOES_ON) from None
    content = sweep_content(request, cache)
    if all(point["status"] == FAILED for point in content["points"]):
        raise InputError(content["points"][0]["why"])
    from comparisons.campaigns.sweep.picture import sweep_picture
    from comparisons.campaigns.sweep.zone_map import zone_map

    files = {TABLE: sweep_csv(content), PICTURE: sweep_picture(content), SWEEP: as_json(content)}
    if any(ZONE in point for point in content["points"]):
        files[ZONE_MAP] = zone_map(content)
    if any(BULGE in point for point in content["points"]):
        from comparisons.campaigns.sweep.bulge_curve import bulge_curve

        files[BULGE_CURVE] = bulge_curve(content)
    publish(out, files, FILES)
    return content


def solved(point: SweepPoint) -> dict:
    """What was `found` at a point, or why nothing was; and the `seconds` that it took."""
    from comparisons.runs.run import run

    began = perf_counter()
    try:
        if point.scene is None:
            raise InputError(point.why)
        outcome = run(point.scene, None, point.models)
        rows = tuple(rows_of(result_of(outcome), point.scene.name))
        found = {"status": SOLVED, "rows": rows}
        if zones := _zones(outcome):
            found[ZONE] = zones
        if bulges := bulges_of(outcome.found.get(BULGE)):
            found[BULGE] = [_bulge(each) for each in bulges]
    except (InputError, SolverError, ArithmeticError) as error:
        found = failed(str(error) or type(error).__name__)
    return {"found": found, "seconds": perf_counter() - began}


def _zones(run: Run) -> dict[str, list[dict]]:
    """The quiescent zones by model, then by friction coefficient."""
    by_model: dict[str, list[dict]] = {}
    for zone in zones_of(run.found.get(ZONE)):
        figures = {name: _stated(zone.figures.get(name)) for name in ZONE_QUANTITIES}
        counts = {"bridged": zone.bridged, "asperities": zone.asperities}
        entry = {"friction": zone.friction, "status": zone.state, **figures, **counts}
        by_model.setdefault(zone.model, []).append(entry)
    return by_model


def _stated(figure: Figure | None) -> dict[str, float | None]:
    if figure is None:
        return {"value": None, "uncertainty": None}
    size = figure.numerical * figure.scale
    return {"value": figure.value, "uncertainty": size if isfinite(size) else None}


def _bulge(bulge: Bulge) -> dict:
    """Its figures by name, with the uncertainty of three of them."""
    stated = {"height": "uncertainty", "end": "end_uncertainty", "energy": "energy_uncertainty"}
    sizes = {word: _stated(bulge.figures.get(n))["uncertainty"] for n, word in stated.items()}
    values = {name: bulge.value(name) for name in BULGE_QUANTITIES}
    return {"friction": bulge.friction} | values | sizes | {"energy_ahead": bulge.energy_ahead}


def sweep_content(request: SweepRequest, cache: Cache) -> dict:
    """sweep.json: points in their order, and the scatter of every figure over all of them."""
    found = [cache.load(point.key)["found"] for point in request.points]
    over = [{"field": field.name, "values": list(field.values)} for field in request.fields]
    points = [
        {"values": list(point.values), **each, "rows": list(each.get("rows", ()))}
        for point, each in zip(request.points, found, strict=True)
    ]
    asked = " ".join(f"--over {field.text!r}" for field in request.fields)
    return {
        "schema": SCHEMA,
        "command": f"crosscheck sweep {request.scene.source} {asked}",
        "scene": {"name": request.scene.name, "title": request.scene.title},
        "models": list(request.models),
        "over": over,
        "points": points,
        "scatter": scatter(points, any(each["field"] == "load.friction" for each in over)),
        "versions": versions(),
    }


def scatter(points: Iterable[dict], over_friction: bool) -> list[dict]:
    """By quantity, friction coefficient (None where it is swept) and figure: number of values,
    mean, standard deviation of the sample, smallest and largest."""
    values: dict[tuple, list[float]] = {}
    for point in points:
        for row in point["rows"]:
            friction = None if over_friction else row["friction"]
            for figure in FIGURES:
                if row[figure] is not None:
                    values.setdefault((row["quantity"], friction, figure), []).append(row[figure])
    order = {name: number for number, name in enumerate(QUANTITIES)}
    return [
        {
            "quantity": quantity,
            "friction": friction,
            "figure": figure,
            "count": len(each),
            "mean": float(np.mean(each)),
            "standard_deviation": float(np.std(each, ddof=1)) if len(each) > 1 else None,
            "smallest": min(each),
            "largest": max(each),
        }
        for (quantity, friction, figure), each in sorted(
            values.items(), key=lambda item: (order.get(item[0][0], len(order)), item[0][1] or 0.0)
        )
    ]


def sweep_csv(content: dict) -> str:
    """A row for each point, friction coefficient and quantity: the swept fields, and the columns of
    `comparisons.output.flat_csv`."""
    fields = [each["field"] for each in content["over"]]
    rows = (
        map(harmless, [*point["values"], *(row[name] for name in COLUMNS)])
        for point in content["points"]
        for row in point["rows"]
    )
    return csv_text([[*fields, *COLUMNS], *rows])


def sweep_table(content: dict, out: Path | None) -> "Group":
    from rich.console import Group
    from rich.text import Text

    from comparisons.output.terminal import PLAIN, SHORT, plain_table

    table = plain_table("quantity", "", numbers=("mu", "mean", "std", "smallest", "largest"))
    for row in content["scatter"]:
        relative = row["figure"] == "model_error" or QUANTITIES[row["quantity"]].of_pair
        deviation, mean = row["standard_deviation"], row["mean"]
        if deviation is None:
            spread = ""
        else:  # of an error in its own per cent, of a figure in per cent of the mean
            spread = percent(deviation if relative or mean == 0.0 else deviation / abs(mean))
        unit = QUANTITIES[row["quantity"]].unit
        values = (mean, row["smallest"], row["largest"])
        shown = [percent(v, signed=True) if relative else with_unit(v, unit) for v in values]
        friction = "" if row["friction"] is None else f"{row['friction']:g}"
        words = SHORT[row["quantity"]], row["figure"].replace("_", " ")
        cells = (*words, friction, shown[0], spread, *shown[1:])
        table.add_row(*(cell.translate(PLAIN) for cell in cells))
    points = content["points"]
    whys = [point["why"] for point in points if point["status"] == FAILED]
    maps = [f for k, f in ((ZONE, ZONE_MAP), (BULGE, BULGE_CURVE)) if any(k in p for p in points)]
    files = TABLE, PICTURE, *maps, SWEEP
    over = " x ".join(f"{len(each['values'])} of {each['field']}" for each in content["over"])
    return Group(
        table,
        Text(f"{len(points)} scenes ({over}), {len(whys)} failed"),
        *(Text(f"failed, {whys.count(why)}: {why}") for why in dict.fromkeys(whys)),
        *([] if out is None else [Text(f"sweep: {', '.join(str(out / name) for name in files)}")]),
    )
