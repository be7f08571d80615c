"""Readers of files: which one reads a file, whose units count, and what happens to lost heights."""

from pathlib import Path

import numpy as np
import pytest
from text_profiles import read_measured, refused

import analytic.surface.readers.instruments as instruments
from analytic.surface.readers.files import MissingUnitError, profile_of
from analytic.surface.readers.source import ProfileError
from analytic.surface.readers.topography import MapLine, Topography

SCAN = b"0,1\n1,2\n2,4\n3,3\n4,0\n"
SCALES = {"x_scale": 1e-6, "height_scale": 1e-9}
MAP = [[1.0, 2.0, 3.0, 4.0, 9.0], [5.0, None, 7.0, 8.0, 1.0], [None, 2.0, 3.0, 0.5, None],
       [6.0, 6.5, 7.0, 3.0, 2.0]]  # fmt: skip


def opened(rows, pitch=(1e-6, 2e-6)) -> Topography:
    """Rows of a map [nm], or the only one of a line scan, as a file gives them."""
    heights = 1e-9 * np.array(rows, dtype=float)
    return Topography(
        Path("surface.x3p"), heights if len(rows) > 1 else heights[0], pitch, None, 1.0, "made"
    )


def text(folder, content=SCAN):
    (folder / "trace.csv").write_bytes(content)
    return folder / "trace.csv"


def refusal(path, kind=ProfileError, **options) -> str:
    read = profile_of if isinstance(path, Topography) else read_measured
    return str(refused(path, read, kind, **options))


def knows(monkeypatch, **answer):
    """Make every instrument's file one of these."""
    answers = {"format": "made", "version": "1", "pitch": None, "unit": None, "unit_name": None}
    program = (
        "import json, sys\nimport numpy as np\n"
        "np.savez(sys.argv[2], heights=np.array([1.0, 4.0, 9.0, 2.0, 3.0]))\n"
        f"print({str(answers | answer)!r}.replace(chr(39), chr(34)).replace('None', 'null'))"
    )
    monkeypatch.setattr(instruments, "WORKER", ("-c", program))


def test_text_is_a_line_scan(tmp_path):
    trace = read_measured(text(tmp_path), **SCALES)
    np.testing.assert_allclose(trace.profile.x, 1e-6 * np.arange(5))
    np.testing.assert_allclose(trace.profile.height, 1e-9 * np.array([1, 2, 4, 3, 0]))
    assert (trace.format, trace.place, trace.bridged, trace.trimmed) == ("text", None, 0, 0)


@pytest.mark.parametrize(("given", "asked"), [("x_scale", "z_unit"), ("height_scale", "x_unit")])
def test_text_needs_its_units(tmp_path, given, asked):
    with pytest.raises(MissingUnitError, match="no unit is taken") as caught:
        read_measured(text(tmp_path), **{given: 1e-6})
    assert caught.value.field == asked


def test_units_that_the_file_gives_may_be_repeated_but_not_contradicted():
    scan = opened(MAP[:1])
    profile_of(scan, x_scale=1.0, height_scale=1.0)
    message = refusal(scan, height_scale=1e-6)
    assert "counts in units of 1 m and not of 1e-06 m, as z_unit has it; allowed is to" in message
    assert "as x_unit has it" in refusal(scan, x_scale=1e-6, height_scale=1.0)
    assert refusal(scan, spacing=1e-6).endswith("the sample spacing is for files without one")


def test_lost_heights_are_refused_with_their_place():
    scan = opened(MAP)
    said = "choose another line, or ask for dropouts to be bridged"
    said = f"sample 1 of row 1, at x = 1e-06 m, was not measured; {said}"
    assert refusal(scan, chosen=MapLine(row=1)).endswith(said)
    said = "sample 0 of row 2, at x = 0 m, was not measured, nor was 1 more"
    assert said in refusal(scan, chosen=MapLine(row=2))


def test_lost_heights_are_bridged_and_ends_left_out():
    rows = [[None, 1.0, None, 5.0, 6.0, 2.0, None]]
    trace = profile_of(opened(rows), dropouts="bridge")
    np.testing.assert_allclose(trace.profile.height, 1e-9 * np.array([1, 3, 5, 6, 2]))
    np.testing.assert_allclose(trace.profile.x, 1e-6 * np.arange(1, 6))
    assert (trace.bridged, trace.trimmed) == (1, 2)


def test_an_instruments_file_in_its_own_units(tmp_path, monkeypatch):
    knows(monkeypatch, pitch=[2.0, 2.0], unit=1e-6, unit_name="um")
    trace = read_measured(text(tmp_path, b"\x00\x01\x02"))
    np.testing.assert_allclose(trace.profile.x, 2e-6 * np.arange(5))
    np.testing.assert_allclose(trace.profile.height, 1e-6 * np.array([1, 4, 9, 2, 3]))
    assert trace.format == "made, by SurfaceTopography 1"


