"""Several processes under mpirun: one speaks and writes, all end alike."""

import signal
from dataclasses import replace

import pytest

from comparisons.cli import main
from comparisons.common.mpi import PATIENCE, RANKS, as_one, is_first, is_several
from comparisons.common.progress import no_progress
from comparisons.runs.write import write_files


@pytest.fixture(autouse=True)
def alone(monkeypatch):
    for name in RANKS:
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize("name", RANKS)
def test_rank_of_every_launcher(monkeypatch, name):
    assert is_first() and not is_several()
    for rank, first in (("0", True), ("1", False), ("10", False)):
        monkeypatch.setenv(name, rank)
        assert is_first() is first and is_several()


def test_others_are_silent_and_end_alike(monkeypatch, capsys):
    assert main(["scenes"]) == 0
    heard = capsys.readouterr()
    assert heard.out and not heard.err
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "1")
    assert main(["scenes"]) == 0
    assert capsys.readouterr() == ("", "")


def test_others_leave_an_error_to_the_first_for_a_while(monkeypatch, capsys):
    waits = []
    monkeypatch.setattr("time.sleep", waits.append)
    assert main(["rnu"]) == 2
    line = capsys.readouterr().err
    assert line and not waits
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "1")
    assert main(["rnu"]) == 2
    assert capsys.readouterr() == ("", line)
    assert waits == [PATIENCE]


def test_the_launcher_interrupts_work_and_nothing_else(monkeypatch):
    """mpirun hands Ctrl-C on as SIGTERM."""
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "0")
    before = signal.getsignal(signal.SIGTERM)

    def work():
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGTERM)
        return 0

    assert as_one(work, ends=(0,)) == 0
    assert signal.getsignal(signal.SIGTERM) == before


def test_others_write_no_files(monkeypatch, tmp_path, smooth_outcome):
    monkeypatch.setenv("PMI_RANK", "3")
    write_files(replace(smooth_outcome, directory=tmp_path / "out"), no_progress)
    assert list(tmp_path.iterdir()) == []
