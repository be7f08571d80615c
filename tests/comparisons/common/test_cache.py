"""Kept results: whole and the same, or none, whatever happened to the file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from comparisons.common.cache import keep, kept

FLIPS = 1200  # of one bit each; a dozen of them raise what is no BadZipFile


@dataclass(frozen=True)
class Some:
    x: np.ndarray
    count: int


@pytest.fixture
def path(tmp_path: Path) -> Path:
    keep(tmp_path / "some.npz", "key", Some(np.linspace(0.0, 1.0, 50), 3))
    return tmp_path / "some.npz"


def test_it_comes_back_for_its_key_alone(path):
    found = kept(path, "key", [Some])
    assert np.array_equal(found.x, np.linspace(0.0, 1.0, 50)) and found.count == 3
    assert kept(path, "other", [Some]) is None


def test_a_wrong_bit_anywhere_is_harmless(path):
    whole, random = path.read_bytes(), np.random.default_rng(4)
    refused = 0
    for place, bit in zip(
        random.integers(len(whole), size=FLIPS), random.integers(8, size=FLIPS), strict=True
    ):
        spoilt = bytearray(whole)
        spoilt[place] ^= 1 << bit
        path.write_bytes(spoilt)
        found = kept(path, "key", [Some])
        refused += found is None
        if found is not None:  # the bit was of no account
            assert np.array_equal(found.x, np.linspace(0.0, 1.0, 50)) and found.count == 3
    assert refused > 0.8 * FLIPS


@pytest.mark.parametrize("share", [0.0, 0.3, 0.99])
def test_a_file_that_was_cut_short_is_none(path, share):
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    assert kept(path, "key", [Some]) is None
