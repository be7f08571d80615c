"""A sweep from its request to its files: every point solved, the figures, and how they scatter."""

from collections.abc import Iterable
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.points import FAILED, SOLVED, failed, finish, tasks_by
from comparisons.campaigns.sweep.request import SweepPoint, SweepRequest
from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, SolverError
from comparisons.common.files import check_writable, publish
from comparisons.common.numbers import percent, with_unit
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json, versions
from comparisons.figures.quantity import QUANTITIES
from comparisons.results.flat_table import COLUMNS, csv_text, harmless, rows_of
from comparisons.scenes.resolve import resolve_tables

if TYPE_CHECKING:
    from rich.console import Group

SWEEP, TABLE, PICTURE = "sweep.json", "sweep.csv", "sweep.svg"
ZONE, ZONE_MAP = "quiescent_zone", "quiescent_zone.svg"
BULGE, BULGE_CURVE = "bulge", "bulge.svg"
LONG = ("distance", "rise", "patches")  # of a bulge's entries: left out
FILES = (TABLE, PICTURE, ZONE_MAP, BULGE_CURVE, SWEEP)
FOLDER = "sweep_points"
SCHEMA = 1
GOES_ON = "finished points are kept, the same command goes on from there"
FIGURES = ("half_plane", "finite_element", "model_error")  # whose scatter is stated


def make_sweep(
    request: SweepRequest,
    out: Path,
    workers: int | str | None = None,
    callback: ProgressCallback = no_progress,
) -> dict | None:
    """Solve the points that `out` does not have, write table and picture there, return the content;
    None in processes that only work for the first one under mpirun.

    workers  as `tasks_by` takes them
    Raises InputError for what cannot be written, and where no point has an answer."""
    cache = Cache(out / FOLDER, "", {})
    try:
        with tasks_by(workers, cache) as tasks:
            if tasks is None:
                return None
            check_writable(out, FILES)
            cache.remove_leftovers()
            solve = partial(solved, name=request.name)
            finish(request.points, solve, tasks, callback, "sweep")
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


def solved(point: SweepPoint, name: str) -> dict:
    """What was `found` at a point, or why nothing was; and the `seconds` that it took."""
    from comparisons.runs.run import run

    began = perf_counter()
    try:
        if point.tables is None:
            raise InputError(point.why)
        place = {"folder": point.folder, "source": point.source}
        scene = resolve_tables(point.tables, name=name, **place)
        outcome = run(scene, None, point.models)
        rows = tuple(rows_of(outcome.result, name))
        found = {"status": SOLVED, "rows": rows}
        if (zones := outcome.result["quiescent_zone"]) and "why" not in zones:
            for entry in (each for entries in zones.values() for each in entries):
                entry["asperities"] = len(entry["asperities"])
            found[ZONE] = zones
        if entries := (outcome.result["bulge"] or {}).get("by_friction"):
            found[BULGE] = [{k: v for k, v in e.items() if k not in LONG} for e in entries]
    except (InputError, SolverError, ArithmeticError) as error:
        found = failed(str(error) or type(error).__name__)
    return {"found": found, "seconds": perf_counter() - began}


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
        "command": f"crosscheck sweep {request.source} {asked}",
        "scene": {"name": request.name, "title": request.title},
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
    `comparisons.results.flat_table`."""
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

    from comparisons.report.terminal import PLAIN, SHORT, plain_table

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
