"""Ctrl-C wherever a run is: it ends, keeps what is finished, and says in one line how to go on."""

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from unittest.mock import Mock

import pytest
from scenes import PROJECT

from comparisons.cli import main
from comparisons.common.errors import ExitStatus

KEPT = "crosscheck: interrupted; finished levels are kept, the same command goes on from there\n"
PATIENT = 60.0  # s; far longer than anything here takes
SCENE = """
roller = {radius = "8 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
load = {per_length = "1 N/um"}
resolution = {pitch = "30 um", levels = 2}
finite_element = {block = 20}
tolerance = {peak_pressure = 0.5, contact_length = 0.5}
budget = {effects = false, time = 0.9}
"""
# The command with one function replaced by what stands for it.
COMMAND = """
import os, pathlib, signal, sys, time
import comparisons.output.page.page
comparisons.output.page.page.render = lambda *_: ""
from comparisons.cli import entry
from fem.solver import mumps
there, factorised = pathlib.Path("there"), mumps.factorised
{replaced}
sys.argv = ["crosscheck", "run", "scene.toml", "--out", "out"]
entry()
"""
# A loop inside the interpreter that hears no signal, as a library's would not.
STUCK = """
calls = []
def stuck(*given):
    calls.append(1)
    if len(calls) == {call}:
        there.touch()
        sum(range(10**12))
    return factorised(*given)
mumps.factorised = stuck
"""
COUNTED = """
def counted(*given):
    with there.open("a") as file:
        file.write(".")
    return factorised(*given)
mumps.factorised = counted
"""
# A mesher that is busy for ten minutes, and ends with its parent as the real one does.
MESHER = """
from meshes import build
asleep = "import time; from meshes.gmsh_worker import die_with_parent; die_with_parent(); "
asleep += "open('there', 'w'); time.sleep(600)"
build.WORKER = (sys.executable, "-c", asleep)
"""
WAITS = """
def waits(*given):
    there.touch()
    while not pathlib.Path("go on").exists():
        time.sleep(0.02)
    return factorised(*given)
mumps.factorised = waits
"""
# One process for all tasks, and one for each core.
ALONE = "os.sched_getaffinity = lambda process: {0}\n"
SIDE_BY_SIDE = "os.sched_getaffinity = lambda process: {0, 1}\n"
CRASH = """
mumps.factorised = lambda *args: os.kill(os.getpid(), signal.SIG{name})
"""


@pytest.fixture
def folder(tmp_path) -> Path:
    (tmp_path / "scene.toml").write_text(SCENE)
    return tmp_path


def started(folder: Path, replaced: str) -> subprocess.Popen:
    (folder / "there").unlink(missing_ok=True)
    environment = os.environ | {"PYTHONPATH": str(PROJECT), "OMP_NUM_THREADS": "1"}
    return subprocess.Popen(
        [sys.executable, "-c", COMMAND.format(replaced=replaced)],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def reached(folder: Path, replaced: str) -> subprocess.Popen:
    """A process that is where it is to be stopped."""
    process = started(folder, replaced)
    end = time.monotonic() + PATIENT
    while not (folder / "there").exists():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < end
        time.sleep(0.02)
    return process


def count(folder: Path) -> int:
    """Factorisations of a run to its end."""
    process = started(folder, COUNTED)
    _, err = process.communicate(timeout=PATIENT)
    assert process.returncode == 0, err
    return len((folder / "there").read_text())


@pytest.mark.parametrize("interrupt", [os.kill, os.killpg], ids=["a signal", "a terminal"])
def test_in_the_middle_of_a_factorisation(folder, interrupt):
    process = reached(folder, ALONE + STUCK.format(call=3))
    interrupt(process.pid, signal.SIGINT)
    with suppress(ProcessLookupError):  # a second one changes nothing
        interrupt(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=PATIENT)
    assert process.returncode == ExitStatus.INTERRUPTED
    assert (out, err) == ("", KEPT)
    kept = {path.name for path in (folder / ".out.unfinished/run").iterdir()}
    assert "finite_element-2.npz" in kept and "finite_element-far_boundary_check-1.npz" not in kept
    assert not (folder / "out").exists()
    if interrupt is os.kill:
        # of five in all: two levels, the far boundary, linear and cubic elements for their cost
        assert count(folder) == 3
        assert not (folder / ".out.unfinished").exists()


def test_in_the_middle_of_factorisations_side_by_side(folder):
    """Results that each process had finished are not computed again."""
    process = reached(folder, SIDE_BY_SIDE + STUCK.format(call=2))
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=PATIENT)
    assert (process.returncode, out, err) == (ExitStatus.INTERRUPTED, "", KEPT)
    kept = {path.name for path in (folder / ".out.unfinished/run").glob("finite_element*")}
    assert 1 <= len(kept) < 3
    assert count(folder) == 5 - len(kept)


@pytest.mark.parametrize("beside", [ALONE, SIDE_BY_SIDE], ids=["alone", "side by side"])
def test_in_the_middle_of_meshing(folder, beside, session, until):
    process = reached(folder, beside + MESHER)
    os.kill(process.pid, signal.SIGINT)
    _, err = process.communicate(timeout=PATIENT)
    assert (process.returncode, err) == (ExitStatus.INTERRUPTED, KEPT)
    assert until(lambda: not session(process.pid))


def test_while_the_report_is_drawn(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    drawn = Mock(side_effect=KeyboardInterrupt)
    monkeypatch.setattr("comparisons.output.page.page.render", drawn)
    assert main(["run", "scene.toml", "--models", "half-plane", "--out", "out"]) == 130
    out, err = capsys.readouterr()
    assert "peak pressure" in out and "NOT COMPARED" in out
    assert err == KEPT
    assert (folder / ".out.unfinished/run" / "half_plane-1.npz").exists()
    assert (folder / "out/result.json").exists() and not (folder / "out/report.html").exists()


@pytest.mark.parametrize("beside", [ALONE, SIDE_BY_SIDE], ids=["alone", "side by side"])
def test_the_end_of_the_process_of_a_level_is_one_line(folder, beside):
    """The system kills it where memory is short."""
    process = started(folder, beside + CRASH.format(name="KILL"))
    out, err = process.communicate(timeout=PATIENT)
    assert (process.returncode, out) == (ExitStatus.NOT_CONVERGED, "")
    assert err.startswith("crosscheck: scene.toml: finite elements: ") and err.count("\n") == 1
    assert (
        "the process that worked on it was killed, as the system does where memory ends, for the "
        "second time, alone; finished levels are kept, the same command goes on from there; "
        "where memory ends again, allowed is a smaller budget.memory" in err
    )
    kept = {path.name for path in (folder / ".out.unfinished/run").iterdir()}
    assert kept == {"half_plane-1.npz", "half_plane-2.npz"}
    assert not (folder / "out").exists()


@pytest.mark.parametrize("beside", [ALONE, SIDE_BY_SIDE], ids=["alone", "side by side"])
@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGKILL])
def test_nothing_outlives_the_command(folder, sent, beside):
    process = reached(folder, beside + STUCK.format(call=1))
    process.send_signal(sent)
    process.communicate(timeout=PATIENT)  # returns when nobody holds its output any more
    assert process.returncode == -sent


def test_an_ignored_interrupt_stays_ignored(folder):
    process = reached(folder, f"{ALONE}signal.signal(signal.SIGINT, signal.SIG_IGN)\n{WAITS}")
    process.send_signal(signal.SIGINT)
    (folder / "go on").touch()
    _, err = process.communicate(timeout=PATIENT)
    assert (process.returncode, err) == (0, "")
