"""Text files of columns: read back from every dialect that they may be written in, or refused in
one clear line with the file, the line and what is allowed. Dropouts on the straight line between
their neighbours, never beyond the ends; a missing stretch of x is one, and rounded or uneven
steps are not."""

import os
import re
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from text_profiles import read_measured, read_profile, refused

from analytic.surface.readers import columns
from analytic.surface.readers.dropouts import gaps
from analytic.surface.readers.source import ProfileError

GOOD = b"0,1.5\n1,2.5\n2,3.5\n3,1.0\n4,0.5\n"

# content, number of the line to be named (None: the file as a whole), words
BAD = {
    "empty": (b"", None, "is empty"),
    "byte-order mark alone": (b"\xef\xbb\xbf", None, "is empty"),
    "only comments": (b"# a\n% b\n// c\n;d\n", None, "only comments"),
    "only text": (b"Lorem ipsum\ndolor\n", None, "'Lorem ipsum' is no row of numbers"),
    "NUL bytes": (GOOD + b"\x00\x00\n", 6, "not text (byte 0x00)"),
    "control character": (b"0,1\n1,2\x07\n2,3\n3,4\n", 2, "not text (byte 0x07)"),
    "broken UTF-16 without its mark": (b"0\x00;\x001\x00\n", None, "not text (broken UTF-16)"),
    "text in numbers": (b"# c\n0,1.5\n1,abc\n2,3\n3,1\n4,2\n", 3, "'abc' is not a number"),
    "text in the first row": (b"x,z\n0,peak\n1,2\n2,3\n3,1\n", 2, "'peak' is not a number"),
    "unit behind a number": (b"0 um;1\n1;2\n2;3\n3;4\n", 1, "'0 um' is not a number"),
    "grouped digits": (b"0;1,000.5\n1;2.5\n2;3.5\n3;4.5\n", 1, "'1,000.5' is not a number"),
    "digits with underscore": (b"0 1\n1 1_0\n2 3\n3 4\n", 2, "'1_0' is not a number"),
    "hexadecimal": (b"0 1\n1 2\n2 0x10\n3 4\n", 3, "'0x10' is not a number"),
    "digits of another script": ("0 1\n1 2\n2 ３\n3 4\n".encode(), 3, "is not a number"),
    "point among decimal commas": (b"0;1,5\n1;2,5\n2;3.5\n3;4,5\n", 3, "decimal comma"),
    "comma among decimal points": (b"0;1.5\n1;2.5\n2;3.5\n3;4,5\n", 4, "decimal point"),
    "one separator of another kind": (b"0,1\n1,2\n2;3\n3,4\n", 3, "'2;3' is not a number"),
    "missing column": (b"0,1\n1,2\n2\n3,4\n", 3, "1 column where most lines have 2"),
    "additional column": (b"0 1\n1 2\n2 3 4\n3 4\n", 3, "3 columns where most lines have 2"),
    "truncated last line": (GOOD + b"5", 6, "1 column where most lines have 2"),
    "three columns": (b"x y z\n0 1 2\n1 2 3\n2 3 4\n3 4 5\n", 2, "3 columns; a profile has two"),
    "decimal commas between commas": (
        b"0,5,1,5\n1,5,2,5\n2,5,3,5\n",
        1,
        "where commas are decimal",
    ),
    "three samples": (b"0,1\n1,2\n2,3\n", None, "has 3 samples; a profile needs at least 4"),
    "NaN": (b"# c\nx,z\n0,1\n1,NaN\n2,3\n3,4\n4,nan\n", 4, "height is lost ('1,NaN'), and"),
    "infinity": (b"0,1\n1,2\n2,inf\n3,4\n", 3, "height is lost ('2,inf');"),
    "overflow": (b"0,1\n1,2\n2,3\n3,1e999\n", 4, "height is lost"),
    "empty cell": (b"0;1\n1;2\n2;\n3;4\n", 3, "height is lost"),
    "lost x": (b"0;1\n;2\n2;3\n3;4\n", 2, "x is lost"),
    "asterisks": (b"0 1\n1 2\n2 3\n3 *****\n", 4, "height is lost"),
    "BAD": (b"0 1\n1 BAD\n2 3\n3 4\n", 2, "height is lost"),
    "not available": (b"0,1\n1,#N/A\n2,3\n3,4\n", 2, "height is lost"),
    "NaN of another program": (b"0 1\n1 2\n2 1.#QNAN0\n3 4\n", 3, "height is lost"),
    "same x twice": (b"0,1\n1,2\n2,3\n1,2\n3,4\n", 4, "the same as in line 2"),
    "same x, unsorted, after comments": (b"#\n3,1\n\n1,2\n2,3\n#\n3,2\n", 7, "as in line 2"),
    "x closer than rounding": (b"0,1\n1,2\n1.0000000001,3\n2,4\n", 3, "as in line 2"),
    "x everywhere the same": (b"5,1\n5,2\n5,3\n5,4\n", None, "x is the same in every line"),
    "heights alone without spacing": (b"1.5\n2.5\n3.5\n4.5\n", 1, "need the sample spacing"),
    "decimal commas without spacing": (b"0,5\n1,7\n0,2\n2,1\n", 3, "where commas are decimal"),
    "small decimal commas without spacing": (b"0,5\n0,7\n0,2\n0,1\n", None, "give heights alone"),
}
BAD_ALONE = {
    "two columns with spacing": (b"# c\n" + GOOD, 2, "spacing is for heights alone"),
    "comma of either kind": (b"0,1\n1,2\n2,3\n3,4\n", 1, "comma may stand between"),
    "empty line": (b"1.5\n2.5\n\n3.5\n4.5\n5.5\n", 3, "height is lost ('')"),
    "error value": (b"1.5\n2.5\n#N/A\n3.5\n4.5\n", 3, "height is lost ('#N/A')"),
    "two heights in a line": (b"1.5\n2.5\n3.5 3.6\n4.5\n5.5\n", 3, "'3.5 3.6' is not a number"),
}


