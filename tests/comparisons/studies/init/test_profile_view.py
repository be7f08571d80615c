"""Pictures of curves in the terminal."""

import os
import pty
import subprocess
import sys

import numpy as np
import pytest
from scenes import PROFILES, PROJECT

from comparisons.studies.init.profile_view import curve

PROFILE = PROFILES / "ground_unrun.csv"
RISE = np.linspace(0.0, 1.0, 9)


def test_a_straight_line_climbs_dot_by_dot():
    # four columns of dots, four rows: one dot each, the last row is the top
    assert curve(RISE, RISE, 2, 1) == ["⡠⠊"]
    assert curve(RISE, -RISE, 2, 1) == ["⠑⢄"]


def test_plain_characters_have_two_dots_each():
    assert curve(RISE, RISE, 2, 1, plain=True) == [".'"]


def test_a_spike_between_two_dots_is_curve():
    x = np.linspace(0.0, 1.0, 1001)
    lines = curve(x, np.where(np.arange(1001) == 333, 1.0, 0.0), 20, 4, plain=True)
    assert sum(line.count(":") for line in lines) >= 3
    assert lines[-1].strip("'.:") == ""


def test_a_line_covers_every_dot_that_it_passes():
    # of four rows: from 0 to 1.2 in the first column of dots, from 1.2 to 4 in the second
    assert curve(np.arange(3.0), np.array([0.0, 0.3, 1.0]), 1, 1) == ["⡼"]


def test_a_flat_profile_is_a_line():
    (line,) = curve(RISE, np.zeros(9), 3, 1)
    assert line == "⣀⣀⣀"


@pytest.mark.parametrize("encoding", ["utf-8", "ascii", None])
def test_a_picture_is_for_a_terminal_alone(tmp_path, encoding):
    command = [sys.executable, "-m", "comparisons.cli", "init", str(PROFILE)]
    command += ["--out", str(tmp_path / "mine.toml"), "--no-picture"]
    environment = os.environ | {"PYTHONIOENCODING": encoding or "utf-8", "TERM": "xterm"}
    environment |= {"PYTHONPATH": str(PROJECT), "COLUMNS": "80"}
    if encoding is None:
        done = subprocess.run(command, env=environment, capture_output=True, check=True)
        shown = done.stdout.decode()
    else:
        ours, theirs = pty.openpty()
        with subprocess.Popen(command, env=environment, stdout=theirs, close_fds=True):
            os.close(theirs)
            shown = _all_of(ours).decode()
    braille = any("\u2800" < sign <= "\u28ff" for sign in shown)
    assert braille == (encoding == "utf-8")
    assert shown.isascii() == (encoding == "ascii")
    assert ("-1.92 um" in shown) == (encoding is not None)
    assert "363.7 nm" in shown


def _all_of(terminal: int) -> bytes:
    """What comes out until the last one who writes has gone."""
    said = b""
    while True:
        try:
            piece = os.read(terminal, 65536)
        except OSError:
            return said
        if not piece:
            return said
        said += piece
