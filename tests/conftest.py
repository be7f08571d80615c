"""Process and random numbers that every test needs."""

import os
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

from analytic.surface.readers import instrument_worker, instruments
from comparisons.common.progress import machine_memory

PROJECT = Path(__file__).resolve().parents[1]
LAST = ("fem", "meshes", "analytic")  # folders of tests, by how long a file takes
WORKER_MEMORY = 2.5e9  # bytes that one process with its share of the tests may take

# Tests start some hundred processes: what one has compiled, the next one need not. Nor need pytest
# rewrite assertions again that it has rewritten once.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
# Nor is what they print as wide as the terminal that pytest writes to.
os.environ.pop("COLUMNS", None)
# A shell hands an ignored SIGINT down to what it runs in the background; tests send interrupts.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """One a core, as long as memory lasts; 0, and no process but pytest's own, for a single one,
    where files are named, and where tests are to have the terminal."""
    named = any(Path(name.partition("::")[0]).is_file() for name in config.args)
    if named or config.option.capture == "no" or config.option.trace:
        return 0
    count = int(min(len(os.sched_getaffinity(0)), machine_memory() / WORKER_MEMORY))
    return count if count > 1 else 0


def pytest_configure(config: pytest.Config) -> None:
    config.option.loadscopereorder = False  # xdist begins with the files that come first


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Whole runs first, then the folders of ever shorter files: processes that share them out end
    at about the same time."""

    def place(item: pytest.Item) -> int:
        folder = item.path.relative_to(PROJECT / "tests").parts[0]
        return LAST.index(folder) if folder in LAST else -1

    items.sort(key=place)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """One line of what was not tested here, with the command that brings it."""
    reports = terminalreporter.stats.get("skipped", [])
    reasons = Counter(str(report.longrepr[-1]).removeprefix("Skipped: ") for report in reports)
    if reasons:
        listed = "; ".join(f"{reason} ({count})" for reason, count in sorted(reasons.items()))
        terminalreporter.write_line(f"not tested here: {listed}")


@pytest.fixture(scope="session")
def reading_process() -> Iterator[ProcessPoolExecutor]:
    """SurfaceTopography in one process for all files: most of the time of one is its import."""
    with ProcessPoolExecutor(1, get_context("spawn")) as process:
        yield process


@pytest.fixture
def one_reader(monkeypatch: pytest.MonkeyPatch, reading_process: ProcessPoolExecutor) -> None:
    """Each file is read as by a process of its own."""

    def asked(path: Path, target: Path, channel: str | None) -> dict:
        arguments = str(path.resolve()), str(target), channel
        return reading_process.submit(instrument_worker.main, *arguments).result()

    monkeypatch.setattr(instruments, "_ask", asked)


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers, equal in each test, whichever ran before."""
    return np.random.default_rng(29)
