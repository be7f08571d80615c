"""Readers of foreign files in a process of their own: one that crashes, or hangs, is an error in
words."""

import os
import signal
import subprocess
from collections.abc import Mapping, Sequence

PATIENCE = 300.0  # s; the largest maps take ten
LONGEST = 200  # characters of what a reader says


class ReaderError(Exception):
    """`str` says how a reader ended."""


def said_by(
    command: Sequence[str], environment: Mapping[str, str] | None = None, cwd: str | None = None
) -> str:
    """Text that a command prints. Raises ReaderError where it fails, with its last words; OSError
    where there is no such command."""
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            stdin=subprocess.DEVNULL,
            text=True,
            errors="replace",
            cwd=cwd,
            env=dict(os.environ if environment is None else environment) | {"OMP_NUM_THREADS": "1"},
            timeout=PATIENCE,
        )
    except subprocess.TimeoutExpired:
        raise ReaderError(f"has not read it within {PATIENCE:g} s") from None
    if done.returncode == 0:
        return done.stdout
    lines = done.stderr.strip().splitlines()
    said = (lines[-1] if lines else "it said nothing")[:LONGEST]
    if done.returncode < 0:
        said = f"crashes on it ({signal.Signals(-done.returncode).name}; {said})"
    raise ReaderError(said)
