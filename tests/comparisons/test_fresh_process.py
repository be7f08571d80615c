"""The process that measures: what it answers, and how it ends."""

import os
import signal
import threading
import time

import pytest

from comparisons.fresh_process import ProcessEnded, fresh_process


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
