"""Tasks of a run: the same answers in any number of processes, in the order of what is asked."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from scenes import PROJECT

from comparisons.common import tasks as module
from comparisons.common.processes import fresh_process
from comparisons.common.tasks import AT_ONCE, FIRST, LATER, PERHAPS, Here, Tasks, tasks_of_a_run

GIGABYTES = 1e12


@pytest.fixture
def worth(monkeypatch):
    """Processes begin, whatever there is to do."""
    monkeypatch.setattr(module, "WORTH_A_START", 0.0)
    monkeypatch.setattr(module, "WORTH_A_FORK", 0.0)


@pytest.fixture
def beside(worth):
    """Tasks of two processes."""
    with tasks_of_a_run(lambda stage: None, GIGABYTES) as tasks:
        tasks.processes = 2
        yield tasks


def number(here: Here, *given: object) -> int:
    return os.getpid()


def home(here: Here) -> int:
    """Slow, so that each process takes part."""
    time.sleep(0.3)
    return os.getpid()


def noted(here: Here, path: Path, name: str) -> str:
    here.callback(name)
    with path.open("a") as file:
        file.write(name)
    return name


def together(here: Here, folder: Path, own: str, other: str) -> bool:
    """Whether the other one begins while this one works."""
    (folder / own).touch()
    end = time.monotonic() + 60.0
    while not (folder / other).exists() and time.monotonic() < end:
        time.sleep(0.01)
    return (folder / other).exists()


def divided(here: Here) -> float:
    return 1 / 0


def dies_elsewhere(here: Here, home: int) -> str:
    if os.getpid() != home:
        os._exit(3)
    return "here"


def test_alone_they_run_when_they_are_asked_for(tmp_path):
    told, path = [], tmp_path / "order"
    tasks = Tasks(told.append)
    for name in "abc":
        tasks.add(name, noted, path, name, seconds=1.0)
    assert [tasks.result(name) for name in "cab"] == ["c", "a", "b"]
    assert path.read_text() == "cab"
    assert [stage.done for stage in told] == [0.0, pytest.approx(1 / 3), pytest.approx(2 / 3)]


def test_two_work_side_by_side_and_not_in_this_process(beside, tmp_path):
    for one, other in ("ab", "ba"):
        beside.add(one, together, tmp_path, one, other)
    assert beside.result("a") and beside.result("b")
    beside.add("c", number)
    assert beside.result("c") != os.getpid()


def test_the_urgent_come_first_then_the_long(worth, tmp_path):
    path = tmp_path / "order"
    with tasks_of_a_run(lambda stage: None, GIGABYTES) as tasks:
        tasks.processes = 1
        tasks.add("p", noted, path, "p", seconds=9.0, urgency=PERHAPS)
        tasks.add("s", noted, path, "s", seconds=1.0, urgency=LATER)
        tasks.add("l", noted, path, "l", seconds=2.0, urgency=LATER)
        tasks.add("f", noted, path, "f", urgency=FIRST)
        for name in "slfp":
            tasks.result(name)
    assert path.read_text() == "flsp"


@pytest.mark.parametrize(("other", "order"), [(2.5, "fsbt"), (4.0, "fbst")])
def test_a_process_stays_with_what_shares_while_that_takes_longer(worth, tmp_path, other, order):
    path = tmp_path / "order"
    given = {"f": (9.0, 1), "b": (other, 2), "s": (2.0, 1), "t": (1.0, 1)}
    with tasks_of_a_run(lambda stage: None, GIGABYTES) as tasks:
        tasks.processes = 1
        for name, (seconds, shares) in given.items():
            tasks.add(name, noted, path, name, seconds=seconds, shares=shares)
        for name in given:
            tasks.result(name)
    assert path.read_text() == order


def test_processes_share_different_things(beside):
    """Four tasks in pairs that share: each process has one pair."""
    for name in "aabb":
        beside.add(f"{name}{len(beside._tasks)}", home, seconds=1.0, shares=name)
    found = {key: beside.result(key) for key in list(beside._tasks)}
    assert len({found[key] for key in found if key[0] == "a"}) == 1
    assert {found[key] for key in found if key[0] == "a"}.isdisjoint(
        found[key] for key in found if key[0] == "b"
    )


def test_a_known_task_becomes_more_urgent_and_not_less(worth, tmp_path):
    path = tmp_path / "order"
    with tasks_of_a_run(lambda stage: None, GIGABYTES) as tasks:
        tasks.processes = 1
        for name, urgency in (("f", FIRST), ("b", LATER), ("s", PERHAPS), ("s", FIRST), ("s", 9)):
            tasks.add(name, noted, path, name, seconds=1.0 + (name == "f"), urgency=urgency)
        for name in "fbs":
            tasks.result(name)
    assert path.read_text() == "fsb"


def test_what_has_no_memory_beside_the_others_waits(beside, tmp_path):
    beside.memory = 10.0
    for name in "ab":
        beside.add(name, noted, tmp_path / "order", name, memory=6.0, seconds=1.0)
    running = []
    hand_out = beside._hand_out
    beside._hand_out = lambda: (hand_out(), running.append(len(beside._running)))
    assert [beside.result(name) for name in "ab"] == ["a", "b"]
    assert max(running) == 1


def test_errors_are_raised_where_they_are_asked_for(beside):
    beside.add("bad", divided, urgency=FIRST)
    beside.add("good", number)
    assert beside.result("good")
    with pytest.raises(ZeroDivisionError):
        beside.result("bad")


def test_what_its_process_did_not_finish_is_done_here(beside):
    beside.add("a", dies_elsewhere, os.getpid())
    assert beside.result("a") == "here"


def test_few_tasks_begin_no_process(monkeypatch):
    monkeypatch.setattr(module, "WORTH_A_START", 1.0)
    monkeypatch.setattr(module, "WORTH_A_FORK", 1.0)
    with tasks_of_a_run(lambda stage: None, GIGABYTES) as tasks:
        tasks.processes = 2
        tasks.add("a", number, seconds=1e9)  # nothing to do beside it
        tasks.add("b", number, seconds=0.5)
        tasks.add("c", number, seconds=1e9, urgency=PERHAPS)
        assert tasks.result("a") == os.getpid()


def test_one_of_several_processes_begins_none(monkeypatch):
    cores = len(os.sched_getaffinity(0))
    assert _processes() == (cores if cores > 1 else 0)
    with fresh_process() as call:
        assert call(_processes) == 0
    monkeypatch.setattr(module, "is_several", lambda: True)
    assert _processes() == 0


def _processes() -> int:
    with tasks_of_a_run(lambda stage: None, GIGABYTES) as tasks:
        return tasks.processes


FORKED = """
import os, pathlib, sys, time
from comparisons.common import tasks as module
from comparisons.common.tasks import tasks_of_a_run
module.WORTH_A_FORK = 0.0
loaded = os.getpid()

