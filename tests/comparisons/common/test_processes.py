"""A process that works for this one: how it begins, and what it gives back."""

import os
import resource
from pathlib import Path

import pytest

from comparisons.common.processes import ProcessWorker, return_freed_memory
from comparisons.common.tasks import Tasks, called


def elsewhere(work, *args):
    """What a fresh process answers."""
    with Tasks(ProcessWorker) as tasks:
        tasks.add("work", called, work, *args)
        return tasks.result("work")


def test_it_has_one_thread_and_leaves_the_environment_as_it_was(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    assert elsewhere(os.getenv, "OMP_NUM_THREADS") == "1"
    assert os.environ["OMP_NUM_THREADS"] == "7"
    monkeypatch.delenv("OMP_NUM_THREADS")
    elsewhere(int)
    assert "OMP_NUM_THREADS" not in os.environ


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
    pages = [elsewhere(freed_memory, ask) * resource.getpagesize() for ask in (False, True)]
    assert pages[0] < 5e7 < 9e7 < pages[1]
