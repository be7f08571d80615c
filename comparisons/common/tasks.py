"""One way to have work done: tasks by key, side by side in workers, or one after the other here.

A level, an effect, some samples, a point of a map, a case and a picture are tasks. The number of
processes and the order of work change no result, and what is kept is not computed again. Where a
process ends amid a task, the task is tried again while nothing else runs. A process that ends then
was ended by its task (`ProcessEnded`)."""

import math
import multiprocessing
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from multiprocessing.connection import Connection
from typing import TypeVar

from comparisons.common.cache import NO_CACHE, Cache
from comparisons.common.errors import SolverError, note_place
from comparisons.common.processes import (
    KILLED,
    ProcessWorker,
    cores,
    interrupts_later,
    is_forkable,
    return_freed_memory,
    uncollected,
)
from comparisons.common.progress import ProgressCallback, Step, machine_memory, no_progress

Held = TypeVar("Held")

# Seconds of work that are worth a process: one forked and a fresh one, which imports for itself.
WORTH_A_FORK, WORTH_A_START = 0.05, 10.0
SOON = 0.02  # seconds in which a task comes that is already known
SILENT = 30.0  # seconds without a word of any worker, after which its stage is told again
PREPARATION = 0.2  # seconds that processes save where they have something to prepare
SHARE_OF_MEMORY = 0.8  # that side-by-side tasks may expect of the machine's
# Urgencies: others wait for the first kind, nothing for the fifth, and the last may turn out to be
# for nothing.
AT_ONCE, FIRST, NEEDED, LATER, LAST, PERHAPS = range(6)


class ProcessEnded(SolverError):
    """A process ended amid a task that it had for itself.

    killed  whether the system killed it, as it does where memory ends"""

    def __init__(self, words: str = "", killed: bool = False) -> None:
        super().__init__(words)
        self.killed = killed


class Here:
    """The process that a task runs in.

    callback  gets the task's stages
    shared    what all tasks may read, without pickle; None unless the process was forked for it"""

    def __init__(self, callback: ProgressCallback = no_progress, shared: object = None) -> None:
        self.callback, self.shared = callback, shared
        self._held: dict[str, tuple[object, object]] = {}

    def held(self, kind: str, key: object, make: Callable[[], Held]) -> Held:
        """Object that `make` gave for the key; of each kind the latest key's is held alone."""
        if kind not in self._held or self._held[kind][0] != key:
            self._held.pop(kind, None)  # before the next is made: memory
            self._held[kind] = key, make()
        return self._held[kind][1]


Work = Callable[..., object]  # work(here, *args)
Preparation = Callable[[], object]  # what it raises comes again where it is needed
# opens(serve) a worker: a process, or what has its methods (`comparisons.common.executors`)
Opens = Callable[[Callable[[Connection], None]], ProcessWorker]


@dataclass
class _Task:
    work: Work
    args: tuple
    seconds: float
    memory: float
    urgency: int
    shares: object
    losses: int = 0  # processes that have ended with it in hand
    stage: str = ""  # the last one that was told


