"""Files that are no profile: one clear line with the file, the line and what is allowed."""

import os
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from text_profiles import read_profile

from analytic.surface.readers import columns
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
    with pytest.raises(ProfileError) as caught:
        read_profile(path, **({"x_scale": 1e-6, "height_scale": 1e-6} | options))
    message = str(caught.value)
    assert message.startswith(str(path)) and "\n" not in message
    named = re.match(r", line (\d+): ", message.removeprefix(str(path)))
    assert (int(named[1]) if named else None) == caught.value.line
    return message, caught.value.line


def check(path, case, **options):
    content, line, words = case
    path.write_bytes(content)
    message, place = refusal(path, **options)
    assert place == line
    assert words in message


@pytest.mark.parametrize("case", BAD.values(), ids=BAD)
def test_bad_files_are_refused_at_their_line(tmp_path, case):
    check(tmp_path / "trace.csv", case)


@pytest.mark.parametrize("case", BAD_ALONE.values(), ids=BAD_ALONE)
def test_bad_files_of_heights_alone_are_refused_at_their_line(tmp_path, case):
    check(tmp_path / "trace.csv", case, spacing=1e-6)


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_line_numbers_count_the_lines_of_other_systems(tmp_path, end):
    content = end.join(["# c", "", "x z", "0 1", "1 2", "2 oops", "3 4", "4 5"]).encode()
    check(tmp_path / "trace.csv", (content, 6, "'oops' is not a number"))


def test_line_number_far_down_a_long_file(tmp_path):
    rows = [f"{i};{i % 7},5" for i in range(100_000)]
    rows[54_321] = "54321;1,5x"
    content = "\n".join(rows).encode()
    check(tmp_path / "trace.csv", (content, 54_322, "'1,5x' is not a number"))


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
    path = tmp_path_factory.mktemp("profiles") / "trace.txt"
    path.write_text(text, newline="")
    try:
        options = {"dropouts": dropouts, "spacing": spacing}
        read = read_profile(path, x_scale=1.0, height_scale=1.0, **options)
    except ProfileError as error:
        assert str(error).startswith(str(path)) and "\n" not in str(error)
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
    path = tmp_path / "trace.csv"
    path.write_bytes(GOOD)
    with pytest.raises(ValueError, match=words):
        read_profile(path, **({"x_scale": 1e-6, "height_scale": 1e-6} | options))
