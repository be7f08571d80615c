"""Several processes of one command, as mpirun starts them: one decides, speaks and writes.

All carry out the same program, since it takes all of them to factorise and to solve. What may
differ between them (files, clocks, free memory) is found by the first and sent to the others:
processes that take different branches wait for each other for ever. What each computes for itself
is equal where they are the same program on the same kind of processor.

Matrix and factor are distributed. gmsh, MUMPS' ordering, the half-plane, the recovery of stresses
and all files are the first's; mesh, pressures and displacements are whole in each. At 375 000
unknowns one process takes 986 MB, of four the first 598 MB and the others 372 MB: the factor takes
1.25 kB an unknown in all, and the first 1 kB an unknown beside its part of it."""

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

# Seconds before another process than the first prints its error: where the first has the same
# error, it prints it and ends all of them before that.
PATIENCE = 10.0


def is_several() -> bool:
    """Whether mpirun started this process, one of several perhaps."""
    return any(name in os.environ for name in RANKS)


def forget_inherited_launcher() -> None:
    """Where the environment names a rank, but MPI knows of no other process, drop what it says: a
    shell inherited it, and this process is alone."""
    if is_several():
        from mpi4py import MPI

        if MPI.COMM_WORLD.size == 1:
            for name in RANKS:
                os.environ.pop(name, None)


def is_first() -> bool:
    """Whether this is rank 0, or was started alone; the others solve the same and stay silent."""
    return all(os.environ.get(name, "0") == "0" for name in RANKS)


def from_first(make: Callable[[], Result]) -> Result:
    """What `make` returns in the first process, in every process; it runs in no other.
    All must call it. An exception that `make` raises is raised in all. Calls of `from_first` inside
    `make` run in the first alone."""
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
    made = result
    result, error = MPI.COMM_WORLD.bcast((result, error))
    if error is not None:
        raise error
    return made if MPI.COMM_WORLD.rank == 0 else result


def as_one(work: Callable[[], int], ends: Container[int]) -> int:
    """Carry out `work`, which returns an exit status, in every process, as if they were one.
    Only the first prints, and one that alone has an error. `ends` are the statuses with
    which all end by themselves; with any other status a process ends the others too, which may be
    waiting for it. mpirun's SIGTERM interrupts the first process as Ctrl-C does."""
    if not is_several():
        return work()
    errors = io.StringIO()
    if is_first():
        before = signal.signal(signal.SIGTERM, signal.default_int_handler)
        status = work()
        signal.signal(signal.SIGTERM, before)
    else:
        with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere), redirect_stderr(errors):
            status = work()
    if status not in ends:
        if not is_first():
            time.sleep(PATIENCE)
            with suppress(OSError):
                sys.stderr.write(errors.getvalue())
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
