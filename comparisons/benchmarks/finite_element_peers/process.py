"""Codes under comparison as processes: what they are started with, and what they cost."""

import math
import os
import resource
import signal
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from comparisons.benchmarks.finite_element_peers.task import Answer, Task

PROJECT = Path(__file__).resolve().parents[3]
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class FailedError(Exception):
    """A code gave no pressures; the message is its last word."""


@dataclass(frozen=True)
class Run:
    """One process: its answer, and the `whole` processor time of one solution from the start of
    the program to its end, reading the mesh and writing the pressures included [s]."""

    answer: Answer
    whole: float


@dataclass(frozen=True)
class Code:
    """One configuration of one code.

    name   of the code
    how    its configuration, for the table
    solve  a task to a Run, with a folder for its files and a limit of seconds; raises FailedError
    """

    name: str
    how: str
    solve: Callable[[Task, Path, float], Run]


def spent(command: Sequence[str], folder: Path, limit: float, **environment: str) -> float:
    """Processor time [s] of a command in a folder, on one thread.

    Raises FailedError, with its last line, if it fails or takes more than `limit` [s].
    """
    most = math.ceil(limit)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        command,
        cwd=folder,
        env=os.environ | ONE_THREAD | environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (most, most)),
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        raise FailedError(f"not done after {most} s")
    if done.returncode != 0:
        said = done.stdout.decode(errors="replace").strip().splitlines()
        raise FailedError(said[-1] if said else f"ended with status {done.returncode}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def by_program(interpreter: str, module: str, *arguments: str) -> Callable[..., Run]:
    """`Code.solve` of a program of this package, in that interpreter."""

    def solve(task: Task, folder: Path, limit: float) -> Run:
        given, answer = folder / "task.npz", folder / "answer.npz"
        task.save(str(given))
        command = [interpreter, "-m", f"comparisons.benchmarks.{module}", *arguments]
        total = spent([*command, str(given), str(answer)], folder, limit, PYTHONPATH=str(PROJECT))
        found = Answer.load(str(answer))
        return Run(found, total - float(found.seconds[1:].sum()))

    return solve


def runs(command: Sequence[str]) -> bool:
    """Whether a command succeeds."""
    return subprocess.run(command, capture_output=True).returncode == 0
