"""Tables of more than x and height, packed files, arrays and spreadsheets."""

import gzip
import importlib.util
import zipfile

import numpy as np
import pytest
from text_profiles import read_measured, refused

from analytic.surface.readers import source
from analytic.surface.readers.arrays import read_arrays
from analytic.surface.readers.files import MissingUnitError, open_measured
from analytic.surface.readers.source import LONGEST_LINE, MAX_LINES, ProfileError
from analytic.surface.readers.text import ColumnsError
from analytic.surface.readers.topography import MapLine, UnchosenLineError

pytestmark = pytest.mark.usefixtures("one_reader")
X = 0.5 * np.arange(40)  # um
RAW = np.sin(X / 3.0)
LEVEL = RAW - 0.01 * X
UM = {"x_scale": 1e-6, "height_scale": 1e-6}
ALONE = {"spacing": 0.5e-6, "height_scale": 1e-6}  # of heights without their x
HAS_SPREADSHEETS = importlib.util.find_spec("SurfaceTopography") is not None
needs_spreadsheets = pytest.mark.skipif(
    not HAS_SPREADSHEETS, reason="no SurfaceTopography: pip install SurfaceTopography"
)


def holds(path, height, **options):
    """The file's profile is that of X and these heights [um]."""
    trace = read_measured(path, **({} if "spacing" in options else UM) | options)
    np.testing.assert_allclose(trace.profile.x, 1e-6 * X, atol=1e-15)
    np.testing.assert_allclose(trace.profile.height, 1e-6 * height, atol=1e-12)
    return trace


