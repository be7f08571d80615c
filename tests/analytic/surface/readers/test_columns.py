"""Profiles read back from every dialect that they may be written in: separators, decimals, ends of
lines and encodings by round trips, the rest one by one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from text_profiles import read_profile

from analytic.surface.readers.source import ProfileError

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


def write(directory, content):
    path = directory / "trace.txt"
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("content", TWO_COLUMNS.values(), ids=TWO_COLUMNS)
def test_two_columns_in_any_dialect(tmp_path, content):
    read = read_profile(write(tmp_path, content), x_scale=1.0, height_scale=1.0)
    np.testing.assert_array_equal(read.profile.x, X)
    np.testing.assert_array_equal(read.profile.height, HEIGHT)
    assert (read.bridged, read.trimmed) == (0, 0)


@pytest.mark.parametrize("content", ONE_COLUMN.values(), ids=ONE_COLUMN)
def test_one_column_in_any_dialect(tmp_path, content):
    path = write(tmp_path, content)
    read = read_profile(path, x_scale=1.0, height_scale=1.0, spacing=0.25)
    np.testing.assert_array_equal(read.profile.x, [0.0, 0.25, 0.5, 0.75, 1.0])
    np.testing.assert_array_equal(read.profile.height, HEIGHT)


def test_whole_numbers_with_a_comma_are_two_columns(tmp_path):
    path = write(tmp_path, b"1,5\n2,7\n3,7\n4,6\n")
    read = read_profile(path, x_scale=1.0, height_scale=1.0)
    np.testing.assert_array_equal(read.profile.x, [1, 2, 3, 4])
    np.testing.assert_array_equal(read.profile.height, [5, 7, 7, 6])


def test_heights_are_scaled_but_not_moved(tmp_path):
    path = write(tmp_path, b"1 105\n2 107\n3 106\n4 109\n")
    read = read_profile(path, x_scale=1e-6, height_scale=1e-9)
    np.testing.assert_allclose(read.profile.height, [1.05e-7, 1.07e-7, 1.06e-7, 1.09e-7])


def test_a_long_file_reads_the_same_fast_and_row_by_row(tmp_path):
    generator = np.random.default_rng(7)
    x, height = np.arange(20_000) * 0.25, generator.normal(size=20_000)
    plain = "\n".join(f"{a:.2f} {h:.12e}" for a, h in zip(x, height, strict=True))
    fast = read_profile(write(tmp_path, plain.encode()), x_scale=1.0, height_scale=1.0)
    fortran = plain.replace("e", "D").encode()
    careful = read_profile(write(tmp_path, fortran), x_scale=1.0, height_scale=1.0)
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
    path = write(tmp_path_factory.mktemp("profiles"), content)
    read = read_profile(path, x_scale=1.0, height_scale=1.0)
    order = np.argsort(x)
    np.testing.assert_array_equal(read.profile.x, x[order])
    np.testing.assert_array_equal(read.profile.height, rounded(dialect, height)[order])


@settings(max_examples=100, deadline=None, derandomize=True)
@given(dialect=dialects(), height=st.lists(heights, min_size=4, max_size=30))
def test_one_column_survives_a_round_trip(tmp_path_factory, dialect, height):
    dialect = dialect | {"separator": "", "header": "height\n"}
    content = written(dialect, [(h,) for h in height])
    path = write(tmp_path_factory.mktemp("profiles"), content)
    options = {"x_scale": 1.0, "height_scale": 1.0, "spacing": 0.5}
    cells = [format(h, dialect["form"]).partition(".") for h in height]
    every_row_has_a_comma = dialect["decimal"] == "," and all(point for _, point, _ in cells)
    if every_row_has_a_comma and len({whole for whole, _, _ in cells}) == len(height):
        with pytest.raises(ProfileError, match="may stand between x and height or be decimal"):
            read_profile(path, **options)
        return
    read = read_profile(path, **options)
    np.testing.assert_array_equal(read.profile.x, 0.5 * np.arange(len(height)))
    np.testing.assert_array_equal(read.profile.height, rounded(dialect, height))
