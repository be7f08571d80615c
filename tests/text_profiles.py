"""Profiles in files: of text alone, where no other reader is asked, or of any kind; files that are
refused, and profiles from the other side."""

from collections.abc import Callable
from pathlib import Path

import pytest

from analytic.profile import Profile
from analytic.surface.readers.columns import profile_in
from analytic.surface.readers.dropouts import MeasuredProfile
from analytic.surface.readers.files import open_measured, profile_of
from analytic.surface.readers.source import ProfileError
from analytic.surface.readers.text import read_table

# Arguments by which `ground_texture` makes the shipped ground profiles, without a run.
GROUND = {
    "rms_height": 0.4608e-6, "samples": 2237, "length": 2236e-6, "seed": 1,
    "roll_off_wavelength": 80e-6, "shortest_wavelength": 10e-6, "longest_wavelength": 250e-6,
}  # fmt: skip
MOST_BYTES = 100 * 2_000_000 + 2**20


def read_profile(path, **how) -> MeasuredProfile:
    """The profile in a text file of one or two columns; `how` as `profile_in` has it."""
    table = read_table(Path(path), MOST_BYTES, how.get("spacing") is not None)
    return profile_in(table, **how)


def read_measured(path, *, columns=None, channel=None, **how) -> MeasuredProfile:
    """The profile in a file of any kind: `open_measured`, then `profile_of`, which takes `how`."""
    one_column, is_map = how.get("spacing") is not None, how.get("chosen") is not None
    which = {"columns": columns, "channel": channel, "one_column": one_column}
    opened = open_measured(path, **which, is_map=is_map)
    return profile_of(opened, **how)


def refused(path, read: Callable = read_measured, kind=ProfileError, **how) -> ProfileError:
    """The error, in one line that begins with the file, with which it is not read."""
    with pytest.raises(kind) as caught:
        read(path, **how)
    assert str(caught.value).startswith(str(getattr(path, "path", path)))
    assert "\n" not in str(caught.value)
    return caught.value


def mirrored(profile: Profile) -> Profile:
    """The profile as seen from the other side: height(-x)."""
    return Profile(-profile.x[::-1], profile.height[::-1])
