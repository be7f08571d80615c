"""Dropouts on the straight line between their neighbours, never beyond the ends; a missing stretch
of x is one, and rounded or uneven steps are not."""

import numpy as np
import pytest
from text_profiles import read_measured, read_profile

from analytic.surface.readers.dropouts import gaps
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


X = 0.5 * np.arange(400)  # um
Z = np.sin(X / 7.0)
KEPT = (X < 60.0) | (X > 90.0)


def written(folder, x, z, form="%.6g"):
    path = folder / "trace.csv"
    np.savetxt(path, np.column_stack([x, z]), fmt=form, delimiter=",")
    return path


def read(path, dropouts):
    return read_measured(path, x_scale=1e-6, height_scale=1e-6, dropouts=dropouts)


def test_a_gap_is_refused_where_it_is(tmp_path):
    path = written(tmp_path, X[KEPT], Z[KEPT])
    with pytest.raises(ProfileError, match=r"gap from 5.95e-05 m to 9.05e-05 m \(61 samples lost"):
        read(path, "refuse")
    kept = KEPT & ((X < 20.0) | (X > 21.5))
    with pytest.raises(ProfileError, match=r"and at 1 more places \(65 samples lost\)"):
        read(written(tmp_path, X[kept], Z[kept]), "refuse")


def test_a_gap_is_bridged_by_a_straight_line(tmp_path):
    trace = read(written(tmp_path, X[KEPT], Z[KEPT]), "bridge")
    np.testing.assert_allclose(trace.profile.x, 1e-6 * X, atol=1e-15)
    np.testing.assert_allclose(trace.profile.height[KEPT], 1e-6 * Z[KEPT], atol=1e-11)
    between = 1e-6 * np.interp(X[~KEPT], X[KEPT], Z[KEPT])
    np.testing.assert_allclose(trace.profile.height[~KEPT], between, atol=1e-11)
    assert (trace.bridged, trace.trimmed) == (61, 0)
    assert trace.stretch == pytest.approx((59.5e-6, 90.5e-6))


def test_a_gap_beyond_all_bounds_is_not_filled(tmp_path):
    x = np.append(X[:-1], 1e7)
    with pytest.raises(ProfileError, match=r"x has a gap of 199996.. samples; at most 2000000"):
        read(written(tmp_path, x, Z), "bridge")


def test_an_uneven_scan_of_an_instrument_has_gaps_too(tmp_path, monkeypatch):
    from analytic.surface.readers import files
    from analytic.surface.readers.topography import Topography

    scan = Topography(tmp_path, 1e-6 * Z[KEPT], None, 1e-6 * X[KEPT], 1.0, "made")
    monkeypatch.setattr(files, "read_instrument_file", lambda path, channel: scan)
    path = tmp_path / "trace.dat"
    path.write_bytes(b"\x00\x01")
    with pytest.raises(ProfileError, match=r"x has a gap from 5.95e-05 m to 9.05e-05 m"):
        read_measured(path)
    assert read_measured(path, dropouts="bridge").bridged == 61


RNG = np.random.default_rng(5)
WHOLE = {
    "even": X,
    "rounded to its own step": np.round(0.156 * np.arange(2000), 1),
    "rounded, rarely a longer step": np.round(0.101 * np.arange(2000), 1),
    "random steps": np.cumsum(RNG.uniform(0.2, 1.0, 500)),
    "steps of exponential length": np.cumsum(0.01 + RNG.exponential(1.0, 500)),
    "coarse, then fine": np.concatenate([np.arange(50.0), 50.0 + 0.1 * np.arange(200)]),
    "one sample lost": np.delete(X, 100),
    "few samples": np.array([0.0, 1.0, 2.0, 50.0, 51.0]),
}


@pytest.mark.parametrize("x", WHOLE.values(), ids=WHOLE)
def test_other_steps_are_no_gaps(x):
    assert gaps(x) == []