@dataclass
class Tasks:
    """Tasks to compute, by key; `result` gives their results.

    >>> with Tasks() as tasks:
    ...     tasks.add("eight", called, pow, 2, 3)
    ...     tasks.result("eight")
    8"""

    opens: Opens | None = None  # opens a worker; None: all is done in this process
    at_once: float = 1  # workers beside this process, which then only hands out
    kept: Cache = NO_CACHE  # has results from before, and gets the new ones
    # gets the stages of all tasks, with the share of the expected seconds that is done
    callback: ProgressCallback = no_progress
    # seconds that tasks last beside the longest where workers begin; None: with the first task
    worth: float | None = None
    memory: float = math.inf  # [bytes] that tasks side by side may expect together
    shared: object = None  # that `Here` gives to the tasks
    # preparations for what follows the tasks, while this process waits
    here: Sequence[Preparation] = ()
    spare: list[Preparation] = field(default_factory=list)  # others, while a core is free, too
    # preparations of workers for their tasks, which may begin before there are any
    there: Sequence[Preparation] = ()
    _waiting: dict[str, _Task] = field(default_factory=dict)
    _running: dict[ProcessWorker, str] = field(default_factory=dict)
    _answers: dict[str, tuple[bool, object]] = field(default_factory=dict)
    _unkept: dict[str, object] = field(default_factory=dict)  # results that are to be kept
    _tasks: dict[str, _Task] = field(default_factory=dict)
    # with what their tasks share
    _workers: dict[ProcessWorker, object] = field(default_factory=dict)
    _has_begun: bool = False
    _done: float = 0.0
    _share: float = 0.0

    def __post_init__(self) -> None:
        self._here = Here(self._tell, self.shared)
        self._left = list(self.here)

    def __enter__(self) -> "Tasks":
        if self.there:
            self._begin()
            self._open(self.at_once)
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def _end(self) -> None:
        """End the workers at once, whatever they do."""
        for worker in self._workers:
            worker.kill()
        self._workers, self._running = {}, {}

    def add(
        self,
        key: str,
        work: Work,
        *args: object,
        seconds: float = 0.0,
        memory: float = 0.0,
        urgency: int = NEEDED,
        shares: object = None,
        by_itself: bool = False,
    ) -> None:
        """Make a task known: `work(here, *args)`, of expected seconds and bytes; this process does
        it `by_itself`, at once. The most urgent begins first. Of equally urgent ones a process
        takes the longest, but first those whose `shares` is that of its last one, and last those
        whose `shares` is that of another process's last one.

        A known task may become more urgent."""
        if key not in self._tasks:
            task = _Task(work, args, seconds, memory, urgency, shares)
            self._tasks[key] = self._waiting[key] = task
            kept = self.kept.load(key)
            if kept is not None:
                self._answer(key, True, kept, is_new=False)
            elif by_itself:
                self._answer(key, *_answered(work, self._here, *args))
            elif self.worth is None:
                self._begin()
            self._hand_out()
        self._tasks[key].urgency = min(self._tasks[key].urgency, urgency)

    def held(self, kind: str, key: object, make: Callable[[], Held]) -> Held:
        """Object that this process holds (`Here.held`)."""
        return self._here.held(kind, key, make)

    def result(self, key: str) -> object:
        """The result of a known task, waited for, then forgotten; raises what its work raised, and
        ProcessEnded."""
        self._tasks[key].urgency = min(self._tasks[key].urgency, LATER)
        while key not in self._answers:
            self._turn(key)
        good, answer = self._answers.pop(key)
        del self._tasks[key]
        if good:
            return answer
        raise answer

    def left(self) -> dict[str, _Task]:
        """Tasks that are known and not done, by key, without those that may be for nothing."""
        return {
            key: task
            for key, task in self._tasks.items()
            if key not in self._answers and task.urgency < PERHAPS
        }

    def seconds_left(self) -> float:
        """Seconds by the clock that this takes on the workers that there may be."""
        seconds = [task.seconds for task in self.left().values()]
        return max(sum(seconds) / self.at_once, max(seconds, default=0.0))

    def as_done(self, keys: Iterable[str]) -> Iterator[str]:
        """Known keys in the order in which they are done."""
        left = dict.fromkeys(keys)
        while left:
            for key in [key for key in left if key in self._answers]:
                del left[key]
                yield key
            if left:
                self._turn(next(iter(left)))

    def _turn(self, key: str) -> None:
        """Wait for the workers to say something; without any work on a task here."""
        self._begin()
        self._hand_out()
        if self._running:
            self._collect()
        else:
            task = self._tasks[key]
            self._answer(key, *_answered(task.work, self._here, *task.args))
        while self._unkept:  # while workers have their next tasks: nobody waits for the disk
            self.kept.save(*self._unkept.popitem())

    def _begin(self) -> None:
        """Let workers begin, where there are to be any and the tasks are worth them."""
        if self.opens is None or self._has_begun:
            return
        needed = [task.seconds for task in self._waiting.values() if task.urgency < PERHAPS]
        # what lies beyond the longest can be done beside it
        beside = sum(needed) - max(needed, default=0.0) + (PREPARATION if self.there else 0.0)
        self._has_begun = self.worth is None or beside >= self.worth

    def _open(self, wanted: float) -> None:
        """Let there be so many workers, as far as there may be."""
        serve = partial(_serve, self.there, self.shared)
        while self._has_begun and len(self._workers) < min(wanted, self.at_once):
            with interrupts_later():  # none may begin unknown
                self._workers[self.opens(serve)] = None

    def _hand_out(self) -> None:
        """Give each idle worker the next task that there is memory for. A task that has lost its
        process waits until nothing runs; others then hold no memory either."""
        if len(self._running) >= self.at_once:
            return
        lost = [k for k in (*self._running.values(), *self._waiting) if self._tasks[k].losses]
        if lost and self._running:
            return
        if lost:
            self._end()
        tasks = len(self._running) + len(self._waiting)
        self._open(1 if lost else self.at_once if self.there else tasks)
        shared = {task.shares for task in self._waiting.values()}
        idle = [worker for worker in self._workers if worker not in self._running]
        for worker in sorted(idle, key=lambda worker: self._workers[worker] not in shared):
            taken = sum(self._tasks[key].memory for key in self._running.values())
            for key in lost[:1] or self._order(worker):
                task = self._tasks[key]
                if self._running and taken + task.memory > self.memory:
                    continue
                del self._waiting[key]
                self._running[worker] = key
                self._workers[worker] = task.shares or self._workers[worker]
                with suppress(ConnectionError):  # an end that is heard of when it is waited for
                    worker.send(task.work, *task.args)
                break

    def _order(self, worker: ProcessWorker) -> list[str]:
        """The queue of a worker."""
        last = self._workers[worker]
        others = {shares for other, shares in self._workers.items() if other is not worker} - {None}

        def place(key: str) -> tuple:
            task = self._waiting[key]
            stays = task.shares is not None and task.shares == last
            return task.urgency, not stays, task.shares in others, -task.seconds

        return sorted(self._waiting, key=place)

    def _collect(self) -> None:
        """Wait for what the workers have to say."""
        ready = partial(next(iter(self._running)).ready, list(self._running))
        if all(self._tasks[key].urgency > AT_ONCE for key in self._running.values()):
            _prepare(self._left, lambda: ready(0.0))
            if len(self._running) < self.at_once:
                _prepare(self.spare, lambda: ready(0.0))
        said = ready(SILENT)
        if not said and (stage := self._tasks[next(iter(self._running.values()))].stage):
            self._tell(stage)
        for worker in said:
            try:
                kind, content = worker.receive()
            except (EOFError, ConnectionError):
                self._lose(worker)
                continue
            if kind == "stage":
                self._tasks[self._running[worker]].stage = content
                self._tell(content)
            else:
                self._answer(self._running.pop(worker), *content)
        self._hand_out()

    def _lose(self, worker: ProcessWorker) -> None:
        """A process has ended: what it had in hand waits again, once."""
        key = self._running.pop(worker)
        del self._workers[worker]
        how = worker.how_it_ended()
        worker.kill()
        task = self._waiting[key] = self._tasks[key]
        task.losses += 1
        words = f"{task.stage or key}: the process that worked on it {how}"
        if task.losses > 1:
            error = ProcessEnded(f"{words}, for the second time, alone", KILLED in how)
            self._answer(key, False, error)
        else:
            self._tell(f"{words}; it is tried again alone")

    def _answer(self, key: str, good: bool, answer: object, is_new: bool = True) -> None:
        self._waiting.pop(key, None)
        self._answers[key] = good, answer
        self._done += self._tasks[key].seconds
        if good and is_new:
            self._unkept[key] = answer

    def _tell(self, stage: str) -> None:
        left = sum(task.seconds for task in self.left().values())
        if self._done:
            self._share = max(self._share, self._done / (self._done + left))
        self.callback(Step(stage, self._share))


