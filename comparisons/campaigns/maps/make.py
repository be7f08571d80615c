"""`crosscheck map` from its request to the finished map.

In: a request, or the name of a map that comes with the project. Out: map.json and its picture."""

from pathlib import Path

from comparisons.campaigns.grid import failures, solved_in
from comparisons.campaigns.maps.content import MAP, PICTURE, map_content, showing
from comparisons.campaigns.maps.place import finished_map, mark_of
from comparisons.campaigns.maps.point import NOT_CONVERGED, solve_point
from comparisons.campaigns.maps.request import MapRequest
from comparisons.common.errors import ExitStatus
from comparisons.common.files import check_writable, publish
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json
from comparisons.models.problem import Problem

TIMES = "map_times.json"


def make_map(
    request: MapRequest,
    out: Path,
    workers: int | str | None = None,
    callback: ProgressCallback = no_progress,
    marked: Problem | None = None,
) -> dict | None:
    """Compute the points that `out` does not have, write the map there, and return its content;
    None in processes that only work for the first one under mpirun.

    workers  as `tasks_by` takes them
    marked   a scene of the user's on the picture
    Raises InputError for what cannot be mapped or written.
    """
    files = MAP, PICTURE, TIMES
    answers = solved_in(out, files, request.points, solve_point, workers, callback)
    if answers is None:
        return None
    content = map_content(request, [answer for answer, _ in answers])
    callback("map: picture")
    times = {"seconds": [seconds for _, seconds in answers]}
    publish(out, _files(content, marked) | {TIMES: as_json(times)})
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


def exit_status(content: dict) -> ExitStatus:
    """3 where a solver did not converge at a point."""
    failed = any(NOT_CONVERGED in why for why in failures(content["points"]))
    return ExitStatus.NOT_CONVERGED if failed else ExitStatus.DONE
