"""Contents of a wheel, and `import crosscheck` from it beside modules of the user's."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from scenes import PROJECT, python

import comparisons as crosscheck

PACKAGES = ("analytic", "meshes", "fem", "comparisons")
SCRIPT = """
import sys
path = list(sys.path)
import crosscheck
steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
run = crosscheck.run({
    "roller": {"radius": 0.01, **steel},
    "body": steel,
    "load": {"hertz_peak_pressure": 1e9},
    "resolution": {"pitch": 30e-6, "levels": 2},
    "finite_element": {"block": 10, "growth": 0.5},
    "budget": {"effects": False},
})
from comparisons.common.processes import ProcessWorker
from comparisons.common.tasks import Tasks, called
with Tasks(ProcessWorker) as tasks:
    tasks.add("length", called, len, "abc")
    assert tasks.result("length") == 3
assert sys.path == path
print(sorted(run.arrays.models), *dir(crosscheck))
"""


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Path:
    """A folder with what the wheel holds, as site-packages has it."""
    source, built = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("built")
    for package in PACKAGES:
        unwanted = shutil.ignore_patterns("__pycache__")
        shutil.copytree(PROJECT / package, source / package, ignore=unwanted)
    for name in ("pyproject.toml", ".gitignore"):
        shutil.copy(PROJECT / name, source)
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", built],
        cwd=source,
        check=True,
        capture_output=True,
    )
    (wheel,) = built.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(built / "site")
    return built / "site"


def script(text: str, folder: Path, installed: Path) -> subprocess.CompletedProcess:
    """Run a user's own script, whose folder is then first on the path."""
    (folder / "his_script.py").write_text(text)
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    one = {"PYTHONPATH": str(installed), "OMP_NUM_THREADS": "1"}
    return python("his_script.py", cwd=folder, env=variables, **one)


def test_wheel_holds_every_file_of_the_packages(installed):
    """Scenes, profiles and templates too: an installed crosscheck works without the checkout."""
    files = [path.relative_to(installed) for path in installed.rglob("*") if path.is_file()]
    packed = {path for path in files if ".dist-info" not in path.parts[0]}
    ours = {
        path.relative_to(PROJECT)
        for package in PACKAGES
        for path in (PROJECT / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert {Path(package, "py.typed") for package in PACKAGES} <= packed
    moved = {Path("comparisons/commands/crosscheck.py")}
    assert packed == ours - moved | {Path("crosscheck.py")}


def test_modules_of_the_users_break_nothing(installed, tmp_path):
    for name in PACKAGES:
        (tmp_path / f"{name}.py").write_text("raise SystemExit('his')")
    done = script(SCRIPT, tmp_path, installed)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["['finite_element',", "'half_plane']", *sorted(dir(crosscheck))]
    for name in ("analytic", "meshes", "fem"):
        said = f"{tmp_path / name}.py: crosscheck has a package {name} too, which `import {name}`"
        assert said in done.stderr
    assert sorted(dir(crosscheck)) == sorted(crosscheck.__all__)


def test_a_module_of_the_users_that_is_in_use_is_told_in_one_line(installed, tmp_path):
    (tmp_path / "fem.py").write_text("his = True")
    done = script("import fem, crosscheck", tmp_path, installed)
    *_, line = done.stderr.splitlines()
    said = f"{tmp_path}/fem.py: crosscheck has a package fem too, and a process cannot have both"
    assert line == f"ImportError: {said}: rename yours"
    assert script("import crosscheck, fem; fem.contact", tmp_path, installed).stderr.count("\n") > 1


def test_without_modules_of_the_users_nothing_is_said(installed, tmp_path):
    done = script("import crosscheck, fem; print(crosscheck.Scene.__name__)", tmp_path, installed)
    assert (done.stdout, done.stderr) == ("Scene\n", "")
