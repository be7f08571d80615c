"""What a run spends its time on: seconds by stage, told to whoever watches."""

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
    try:  # what getrusage tells includes, in a process just started, that of its parent
        with open("/proc/self/status") as file:
            kilobytes = dict(line.split(":", 1) for line in file)["VmHWM"].split()[0]
        return 1024 * int(kilobytes)
    except (OSError, KeyError):
        kilobytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return kilobytes * (1 if sys.platform == "darwin" else 1024)


def machine_memory() -> float:
    """Memory that processes of this machine could still get [bytes]; infinite if it tells none."""
    try:
        with open("/proc/meminfo") as file:
            kilobytes = dict(line.split(":") for line in file)["MemAvailable"].split()[0]
    except (OSError, KeyError):
        return math.inf
    return 1024.0 * float(kilobytes)


def no_progress(stage: str) -> None:
    """A callback that says nothing."""


class Step(str):
    """The name of a stage, with the share of its task, 0 to 1, that lies behind as it begins."""

    behind: float

    def __new__(cls, name: str, behind: float) -> "Step":
        step = super().__new__(cls, name)
        step.behind = min(max(behind, 0.0), 1.0)
        return step


def within(callback: ProgressCallback, start: float, stop: float) -> ProgressCallback:
    """What to hand to a part of a task, which takes it from the share `start` to `stop`."""

    def told(stage: str) -> None:
        if isinstance(stage, Step):
            stage = Step(stage, start + (stop - start) * stage.behind)
        callback(stage)

    return told


@dataclass
class Stages:
    """Collects seconds by stage; `callback` is told the name of each stage as it begins."""

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
