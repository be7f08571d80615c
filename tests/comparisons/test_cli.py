"""The command line: what it hands on, what it prints where, and how it ends."""

import json
import os
import subprocess
import sys
import types
from pathlib import Path
from unittest.mock import Mock

import pytest
from scenes import PROJECT, STEADY, as_toml, python

from comparisons.cli import main
from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.progress import Early
from comparisons.figures.quantity import MODELS
from comparisons.scenes.files import scene_titles

HEAVY = "comparisons.scenes.scene pint numpy scipy rich dolfinx gmsh pyvista matplotlib"


class Solver:
    """Stands for `runs.run.solve_scene`: remembers its call, then returns or raises `raises`."""

    def __init__(self) -> None:
        self.calls = []
        self.status = ExitStatus.DONE
        self.raises = None

    def solve(self, scene, out, models, progress, *further):
        self.calls.append((scene, out, models))
        progress("solving [with] care")
        progress(Early("half-plane: 3 µm"))
        if self.raises:
            raise self.raises

    def finished(self, outcome):
        return types.SimpleNamespace(
            result={"schema": 1, "name": "µ"},
            tables=lambda details: "peak pressure agree",
            write=lambda junit, pdf, progress: True,
            exit_status=self.status,
        )


@pytest.fixture
def solver(monkeypatch, tmp_path):
    solver = Solver()
    monkeypatch.setattr("comparisons.runs.run.solve_scene", lambda *asked: solver.solve(*asked))
    monkeypatch.setattr("comparisons.api.FinishedRun.of", lambda outcome: solver.finished(outcome))
    monkeypatch.setattr("comparisons.api.warnings_about_result", lambda outcome: [])
    monkeypatch.chdir(tmp_path)
    return solver


@pytest.mark.parametrize(
    ("options", "folder", "models"),
    [
        ([], "results/smooth", MODELS),
        (["--out", "a/b/c", "--models", "half-plane"], "a/b/c", ("half_plane",)),
        (["--models", "finite-element, half-plane"], "results/smooth", MODELS),
    ],
)
def test_run_hands_everything_on_and_leaves_nothing(
    solver, tmp_path, capsys, options, folder, models
):
    assert main(["run", "smooth", *options]) == 0
    [(scene, out, taken)] = solver.calls
    assert (scene.name, out, taken) == ("smooth", Path(folder), models)
    written = f"written: {folder}/report.html, result.json and the fields beside it\n"
    assert capsys.readouterr() == (f"peak pressure agree\n{written}", "")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("status", [0, 1, 3, 4])
def test_the_outcome_decides_the_status(solver, status):
    solver.status = ExitStatus(status)
    assert main(["run", "smooth"]) == status


def interrupted_import() -> ImportError:
    """Error that Ctrl-C becomes while a compiled module starts."""
    error = ImportError("initialization failed")
    error.__cause__ = KeyboardInterrupt()
    return error


@pytest.mark.parametrize(
    ("error", "status", "line"),
    [
        (InputError("the trace is too short"), 2, "crosscheck: the trace is too short"),
        (KeyboardInterrupt(), 130, "crosscheck: interrupted"),
        (interrupted_import(), 130, "crosscheck: interrupted"),
        (ImportError("no numpy"), 70, "crosscheck: internal error: ImportError: no numpy in "),
        (OSError(28, "No space left on device"), 74, "crosscheck: OSError: [Errno 28] No space"),
        (MemoryError("Unable to allocate 9 GB"), 71, "crosscheck: MemoryError: Unable to allocate"),
        (ZeroDivisionError("two\nlines"), 70, "crosscheck: internal error: ZeroDivisionError: two"),
    ],
    ids=lambda value: type(value).__name__,
)
def test_how_failures_end(solver, capsys, monkeypatch, error, status, line):
    monkeypatch.delenv("CROSSCHECK_TRACEBACK", raising=False)
    solver.raises = error
    assert main(["run", "smooth"]) == status
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(line) and err.count("\n") == 1


@pytest.mark.parametrize(
    ("command", "kept"),
    [("map", "points"), ("sweep", "points"), ("cost", "levels"), ("stability", "cases")],
)
def test_an_interrupt_says_what_is_kept_whenever_it_comes(monkeypatch, capsys, command, kept):
    monkeypatch.setattr("comparisons.cli.get_command", Mock(side_effect=KeyboardInterrupt))
    assert main([command]) == ExitStatus.INTERRUPTED
    left = f"finished {kept} are kept, the same command goes on from there"
    assert capsys.readouterr().err == f"crosscheck: interrupted; {left}\n"


def test_traceback_on_request(solver, capsys, monkeypatch):
    monkeypatch.setenv("CROSSCHECK_TRACEBACK", "1")
    solver.raises = ZeroDivisionError("why")
    assert main(["run", "smooth"]) == ExitStatus.DEFECT
    err = capsys.readouterr().err
    assert err.startswith("Traceback") and "\nZeroDivisionError: why\n" in err


