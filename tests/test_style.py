"""Lint, format and type hints, so that the test command checks them too."""

import pytest
from scenes import python


@pytest.mark.parametrize("check", [["check"], ["format", "--check", "--diff"]], ids=lambda c: c[0])
def test_ruff_finds_nothing(check):
    done = python("-m", "ruff", *check, "--no-cache", ".")
    assert done.returncode == 0, done.stdout + done.stderr
