"""Profiles and maps in files of numpy (npy, npz), as numbers alone.

Vectors of one length are the columns of a table under their names, an `x` first. An array of two
dimensions is such a table where it has few columns, else a map without size and unit."""

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from analytic.surface.readers.source import (
    MAX_BYTES,
    ProfileError,
    check_numbers,
    check_unpacked,
    contents,
    shown,
)
from analytic.surface.readers.text import ProfileTable, chosen_columns
from analytic.surface.readers.topography import Topography

MOST_COLUMNS = 16  # of a table; an array with more of them, or more columns than rows, is a map
NPY, ZIP = b"\x93NUMPY", b"PK\x03\x04"

Others = dict[str, tuple[int, str]]  # size and kind of each array that is not of real numbers


def is_arrays(path: Path, head: bytes) -> bool:
    """True if a file that begins with these bytes is one of these."""
    return head.startswith(NPY) or (head.startswith(ZIP) and path.suffix == ".npz")


def read_arrays(
    path: Path, columns: Sequence[str | int] | None, channel: str | None, is_map: bool = False
) -> ProfileTable | Topography:
    """Read the file; `channel` is the name of one array of several, `is_map` whether one of two
    dimensions is a map however few its columns are.
    Raises ProfileError, one line, for anything else than arrays of real numbers."""
    check_unpacked(path)
    raw = contents(path, MAX_BYTES)
    kind = "npy" if raw.startswith(NPY) else "npz"
    try:
        arrays, others = _numpy(raw)
    except ProfileError:
        raise
    except Exception as error:  # numpy raises whatever a damaged file brings about
        text = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise ProfileError(path, f"is a damaged {kind} file ({text[:200]})") from error
    check_numbers(path, sum(array.size for array in arrays.values()))
    arrays = {name: np.asarray(array, dtype=float) for name, array in arrays.items()}
    names = tuple(arrays)
    _check_others(path, arrays, others, channel)
    if channel is not None:
        if channel not in arrays:
            allowed = ", ".join(map(shown, names)) or "none"
            raise ProfileError(path, f"has no channel {shown(channel)}; allowed is {allowed}")
        arrays = {channel: arrays[channel]}

    def is_vector(array: np.ndarray) -> bool:
        return array.size > 1 and array.size == max(array.shape)

    vectors = {name: np.ravel(values) for name, values in arrays.items() if is_vector(values)}
    longest = max((len(vector) for vector in vectors.values()), default=0)
    vectors = {name: vector for name, vector in vectors.items() if len(vector) == longest}
    if longest > 1:
        order = sorted(vectors, key=lambda name: name.lower() != "x")
        numbers = np.column_stack([vectors[name] for name in order])
        return _table(path, kind, numbers, tuple(order), columns)
    fields = {name: field for name, field in arrays.items() if field.ndim == 2 and field.size}
    if len(fields) > 1:
        allowed = ", ".join(map(shown, fields))
        raise ProfileError(path, f"holds {len(fields)} maps; allowed is channel, of {allowed}")
    if not fields:
        raise ProfileError(path, "holds no arrays of one or two dimensions; a profile is one")
    (field,) = fields.values()
    if not is_map and field.shape[1] <= MOST_COLUMNS and field.shape[0] > field.shape[1]:
        return _table(path, kind, field, (), columns)
    return Topography(path, field, None, None, None, kind)


def _check_others(
    path: Path, arrays: dict[str, np.ndarray], others: Others, channel: str | None
) -> None:
    """Raise ProfileError for what is asked for, or belongs to a lone vector, and is no numbers."""
    sizes = {array.size for array in arrays.values() if array.size > 1}
    alone = sum(array.size > 1 for array in arrays.values()) < 2
    for name, (size, kind) in others.items():
        if name == channel or (channel is None and alone and size > 1 and sizes <= {size}):
            message = f"{shown(name)} holds {kind} in place of numbers; allowed are real ones"
            raise ProfileError(path, message)


def _table(
    path: Path,
    kind: str,
    numbers: np.ndarray,
    names: tuple[str, ...],
    columns: Sequence[str | int] | None,
) -> ProfileTable:
    numbers = np.where(np.isfinite(numbers), numbers, np.nan)
    rows = np.arange(1, len(numbers) + 1)
    head = (", ".join(names),) if names else ()
    table = ProfileTable(path, numbers, range(len(rows)), rows, names=names, head=head, format=kind)
    return chosen_columns(table, columns)


def _numpy(raw: bytes) -> tuple[dict[str, np.ndarray], Others]:
    arrays = np.load(io.BytesIO(raw), allow_pickle=False)
    named = {"array": arrays}
    if not isinstance(arrays, np.ndarray):
        named = {name: arrays[name] for name in arrays.files}
    real = {name: array for name, array in named.items() if array.dtype.kind in "fiu"}
    return real, {n: (a.size, str(a.dtype)) for n, a in named.items() if n not in real}