def test_progress_is_shown_to_a_terminal(solver, capsys, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm")
    assert main(["run", "smooth"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("peak pressure agree\nwritten: ")
    assert "solving [with] care" in err and "half-plane: 3 um" in err


def test_scenes_are_listed_with_their_titles(capsys):
    assert main(["scenes"]) == 0
    out, err = capsys.readouterr()
    listed = dict(line.split(maxsplit=1) for line in out.splitlines())
    assert listed == scene_titles()
    assert err == ""
    assert main(["scenes", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == scene_titles()


@pytest.mark.parametrize("arguments", [[], ["--help"], ["-h"]])
def test_help(capsys, arguments):
    assert main(arguments) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert all(command in out for command in ("run", "scenes", "doctor", "Exit status"))


@pytest.mark.parametrize("arguments", [["--help"], ["run", "--help"], ["scenes"]])
def test_help_loads_nothing_heavy(arguments):
    code = f"import sys; from comparisons.cli import main; main({arguments!r}); "
    done = python("-c", f"{code}print(*sys.modules, file=sys.stderr)")
    loaded = set(done.stderr.split())
    assert "comparisons.cli" in loaded
    assert loaded.isdisjoint(HEAVY.split())


def test_the_half_plane_answers_before_anything_else_is_imported(tmp_path):
    others = {"matplotlib", "PIL", "vtkmodules", "jinja2"}
    others |= {"fem.body.elasticity", "fem.heat", "analytic.heat"}
    code = f"""import sys
from comparisons.runs.finished import FinishedRun
FinishedRun.write = lambda *_, **__: print({others} & {{*sys.modules}})
from comparisons.cli import main
main(["run", "smooth", "--models", "half-plane", "--out", {str(tmp_path / "out")!r}])"""
    out = python("-c", code).stdout
    assert "peak pressure" in out.partition("set()\n")[0] and "set()\n" in out


@pytest.mark.parametrize(("wanted", "taken"), [(None, "1"), ("7", "7")])
def test_one_thread_unless_the_user_says_otherwise(wanted, taken):
    environment = {k: v for k, v in os.environ.items() if k != "OMP_NUM_THREADS"}
    environment |= {"OMP_NUM_THREADS": wanted} if wanted else {}
    code = "import os; from comparisons import cli; cli.main = lambda *_: "
    code += "print(os.environ['OMP_NUM_THREADS']) or 0; cli.entry()"
    done = python("-c", code, env=environment)
    assert done.stdout.splitlines()[-1] == taken


def printing_to(output, arguments: list[str]) -> subprocess.CompletedProcess:
    """A process with its own buffer before `output`, an open file."""
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    return subprocess.run(
        [sys.executable, "-m", "comparisons.cli", *arguments],
        cwd=PROJECT,
        env=buffered,
        stdout=output,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )


HALF_PLANE = ["run", "small.toml", "--models", "half-plane", "--out"]


@pytest.mark.parametrize("arguments", [["scenes"], ["--help"], HALF_PLANE, [*HALF_PLANE, "--json"]])
def test_a_reader_that_goes_away(tmp_path, arguments):
    """`crosscheck … | head -0`: no traceback, and the status a shell expects."""
    if "--out" in arguments:
        (tmp_path / "small.toml").write_text(as_toml(STEADY | {"stress": None}))
        at = arguments.index("--out") + 1
        arguments = [*arguments[:at], str(tmp_path / "out"), *arguments[at:]]
        arguments[1] = str(tmp_path / "small.toml")
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "w") as pipe:
        done = printing_to(pipe, arguments)
    assert done.returncode == ExitStatus.BROKEN_PIPE
    assert done.stderr == ""
    if "--out" in arguments:
        assert (tmp_path / "out" / "result.json").exists()


def test_a_full_disc_is_one_line():
    with Path("/dev/full").open("w") as full:
        done = printing_to(full, ["scenes"])
    assert done.returncode == ExitStatus.CANNOT_WRITE
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith("crosscheck: OSError: [Errno 28] No space left on device")


def test_without_dolfinx_the_half_plane_works_and_the_rest_says_what_to_install(tmp_path):
    code = (
        "import sys; sys.modules.update(dict.fromkeys(('dolfinx', 'petsc4py', 'mpi4py')))\n"
        "import importlib.util as util; found = util.find_spec\n"
        "util.find_spec = lambda name, *more: None if name == 'dolfinx' else found(name, *more)\n"
        "from comparisons.cli import main; sys.exit(main({!r}))"
    )
    out = str(tmp_path / "out")
    for command in (["run", "smooth"], ["verify"]):
        done = python("-c", code.format([*command, "--out", out]))
        assert (done.returncode, done.stdout) == (ExitStatus.BAD_INPUT, "")
        (line,) = done.stderr.splitlines()
        assert "finite elements need dolfinx" in line
        assert "allowed is run --models half-plane" in line
        assert not (tmp_path / "out").exists()
    done = python("-c", code.format(["run", "smooth", "--models", "half-plane", "--out", out]))
    assert "peak pressure    0  4.1500 +- 0.0001 GPa" in done.stdout


def test_long_work_speaks_every_minute_where_no_terminal_shows_it(solver, capsys, monkeypatch):
    clock = iter((0.0, 61.0, 62.0, 63.0))  # as solving begins, at its two stages, as it is drawn
    monkeypatch.setattr("comparisons.commands.output.monotonic", lambda: next(clock))
    assert main(["run", "smooth"]) == 0
    assert capsys.readouterr().err == "crosscheck: after 61 s: solving [with] care\n"
