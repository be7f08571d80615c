"""Which processes solve a body together: all that mpirun started, or this one by itself."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mpi4py.MPI import Comm

_alone = ContextVar("alone", default=False)


def communicator() -> "Comm":
    """Of the processes that share the next body's matrix."""
    from mpi4py import MPI

    return MPI.COMM_SELF if _alone.get() else MPI.COMM_WORLD


def is_alone() -> bool:
    """Whether this process works by itself just now, whatever others do."""
    return _alone.get()


@contextmanager
def each_alone() -> Iterator[None]:
    """Inside, this process' bodies are its own; others have theirs, or none."""
    before = _alone.set(True)
    try:
        yield
    finally:
        _alone.reset(before)
