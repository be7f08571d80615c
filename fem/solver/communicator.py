"""The processes that solve a body together: all that mpirun started, or this one alone."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mpi4py.MPI import Comm

_alone = ContextVar("alone", default=False)


def communicator() -> "Comm":
    """Communicator of the processes that share the next body's matrix."""
    from mpi4py import MPI

    return MPI.COMM_SELF if _alone.get() else MPI.COMM_WORLD


def is_alone() -> bool:
    """Whether this process solves its bodies alone now."""
    return _alone.get()


@contextmanager
def each_alone() -> Iterator[None]:
    """Inside, each process solves its own bodies alone."""
    before = _alone.set(True)
    try:
        yield
    finally:
        _alone.reset(before)
