"""The doctor finds what works, what is missing, what crashes and what hangs."""

import io
import json
import re
import shutil
import subprocess
import sys

import pytest
from rich.console import Console

from comparisons.cli import main
from comparisons.commands import doctor
from comparisons.commands.doctor import Finding, attempt, findings_table, trials
from comparisons.common import provenance
from comparisons.common.provenance import PROJECT, revision

# A module that each trial cannot do without.
MODULES = {name: name for name in trials()} | {
    "numpy and scipy": "scipy",
    "others": "pint",
    "half-plane": "scipy",
    "finite elements": "dolfinx",
}


@pytest.mark.parametrize("name", trials())
def test_what_is_installed_works_and_what_is_missing_is_named(name):
    finding = attempt(name, trials()[name])
    assert finding.ok and re.search(r"\d+\.\d+", finding.detail), finding
    blocked = f"import sys; sys.modules[{MODULES[name]!r}] = None\n{trials()[name]}"
    finding = attempt(name, blocked)
    assert not finding.ok and MODULES[name] in finding.detail


@pytest.mark.parametrize(
    ("program", "detail", "patience"),
    [
        ("import os; os.kill(os.getpid(), 11)", "crashes (SIGSEGV)", 60.0),
        ("import time; time.sleep(20); print(1)", "does not answer within 0.5 s", 0.5),
        ("print('1.0'); raise ValueError('torn')", "ValueError: torn", 60.0),
        ("import sys; sys.exit('first\\nlast')", "last", 60.0),
        ("raise SystemExit(3)", "ends with 3", 60.0),
    ],
)
def test_a_failure_is_a_finding(program, detail, patience):
    assert attempt("x", program, patience) == Finding("x", False, detail)


@pytest.mark.parametrize(("known", "shown"), [("6b1b4b3", "6b1b4b3"), (None, "no revision")])
def test_findings_in_order_as_a_table_and_as_json(known, shown, monkeypatch, capsys):
    monkeypatch.setattr(provenance, "revision", lambda: known)
    monkeypatch.setattr(doctor, "trials", lambda: {"slow": "a", "fast": "b"})
    monkeypatch.setattr(doctor, "attempt", lambda name, program: Finding(name, True, program))
    assert main(["doctor", "--json"]) == 0
    python, project, *others = json.loads(capsys.readouterr().out)
    assert project == {"name": "crosscheck", "ok": True, "detail": f"{shown}, {PROJECT}"}
    assert python["name"] == "Python" and sys.executable in python["detail"]
    assert others == [{"name": n, "ok": True, "detail": p} for n, p in doctor.trials().items()]
    monkeypatch.setattr(doctor, "attempt", lambda name, program: Finding(name, False, "torn"))
    assert main(["doctor"]) == 1
    out, err = capsys.readouterr()
    assert "torn" in out and out.endswith(f"{doctor.REMEDY}\n") and err == ""


def test_the_revision_is_of_this_checkout_and_of_no_other(monkeypatch, tmp_path):
    """Whatever repository the environment names or lies around it; by a program instead of git."""
    git, checkout = tmp_path / "git", tmp_path / "checkout"
    git.write_text('#!/bin/sh\n[ -z "$GIT_DIR" ] && echo "$2"\n')
    git.chmod(0o755)
    checkout.mkdir()
    monkeypatch.setattr(provenance, "PROJECT", checkout)
    monkeypatch.setenv("GIT_DIR", str(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path))
    assert revision.__wrapped__() is None  # files of a tarball
    (checkout / ".git").mkdir()
    assert revision.__wrapped__() == str(checkout)
    git.write_text("#!/bin/sh\nexit 128\n")
    assert revision.__wrapped__() is None
    git.unlink()
    assert revision.__wrapped__() is None


def test_git_knows_the_revision():
    git, head = ("git", "-C", str(PROJECT), "rev-parse", "HEAD"), ""
    if shutil.which("git") and (PROJECT / ".git").exists():
        head = subprocess.run(git, capture_output=True, text=True).stdout
    if not head:
        pytest.skip("no git, or no clone: apt-get install git, git clone")
    assert head.startswith(revision.__wrapped__().removesuffix("+changes"))


def test_the_table_shows_every_word_as_it_is():
    console = Console(file=io.StringIO(), width=80)
    console.print(findings_table([Finding("a", True, "1.0 [bold]"), Finding("b", False, "torn")]))
    rows = [re.split(" {2,}", line.strip()) for line in console.file.getvalue().splitlines()]
    assert rows[2:] == [["a", "yes", "1.0 [bold]"], ["b", "no", "torn"]]