def refusal(path, **options):
    error = refused(path, read_profile, **{"x_scale": 1e-6, "height_scale": 1e-6} | options)
    named = re.match(r", line (\d+): ", str(error).removeprefix(str(path)))
    assert (int(named[1]) if named else None) == error.line
    return str(error), error.line


def read_content(folder, content, **how):
    """What is read from a file of this content, in its own units unless others are given."""
    path = folder / "trace.csv"
    path.write_bytes(content)
    return read_profile(path, **({"x_scale": 1.0, "height_scale": 1.0} | how))


bridged = partial(read_content, dropouts="bridge")


def holds(read, x, height, lost=(0, 0), rtol=0.0):
    """`lost` samples are those bridged and those trimmed."""
    np.testing.assert_allclose(read.profile.x, x, rtol=rtol)
    np.testing.assert_allclose(read.profile.height, height, rtol=rtol)
    assert (read.bridged, read.trimmed) == lost


def check(folder, case, **options):
    content, line, words = case
    path = folder / "trace.csv"
    path.write_bytes(content)
    message, place = refusal(path, **options)
    assert place == line
    assert words in message


@pytest.mark.parametrize("case", BAD.values(), ids=BAD)
def test_bad_files_are_refused_at_their_line(tmp_path, case):
    check(tmp_path, case)


@pytest.mark.parametrize("case", BAD_ALONE.values(), ids=BAD_ALONE)
def test_bad_files_of_heights_alone_are_refused_at_their_line(tmp_path, case):
    check(tmp_path, case, spacing=1e-6)


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_line_numbers_count_the_lines_of_other_systems(tmp_path, end):
    content = end.join(["# c", "", "x z", "0 1", "1 2", "2 oops", "3 4", "4 5"]).encode()
    check(tmp_path, (content, 6, "'oops' is not a number"))


def test_line_number_far_down_a_long_file(tmp_path):
    rows = [f"{i};{i % 7},5" for i in range(100_000)]
    rows[54_321] = "54321;1,5x"
    content = "\n".join(rows).encode()
    check(tmp_path, (content, 54_322, "'1,5x' is not a number"))


