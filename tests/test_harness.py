"""What programs that measure the project share: absent peers, one thread, the exit status."""

import subprocess
import sys

import pytest

from tests.harness import AbsentError, Demand, installed, print_demands


def test_absent_peers_are_named(capsys):
    def absent():
        raise AbsentError("Some is not installed")

    assert installed(absent, lambda: ["code"]) == ["code"]
    assert capsys.readouterr().out == "skipped: Some is not installed\n"


@pytest.mark.parametrize(("holds", "status"), [(True, 0), (False, 1)])
def test_status_says_whether_all_demands_hold(holds, status, capsys):
    assert print_demands([Demand(True, "one"), Demand(holds, "two")]) == status
    assert ("FAILS  two" in capsys.readouterr().out) is not holds


def test_libraries_use_one_thread():
    program = (
        "import os, sys; from tests.harness import run_on_one_thread;"
        "run_on_one_thread(lambda: os.environ['OMP_NUM_THREADS'] + sys.argv[1])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, "7"], env={"OMP_NUM_THREADS": "4"}, capture_output=True
    )
    assert done.stderr.decode().strip().endswith("17")
