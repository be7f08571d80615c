"""Profiles in text files alone, by the readers of text: no other reader is asked."""

from pathlib import Path

from analytic.profile import MAX_SAMPLES
from analytic.surface.readers.columns import profile_in
from analytic.surface.readers.dropouts import MeasuredProfile
from analytic.surface.readers.text import read_table


def read_profile(path, *, max_samples: int = MAX_SAMPLES, **how) -> MeasuredProfile:
    """The profile in a text file of one or two columns; `how` as `profile_in` has it."""
    table = read_table(Path(path), 100 * max_samples + 2**20, how.get("spacing") is not None)
    return profile_in(table, max_samples=max_samples, **how)
