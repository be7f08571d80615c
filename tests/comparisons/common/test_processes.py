"""The process that measures: what it answers, and how it ends."""

import os
import resource
import signal
import threading
import time
from pathlib import Path

import pytest

from comparisons.common.processes import (
    ProcessEnded,
    fresh_process,
    return_freed_memory,
    side_by_side,
)


def test_one_that_hears_nothing_ends_at_an_interrupt():
    """It sleeps with Python's lock held, as in a factorisation."""
    asleep, numbers = "__import__('ctypes').PyDLL(None).sleep(300)", []
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt), fresh_process() as call:
        numbers.append(call(os.getpid))
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        call(eval, asleep)
    assert time.monotonic() - begin < 100.0
    with pytest.raises(ProcessLookupError):
        os.kill(numbers[0], 0)


def test_one_that_is_killed_before_it_has_read_a_large_task():
    """Nobody waits for it: an executor's thread would, with the task in hand."""
    with pytest.raises(KeyboardInterrupt), fresh_process() as call:
        os.kill(call(os.getpid), signal.SIGSTOP)
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        call(len, b"1" * 10**7)


def test_it_hears_no_ctrl_c_while_it_starts():
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    with fresh_process() as call:
        blocked = call(eval, "__import__('signal').pthread_sigmask(0, ())")
    assert signal.SIGINT in blocked
    assert signal.pthread_sigmask(signal.SIG_BLOCK, ()) == before


def test_answers_errors_and_its_end():
    with fresh_process() as call:
        assert call(len, b"1" * 10**7) == 10**7
        with pytest.raises(ZeroDivisionError):
            call(eval, "1 / 0")
        assert call(os.getenv, "OMP_NUM_THREADS") == "1"
        with pytest.raises(ProcessEnded):
            call(os._exit, 3)


@pytest.fixture
def two_cores(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {0, 1})
    monkeypatch.setenv("OMP_NUM_THREADS", "1")


@pytest.mark.usefixtures("two_cores")
class TestSideBySide:
    def test_copies_answer_in_order_with_what_is_in_memory(self):
        shared = [bytes(number) for number in range(9)]
        answers = side_by_side([lambda n=n: (len(shared[n]), os.getpid()) for n in range(9)])
        assert [size for size, _ in answers] == list(range(9))
        assert os.getpid() not in {copy for _, copy in answers}

    def test_one_core_works_here(self, monkeypatch):
        monkeypatch.setattr(os, "sched_getaffinity", lambda process: {0})
        assert side_by_side([os.getpid] * 3) == [os.getpid()] * 3

    def test_several_threads_work_here(self, monkeypatch):
        monkeypatch.setenv("OMP_NUM_THREADS", "2")
        assert side_by_side([os.getpid] * 3) == [os.getpid()] * 3

    def test_what_a_killed_copy_was_to_do_is_done_here(self):
        own = os.getpid()
        assert side_by_side([lambda: os.getpid() == own or os._exit(9)] * 3) == [True] * 3

    def test_errors_come_through(self):
        with pytest.raises(ZeroDivisionError):
            side_by_side([lambda: 1 / 0, int])
        with pytest.raises(FileNotFoundError, match="nowhere"):
            side_by_side([int, lambda: os.stat("/nowhere/at/all")])

    def test_an_interrupt_ends_them(self):
        before = signal.pthread_sigmask(signal.SIG_BLOCK, ())
        begin = time.monotonic()
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            side_by_side([lambda: time.sleep(300.0)] * 2)
        assert time.monotonic() - begin < 100.0
        assert signal.pthread_sigmask(signal.SIG_BLOCK, ()) == before


def freed_memory(ask: bool) -> int:
    """Pages that a process gives back once it has freed 100 MB below something that it keeps."""
    blocks = [bytearray(2**16) for _ in range(1600)]
    kept = [bytearray(2**16) for _ in range(8)]
    before = resident()
    del blocks
    if ask:
        return_freed_memory()
    return before - resident() if kept else 0


def resident() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1])


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read from /proc")
def test_freed_memory_is_returned_when_asked_for():
    """The C library alone keeps it."""
    pages = []
    for ask in (False, True):
        with fresh_process() as call:
            pages.append(call(freed_memory, ask) * resource.getpagesize())
    assert pages[0] < 5e7 < 9e7 < pages[1]
