"""Tasks of a run: side by side in a process for each core, or one after the other in this one.

The processes begin once, where what is known to do is worth them. They are forked from this one
with all that it has loaded, as long as it has no MPI, which survives no fork, and its libraries are
on one thread; else they are fresh. The answers are those of one process, in any order of work.

Whoever waits may prepare what it will need: imports take as long as a small run's solution."""

import multiprocessing
import os
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from multiprocessing.connection import Connection, wait
from typing import TypeVar

from comparisons.common.mpi import from_first, is_several
from comparisons.common.processes import (
    ONE_THREAD,
    Worker,
    answered,
    interrupts_later,
    return_freed_memory,
    uncollected,
)
from comparisons.common.progress import ProgressCallback, Step, machine_memory, no_progress

Held = TypeVar("Held")

# Seconds of work that are worth a process: one forked and a fresh one, which imports for itself.
WORTH_A_FORK, WORTH_A_START = 0.1, 10.0
SOON = 0.02  # seconds in which a task comes that is already known
PREPARATION = 0.2  # seconds that forked processes save where they have something to prepare
SHARE_OF_MEMORY = 0.8  # that side-by-side tasks may expect of the machine's
# Urgencies: others wait for the first kind, nothing for the fifth, and the last may turn out to be
# for nothing.
AT_ONCE, FIRST, NEEDED, LATER, LAST, PERHAPS = range(6)


class Here:
    """The process that a task runs in: how it tells its stage, and what it holds for the next."""

    def __init__(self, callback: ProgressCallback) -> None:
        self.callback = callback
        self._held: dict[str, tuple[object, object]] = {}

    def held(self, kind: str, key: object, make: Callable[[], Held]) -> Held:
        """What `make` gave for the key; of each kind the latest key's is held alone."""
        if kind not in self._held or self._held[kind][0] != key:
            self._held.pop(kind, None)  # before the next is made: memory
            self._held[kind] = key, make()
        return self._held[kind][1]


Work = Callable[..., object]  # work(here, *given)
Preparation = Callable[[], object]  # what it raises comes again where it is needed


@dataclass
class _Task:
    work: Work
    given: tuple
    seconds: float
    memory: float
    urgency: int
    shares: object


