"""A whole run under mpirun: the same figures and files as from one process, and one way to end."""

import re
from pathlib import Path

import numpy as np
import pytest

from comparisons.cli import main
from comparisons.common.errors import ExitStatus
from comparisons.output.record import read_result

SCENE = """
[roller]
radius = "8 mm"
rigid = true

[body]
youngs_modulus = "100 GPa"
poissons_ratio = 0.2

[load]
per_length = "1 N/um"
friction = 0.1

[stress]
points = [20, 10]

[finite_element]
far_field = "half-plane"
growth = 0.5

[resolution]
pitch = "40 um"
levels = 2

[budget]
time = "1 us"
effects = false
"""
COMMAND = ("-m", "comparisons.cli", "run")
# Without the pictures: while one process draws, the other one waits at a core's full cost.
UNDRAWN = """
import sys
import comparisons.output.page.page
from comparisons.cli import main
comparisons.output.page.page.render = lambda *_: "page"
sys.exit(main())
"""


def files(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def table(said: str) -> list[str]:
    """All lines, without times and places."""
    lines = [re.sub(r"\([\d.]+ m?s\b", "(", " ".join(line.split())) for line in said.splitlines()]
    return [line for line in lines if not line.startswith(("time", "written"))]


def test_two_processes_report_what_one_reports(tmp_path, launch, capsys, monkeypatch):
    scene, outs = tmp_path / "small.toml", (tmp_path / "one", tmp_path / "two")
    scene.write_text(SCENE)
    end = launch(2, "-c", UNDRAWN, "run", scene, "--out", outs[1])
    # two levels state no uncertainty
    assert end.returncode == ExitStatus.INCONCLUSIVE, end.stderr
    monkeypatch.setattr("comparisons.output.page.page.render", lambda *_: "page")
    assert main(["run", str(scene), "--out", str(outs[0])]) == ExitStatus.INCONCLUSIVE
    assert table(end.stdout) == table(capsys.readouterr().out)
    assert files(outs[0]) == files(outs[1])
    assert {path.name for path in tmp_path.iterdir()} == {"small.toml", "one", "two"}
    one, two = (read_result(out / "result.json") for out in outs)
    assert (one.verdict, one.next) == (two.verdict, two.next) and len(one.figures) > 50
    contact = [
        np.loadtxt(out / "finite_element/contact.csv", delimiter=",", skiprows=3) for out in outs
    ]
    np.testing.assert_allclose(contact[0], contact[1], rtol=1e-9, atol=1e-9 * contact[0].max())
    half_width = one.figures.one(study="problem", quantity="half_width").value
    for figure, other in zip(one.figures, two.figures, strict=True):
        assert figure.key == other.key and figure.verdict == other.verdict
        # differences of figures, and a place near the middle, have no digits to spare
        spare = 1e-8 if figure.against or figure.study == "checks" else 0.0
        assert other.value == pytest.approx(figure.value, rel=1e-9, abs=spare), figure.key
        if figure.place is not None:
            assert other.place == pytest.approx(figure.place, rel=1e-9, abs=1e-8 * half_width)


def own_words(said: str) -> list[str]:
    """Lines of crosscheck among what mpirun says when a process ends early, at times on the
    same line, or behind the zero byte that ends its own text."""
    lines = said.replace("\0", "").replace("-----", "\n-----", 1).splitlines()
    return [line for line in lines if line.startswith("crosscheck")]


def test_wrong_input_ends_all_with_one_line(tmp_path, launch):
    """Found by all, once MPI is at work."""
    scene = tmp_path / "wrong.toml"
    scene.write_text(SCENE.replace('time = "1 us"', 'memory = "1 kB"'))
    end = launch(2, *COMMAND, scene, "--out", tmp_path / "out")
    assert (end.returncode, end.stdout) == (2, "")
    (line,) = own_words(end.stderr)
    assert line.startswith(f"crosscheck: {scene}: budget.memory:")
    assert list(tmp_path.iterdir()) == [scene]


ALONE = """
import sys
from mpi4py import MPI
from comparisons import cli
from comparisons.common import mpi
from comparisons.common.errors import InputError

from comparisons.output import plausibility

def run(*scene):
    if mpi.from_first(lambda: mpi.from_first(lambda: MPI.COMM_WORLD.rank)) != 0:
        raise AssertionError("each has found its own")
    if MPI.COMM_WORLD.rank == int(sys.argv[1]):
        raise InputError("one line")
    MPI.COMM_WORLD.barrier()

mpi.PATIENCE = 0.1
plausibility.warnings_about = run
sys.exit(cli.main(["run", "smooth"]))
"""


@pytest.mark.parametrize("process", [0, 1])
def test_an_error_of_one_process_is_heard_and_ends_the_others(launch, process):
    end = launch(2, "-c", ALONE, process)
    assert (end.returncode, end.stdout) == (2, "")
    assert own_words(end.stderr) == ["crosscheck: one line"]
