"""`crosscheck map`: from its arguments to a finished map, whoever does the work."""

from pathlib import Path

from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback
from comparisons.studies.maps.executors import cluster, ranks
from comparisons.studies.maps.make import make_map
from comparisons.studies.maps.point import FAILED, NOT_CONVERGED
from comparisons.studies.maps.request import MapRequest


def mapped(
    request: MapRequest, out: Path, workers: str | None, callback: ProgressCallback
) -> dict | None:
    """The content of the map; None in processes that only work for the first under mpirun.

    workers  a number of processes, or the address of a Dask scheduler; None: one a core, or what
             mpirun started
    Raises InputError for wrong ones, and as `make_map` does.
    """
    if is_several():
        with ranks() as crew:
            return None if crew is None else make_map(request, out, crew, callback)
    if workers is None or workers.isdigit():
        return make_map(request, out, _number(workers), callback)
    if "://" not in workers:
        raise InputError(
            f"--workers: is {workers!r}; allowed is a number, or a Dask scheduler's address "
            "such as tcp://host:8786"
        )
    with cluster(workers) as crew:
        return make_map(request, out, crew, callback)


def exit_status(content: dict) -> ExitStatus:
    """3 where a solver did not converge at a point."""
    whys = [point["why"] for point in content["points"] if point["status"] == FAILED]
    return (
        ExitStatus.NOT_CONVERGED if any(NOT_CONVERGED in why for why in whys) else ExitStatus.DONE
    )


def _number(given: str | None) -> int | None:
    if given is not None and int(given) < 1:
        raise InputError(f"--workers: is {given}; allowed is from 1 on")
    return None if given is None else int(given)
