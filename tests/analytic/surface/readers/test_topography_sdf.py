"""Surface data files written byte by byte, and damaged ones."""

import struct

import numpy as np
import pytest

from analytic.surface.readers.source import ProfileError
from analytic.surface.readers.topography import is_sdf, read_sdf

HEIGHTS = np.array([[1.0, -2.5, 3.0, 0.0], [4.0, np.nan, 0.5, 2.0], [7.0, 8.0, -9.0, 1e-3]])
HEADER = """aISO-1.0
ManufacID   = MAKER
CreateDate  = 010120200000
ModDate     = 010120200000
NumPoints   = 4
NumProfiles = 3
Xscale      = 1.5e-6
Yscale      = 2.5e-6
Zscale      = 1e-9
Zresolution = -1
Compression = 0
DataType    = 7
CheckType   = 0
*
"""
ROWS = "1 -2.5 3 0\n4 BAD 0.5 2\n7 8 -9 1e-3\n"
TEXT = f"{HEADER}{ROWS}*\n<xml>a trailer</xml>\n*"


def binary(numbers: np.ndarray, kind: int, code: str, **changes) -> bytes:
    """A binary file: numbers (profiles, points) of a struct code."""
    profiles, points = numbers.shape
    given = {"points": points, "profiles": profiles, "x": 1.5e-6, "y": 2.5e-6, "z": 1e-9} | changes
    header = b"bISO-1.0" + b"MAKER".ljust(10) + b"010120200000" * 2
    header += struct.pack("<HH", given["points"], given["profiles"])
    header += struct.pack("<dddd", given["x"], given["y"], given["z"], -1.0)
    header += struct.pack("<BBB", given.get("compression", 0), kind, 0)
    return header + struct.pack(f"<{numbers.size}{code}", *numbers.ravel().tolist())


def read(folder, content):
    path = folder / "surface.sdf"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_sdf(path)


def check(found, wanted):
    np.testing.assert_allclose(found.heights, 1e-9 * wanted, rtol=1e-7)
    assert found.pitch == (1.5e-6, 2.5e-6)
    assert (found.unit, found.x, found.format) == (1.0, None, "SDF (ISO 25178-71)")


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_text(tmp_path, end):
    check(read(tmp_path, TEXT.replace("\n", end)), HEIGHTS)


@pytest.mark.parametrize(("kind", "code"), [(3, "f"), (7, "d")])
def test_binary_floats(tmp_path, kind, code):
    check(read(tmp_path, binary(HEIGHTS, kind, code)), HEIGHTS)


@pytest.mark.parametrize(
    ("kind", "code", "lost"),
    [
        (0, "B", None),
        (1, "H", 2**16 - 1),
        (2, "I", 2**32 - 1),
        (4, "b", None),
        (5, "h", -(2**15)),
        (6, "i", -(2**31)),
    ],
)
def test_binary_whole_numbers(tmp_path, kind, code, lost):
    numbers = np.array([[1, 2, 3, 100], [4, 5, 6, 7]], dtype=object)
    wanted = numbers.astype(float)
    if lost is not None:
        numbers[1, 2], wanted[1, 2] = lost, np.nan
    if code.islower():
        numbers[0, 0], wanted[0, 0] = -90, -90.0
    check(read(tmp_path, binary(numbers, kind, code)), wanted)


def test_a_single_profile_is_a_line_scan(tmp_path):
    found = read(tmp_path, binary(HEIGHTS[:1], 7, "d"))
    assert not found.is_map
    check(found, HEIGHTS[0])


def test_what_follows_a_binary_files_heights_does_not_matter(tmp_path):
    check(read(tmp_path, binary(HEIGHTS, 7, "d") + b"<xml/>"), HEIGHTS)


def test_the_first_bytes_decide():
    assert is_sdf(TEXT.encode()) and is_sdf(binary(HEIGHTS, 7, "d"))
    assert not is_sdf(b"0,1\n1,2\n") and not is_sdf(b"")


GOOD = binary(HEIGHTS, 7, "d")
BAD = {
    "header cut": (GOOD[:60], "damaged surface data file: it ends inside its header"),
    "heights cut": (GOOD[:-1], "it ends before its 3 profiles of 4 heights"),
    "compressed": (binary(HEIGHTS, 7, "d", compression=1), "is a compressed surface data file"),
    "unknown type": (binary(HEIGHTS, 8, "d"), "its data type is 8"),
    "no heights": (binary(HEIGHTS, 7, "d", points=0), "it holds no heights"),
    "zero scale": (binary(HEIGHTS, 7, "d", z=0.0), "its scales are not positive and finite"),
    "scale not finite": (binary(HEIGHTS, 7, "d", x=np.nan), "its scales are not positive"),
    "text: no end of header": (HEADER.replace("*", ""), "its header has no end"),
    "text: field missing": (TEXT.replace("Xscale", "Scale"), "its header has no xscale"),
    "text: number wrong": (TEXT.replace("= 4", "= four"), "its header is wrong ("),
    "text: heights missing": (TEXT.replace("1e-3", ""), "it has 11 heights, not 3 profiles of 4"),
    "text: word": (TEXT.replace("8 -9", "8 minus"), "a height is no number ("),
    "text: compressed": (TEXT.replace("sion = 0", "sion = 1"), "is a compressed surface data"),
    "text: negative counts": (TEXT.replace("= 4", "= -4").replace("= 3", "= -3"), "it has 12 he"),
}


@pytest.mark.parametrize("case", BAD.values(), ids=BAD)
def test_damaged_files_are_refused(tmp_path, case):
    content, words = case
    with pytest.raises(ProfileError) as caught:
        read(tmp_path, content)
    message = str(caught.value)
    assert words in message
    assert message.startswith(str(tmp_path / "surface.sdf")) and "\n" not in message
