"""Seconds of a run by stage and of the processor, a callback for each stage, and memory."""

import math
import resource
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter

ProgressCallback = Callable[[str], None]


def peak_memory() -> int:
    """Largest resident memory of this process so far [bytes]."""
    kilobytes = _kilobytes("/proc/self/status", "VmHWM")
    if kilobytes is not None:  # getrusage includes the parent's, in a process just started
        return 1024 * kilobytes
    kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return kilobytes * (1 if sys.platform == "darwin" else 1024)


def machine_memory() -> float:
    """Memory that processes of this machine could still get [bytes]; infinite where unknown."""
    kilobytes = _kilobytes("/proc/meminfo", "MemAvailable")
    return math.inf if kilobytes is None else 1024.0 * kilobytes


def _kilobytes(path: str, name: str) -> int | None:
    try:
        with open(path) as file:
            return int(dict(line.split(":", 1) for line in file)[name].split()[0])
    except (OSError, KeyError):
        return None


def no_progress(stage: str) -> None:
    """A progress callback that does nothing."""


class Step(str):
    """The name of a stage, with the share of the task, 0 to 1, that is done as it begins."""

    done: float

    def __new__(cls, name: str, done: float) -> "Step":
        step = super().__new__(cls, name)
        step.done = min(max(done, 0.0), 1.0)
        return step


class Lasting(str):
    """A line that is to stay where stages come and go."""


class Early(str):
    """A line that is to stay on a terminal alone: a part of the result, before the rest."""


@dataclass
class Stages:
    """Collects seconds by stage; `callback` gets the name of each stage as it begins."""

    callback: ProgressCallback = no_progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, announce: str | None = None) -> Iterator[None]:
        """Time what runs inside under `name`; repeated stages add up."""
        self.callback(announce or name)
        begin = perf_counter()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + perf_counter() - begin
