"""A map from start to end: its points, map.json, the picture."""

import json
import os
from contextlib import nullcontext
from pathlib import Path

from comparisons.common.files import check_writable, write_whole
from comparisons.common.processes import processes
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json
from comparisons.studies.maps.content import map_content
from comparisons.studies.maps.executors import Workers
from comparisons.studies.maps.request import MapRequest, point_cache
from comparisons.studies.maps.sweep import sweep

GOES_ON = "finished points are kept, the same command goes on from there"
MAP, PICTURE, TIMES = "map.json", "map.svg", "map_times.json"


def make_map(
    request: MapRequest,
    out: Path,
    workers: Workers | int | None = None,
    callback: ProgressCallback = no_progress,
) -> dict:
    """Compute the points that `out` lacks, write the map there, and return its content.

    workers  an executor that has the points solved, or a number of processes; None: one a core
    Raises InputError for what cannot be mapped or written.
    """
    points = request.points
    check_writable(out)
    store = point_cache(out)
    store.remove_leftovers()
    open_executor, count = processes, workers or os.cpu_count() or 1
    if isinstance(workers, Workers):
        open_executor, count = lambda count: nullcontext(workers.executor), workers.count
    try:
        sweep(points, store, open_executor, count, callback)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(GOES_ON) from None
    content = map_content(request, store)
    callback("map: picture")
    from comparisons.studies.maps.picture import map_picture

    write_whole(out / PICTURE, map_picture(content))
    write_whole(out / TIMES, as_json({"seconds": [store.load(p.key)["seconds"] for p in points]}))
    write_whole(out / MAP, as_json(content))
    return content


def read_map(path: Path) -> dict:
    """The content of a map.json."""
    return json.loads(path.read_text(encoding="utf-8"))
