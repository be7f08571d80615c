"""Surface data files, version 1.0, as text or binary (ISO 25178-71:2017).

text      first line aISO-1.0, then lines `Key = value`, a line with an asterisk, the heights row
          by row (a row is a profile) with BAD for those that were not measured, an asterisk
binary    bISO-1.0, a header of fixed length, little endian, then the heights

Scales are in m; a height is its number times Zscale.
"""

import struct
from pathlib import Path

import numpy as np

from analytic.surface.readers.lines import ProfileError
from analytic.surface.readers.topography import Topography

FORMAT = "SDF (ISO 25178-71)"
MAGIC_TEXT, MAGIC_BINARY = b"aISO-1.0", b"bISO-1.0"
# Manufacturer, created, modified, points, profiles, x, y, z scale, resolution, compression,
# data type, check type.
HEADER = struct.Struct("<10s12s12sHHddddBBB")
TYPES = ("u1", "<u2", "<u4", "<f4", "i1", "<i2", "<i4", "<f8")
# Integers of 16 and 32 bits have one number that stands for no height.
LOST = {1: 2**16 - 1, 2: 2**32 - 1, 5: -(2**15), 6: -(2**31)}


def is_sdf(head: bytes) -> bool:
    """Whether a file that begins with these bytes says that it is one."""
    return head.startswith((MAGIC_TEXT, MAGIC_BINARY))


def read_sdf(path: Path) -> Topography:
    """The heights of a surface data file; one of a single profile is a line scan.

    Raises ProfileError, one line, for a file that is cut short, compressed or damaged.
    """
    content = path.read_bytes()
    read = _read_text if content.startswith(MAGIC_TEXT) else _read_binary
    scales, heights = read(path, content)
    if not (np.all(np.isfinite(scales)) and np.all(scales > 0.0)):
        raise _damaged(path, "its scales are not positive and finite")
    heights = heights * scales[2]
    return Topography(
        path=path,
        heights=heights[0] if len(heights) == 1 else heights,
        pitch=(float(scales[0]), float(scales[1])),
        x=None,
        unit=1.0,
        format=FORMAT,
    )


def _read_binary(path: Path, content: bytes) -> tuple[np.ndarray, np.ndarray]:
    start = len(MAGIC_BINARY) + HEADER.size
    if len(content) < start:
        raise _damaged(path, "it ends inside its header")
    _, _, _, points, profiles, *scales, _, compression, kind, _ = HEADER.unpack_from(
        content, len(MAGIC_BINARY)
    )
    _check_kind(path, compression, kind)
    if points == 0 or profiles == 0:
        raise _damaged(path, "it holds no heights")
    dtype = np.dtype(TYPES[kind])
    count = points * profiles
    if len(content) < start + count * dtype.itemsize:
        raise _damaged(path, f"it ends before its {profiles} profiles of {points} heights")
    numbers = np.frombuffer(content, dtype, count, start).astype(float)
    numbers[~np.isfinite(numbers) | (numbers == LOST.get(kind, np.nan))] = np.nan
    return np.array(scales), numbers.reshape(profiles, points)


def _read_text(path: Path, content: bytes) -> tuple[np.ndarray, np.ndarray]:
    header, star, rest = content.decode("latin-1").partition("*")
    if not star:
        raise _damaged(path, "its header has no end")
    fields = {
        key.strip().lower(): value.strip()
        for key, equals, value in (line.partition("=") for line in header.splitlines()[1:])
        if equals
    }
    try:
        points, profiles = int(fields["numpoints"]), int(fields["numprofiles"])
        scales = np.array([float(fields[name]) for name in ("xscale", "yscale", "zscale")])
        compression, kind = int(fields.get("compression", 0)), int(fields["datatype"])
    except KeyError as error:
        raise _damaged(path, f"its header has no {error.args[0]}") from error
    except ValueError as error:
        raise _damaged(path, f"its header is wrong ({error})") from error
    _check_kind(path, compression, kind)
    words = rest.partition("*")[0].split()
    if points < 1 or profiles < 1 or len(words) != points * profiles:
        message = f"it has {len(words)} heights, not {profiles} profiles of {points}"
        raise _damaged(path, message)
    try:
        numbers = np.array([word if word.upper() != "BAD" else "nan" for word in words], float)
    except ValueError as error:
        raise _damaged(path, f"a height is no number ({error})") from error
    numbers[~np.isfinite(numbers) | (numbers == LOST.get(kind, np.nan))] = np.nan
    return scales, numbers.reshape(profiles, points)


def _check_kind(path: Path, compression: int, kind: int) -> None:
    if compression != 0:
        message = "is a compressed surface data file; allowed is to export it uncompressed"
        raise ProfileError(path, message)
    if not 0 <= kind < len(TYPES):
        raise _damaged(path, f"its data type is {kind}")


def _damaged(path: Path, message: str) -> ProfileError:
    return ProfileError(path, f"is a damaged surface data file: {message}")