@dataclass
class Tasks:
    """What a run has to compute, by key; `result` gives it."""

    # gets the stages of all tasks, with the share of the expected seconds that is done
    callback: ProgressCallback = no_progress
    # that may work beside this one, which then only hands out; none: all is done here
    processes: int = 0
    memory: float = float("inf")  # [bytes] that tasks side by side may expect together
    # preparations for what follows the tasks, while this process waits
    here: Sequence[Preparation] = ()
    # preparations of forked processes for their tasks, which are worth them then
    there: Sequence[Preparation] = ()
    # [bytes] that the machine had to give at the start
    machine: float = field(default_factory=lambda: from_first(machine_memory))
    _waiting: dict[str, _Task] = field(default_factory=dict)
    _running: dict[Connection, str] = field(default_factory=dict)
    _answers: dict[str, tuple[bool, object]] = field(default_factory=dict)
    _tasks: dict[str, _Task] = field(default_factory=dict)
    _workers: dict[Connection, Worker] = field(default_factory=dict)
    _held: dict[Connection, object] = field(default_factory=dict)
    _done: float = 0.0
    _share: float = 0.0

    def __post_init__(self) -> None:
        self._here = Here(self._tell)
        self._left = list(self.here)
        self.memory = min(self.memory, SHARE_OF_MEMORY * self.machine)

    def add(
        self,
        key: str,
        work: Work,
        *given: object,
        seconds: float = 0.0,
        memory: float = 0.0,
        urgency: int = NEEDED,
        shares: object = None,
    ) -> None:
        """Make a task known: `work(here, *given)`, of expected seconds and bytes. The lower its
        urgency, the sooner it begins; of equal ones first what `shares` nothing with the last task
        of another process, then the longest, where a process stays with what shares the same for as
        long as all of that takes longer. Known keys may become urgent."""
        if key not in self._tasks:
            task = _Task(work, given, seconds, memory, urgency, shares)
            self._tasks[key] = self._waiting[key] = task
            self._hand_out()
        self._tasks[key].urgency = min(self._tasks[key].urgency, urgency)

    def result(self, key: str) -> object:
        """The answer of a known task, waited for, then forgotten; raises what its work raised."""
        task = self._tasks[key]
        task.urgency = min(task.urgency, LATER)
        while key not in self._answers:
            self._begin()
            self._hand_out()
            if self._running:
                self._collect()
            else:
                self._answer(key, *answered(task.work, self._here, *task.given))
        good, answer = self._answers.pop(key)
        del self._tasks[key]
        if good:
            return answer
        raise answer

    def end(self) -> None:
        """End the processes at once, whatever they do."""
        for worker in self._workers.values():
            worker.kill()
        self._workers, self._running = {}, {}

    def _begin(self) -> None:
        """Begin the processes, where there are to be any and the tasks are worth them."""
        forked = "mpi4py.MPI" not in sys.modules and sys.platform == "linux"
        forked = forked and os.environ.get("OMP_NUM_THREADS") == ONE_THREAD["OMP_NUM_THREADS"]
        worth = WORTH_A_FORK if forked else WORTH_A_START
        needed = [task for task in self._waiting.values() if task.urgency < PERHAPS]
        # what lies beyond the longest can be done beside it
        beside = sum(task.seconds for task in needed) - max((t.seconds for t in needed), default=0)
        beside += PREPARATION if forked and self.there else 0.0
        if self.processes and beside >= worth:
            serve = partial(_serve, self.there)
            for _ in range(self.processes):
                others, worker = list(self._workers.values()), Worker(serve, forked)
                self._workers[worker.pipe] = worker
                worker.start(others)
            self.processes = 0

    def _hand_out(self) -> None:
        """Give each idle process the next task that there is memory for."""
        shared = {task.shares for task in self._waiting.values()}
        idle = [pipe for pipe in self._workers if pipe not in self._running]
        for pipe in sorted(idle, key=lambda pipe: self._held.get(pipe) not in shared):
            taken = sum(self._tasks[key].memory for key in self._running.values())
            for key, task in self._order(pipe):
                if self._running and taken + task.memory > self.memory:
                    continue
                try:
                    pipe.send((task.work, task.given))
                except OSError:
                    self._lose(pipe)
                else:
                    del self._waiting[key]
                    self._running[pipe], self._held[pipe] = key, task.shares or self._held.get(pipe)
                break

    def _order(self, pipe: Connection) -> list[tuple[str, _Task]]:
        """The queue of a process."""
        own = self._held.get(pipe)
        others = {held for other, held in self._held.items() if other is not pipe}
        together = defaultdict(list)
        for task in self._waiting.values():
            together[task.urgency, task.shares].append(task.seconds)

        def place(item: tuple[str, _Task]) -> tuple:
            task = item[1]
            sharing = together[task.urgency, task.shares]
            length = sum(sharing) if task.shares == own else max(sharing)
            if task.shares is None:
                return task.urgency, False, -task.seconds, 0.0
            return task.urgency, task.shares in others, -length, -task.seconds

        return sorted(self._waiting.items(), key=place)

    def _collect(self) -> None:
        """Wait for what the processes have to say."""
        if all(self._tasks[key].urgency > AT_ONCE for key in self._running.values()):
            _prepare(self._left, lambda: wait(list(self._running), 0.0))
        for pipe in wait(list(self._running)):
            try:
                kind, content = pipe.recv()
            except (EOFError, OSError):
                self._lose(pipe)
                continue
            if kind == "stage":
                self._tell(content)
            else:
                self._answer(self._running.pop(pipe), *content)

    def _lose(self, pipe: Connection) -> None:
        """A process has ended: what it had in hand waits again."""
        key = self._running.pop(pipe, None)
        if key is not None:
            self._waiting[key] = self._tasks[key]
        self._held.pop(pipe, None)
        self._workers.pop(pipe).kill()

    def _answer(self, key: str, good: bool, answer: object) -> None:
        self._waiting.pop(key, None)
        self._answers[key] = good, answer
        self._done += self._tasks[key].seconds

    def _tell(self, stage: str) -> None:
        left = sum(
            task.seconds
            for key, task in self._tasks.items()
            if key not in self._answers and task.urgency < PERHAPS
        )
        if self._done:
            self._share = max(self._share, self._done / (self._done + left))
        self.callback(Step(stage, self._share))


@contextmanager
def tasks_of_a_run(
    callback: ProgressCallback,
    memory: float,
    here: Sequence[Preparation] = (),
    there: Sequence[Preparation] = (),
) -> Iterator[Tasks]:
    """Tasks on all cores within `memory` [bytes]; in this process alone where it is one of several.
    What ends the block ends all of them."""
    alone = not is_several() and multiprocessing.parent_process() is None
    cores = len(os.sched_getaffinity(0)) if alone else 1
    tasks = Tasks(callback, cores if cores > 1 else 0, memory, here, there)
    try:
        yield tasks
    finally:
        tasks.end()


def _prepare(steps: list[Preparation], is_wanted: Callable[[], object]) -> None:
    """Carry out steps, and drop them from the list, until this process is wanted."""
    while steps and not is_wanted():
        with suppress(Exception), interrupts_later(), uncollected():
            steps.pop(0)()


def _serve(preparations: Sequence[Preparation], pipe: Connection) -> None:
    """Work on what comes through the pipe, until it closes."""
    here = Here(lambda stage: pipe.send(("stage", str(stage))))
    left = list(preparations)
    while True:
        _prepare(left, lambda: pipe.poll(SOON))
        work, given = pipe.recv()
        answer = answered(work, here, *given)
        return_freed_memory()
        pipe.send(("answer", answer))
