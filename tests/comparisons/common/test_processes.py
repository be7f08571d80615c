"""The process that measures: what it answers, and how it ends."""

import os
import signal
import threading
import time

import pytest

from comparisons.common.processes import ProcessEnded, fresh_process, share_out


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


class TestShareOut:
    def test_every_item_is_worked_on_once(self):
        worked = []
        share_out(range(100), worked.append, [worked.append, worked.append])
        assert sorted(worked) == list(range(100))

    def test_those_beside_work_at_the_same_time(self):
        both = threading.Barrier(2, timeout=60.0)
        share_out(range(2), lambda item: both.wait(), [lambda item: both.wait()])

    def test_what_a_process_had_in_hand_is_worked_on_here(self):
        here, begun = [], threading.Event()

        def ends(item):
            begun.set()
            time.sleep(0.05)  # after all others are done
            raise ProcessEnded

        def work(item):
            begun.wait(60.0)
            here.append(item)

        share_out(range(3), work, [ends])
        assert sorted(here) == [0, 1, 2]

    def test_an_error_beside_ends_the_rest_and_is_raised(self):
        here, failed = [], threading.Event()

        def fails(item):
            failed.set()
            raise ZeroDivisionError

        def work(item):
            failed.wait(60.0)
            time.sleep(0.05)
            here.append(item)

        with pytest.raises(ZeroDivisionError):
            share_out(range(10), work, [fails])
        assert len(here) <= 1

    def test_an_interrupt_here_waits_for_nobody(self):
        free = threading.Event()

        def interrupted(item):
            raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            share_out(range(2), interrupted, [lambda item: free.wait(60.0)])
        free.set()
