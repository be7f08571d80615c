"""A command in a process of its own, so that Ctrl-C ends it at once.

A factorisation is one call of a compiled library, and Python handles an interrupt only when that
returns: after seconds, or minutes. So the command works in a child; its parent waits, passes
signals on, and kills a child that does not end in time. What the child had finished is on disk."""

import atexit
import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from types import FrameType

from comparisons.common.errors import ExitStatus, tell

PATIENCE = 1.5  # seconds that the child has to end by itself
SHOW_CURSOR = "\x1b[?25h\n"  # a progress bar that was cut off has hidden it
KILLED = "killed, as the system does where memory ends"
PR_SET_PDEATHSIG = 1  # of Linux's prctl


def watched(work: Callable[[], int], left: str) -> int:
    """The exit status of `work`, which a child carries out; the child returns from here only where
    it has to finalize MPI.

    left  what a killed child leaves, for the line on standard error that says so"""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # as shells have it in the background
        return work()
    sys.stdout.flush()
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # until handled
    ended, ends = os.pipe()  # the child writes when its work has ended
    os.set_blocking(ended, False)
    child = os.fork()
    if child == 0:
        end_with_parent()
        signal.signal(signal.SIGINT, _interrupt_once)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        status = work()
        os.write(ends, b"*")
        if "mpi4py.MPI" not in sys.modules:
            _leave(status)
        return status
    killed = _pass_signals_to(child)
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    if killed and status == -signal.SIGKILL:
        if _is_empty(ended):  # else the child has printed its own line, and was slow to leave
            cursor = SHOW_CURSOR if sys.stderr.isatty() else ""
            tell(f"interrupted; {left}", cursor)
        return int(ExitStatus.INTERRUPTED)
    if status == -signal.SIGKILL:
        tell(f"the process that worked was {KILLED}; {left}")
        return int(ExitStatus.KILLED)
    if status < 0:  # what killed the child kills its parent: shells see a crash by that
        signal.signal(-status, signal.SIG_DFL)
        os.kill(os.getpid(), -status)
    return status


def _leave(status: int) -> None:
    """End as Python does, but for taking apart all that was imported: a tenth of a second."""
    atexit._run_exitfuncs()
    with suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def _pass_signals_to(child: int) -> list[int]:
    """Pass on what this process gets; the list is not empty once the child had to be killed."""
    killed: list[int] = []

    def kill(number: int, frame: FrameType | None) -> None:
        killed.append(number)
        os.kill(child, signal.SIGKILL)

    def interrupt(number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, kill)  # who asks twice does not want to wait
        signal.signal(signal.SIGALRM, kill)
        signal.setitimer(signal.ITIMER_REAL, PATIENCE)
        os.kill(child, signal.SIGINT)

    signal.signal(signal.SIGINT, interrupt)
    for name in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(name, lambda number, frame: os.kill(child, number))
    return killed


def _is_empty(pipe: int) -> bool:
    try:
        return not os.read(pipe, 1)
    except BlockingIOError:
        return True


def _interrupt_once(number: int, frame: FrameType | None) -> None:
    """A terminal's Ctrl-C arrives twice, from the terminal and by way of the parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    raise KeyboardInterrupt


def end_with_parent() -> None:
    """Let the system kill this process when its parent is killed; only Linux can."""
    import ctypes

    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