def test_what_is_no_file(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    assert "there is no such file" in refusal(tmp_path / "none.csv")[0]
    assert "is a directory" in refusal(tmp_path)[0]
    assert "no regular file" in refusal(tmp_path / "pipe.csv")[0]


def test_too_many_samples(tmp_path, monkeypatch):
    path = tmp_path / "trace.csv"
    path.write_bytes(GOOD)
    monkeypatch.setattr(columns, "MAX_SAMPLES", 4)
    assert "has 5 samples; at most 4 are allowed" in refusal(path)[0]
    monkeypatch.setattr(columns, "MAX_SAMPLES", 5)
    assert len(read_profile(path, x_scale=1.0, height_scale=1.0).profile.x) == 5


def test_a_gigantic_file_is_refused_by_its_size(tmp_path):
    path = tmp_path / "trace.csv"
    with path.open("wb") as file:
        file.truncate(300 * 10**6)  # sparse: it takes no room
    assert "is too large; a profile may have 201 MB" in refusal(path)[0]


def test_a_long_token_is_cut(tmp_path):
    path = tmp_path / "trace.csv"
    path.write_bytes(b"0 1\n1 2\n2 " + b"z" * 10_000 + b"\n3 4\n")
    assert len(refusal(path)[0]) < len(str(path)) + 200


numbers = st.sampled_from(["0", "1", "2.5", "3,5", "-4", "1e999", "NaN", "***", "#N/A", "1_0"])
signs = st.sampled_from(
    [".", ",", ";", "\t", " ", "\n", "\r\n", "#", "%", "//", '"', "+", "e5", "x"]
)
odd_ones = st.sampled_from(["µ", "\x00", "\x0c", "\x85", "\xa0", "\u2028", "\ufeff"])
pieces = numbers | signs | st.just("\n") | odd_ones


@settings(max_examples=400, deadline=None, derandomize=True)
@given(
    text=st.lists(pieces, max_size=40).map("".join),
    dropouts=st.sampled_from(["refuse", "bridge"]),
    spacing=st.sampled_from([None, 1.0]),
)
def test_any_text_is_either_a_profile_or_one_clear_line(tmp_path_factory, text, dropouts, spacing):
    folder = tmp_path_factory.mktemp("profiles")
    try:
        read = read_content(folder, text.encode(), dropouts=dropouts, spacing=spacing)
    except ProfileError as error:
        assert str(error).startswith(str(folder / "trace.csv")) and "\n" not in str(error)
        assert error.line is None or 1 <= error.line <= len(text) + 1
    else:
        assert len(read.profile.x) >= 4
        assert dropouts == "bridge" or read.bridged == read.trimmed == 0


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"x_scale": 0.0}, "x_scale must be positive"),
        ({"height_scale": np.nan}, "height_scale must be positive"),
        ({"spacing": np.inf}, "spacing must be positive"),
        ({"dropouts": "ignore"}, "allowed: refuse, bridge"),
    ],
)
def test_arguments_that_make_no_sense(tmp_path, options, words):
    with pytest.raises(ValueError, match=words):
        read_content(tmp_path, GOOD, **options)


X = [0.0, 0.5, 1.5, 2.0, 4.25]
HEIGHT = [0.125, -3.0, 2.5, 0.0, -0.75]

TWO_COLUMNS = {
    "blank around comma": b"0 , 0.125\n0.5 , -3\n1.5 , 2.5\n2 , 0\n4.25 , -0.75",
    "blank, decimal comma": b"0 0,125\n0,5 -3\n1,5 2,5\n2 0\n4,25 -0,75\n",
    "aligned blanks": b"  0      0.125\n  0.5   -3\n  1.5    2.5\n  2      0\n  4.25  -0.75\n",
    "blanks and tabs": b"0 \t0.125\n0.5  -3\n1.5  2.5\n2  0\n4.25  -0.75\n",
    "end of file sign": b"0,0.125\r\n0.5,-3\r\n1.5,2.5\r\n2,0\r\n4.25,-0.75\r\n\x1a",
    "UTF-16, big end first": "x;µm\n0;0,125\n0,5;-3\n1,5;2,5\n2;0\n4,25;-0,75".encode("utf-16-be"),
    "Latin-1 comment": b"# H\xf6he in \xb5m\n0,0.125\n0.5,-3\n1.5,2.5\n2,0\n4.25,-0.75\n",
    "UTF-8 header": "Höhe/µm\n0,0.125\n0.5,-3\n1.5,2.5\n2,0\n4.25,-0.75\n".encode(),
    "true minus": "0,0.125\n0.5,−3\n1.5,2.5\n2,0\n4.25,−0.75\n".encode(),
    "all comment signs": b"# a\n% b\n; c\n// d\n0,0.125\n0.5,-3 # here\n#\n1.5,2.5 // no\n2,0\n"
    b"4.25,-0.75 % end\n# 9,9\n",
    "blank lines": b"\n\n0,0.125\n\n0.5,-3\n1.5,2.5\n , \n2,0\n4.25,-0.75\n\n,\n",
    "several header lines": b"Date: 2023-06-20\nSpeed, 0.5, mm/s\nx,z\num,um\n0,0.125\n0.5,-3\n"
    b"1.5,2.5\n2,0\n4.25,-0.75\n",
    "tab at line starts": b"\t0\t0.125\n\t0.5\t-3\n\t1.5\t2.5\n\t2\t0\n\t4.25\t-0.75\n",
    "exponents": b"0,1.25E-1\n5e-1,-3\n.15e+1,25.e-1\n+2,0\n4.25,-7.5e-01\n",
    "Fortran exponents": b"0.D0 1.25D-1\n5.D-1 -3.D0\n1.5D0 2.5d0\n2.D0 0.D0\n4.25D0 -7.5D-01\n",
    "quoted decimal commas": b'"0","0,125"\n"0,5","-3"\n"1,5","2,5"\n"2","0"\n"4,25","-0,75"\n',
}
ONE_COLUMN = {
    "decimal comma": b"0,125\n-3,0\n2,5\n0,0\n-0,75\n",
    "decimal comma, some whole": b"0,125\n-3\n2,5\n0\n-0,75\n",
    "semicolon at line ends": b"0,125;\n-3;\n2,5;\n0;\n-0,75;\n",
    "comment between": b"height\n0.125\n-3\n# a comment is no sample\n2.5\n0\n-0.75\n\n\n",
}


