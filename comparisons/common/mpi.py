"""Several processes of one command, as mpirun starts them: one decides, speaks and writes.

All carry out the same program, since it takes all of them to factorise and to solve. What could
turn out otherwise on each (files, clocks, free memory) is found by the first and handed to the
others: processes that go different ways wait for each other for ever. What each computes for
itself comes out alike where they are the same program on the same kind of processor.

Matrix and factor are spread. gmsh, MUMPS' ordering, the half-plane, the recovery of stresses and
all files are the first's; mesh, pressures and displacements lie whole in each. Largest resident
memory [MB] at 375 000 unknowns, factor 1.25 kB an unknown:

    processes      factor in each   first   others
    1              468              986
    2              243 to 285       719     511
    4              139 to 154       598     372

Beside its part of the factor the first keeps 1 kB an unknown: right to some ten million of them,
in plane strain far beyond what a rough contact takes.
"""

import io
import os
import signal
import sys
import time
from collections.abc import Callable, Container
from contextlib import redirect_stderr, redirect_stdout, suppress
from typing import TypeVar

from fem.solver.communicator import each_alone, is_alone

Result = TypeVar("Result")

# the number of the process, as Open MPI, MPICH and PMIx launchers hand it on
RANKS = ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK")

# Seconds that another process than the first keeps an error to itself: where the first has met the
# same it says so and ends all before that.
PATIENCE = 10.0


def is_several() -> bool:
    """Whether mpirun started this process, one of several perhaps."""
    return any(name in os.environ for name in RANKS)


def is_first() -> bool:
    """Whether this is rank 0, or was started alone; the others solve the same and stay silent."""
    return all(os.environ.get(name, "0") == "0" for name in RANKS)


def from_first(make: Callable[[], Result]) -> Result:
    """What `make` returns in the first process, in every process; it runs in no other.

    To be called by all. An exception that it raises there is raised in all. What `make` calls in
    its turn is the first's alone, too.
    """
    if not is_several() or is_alone():
        return make()
    from mpi4py import MPI

    result = error = None
    if MPI.COMM_WORLD.rank == 0:
        try:
            with each_alone():
                result = make()
        except Exception as caught:
            error = caught
    kept = result
    result, error = MPI.COMM_WORLD.bcast((result, error))
    if error is not None:
        raise error
    return kept if MPI.COMM_WORLD.rank == 0 else result


def as_one(work: Callable[[], int], ends: Container[int]) -> int:
    """Carry out `work`, which returns an exit status, in every process, as if they were one.

    Only the first is heard, but for errors of another one alone. `ends` are the statuses with
    which all come to their end; with any other one a process ends the others too, which may be
    waiting for it. mpirun stops its processes by SIGTERM: that interrupts the first as Ctrl-C
    would.
    """
    if not is_several():
        return work()
    said = io.StringIO()
    if is_first():
        before = signal.signal(signal.SIGTERM, signal.default_int_handler)
        status = work()
        signal.signal(signal.SIGTERM, before)
    else:
        with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere), redirect_stderr(said):
            status = work()
    if status not in ends:
        if not is_first():
            time.sleep(PATIENCE)
            sys.stderr.write(said.getvalue())
        _end_all(status)
    return status


def _end_all(status: int) -> None:
    """End every process with this status, if there are others and MPI knows of them."""
    with suppress(OSError):  # nobody reads on
        sys.stdout.flush()
    sys.stderr.flush()
    if "mpi4py.MPI" in sys.modules:
        comm = sys.modules["mpi4py.MPI"].COMM_WORLD
        if comm.size > 1:
            comm.Abort(status)