def test_an_instruments_file_that_names_no_unit_takes_the_callers(tmp_path, monkeypatch):
    knows(monkeypatch, pitch=[2.0, 2.0])
    path = text(tmp_path, b"\x00\x01\x02")
    trace = read_measured(path, **SCALES)
    np.testing.assert_allclose(trace.profile.x, 2e-6 * np.arange(5))
    np.testing.assert_allclose(trace.profile.height, 1e-9 * np.array([1, 4, 9, 2, 3]))
    assert refusal(path, MissingUnitError, x_scale=1.0).endswith("names no unit")


def test_an_instruments_file_without_a_size_takes_the_callers_spacing(tmp_path, monkeypatch):
    knows(monkeypatch)
    path = text(tmp_path, b"\x00\x01\x02")
    trace = read_measured(path, spacing=5e-6, height_scale=1e-9)
    np.testing.assert_allclose(trace.profile.x, 5e-6 * np.arange(5))
    assert refusal(path, MissingUnitError, **SCALES).endswith("does not give its size")


@pytest.mark.parametrize(
    "content",
    [
        b"PK\x03\x04\x14\x00\x06\x00rest",
        b"\\*File list\r\n" + b"words\r\n" * 1000 + b"\x1a\x00\x01\xff",
        b"\xff\xfe0\x00,\x001",
    ],
    ids=["zip", "text, then heights", "broken UTF-16"],
)
def test_what_is_not_text_goes_to_the_instruments_reader(tmp_path, monkeypatch, content):
    knows(monkeypatch, pitch=[2.0, 2.0], unit=1e-6, unit_name="um")
    assert read_measured(text(tmp_path, content)).format.startswith("made")


COLUMNS = b"".join(b"%d %d %d\n" % (i, i * i % 7, 3 * i % 5) for i in range(5))


def test_columns_are_a_map_only_where_their_file_says_so(tmp_path, monkeypatch):
    path = text(tmp_path, COLUMNS)
    knows(monkeypatch)
    said = "by numbers from 0 to 2; of a map row, column or line chooses one line"
    assert refusal(path, **SCALES).endswith(f"columns chooses them: {said}")
    knows(monkeypatch, pitch=[2.0, 2.0], unit=1e-6, unit_name="um")
    assert read_measured(path).format.startswith("made")


@pytest.mark.parametrize("chosen", [None, MapLine(row=1)])
def test_without_the_library_columns_name_what_may_read_them(tmp_path, monkeypatch, chosen):
    program = "import json; print(json.dumps({'absent': 'No module named SurfaceTopography'}))"
    monkeypatch.setattr(instruments, "WORKER", ("-c", program))
    message = refusal(text(tmp_path, COLUMNS), **SCALES, chosen=chosen)
    assert ", line 1: 3 columns; a profile has two (x, height)" in message
    assert message.endswith(instruments.install_command())
    scan = refusal(text(tmp_path), **SCALES, chosen=MapLine(row=1))
    assert scan.endswith("is a line scan, which has no rows; allowed is to leave out row")


@pytest.mark.parametrize(
    ("heights", "pitch", "fragment"),
    [
        (np.empty((0, 5)), (1e-6, 1e-6), "a damaged file: it holds 0 by 5 heights"),
        (np.zeros((4, 5)), (np.nan, 1e-6), "a damaged file: its samples are nan and 1e-06 apart"),
        (np.zeros((4, 5)), (1e-6, 0.0), "a damaged file: its samples are 1e-06 and 0 apart"),
    ],
)
def test_a_map_without_samples_or_size_is_damaged(tmp_path, monkeypatch, heights, pitch, fragment):
    def read(path, channel):
        return Topography(path, heights, pitch, None, 1.0, "made")

    monkeypatch.setattr("analytic.surface.readers.files.read_instrument_file", read)
    (tmp_path / "map.x3p").write_bytes(b"\0" * 10)
    assert fragment in refusal(tmp_path / "map.x3p", chosen=MapLine(row=0))


@pytest.mark.parametrize(
    "content", [b"0,1\n1,1e300\n2,0\n3,1\n4,0\n", b"0,1\n1e290,1\n2e290,0\n3e290,1\n"]
)
def test_heights_of_no_size_are_refused(tmp_path, content):
    assert "holds no profile" in refusal(text(tmp_path, content), x_scale=1.0, height_scale=1.0)


@pytest.mark.usefixtures("one_reader")
def test_digits_in_groups_are_shown_as_they_are(tmp_path):
    path = text(tmp_path, b'"1,000,000";"1,5"\n' * 5)
    assert '"1,000,000"' in refusal(path, **SCALES)


@pytest.mark.parametrize(("scale", "pitch"), [(1.0, 1e-300), (1.0, 1e290), (1e309, 1e-6)])
def test_scales_of_no_size_are_refused(scale, pitch):
    rows = scale * np.array(MAP[::3])
    assert "holds no profile: " in refusal(opened(rows, (pitch, 2e-6)), chosen=MapLine(row=0))