@pytest.mark.parametrize("content", TWO_COLUMNS.values(), ids=TWO_COLUMNS)
def test_two_columns_in_any_dialect(tmp_path, content):
    holds(read_content(tmp_path, content), X, HEIGHT)


@pytest.mark.parametrize("content", ONE_COLUMN.values(), ids=ONE_COLUMN)
def test_one_column_in_any_dialect(tmp_path, content):
    holds(read_content(tmp_path, content, spacing=0.25), 0.25 * np.arange(5), HEIGHT)


def test_whole_numbers_with_a_comma_are_two_columns(tmp_path):
    holds(read_content(tmp_path, b"1,5\n2,7\n3,7\n4,6\n"), [1, 2, 3, 4], [5, 7, 7, 6])


def test_heights_are_scaled_but_not_moved(tmp_path):
    content = b"1 105\n2 107\n3 106\n4 109\n"
    read = read_content(tmp_path, content, x_scale=1e-6, height_scale=1e-9)
    np.testing.assert_allclose(read.profile.height, [1.05e-7, 1.07e-7, 1.06e-7, 1.09e-7])


def test_a_long_file_reads_the_same_fast_and_row_by_row(tmp_path):
    generator = np.random.default_rng(7)
    x, height = np.arange(20_000) * 0.25, generator.normal(size=20_000)
    plain = "\n".join(f"{a:.2f} {h:.12e}" for a, h in zip(x, height, strict=True))
    fast = read_content(tmp_path, plain.encode())
    careful = read_content(tmp_path, plain.replace("e", "D").encode())
    np.testing.assert_array_equal(fast.profile.x, x)
    np.testing.assert_allclose(fast.profile.height, height, rtol=1e-12)
    np.testing.assert_array_equal(careful.profile.height, fast.profile.height)


@st.composite
def dialects(draw):
    separator, decimal = draw(
        st.sampled_from([(",", "."), (" ", ".")])
        | st.tuples(st.sampled_from([";", "\t", "  ", " ; ", "\t "]), st.sampled_from(",."))
    )
    return {
        "separator": separator,
        "decimal": decimal,
        "form": draw(st.sampled_from([".3f", ".4e", "+.3f", "g"])),
        "comment": draw(st.sampled_from(["# 1 2\n", "% Höhe\n", ";x\n", "// 5;5\n", "\n", ""])),
        "header": draw(st.sampled_from(["", "x{0}z\n", "Profil 1\nx{0}z\n[mm]{0}[µm]\n"])),
        "end": draw(st.sampled_from(["\n", "\r\n", "\r"])),
        "encoding": draw(st.sampled_from(["utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le"])),
        "trailing": draw(st.booleans()),
    }