def tasks_here(
    callback: ProgressCallback = no_progress,
    memory: float = math.inf,
    kept: Cache = NO_CACHE,
    here: Sequence[Preparation] = (),
    there: Sequence[Preparation] = (),
) -> Tasks:
    """Tasks on all cores within `memory` [bytes], and within the machine's. Processes begin where
    the tasks are worth them, and where they prepare for compiled libraries: Ctrl-C is heard only
    between calls of these."""
    memory = min(memory, SHARE_OF_MEMORY * machine_memory())
    opens, places = (None, 1) if _is_worker() else (_process, cores())
    worth = WORTH_A_FORK if _forks() else WORTH_A_START
    return Tasks(opens, places, kept, callback, worth, memory, here=here, there=there)


def tasks_of_copies(shared: object, here: Sequence[Preparation] = ()) -> Tasks:
    """Tasks on copies of this process, one a core, that have `shared` in memory; in this process
    where there can be none. They use no MPI, which survives no fork."""
    alone = cores() < 2 or _is_worker() or not is_forkable()
    opens = None if alone else partial(ProcessWorker, forked=True)
    return Tasks(opens, cores(), shared=shared, here=here)


def called(here: Here, work: Callable[..., object], *args: object) -> object:
    """A task that asks nothing of the process that it runs in."""
    return work(*args)


def carried_out(work: Work, *args: object) -> tuple[bool, object]:
    """A task in a worker that says nothing before it is done."""
    return _answered(work, Here(), *args)


def _is_worker() -> bool:
    """Whether this process works for another one itself."""
    return multiprocessing.parent_process() is not None


def _forks() -> bool:
    """Whether processes are forked from this one; MPI survives no fork."""
    return is_forkable() and "mpi4py.MPI" not in sys.modules


def _process(serve: Callable[[Connection], None]) -> ProcessWorker:
    return ProcessWorker(serve, _forks())


def _prepare(steps: list[Preparation], is_wanted: Callable[[], object]) -> None:
    """Carry out steps, and drop them from the list, until this process is wanted."""
    while steps and not is_wanted():
        with suppress(Exception), interrupts_later(), uncollected():
            steps.pop(0)()


def _answered(work: Work, here: Here, *args: object) -> tuple[bool, object]:
    """Whether the work raised nothing, and what it returned or raised."""
    try:
        return True, work(here, *args)
    except Exception as error:
        note_place(error)
        return False, error


def _serve(preparations: Sequence[Preparation], shared: object, pipe: Connection) -> None:
    """Work on what comes through the pipe, until it closes."""
    here = Here(lambda stage: pipe.send(("stage", str(stage))), shared)
    left = list(preparations)
    while True:
        _prepare(left, lambda: pipe.poll(SOON))
        work, *args = pipe.recv()
        answer = _answered(work, here, *args)
        if shared is None:  # copies of a process end soon
            return_freed_memory()
        pipe.send(("answer", answer))
