"""The doctor finds what works, what is missing, what crashes and what hangs."""

import io
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console

from comparisons.commands import doctor_checks as module
from comparisons.commands.doctor_checks import (
    OPTIONAL,
    TRIALS,
    Check,
    Trial,
    attempt,
    doctor,
    doctor_table,
)
from comparisons.report.pdf import browser

PROJECT = Path(__file__).resolve().parents[3]
MODULES = {
    "MPI": "mpi4py",
    "others": "pint",
    "half-plane": "scipy",
    "finite elements": "dolfinx",
    "files of fields": "meshio",
}
MODULES |= {t.name: t.name for t in TRIALS if t.name not in MODULES}
each_trial = pytest.mark.parametrize("trial", TRIALS, ids=lambda trial: trial.name)


@each_trial
def test_what_is_installed_works(trial):
    check = attempt(trial)
    assert (check.name, check.ok, check.remedy) == (trial.name, True, "")
    assert re.search(r"\d+\.\d+", check.detail)


@each_trial
def test_what_is_missing_is_named_with_its_remedy(trial):
    name = MODULES[trial.name]
    blocked = f"import sys; sys.modules[{name!r}] = None\n{trial.program}"
    check = attempt(replace(trial, program=blocked))
    assert not check.ok
    assert name in check.detail
    assert check.remedy == trial.remedy != ""


def test_a_reader_that_is_not_installed_is_no_illness():
    trial = OPTIONAL[0]
    blocked = f"import sys; sys.modules['SurfaceTopography'] = None\n{trial.program}"
    check = attempt(replace(trial, program=blocked))
    assert check.ok
    assert check.detail == "text and SDF; others by the optional SurfaceTopography, not installed"
    broken = trial.program.replace("import SurfaceTopography\n", "import no_such_part\n")
    check = attempt(replace(trial, program=broken))
    assert not check.ok
    assert "it lacks no_such_part" in check.detail


def test_printing_is_tried_where_there_is_a_browser(monkeypatch, tmp_path):
    trial = OPTIONAL[1]
    monkeypatch.setenv("PATH", str(tmp_path))
    check = attempt(trial)
    assert check.ok
    assert "neither Chromium nor Chrome is installed (apt-get install" in check.detail
    torn = tmp_path / "chromium"
    torn.write_text("#!/bin/sh\nexit 3\n")
    torn.chmod(0o755)
    check = attempt(trial)
    assert not check.ok
    assert "ended with 3 and left no PDF" in check.detail
    assert check.remedy == trial.remedy


@pytest.mark.skipif(browser() is None, reason="neither Chromium nor Chrome is installed")
def test_a_browser_that_prints_is_named_with_its_version():
    check = attempt(OPTIONAL[1])
    assert check.ok
    assert re.search(r"(Chrom|Edge)\D+\d+\.", check.detail)


def test_a_crash_is_a_finding():
    check = attempt(Trial("x", "import os; os.kill(os.getpid(), 11)", "mend it"))
    assert check == Check("x", False, "crashes (SIGSEGV)", "mend it")


def test_a_hang_is_a_finding():
    check = attempt(Trial("x", "import time; time.sleep(5); print(1)", "mend it"), patience=0.2)
    assert check == Check("x", False, "does not answer within 0.2 s", "mend it")


def test_a_starter_that_is_missing_is_a_finding():
    check = attempt(Trial("x", "print(1)", "mend it", before=("no-such-mpirun", "-n", "2")))
    assert check == Check("x", False, "no-such-mpirun: No such file or directory", "mend it")


@pytest.mark.parametrize(
    ("program", "detail"),
    [
        ("print('1.0'); raise ValueError('torn')", "ValueError: torn"),
        ("import sys; sys.exit('first\\nlast')", "last"),
        ("import sys; sys.exit('OSError: torn\\nexit code 1\\n-----')", "OSError: torn"),
        ("raise SystemExit(3)", "fails without a word"),
    ],
)
def test_a_failure_is_told_in_its_own_words(program, detail):
    assert attempt(Trial("x", program, "mend it")) == Check("x", False, detail, "mend it")


def test_one_process_alone_does_not_pass_for_mpi():
    (trial,) = (t for t in TRIALS if t.name == "MPI")
    check = attempt(replace(trial, before=()))
    assert not check.ok
    assert "2 processes see 1" in check.detail


def test_python_comes_first_and_the_order_holds(monkeypatch):
    slow = Trial("slow", "import time; time.sleep(0.3); print(1)", "")
    monkeypatch.setattr(module, "TRIALS", (slow,))
    monkeypatch.setattr(module, "OPTIONAL", (Trial("fast", "print(2)", ""),))
    python, *others = doctor()
    assert (python.name, python.ok) == ("Python", True)
    assert sys.executable in python.detail
    assert others == [Check("slow", True, "1", ""), Check("fast", True, "2", "")]


def test_a_python_that_is_too_old_is_told(monkeypatch):
    monkeypatch.setattr(module, "TRIALS", ())
    monkeypatch.setattr(module, "OPTIONAL", ())
    monkeypatch.setattr(module, "OLDEST_PYTHON", (99, 1))
    (python,) = doctor()
    assert not python.ok
    assert "Python 99.1 or newer" in python.remedy


def test_table_shows_every_word_as_it_is():
    checks = [Check("a", True, "1.0 [bold]", ""), Check("b", False, "torn", "mend [it]")]
    console = Console(file=io.StringIO(), width=100)
    console.print(doctor_table(checks))
    rows = [re.split(" {2,}", line.strip()) for line in console.file.getvalue().splitlines()]
    assert rows[0][-1] == "how to get it"
    assert rows[2:] == [["a", "yes", "1.0 [bold]"], ["b", "no", "torn", "mend [it]"]]


def test_one_screen_is_enough_where_all_works():
    checks = [Check(trial.name, True, "a version 1.0 and a few words", "") for trial in TRIALS]
    console = Console(file=io.StringIO(), width=80)
    console.print(doctor_table([*checks, *checks[: 1 + len(OPTIONAL)]]))
    lines = console.file.getvalue().splitlines()
    assert len(lines) <= 24
    assert "how to get it" not in lines[0]


def test_doctor_needs_the_standard_library_only():
    path = f"import sys; sys.path.insert(0, {str(PROJECT)!r}); "
    code = path + "import comparisons.commands.doctor_checks"
    subprocess.run([sys.executable, "-I", "-S", "-c", code], check=True)


def test_libraries_in_the_remedies_are_those_that_the_launcher_installs():
    named = {word for trial in TRIALS for word in re.findall(r"\blib[\w.-]*\w", trial.remedy)}
    launcher = (PROJECT / "crosscheck").read_text()
    installed = set(re.search(r"^packages=\((.*?)\)", launcher, re.S | re.M).group(1).split())
    assert named
    assert named == {package for package in installed if package.startswith("lib")}
