"""Lint, format and type hints, so that the test command checks them too."""

import subprocess
import sys

import pytest
from scenes import PROJECT


@pytest.mark.parametrize("check", [["check"], ["format", "--check", "--diff"]], ids=lambda c: c[0])
def test_ruff_finds_nothing(check):
    done = subprocess.run(
        [sys.executable, "-m", "ruff", *check, "--no-cache", "."],
        cwd=PROJECT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