def text(folder, head, *columns, end="\n"):
    path = folder / "trace.csv"
    rows = (",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True))
    path.write_text(head + end.join(rows) + end)
    return path


def refusal(path, kind=ProfileError, **options) -> str:
    return str(refused(path, kind=kind, **UM | options))


def test_empty_columns_at_the_end_are_none(tmp_path):
    """A Dektak exports these: two commas end every row, one the names."""
    holds(text(tmp_path, "Lateral um,Raw Micrometer,\n", X, RAW, end=",,\n"), RAW)


def test_a_count_above_the_rows_is_no_row(tmp_path):
    holds(text(tmp_path, "µm µm\n40\n", X, RAW), RAW)
    message = refusal(text(tmp_path, "µm µm\n41\n", X, RAW))
    assert "line 2: says that 41 rows follow, and 40 are there; if it is no count, it" in message
    assert "rows follow" not in refusal(text(tmp_path, "0.5\n", X, RAW))


def test_columns_are_chosen_by_number_or_name(tmp_path):
    index = np.arange(40.0)
    path = text(tmp_path, "n,x [um],raw [um],level [um]\n", index, X, RAW, LEVEL)
    holds(path, RAW, columns=(1, 2))
    holds(path, LEVEL, columns=("x [um]", "level [um]"))
    holds(path, LEVEL, columns=("level [um]",), **ALONE)
    message = refusal(path, ColumnsError)
    assert "4 columns; a profile has two (x, height) or one (height), and columns" in message
    assert "numbers from 0 to 3, or by names, of 'n', 'x [um]', 'raw [um]', 'level" in message
    assert "has no column 4; allowed is numbers from 0 to 3" in refusal(path, columns=(1, 4))
    assert "has no column 'z'; allowed is 'n', 'x [um]'" in refusal(path, columns=(1, "z"))


def test_columns_that_are_not_chosen_may_hold_anything(tmp_path):
    path = tmp_path / "trace.csv"
    rows = "".join(
        f"{x},12:30:0{i % 10},{z}\n" for i, (x, z) in enumerate(zip(X, RAW, strict=True))
    )
    path.write_text("x,time,z\n" + rows)
    holds(path, RAW, columns=("x", "z"))
    assert "is not a number" in refusal(path, columns=("x", "time"))


def test_a_packed_file_is_read_as_what_is_in_it(tmp_path):
    path = text(tmp_path, "x,z\n", X, RAW)
    packed = tmp_path / "trace.csv.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    holds(packed, RAW)
    packed.write_bytes(packed.read_bytes()[:-40])
    assert "is a damaged gz file" in refusal(packed)
    packed.write_bytes(gzip.compress(b"0" * 300_000_000, 1))
    assert "is too large; a profile may have" in refusal(packed)


@needs_spreadsheets
def test_an_instruments_file_may_be_packed(tmp_path):
    np.savetxt(tmp_path / "map.txt", np.outer([1.0, 2, 3, 4, 5, 6], RAW), fmt="%.9f")
    body = (tmp_path / "map.txt").read_text()
    head = "# Width: 20 µm\n# Height: 3 µm\n# Value units: µm\n"
    (tmp_path / "map.txt.gz").write_bytes(gzip.compress((head + body).encode()))
    holds(tmp_path / "map.txt.gz", RAW, chosen=MapLine(row=0))


SURFACE = RAW[None, :] + 0.1 * np.arange(7)[:, None]  # (rows, columns)
LIST = [(x, 0.75 * y, z) for y, row in enumerate(SURFACE) for x, z in zip(X, row, strict=True)]


@needs_spreadsheets
@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize("delimiter", [" ", ";"])
def test_a_list_of_the_points_of_a_grid_is_a_map(tmp_path, order, delimiter):
    points = sorted(LIST, key=lambda point: point[:2][::order])
    np.savetxt(tmp_path / "map.xyz", points, fmt="%.9f", delimiter=delimiter)
    message = refusal(tmp_path / "map.xyz", UnchosenLineError, x_scale=None)
    assert "is a map of 7 rows and 40 columns, and a profile is one line of it" in message
    assert "row, column (counted from 0) or line" in message
    holds(tmp_path / "map.xyz", SURFACE[5], chosen=MapLine(row=5))
    line = (0.0, 1.5e-6), (1e-6 * X[-1], 1.5e-6)
    holds(tmp_path / "map.xyz", SURFACE[2], chosen=MapLine(line=line))
    column = read_measured(tmp_path / "map.xyz", **UM, chosen=MapLine(column=9)).profile
    np.testing.assert_allclose(column.x, 0.75e-6 * np.arange(7), atol=1e-15)
    np.testing.assert_allclose(column.height, 1e-6 * SURFACE[:, 9], atol=1e-12)
    with pytest.raises(MissingUnitError, match="names no unit"):
        read_measured(tmp_path / "map.xyz", chosen=MapLine(row=5))


@needs_spreadsheets
def test_numbers_of_which_a_line_is_asked_for_are_a_map(tmp_path):
    """Whatever language its header has; without a choice what is said names both ways."""
    np.savetxt(tmp_path / "map.txt", SURFACE, header="Kanava: Korkeus\nLeveys: 20 µm")
    holds(tmp_path / "map.txt", SURFACE[3], **ALONE, chosen=MapLine(row=3))
    message = refusal(tmp_path / "map.txt", ColumnsError)
    assert "40 columns; a profile has two" in message
    assert "from 0 to 39; of a map row, column or line chooses one line" in message
    np.save(tmp_path / "narrow.npy", SURFACE.T)
    trace = read_measured(tmp_path / "narrow.npy", **ALONE, chosen=MapLine(column=3))
    np.testing.assert_allclose(trace.profile.height, 1e-6 * SURFACE[3], atol=1e-12)


def test_arrays_of_numpy(tmp_path):
    np.save(tmp_path / "heights.npy", RAW)
    holds(tmp_path / "heights.npy", RAW, **ALONE)
    np.save(tmp_path / "both.npy", np.column_stack([X, RAW]))
    holds(tmp_path / "both.npy", RAW)
    np.savez(tmp_path / "named.npz", z=RAW, x=X, gain=3.0, label="mine")
    holds(tmp_path / "named.npz", RAW)
    np.savez(tmp_path / "more.npz", z=RAW, x=X, level=LEVEL)
    holds(tmp_path / "more.npz", LEVEL, columns=("x", "level"))
    assert "by names, of 'x', 'z', 'level'" in refusal(tmp_path / "more.npz", ColumnsError)
    np.save(tmp_path / "map.npy", np.outer(np.ones(40), RAW))
    assert holds(tmp_path / "map.npy", RAW, **ALONE, chosen=MapLine(row=3)).format == "npy"
    said = refusal(tmp_path / "both.npy", MissingUnitError, x_scale=None)
    assert "is npy, from whose header" in said


def test_one_of_several_maps_is_chosen(tmp_path):
    np.savez(tmp_path / "maps.npz", a=np.outer(np.ones(40), RAW), b=np.eye(40))
    assert "holds 2 maps; allowed is channel, of 'a', 'b'" in refusal(tmp_path / "maps.npz")
    holds(tmp_path / "maps.npz", RAW, **ALONE, channel="a", chosen=MapLine(row=0))
    said = refusal(tmp_path / "maps.npz", channel="c", chosen=MapLine(row=0))
    assert "has no channel 'c'; allowed is 'a', 'b'" in said


def test_arrays_that_are_no_profile(tmp_path, monkeypatch):
    np.save(tmp_path / "objects.npy", np.array([{"a": 1}], dtype=object), allow_pickle=True)
    assert "is a damaged npy file" in refusal(tmp_path / "objects.npy")
    (tmp_path / "cut.npy").write_bytes((tmp_path / "objects.npy").read_bytes()[:30])
    assert "is a damaged npy file" in refusal(tmp_path / "cut.npy")
    np.savez(tmp_path / "words.npz", name="mine")
    np.save(tmp_path / "empty.npy", np.empty((5, 0)))
    for name in ("words.npz", "empty.npy"):
        assert "holds no arrays of one or two dimensions" in refusal(tmp_path / name)
    np.savez_compressed(tmp_path / "large.npz", x=np.zeros(100_000, dtype=np.uint8))
    monkeypatch.setattr(source, "MAX_NUMBERS", 90_000)
    with pytest.raises(ProfileError, match=r"holds 1e\+05 numbers; allowed are 9e\+04"):
        read_arrays(tmp_path / "large.npz", None, None)


@pytest.mark.parametrize(
    ("array", "kind"),
    [
        (RAW + 1j, "complex128"),
        (np.arange(40).astype("datetime64[s]"), "datetime64"),
        (np.array(["1"] * 40), "<U1"),
        (np.zeros(40, dtype=[("x", float), ("z", float)]), "'x', '<f8'"),
    ],
    ids=["complex", "dates", "text", "structured"],
)
def test_an_array_of_anything_but_real_numbers_is_none(tmp_path, array, kind):
    np.save(tmp_path / "other.npy", array)
    message = refusal(tmp_path / "other.npy", spacing=1e-6)
    said = "in place of numbers; allowed are real ones"
    assert kind in message and message.endswith(said)
    np.savez(tmp_path / "other.npz", x=X, z=array)  # else x alone passes for the heights
    message = refusal(tmp_path / "other.npz", spacing=1e-6)
    assert f"'z' holds {array.dtype} {said}" in message


@pytest.mark.parametrize("kind", ["npy", "npz", "xlsx"])
def test_a_lost_height_of_an_array_has_its_place(tmp_path, kind):
    path, lost = tmp_path / f"trace.{kind}", np.where(np.arange(40) == 16, np.nan, RAW)
    if kind == "npy":
        np.save(path, np.column_stack([X, lost]))
    elif kind == "npz":
        np.savez(path, x=X, z=lost)
    else:
        openpyxl = pytest.importorskip("openpyxl", reason="no openpyxl: pip install openpyxl")
        book = openpyxl.Workbook()
        for x, z in zip(X, lost, strict=True):
            book.active.append([float(x), None if np.isnan(z) else float(z)])
        book.save(path)
    said = "line 17: height is lost; correct it, or ask for dropouts to be bridged"
    assert refusal(path) == f"{path}, {said}"
    bridged = np.where(np.isnan(lost), (RAW[15] + RAW[17]) / 2.0, RAW)
    holds(path, bridged, dropouts="bridge")


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"0\n" * (MAX_LINES + 1), f"{MAX_LINES + 1} lines"),
        ((b"1," * 400_000 + b"1\n") * 51, "20400051 cells"),
        (b"0,1\n" + b"1" * (LONGEST_LINE + 1), f"{LONGEST_LINE + 2} bytes in a line"),
    ],
    ids=["lines", "cells", "a line"],
)
def test_text_that_is_large_once_unpacked_is_refused_before_it_is_split(tmp_path, content, what):
    path = tmp_path / "trace.csv.gz"
    path.write_bytes(gzip.compress(content, 1))
    assert f"is too large: it has {what}; allowed are" in refusal(path)


