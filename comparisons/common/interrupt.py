"""A command in a process of its own, so that Ctrl-C ends it at once.

A factorisation is one call of a compiled library, and Python hears of an interrupt when that
returns: after seconds, or minutes. So the command works in a child; its parent waits, hands
signals on, and ends a child that has not ended itself in time. What the child had finished by
then lies on disk, whole.
"""

import os
import signal
import sys
from collections.abc import Callable
from contextlib import suppress
from types import FrameType

from comparisons.common.errors import ExitStatus

PATIENCE = 1.5  # seconds that the child has to end by itself
SHOW_CURSOR = "\x1b[?25h\n"  # a progress bar that was cut off has hidden it
PR_SET_PDEATHSIG = 1  # of Linux's prctl


def watched(work: Callable[[], int], last_words: str) -> int:
    """The exit status of `work`, which a child carries out; both return from here.

    last_words  one line for standard error where the child has to be ended
    """
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # as shells have it in the background
        return work()
    sys.stdout.flush()
    sys.stderr.flush()
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # until it is heard right
    heard, said = os.pipe()
    os.set_blocking(heard, False)
    child = os.fork()
    if child == 0:
        _end_with_parent()
        signal.signal(signal.SIGINT, _interrupt_once)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        status = work()
        os.write(said, b"*")
        return status
    ended = _hand_signals_on(child)
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    if ended and status == -signal.SIGKILL:
        if _is_silent(heard):
            cursor = SHOW_CURSOR if sys.stderr.isatty() else ""
            sys.stderr.write(f"{cursor}crosscheck: {last_words}\n")
        return int(ExitStatus.INTERRUPTED)
    if status < 0:  # what ended the child ends its parent: shells tell a crash by that
        signal.signal(-status, signal.SIG_DFL)
        os.kill(os.getpid(), -status)
    return status


def _hand_signals_on(child: int) -> list[int]:
    """Have the child get what this process gets; the list is not empty once it had to be ended."""
    ended: list[int] = []

    def end(number: int, frame: FrameType | None) -> None:
        ended.append(number)
        os.kill(child, signal.SIGKILL)

    def interrupt(number: int, frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, end)  # who asks twice does not want to wait
        signal.signal(signal.SIGALRM, end)
        signal.setitimer(signal.ITIMER_REAL, PATIENCE)
        os.kill(child, signal.SIGINT)

    signal.signal(signal.SIGINT, interrupt)
    for each in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(each, lambda number, frame: os.kill(child, number))
    return ended


def _is_silent(heard: int) -> bool:
    """Whether the child has not come to its own last words: it may take long to leave then."""
    try:
        return not os.read(heard, 1)
    except BlockingIOError:
        return True


def _interrupt_once(number: int, frame: FrameType | None) -> None:
    """A terminal's Ctrl-C arrives twice, from the terminal and by way of the parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    raise KeyboardInterrupt


def _end_with_parent() -> None:
    """Have the system end this process when its parent is killed; only Linux can."""
    import ctypes

    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
