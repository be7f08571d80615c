"""What is installed, which versions, what is missing and how to get it.

Everything is tried, not only looked up: a library that imports may still crash when it draws, and
a solver may come without the factorisation that is needed. Each trial is a process of its own, so
that a crash or a hang is a finding like any other. Needs the standard library only, for the
doctor must be the last to fall ill.
"""

import os
import platform
import signal
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comparisons.commands.doctor_trials import OPTIONAL, TRIALS, Trial
from comparisons.common.progress import ProgressCallback, Step, no_progress

if TYPE_CHECKING:
    from rich.table import Table

OLDEST_PYTHON = (3, 11)
# s; a healthy trial ends within three, the first one that compiles a form within twenty.
PATIENCE = 60.0
AT_ONCE = 2

# Without a display and without asking for one; as root and on a single core, as in a container.
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "VTK_DEFAULT_OPENGL_WINDOW": "vtkEGLRenderWindow",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "PRTE_ALLOW_RUN_AS_ROOT": "1",
    "PRTE_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}


@dataclass(frozen=True)
class Check:
    """One item: whether it works, its version or what went wrong, and how to mend it ("" if ok)."""

    name: str
    ok: bool
    detail: str
    remedy: str


def doctor(callback: ProgressCallback = no_progress) -> list[Check]:
    """Try everything that crosscheck uses; one check an item, Python first."""
    trials, checks = (*TRIALS, *OPTIONAL), [_python()]
    with ThreadPoolExecutor(AT_ONCE) as pool:
        found = pool.map(attempt, trials)
        for number, trial in enumerate(trials):
            callback(Step(f"trying {trial.name}", number / len(trials)))
            checks.append(next(found))
    return checks


def attempt(trial: Trial, patience: float = PATIENCE) -> Check:
    """Run a trial for at most `patience` seconds."""
    try:
        done = subprocess.run(
            [*trial.before, sys.executable, "-c", trial.program],
            capture_output=True,
            text=True,
            errors="replace",
            stdin=subprocess.DEVNULL,
            env=os.environ | ENVIRONMENT,
            timeout=patience,
        )
    except subprocess.TimeoutExpired:
        return Check(trial.name, False, f"does not answer within {patience:g} s", trial.remedy)
    except OSError as error:
        return Check(trial.name, False, f"{error.filename}: {error.strerror}", trial.remedy)
    if done.returncode < 0:
        name = signal.Signals(-done.returncode).name
        return Check(trial.name, False, f"crashes ({name})", trial.remedy)
    if done.returncode > 0:
        return Check(trial.name, False, _complaint(done.stderr), trial.remedy)
    return Check(trial.name, True, (done.stdout.strip() or "no version").splitlines()[-1], "")


def doctor_table(checks: Sequence[Check]) -> "Table":
    """The checks for people to read: a row an item."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    ill = any(check.remedy for check in checks)  # else the column would only take room
    table = Table("item", "works", box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    for name in ("version, or what is wrong", *["how to get it"] * ill):
        table.add_column(name, overflow="fold")
    for check in checks:
        works = Text("yes", style="green") if check.ok else Text("no", style="bold red")
        remedy = [Text(check.remedy)] * ill
        table.add_row(check.name, works, Text(check.detail), *remedy)
    return table


def _python() -> Check:
    ok = sys.version_info >= OLDEST_PYTHON
    oldest = ".".join(map(str, OLDEST_PYTHON))
    remedy = "" if ok else f"Use Python {oldest} or newer: Debian 12 and later have it."
    return Check("Python", ok, f"{platform.python_version()}, {sys.executable}", remedy)


def _complaint(text: str) -> str:
    """The last line that names an exception, or else the last that has words."""
    lines = [line.strip() for line in text.splitlines() if any(map(str.isalpha, line))]
    errors = [line for line in lines if "Error: " in line]
    return [*["fails without a word"], *lines[-1:], *errors[-1:]][-1]