def stuck(here, name):
    pathlib.Path(name).write_text(f"{os.getpid()} {loaded}")
    sum(range(10**12))  # hears no signal

with tasks_of_a_run(print, 1e12) as tasks:
    tasks.processes = 2
    tasks.add("a", stuck, "a")
    tasks.add("b", stuck, "b")
    try:
        tasks.result("a")
    except KeyboardInterrupt:
        pass
print("ended")
"""


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGKILL])
def test_forked_ones_end_with_this_one(tmp_path, sent):
    environment = os.environ | {"PYTHONPATH": str(PROJECT), "OMP_NUM_THREADS": "1"}
    process = subprocess.Popen(
        [sys.executable, "-c", FORKED],
        cwd=tmp_path,
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    there, end = [tmp_path / "a", tmp_path / "b"], time.monotonic() + 60.0
    while not all(path.exists() and path.read_text() for path in there):
        assert process.poll() is None and time.monotonic() < end
        time.sleep(0.02)
    assert {int(path.read_text().split()[1]) for path in there} == {
        process.pid
    }  # not imported anew
    process.send_signal(sent)
    out, _ = process.communicate(timeout=60.0)  # returns when none of them holds the output
    assert out == ("ended\n" if sent == signal.SIGINT else "")


def test_nothing_is_prepared_while_others_wait_for_a_task(worth):
    done = []
    with tasks_of_a_run(lambda stage: None, GIGABYTES, [lambda: done.append(1)]) as tasks:
        tasks.processes = 2
        tasks.add("first", home, urgency=AT_ONCE)
        tasks.result("first")
        assert done == []
        tasks.add("next", home)
        tasks.result("next")
        assert done == [1]


def test_a_process_prepares_between_its_tasks(worth, tmp_path):
    mark, end = tmp_path / "prepared", time.monotonic() + 60.0
    with tasks_of_a_run(lambda stage: None, GIGABYTES, (), [mark.touch]) as tasks:
        tasks.processes = 1
        tasks.add("first", number)
        tasks.result("first")
        while not mark.exists():
            assert time.monotonic() < end
            time.sleep(0.02)