@needs_spreadsheets
def test_a_spreadsheet(tmp_path):
    from openpyxl import Workbook

    book, path = Workbook(), tmp_path / "trace.xlsx"
    book.active.append(["a title of mine"])
    sheet = book.create_sheet("trace")
    sheet.append(["measured by me"])
    sheet.append(["n", "x [um]", "z [um]", None])
    for number, (x, z) in enumerate(zip(X, RAW, strict=True)):
        sheet.append([number, float(x), float(z), "good"])
    book.save(path)
    holds(path, RAW, channel="trace", columns=("x [um]", "z [um]"))
    message = refusal(path, ColumnsError, channel="trace")
    assert "line 3: 3 columns" in message and "'n', 'x [um]', 'z [um]'" in message
    said = "holds no columns of numbers on the sheet 'Sheet' of ['Sheet', 'trace']"
    assert said in refusal(path)
    said = "has no channel 'none'; allowed is Sheet, trace"
    assert said in refusal(path, channel="none")
    head = open_measured(path, channel="trace", columns=(1, 2)).head
    assert head == ("measured by me", "n, x [um], z [um]")


@needs_spreadsheets
def test_a_row_of_too_many_cells_is_refused_before_it_is_taken_apart(tmp_path):
    with zipfile.ZipFile(tmp_path / "wide.xlsx", "w", zipfile.ZIP_DEFLATED) as book:
        book.writestr("xl/workbook.xml", "")
        book.writestr("xl/worksheets/sheet1.xml", b"<c/>" * (2**22 + 1))
    assert "a sheet of more than 4194304 cells" in refusal(tmp_path / "wide.xlsx")


@needs_spreadsheets
def test_a_spreadsheet_with_a_cell_far_away_is_not_filled_up_to_it(tmp_path):
    from openpyxl import Workbook

    book = Workbook()
    book.active.cell(1_000_000, 16_000, 1.0)
    book.save(tmp_path / "far.xlsx")
    assert "reaches over more than 4194304 cells" in refusal(tmp_path / "far.xlsx")
