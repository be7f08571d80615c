"""SurfaceTopography in one process for all files: importing it takes most of the time of a file."""

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import pytest

from analytic.surface.readers import instrument_worker, instruments


@pytest.fixture(scope="session")
def reading_process() -> Iterator[ProcessPoolExecutor]:
    with ProcessPoolExecutor(1, get_context("spawn")) as process:
        yield process


@pytest.fixture
def one_reader(monkeypatch, reading_process: ProcessPoolExecutor) -> None:
    """Each file is read as by a process of its own."""

    def asked(path: Path, target: Path, channel: str | None) -> dict:
        arguments = str(path), str(target), channel
        return reading_process.submit(instrument_worker.main, *arguments).result()

    monkeypatch.setattr(instruments, "_ask", asked)