def written(dialect, rows):
    def cell(number):
        return format(number, dialect["form"]).replace(".", dialect["decimal"])

    separator = dialect["separator"]
    ending = separator if dialect["trailing"] and separator.strip(" ") else ""
    lines = [separator.join(map(cell, row)) + ending for row in rows]
    lines.insert(len(lines) // 2, dialect["comment"].rstrip("\n") or "# middle")
    text = dialect["comment"] + dialect["header"].format(separator) + "\n".join(lines) + "\n"
    return text.replace("\n", dialect["end"]).encode(dialect["encoding"])


def rounded(dialect, numbers):
    return np.array([float(format(number, dialect["form"])) for number in numbers])


heights = st.floats(-1e3, 1e3, allow_nan=False)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(
    dialect=dialects(),
    x=st.lists(st.integers(-500, 500), min_size=4, max_size=30, unique=True),
    data=st.data(),
)
def test_two_columns_survive_a_round_trip(tmp_path_factory, dialect, x, data):
    height = data.draw(st.lists(heights, min_size=len(x), max_size=len(x)))
    x = 0.25 * np.array(x)
    content = written(dialect, zip(x, height, strict=True))
    order = np.argsort(x)
    read = read_content(tmp_path_factory.mktemp("profiles"), content)
    holds(read, x[order], rounded(dialect, height)[order])


@settings(max_examples=100, deadline=None, derandomize=True)
@given(dialect=dialects(), height=st.lists(heights, min_size=4, max_size=30))
def test_one_column_survives_a_round_trip(tmp_path_factory, dialect, height):
    dialect = dialect | {"separator": "", "header": "height\n"}
    problem = tmp_path_factory.mktemp("profiles"), written(dialect, [(h,) for h in height])
    cells = [format(h, dialect["form"]).partition(".") for h in height]
    every_row_has_a_comma = dialect["decimal"] == "," and all(point for _, point, _ in cells)
    if every_row_has_a_comma and len({whole for whole, _, _ in cells}) == len(height):
        with pytest.raises(ProfileError, match="may stand between x and height or be decimal"):
            read_content(*problem, spacing=0.5)
        return
    read = read_content(*problem, spacing=0.5)
    holds(read, 0.5 * np.arange(len(height)), rounded(dialect, height))


def test_gaps_are_bridged_by_place_not_by_count(tmp_path):
    read = bridged(tmp_path, b"0,1\n1,NaN\n4,***\n5,6\n6,BAD\n7,2\n8,0\n")
    holds(read, [0, 1, 4, 5, 6, 7, 8], [1, 2, 5, 6, 4, 2, 0], (3, 0), rtol=1e-15)


def test_ends_are_trimmed_and_not_extrapolated(tmp_path):
    read = bridged(tmp_path, b"0,\n1,\n2,5\n3,6\n4,inf\n5,8\n6,7\n7,NaN\n")
    holds(read, [2, 3, 4, 5, 6], [5, 6, 7, 8, 7], (1, 3))


def test_neighbours_are_those_in_x_whatever_the_order_of_rows(tmp_path):
    read = bridged(tmp_path, b"5,6\n1,NaN\n9,NaN\n0,1\n6,5\n7,4\n")
    holds(read, [0, 1, 5, 6, 7], [1, 2, 6, 5, 4], (1, 1))


def test_empty_lines_of_a_single_column_are_lost_heights(tmp_path):
    read = bridged(tmp_path, b"z\n\n1.5\n2.5\n\n3.5\nbad\n\n2\n\n", spacing=0.5)
    holds(read, 0.5 * np.arange(7), [1.5, 2.5, 3, 3.5, 3, 2.5, 2], (3, 0), rtol=1e-15)


@pytest.mark.parametrize(
    "rows", [b"0;1\n1;2\n;9\nNaN;\n4;8\n5;0\n", b"5;0\n4;8\n-;NaN\n;3\n1;2\n0;1\n"]
)
def test_a_lost_x_is_put_between_its_neighbours_in_ordered_rows(tmp_path, rows):
    read = bridged(tmp_path, rows)
    holds(read, [0, 1, 2, 3, 4, 5], [1, 2, 4, 6, 8, 0], (2, 0), rtol=1e-15)


def test_a_lost_x_at_an_end_is_trimmed(tmp_path):
    read = bridged(tmp_path, b"NaN 7\n0 1\n1 2\n2 1\n3 1\n*** 9\n")
    holds(read, [0, 1, 2, 3], [1, 2, 1, 1], (0, 2))


@pytest.mark.parametrize(
    ("content", "line", "words"),
    [
        (b"0 1\n2 2\n1 2\nNaN 3\n3 3\n4 1\n", 4, "not in order of x"),
        (b"0 NaN\n1 1\n2 1\n3 2\n4 BAD\n", None, "3 samples but for"),
        (b"0 NaN\n1 NaN\n2 NaN\n3 NaN\n", None, "nothing but dropouts"),
        (b"0 1\n1 NaN\n1 2\n2 1\n3 1\n", 3, "the same as in line 2"),
        (b"0 1\n1 oops\n2 NaN\n3 1\n4 1\n", 2, "'oops' is not a number"),
    ],
)
def test_what_cannot_be_bridged_is_refused(tmp_path, content, line, words):
    check(tmp_path, (content, line, words), dropouts="bridge")


PLACES = 0.5 * np.arange(400)  # um
Z = np.sin(PLACES / 7.0)
KEPT = (PLACES < 60.0) | (PLACES > 90.0)


def measured(folder, x, z, dropouts):
    path = folder / "trace.csv"
    np.savetxt(path, np.column_stack([x, z]), fmt="%.6g", delimiter=",")
    return read_measured(path, x_scale=1e-6, height_scale=1e-6, dropouts=dropouts)


def test_a_gap_is_refused_where_it_is(tmp_path):
    with pytest.raises(ProfileError, match=r"gap from 5.95e-05 m to 9.05e-05 m \(61 samples lost"):
        measured(tmp_path, PLACES[KEPT], Z[KEPT], "refuse")
    kept = KEPT & ((PLACES < 20.0) | (PLACES > 21.5))
    with pytest.raises(ProfileError, match=r"and at 1 more places \(65 samples lost\)"):
        measured(tmp_path, PLACES[kept], Z[kept], "refuse")


def test_a_gap_is_bridged_by_a_straight_line(tmp_path):
    trace = measured(tmp_path, PLACES[KEPT], Z[KEPT], "bridge")
    np.testing.assert_allclose(trace.profile.x, 1e-6 * PLACES, atol=1e-15)
    np.testing.assert_allclose(trace.profile.height[KEPT], 1e-6 * Z[KEPT], atol=1e-11)
    between = 1e-6 * np.interp(PLACES[~KEPT], PLACES[KEPT], Z[KEPT])
    np.testing.assert_allclose(trace.profile.height[~KEPT], between, atol=1e-11)
    assert (trace.bridged, trace.trimmed) == (61, 0)
    assert trace.stretch == pytest.approx((59.5e-6, 90.5e-6))


def test_a_gap_beyond_all_bounds_is_not_filled(tmp_path):
    x = np.append(PLACES[:-1], 1e7)
    with pytest.raises(ProfileError, match=r"x has a gap of 199996.. samples; at most 2000000"):
        measured(tmp_path, x, Z, "bridge")


def test_an_uneven_scan_of_an_instrument_has_gaps_too(tmp_path, monkeypatch):
    from analytic.surface.readers import files
    from analytic.surface.readers.topography import Topography

    scan = Topography(tmp_path, 1e-6 * Z[KEPT], None, 1e-6 * PLACES[KEPT], 1.0, "made")
    monkeypatch.setattr(files, "read_instrument_file", lambda path, channel: scan)
    path = tmp_path / "trace.dat"
    path.write_bytes(b"\x00\x01")
    with pytest.raises(ProfileError, match=r"x has a gap from 5.95e-05 m to 9.05e-05 m"):
        read_measured(path)
    assert read_measured(path, dropouts="bridge").bridged == 61


RNG = np.random.default_rng(5)
WHOLE = {
    "even": PLACES,
    "rounded to its own step": np.round(0.156 * np.arange(2000), 1),
    "rounded, rarely a longer step": np.round(0.101 * np.arange(2000), 1),
    "random steps": np.cumsum(RNG.uniform(0.2, 1.0, 500)),
    "steps of exponential length": np.cumsum(0.01 + RNG.exponential(1.0, 500)),
    "coarse, then fine": np.concatenate([np.arange(50.0), 50.0 + 0.1 * np.arange(200)]),
    "one sample lost": np.delete(PLACES, 100),
    "few samples": np.array([0.0, 1.0, 2.0, 50.0, 51.0]),
}


@pytest.mark.parametrize("x", WHOLE.values(), ids=WHOLE)
def test_other_steps_are_no_gaps(x):
    assert gaps(x) == []
