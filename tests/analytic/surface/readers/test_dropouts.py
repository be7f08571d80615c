"""Dropouts on the straight line between their neighbours, never beyond the ends."""

import numpy as np
import pytest
from text_profiles import read_profile

from analytic.surface.readers.source import ProfileError


def bridged(directory, content, **options):
    path = directory / "trace.csv"
    path.write_text(content)
    scales = {"x_scale": 1.0, "height_scale": 1.0}
    return read_profile(path, dropouts="bridge", **(scales | options))


def test_gaps_are_bridged_by_place_not_by_count(tmp_path):
    read = bridged(tmp_path, "0,1\n1,NaN\n4,***\n5,6\n6,BAD\n7,2\n8,0\n")
    np.testing.assert_allclose(read.profile.x, [0, 1, 4, 5, 6, 7, 8])
    np.testing.assert_allclose(read.profile.height, [1, 2, 5, 6, 4, 2, 0], rtol=1e-15)
    assert (read.bridged, read.trimmed) == (3, 0)


def test_ends_are_trimmed_and_not_extrapolated(tmp_path):
    read = bridged(tmp_path, "0,\n1,\n2,5\n3,6\n4,inf\n5,8\n6,7\n7,NaN\n")
    np.testing.assert_array_equal(read.profile.x, [2, 3, 4, 5, 6])
    np.testing.assert_array_equal(read.profile.height, [5, 6, 7, 8, 7])
    assert (read.bridged, read.trimmed) == (1, 3)


def test_neighbours_are_those_in_x_whatever_the_order_of_rows(tmp_path):
    read = bridged(tmp_path, "5,6\n1,NaN\n9,NaN\n0,1\n6,5\n7,4\n")
    np.testing.assert_array_equal(read.profile.x, [0, 1, 5, 6, 7])
    np.testing.assert_array_equal(read.profile.height, [1, 2, 6, 5, 4])
    assert (read.bridged, read.trimmed) == (1, 1)


def test_empty_lines_of_a_single_column_are_lost_heights(tmp_path):
    read = bridged(tmp_path, "z\n\n1.5\n2.5\n\n3.5\nbad\n\n2\n\n", spacing=0.5)
    np.testing.assert_array_equal(read.profile.x, 0.5 * np.arange(7))
    np.testing.assert_allclose(read.profile.height, [1.5, 2.5, 3, 3.5, 3, 2.5, 2], rtol=1e-15)
    assert (read.bridged, read.trimmed) == (3, 0)


@pytest.mark.parametrize(
    "rows", ["0;1\n1;2\n;9\nNaN;\n4;8\n5;0\n", "5;0\n4;8\n-;NaN\n;3\n1;2\n0;1\n"]
)
def test_a_lost_x_is_put_between_its_neighbours_in_ordered_rows(tmp_path, rows):
    read = bridged(tmp_path, rows)
    np.testing.assert_allclose(read.profile.x, [0, 1, 2, 3, 4, 5], rtol=1e-15)
    np.testing.assert_allclose(read.profile.height, [1, 2, 4, 6, 8, 0], rtol=1e-15)
    assert read.bridged == 2


def test_a_lost_x_at_an_end_is_trimmed(tmp_path):
    read = bridged(tmp_path, "NaN 7\n0 1\n1 2\n2 1\n3 1\n*** 9\n")
    np.testing.assert_array_equal(read.profile.height, [1, 2, 1, 1])
    assert (read.bridged, read.trimmed) == (0, 2)


@pytest.mark.parametrize(
    ("content", "line", "words"),
    [
        ("0 1\n2 2\n1 2\nNaN 3\n3 3\n4 1\n", 4, "not in order of x"),
        ("0 NaN\n1 1\n2 1\n3 2\n4 BAD\n", None, "3 samples but for"),
        ("0 NaN\n1 NaN\n2 NaN\n3 NaN\n", None, "nothing but dropouts"),
        ("0 1\n1 NaN\n1 2\n2 1\n3 1\n", 3, "the same as in line 2"),
        ("0 1\n1 oops\n2 NaN\n3 1\n4 1\n", 2, "'oops' is not a number"),
    ],
)
def test_what_cannot_be_bridged_is_refused(tmp_path, content, line, words):
    with pytest.raises(ProfileError, match=words) as caught:
        bridged(tmp_path, content)
    assert caught.value.line == line
