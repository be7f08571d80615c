"""What the benchmarks share: times, peers that are absent, one thread, the exit status."""

import subprocess
import sys
import time

import pytest

from comparisons.benchmarks.harness import AbsentError, Demand, installed, print_demands, timed


def test_times_are_those_of_the_processor():
    def busy(until: float) -> None:
        while time.process_time() < until:
            pass

    assert timed(lambda: busy(time.process_time() + 0.1), 1)[0] == pytest.approx(0.1, rel=0.2)
    assert timed(lambda: time.sleep(0.2), 1)[0] < 0.05


def test_repeats_end_with_the_budget():
    calls = []
    timed(lambda: calls.append(sum(range(100_000))), 1000, budget=1e-3)
    assert 1 <= len(calls) < 100


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
        "import os, sys; from comparisons.benchmarks.harness import run_on_one_thread;"
        "run_on_one_thread(lambda: os.environ['OMP_NUM_THREADS'] + sys.argv[1])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, "7"], env={"OMP_NUM_THREADS": "4"}, capture_output=True
    )
    assert done.stderr.decode().strip().endswith("17")
