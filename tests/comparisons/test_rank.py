"""Several processes under mpirun: one speaks and writes, all end alike."""

from dataclasses import replace

import pytest

from comparisons.cli import main
from comparisons.rank import RANKS, is_first
from comparisons.stages import silent
from comparisons.write import write_files


@pytest.fixture(autouse=True)
def alone(monkeypatch):
    for name in RANKS:
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize("name", RANKS)
def test_rank_of_every_launcher(monkeypatch, name):
    assert is_first()
    for rank, first in (("0", True), ("1", False), ("10", False)):
        monkeypatch.setenv(name, rank)
        assert is_first() is first


@pytest.mark.parametrize(("arguments", "status"), [(["scenes"], 0), (["rnu"], 2), (["-h"], 0)])
def test_others_are_silent_and_end_alike(monkeypatch, capsys, arguments, status):
    assert main(arguments) == status
    heard = capsys.readouterr()
    assert heard.out + heard.err
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "1")
    assert main(arguments) == status
    assert capsys.readouterr() == ("", "")


def test_others_write_no_files(monkeypatch, tmp_path, smooth_outcome):
    monkeypatch.setenv("PMI_RANK", "3")
    write_files(replace(smooth_outcome, directory=tmp_path / "out"), silent)
    assert list(tmp_path.iterdir()) == []
