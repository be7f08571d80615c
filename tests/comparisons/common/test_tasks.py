"""Tasks: the same answers in any number of processes, in the order of what is asked; how a process
begins, and what it gives back."""

import itertools
import os
import resource
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import pytest

from comparisons.common import tasks as module
from comparisons.common.cache import Cache
from comparisons.common.executors import ExecutorWorker
from comparisons.common.processes import ProcessWorker, return_freed_memory
from comparisons.common.tasks import (
    FIRST,
    LATER,
    PERHAPS,
    Here,
    ProcessEnded,
    Tasks,
    called,
    tasks_here,
    tasks_of_copies,
)

LATE = {"worth": 0.0}  # processes begin when the first answer is asked for


@pytest.fixture
def one():
    with Tasks(ProcessWorker, **LATE) as tasks:
        yield tasks


@pytest.fixture
def beside():
    """Tasks of two processes."""
    with Tasks(ProcessWorker, 2, **LATE) as tasks:
        yield tasks


def home(here: Here) -> int:
    """Slow, so that each process takes part."""
    time.sleep(0.3)
    return os.getpid()


def test_a_silent_worker_is_heard_of(monkeypatch):
    """Each time that nothing was said for a while; without a share before anything is done."""
    monkeypatch.setattr(module, "SILENT", 0.05)
    said = []
    with Tasks(ProcessWorker, callback=said.append, **LATE) as tasks:
        tasks.add("home", announced_home)
        tasks.result("home")
    assert 3 < len(said) < 20 and set(said) == {"going home"}


def announced_home(here: Here) -> int:
    here.callback("going home")
    return home(here)


def met(here: Here, folder: Path, name: str, other: str) -> int:
    """The process, which waits until the other task is worked on, too."""
    (folder / name).touch()
    end = time.monotonic() + 60.0
    while not (folder / other).exists():
        assert time.monotonic() < end
        time.sleep(0.01)
    return os.getpid()


def noted(here: Here, path: Path, name: str) -> str:
    here.callback(name)
    with path.open("a") as file:
        file.write(name)
    return name


def dies(here: Here, path: Path, lives: int = 0) -> str:
    """Takes its process along, but for the `lives`th time."""
    with path.open("a") as file:
        file.write("x")
    if len(path.read_text()) != lives:
        os._exit(3)
    return "alive"


def outlasts(here: Here, path: Path) -> None:
    """Write a file and then die."""
    while not path.exists():
        time.sleep(0.01)
    time.sleep(1.0)


class TestOrder:
    def test_alone_they_run_when_they_are_asked_for(self, tmp_path):
        stages, path = [], tmp_path / "order"
        tasks = Tasks(callback=stages.append)
        for name in "abc":
            tasks.add(name, noted, path, name, seconds=1.0)
        assert [tasks.result(name) for name in "cab"] == ["c", "a", "b"]
        assert path.read_text() == "cab"
        assert [s.done for s in stages] == [0.0, pytest.approx(1 / 3), pytest.approx(2 / 3)]

    def test_two_work_side_by_side_and_not_in_this_process(self, beside, tmp_path):
        for name, other in ("ab", "ba"):
            beside.add(name, met, tmp_path, name, other)
        assert beside.result("a") and beside.result("b")
        beside.add("c", called, os.getpid)
        assert beside.result("c") != os.getpid()

    def test_the_urgent_come_first_then_the_long(self, one, tmp_path):
        path = tmp_path / "order"
        one.add("p", noted, path, "p", seconds=9.0, urgency=PERHAPS)
        one.add("s", noted, path, "s", seconds=1.0, urgency=LATER)
        one.add("l", noted, path, "l", seconds=2.0, urgency=LATER)
        one.add("f", noted, path, "f", urgency=FIRST)
        for name in "slfp":
            one.result(name)
        assert path.read_text() == "flsp"

    def test_a_known_task_becomes_more_urgent_and_not_less(self, one, tmp_path):
        path = tmp_path / "order"
        for name, urgency in (("f", FIRST), ("b", LATER), ("s", PERHAPS), ("s", FIRST), ("s", 9)):
            one.add(name, noted, path, name, seconds=1.0 + (name == "f"), urgency=urgency)
        for name in "fbs":
            one.result(name)
        assert path.read_text() == "fsb"

    def test_what_has_no_memory_beside_the_others_waits(self, beside, tmp_path):
        beside.memory = 10.0
        for name in "ab":
            beside.add(name, noted, tmp_path / "order", name, memory=6.0, seconds=1.0)
        running = []
        hand_out = beside._hand_out
        beside._hand_out = lambda: (hand_out(), running.append(len(beside._running)))
        assert [beside.result(name) for name in "ab"] == ["a", "b"]
        assert max(running) == 1

    @pytest.mark.parametrize(("places", "loaded"), [(1, []), (2, ["what draws"])])
    def test_what_is_wanted_later_is_loaded_while_a_core_is_free(self, places, loaded):
        found, spare = [], ["what draws"]
        with Tasks(ProcessWorker, places, spare=[lambda: found.extend(spare)], **LATE) as tasks:
            tasks.add("home", home)
            tasks.result("home")
        assert found == loaded


