"""`crosscheck map` from its request to the finished map, whoever solves the points."""

import os
from contextlib import nullcontext
from pathlib import Path

from comparisons.campaigns.maps.content import MAP, PICTURE, map_content, showing
from comparisons.campaigns.maps.place import finished_map, mark_of
from comparisons.campaigns.maps.point import NOT_CONVERGED, solve_point
from comparisons.campaigns.maps.request import MapRequest, point_cache
from comparisons.campaigns.points import FAILED, Workers, cluster, ranks, solve_points
from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.files import check_writable, publish
from comparisons.common.mpi import is_several
from comparisons.common.processes import processes
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json
from comparisons.models.problem import Problem

GOES_ON = "finished points are kept, the same command goes on from there"
TIMES = "map_times.json"


def make_map(
    request: MapRequest,
    out: Path,
    workers: Workers | int | None = None,
    callback: ProgressCallback = no_progress,
    marked: Problem | None = None,
) -> dict:
    """Compute the points that `out` does not have, write the map there, and return its content.

    workers  an executor that solves the points, or a number of processes; None: one a core
    marked   a scene of the user's on the picture
    Raises InputError for what cannot be mapped or written.
    """
    points = request.points
    check_writable(out, (PICTURE, TIMES, MAP))
    cache = point_cache(out)
    cache.remove_leftovers()
    open_executor, count = processes, workers or os.cpu_count() or 1
    if isinstance(workers, Workers):
        open_executor, count = lambda count: nullcontext(workers.executor), workers.count
    try:
        solve_points(points, solve_point, cache, open_executor, count, callback)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(GOES_ON) from None
    content = map_content(request, cache)
    callback("map: picture")
    seconds = {"seconds": [cache.load(point.key)["seconds"] for point in points]}
    publish(out, _files(content, marked) | {TIMES: as_json(seconds)})
    return content


def show_finished(name: str, quantity: str, marked: Problem | None, out: Path) -> dict:
    """Write a map that comes with the project to `out`, and return its content; nothing is solved.
    Raises InputError for a quantity that it does not have, and what cannot be written."""
    content = showing(finished_map(name), quantity)
    check_writable(out, (PICTURE, MAP))
    publish(out, _files(content, marked))
    return content


def _files(content: dict, marked: Problem | None) -> dict[str, str]:
    from comparisons.campaigns.maps.picture import map_picture

    mark = None if marked is None else mark_of(content, marked)
    return {PICTURE: map_picture(content, mark), MAP: as_json(content)}


def make_map_by(
    workers: str | None,
    request: MapRequest,
    out: Path,
    callback: ProgressCallback,
    marked: Problem | None = None,
) -> dict | None:
    """As `make_map`; None in processes that only work for the first one under mpirun.

    workers  as on the command line: a number of processes, or the address of a Dask scheduler;
             None: one a core, or what mpirun started
    Raises InputError for wrong ones too.
    """
    if is_several():
        with ranks() as pool:
            return None if pool is None else make_map(request, out, pool, callback, marked)
    if workers is None:
        return make_map(request, out, None, callback, marked)
    if workers.isdigit():
        if int(workers) < 1:
            raise InputError(f"--workers: is {workers}; allowed is from 1 on")
        return make_map(request, out, int(workers), callback, marked)
    if "://" not in workers:
        raise InputError(
            f"--workers: is {workers!r}; allowed is a number, or a Dask scheduler's address "
            "such as tcp://host:8786"
        )
    with cluster(workers) as pool:
        return make_map(request, out, pool, callback, marked)


def exit_status(content: dict) -> ExitStatus:
    """3 where a solver did not converge at a point."""
    whys = [point["why"] for point in content["points"] if point["status"] == FAILED]
    failed = any(NOT_CONVERGED in why for why in whys)
    return ExitStatus.NOT_CONVERGED if failed else ExitStatus.DONE