class TestProcesses:
    def test_one_that_works_for_another_begins_none(self, one, monkeypatch):
        monkeypatch.setattr(module, "cores", lambda: 2)
        monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
        assert places() == (2, True, False)
        monkeypatch.setenv("OMP_NUM_THREADS", "1")
        assert places() == (2, True, True)
        one.add("there", called, places)
        assert one.result("there") == (1, False, False)

    def test_copies_have_what_is_in_memory(self, monkeypatch):
        monkeypatch.setenv("OMP_NUM_THREADS", "1")
        monkeypatch.setattr(os, "sched_getaffinity", lambda process: {0, 1})
        with tasks_of_copies(lambda: "no pickle takes this") as tasks:
            for name in "ab":
                tasks.add(name, lookup)
            answers = [tasks.result(name) for name in "ab"]
        assert {said for said, _ in answers} == {"no pickle takes this"}
        assert os.getpid() not in {process for _, process in answers}

    def test_errors_are_raised_where_they_are_asked_for(self, beside):
        beside.add("bad", called, divmod, 1, 0, urgency=FIRST)
        beside.add("good", called, os.getpid)
        assert beside.result("good")
        with pytest.raises(ZeroDivisionError):
            beside.result("bad")


def places() -> tuple[float, bool, bool]:
    """How many workers there may be, whether there are any, and any copies."""
    tasks = tasks_here()
    return tasks.at_once, tasks.opens is not None, tasks_of_copies(None).opens is not None


def lookup(here: Here) -> tuple[str, int]:
    time.sleep(0.3)
    return here.shared(), os.getpid()


def test_what_is_done_is_not_done_again(tmp_path):
    kept, path = Cache(tmp_path / "kept", "key", {}), tmp_path / "order"
    for _ in range(2):
        tasks = Tasks(ProcessWorker, kept=kept)
        with tasks:
            tasks.add("a", noted, path, "a")
            assert tasks.result("a") == "a"
    assert path.read_text() == "a" and not tasks._has_begun
    tasks.add("bad", called, divmod, 1, 0)
    with pytest.raises(ZeroDivisionError), tasks:
        tasks.result("bad")
    assert [path.name for path in kept.folder.iterdir()] == ["a.npz"]
    other = Tasks(kept=Cache(tmp_path / "kept", "another", {}))
    other.add("a", noted, path, "a")
    assert other.result("a") == "a" and path.read_text() == "aa"


class TestEnds:
    def test_a_task_that_ends_every_process_ends_not_this_one(self, beside, tmp_path):
        """Others are done all the same, and it is tried twice."""
        for name in "abcd":
            beside.add(name, home, seconds=1.0)
        beside.add("dies", dies, tmp_path / "tried", seconds=2.0)
        with pytest.raises(ProcessEnded, match="it ended with status 3, for the second time"):
            beside.result("dies")
        assert len({beside.result(name) for name in "abcd"} - {os.getpid()}) >= 1
        assert (tmp_path / "tried").read_text() == "xx"
        beside.add("after", called, os.getpid)
        assert beside.result("after") != os.getpid()

    def test_a_task_that_lost_its_process_is_tried_alone(self, beside, tmp_path):
        beside.add("dies", dies, tmp_path / "tried", 2, seconds=3.0)
        beside.add("beside", outlasts, tmp_path / "tried", seconds=1.0)
        running, hand_out, stages = [], beside._hand_out, []
        beside.callback = lambda stage: stages.append(str(stage))
        beside._hand_out = lambda: (hand_out(), running.append(sorted(beside._running.values())))
        assert beside.result("dies") == "alive"
        [line] = stages
        assert line.startswith("dies: the process that worked on it ended with status 3; it is ")
        steps = [[], ["beside", "dies"], ["beside"], ["dies"], []]
        assert [step for step, _ in itertools.groupby([[], *running, []])] == steps

    def test_one_that_hears_nothing_ends_at_an_interrupt(self, one):
        """It sleeps with Python's lock held, as in a factorisation."""
        asleep = "__import__('ctypes').PyDLL(None).sleep(300)"
        begin = time.monotonic()
        with pytest.raises(KeyboardInterrupt), one:
            one.add("process", called, os.getpid)
            process = one.result("process")
            one.add("asleep", called, eval, asleep)
            threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
            one.result("asleep")
        assert time.monotonic() - begin < 100.0
        with pytest.raises(ProcessLookupError):
            os.kill(process, 0)


def test_tasks_are_submitted_as_they_become_known(tmp_path):
    with ThreadPoolExecutor(2) as pool, Tasks(partial(ExecutorWorker, pool), 9) as tasks:
        for name, other in ("ab", "ba"):
            tasks.add(name, met, tmp_path, name, other)
        while not all((tmp_path / name).exists() for name in "ab"):
            time.sleep(0.01)  # with nobody waiting for a result
        assert tasks.result("a") and tasks.result("b")
        tasks.add("bad", called, divmod, 1, 0)
        with pytest.raises(ZeroDivisionError):
            tasks.result("bad")


def elsewhere(work, *args):
    """Result of a fresh process."""
    with Tasks(ProcessWorker) as tasks:
        tasks.add("work", called, work, *args)
        return tasks.result("work")


def test_a_process_has_one_thread_and_leaves_the_environment_as_it_was(monkeypatch):
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
