"""Lines of maps: rows, columns, and straight lines between samples."""

from pathlib import Path

import numpy as np
import pytest
from text_profiles import refused

from analytic.surface.readers.files import profile_of
from analytic.surface.readers.topography import MapLine, Topography, trace_of

ALONG, ACROSS = 2e-6, 3e-6
COLUMNS, ROWS = 41, 31
Y, X = np.meshgrid(ACROSS * np.arange(ROWS), ALONG * np.arange(COLUMNS), indexing="ij")


def of(heights: np.ndarray, pitch=(ALONG, ACROSS), x=None) -> Topography:
    return Topography(Path("map.x3p"), heights, pitch, x, 1.0, "made")


def line(x0, y0, x1, y1) -> MapLine:
    return MapLine(line=((x0, y0), (x1, y1)))


RANDOM = of(np.random.default_rng(3).standard_normal((ROWS, COLUMNS)))


def test_a_row_runs_along_x_and_a_column_along_y():
    x, height = trace_of(RANDOM, MapLine(row=12))
    np.testing.assert_allclose(x, ALONG * np.arange(COLUMNS), rtol=1e-15)
    assert np.array_equal(height, RANDOM.heights[12])
    x, height = trace_of(RANDOM, MapLine(column=0))
    np.testing.assert_allclose(x, ACROSS * np.arange(ROWS), rtol=1e-15)
    assert np.array_equal(height, RANDOM.heights[:, 0])


def test_a_line_along_a_row_is_that_row():
    place = 7 * ACROSS
    x, height = trace_of(RANDOM, line(0.0, place, (COLUMNS - 1) * ALONG, place))
    np.testing.assert_allclose(x, ALONG * np.arange(COLUMNS), rtol=1e-12)
    np.testing.assert_allclose(height, RANDOM.heights[7], rtol=0.0, atol=1e-12)


def test_a_line_the_other_way_is_the_mirrored_trace():
    ends = (1e-5, 7e-6, 6.3e-5, 8.1e-5)
    x, height = trace_of(RANDOM, line(*ends))
    back, reversed_height = trace_of(RANDOM, line(*ends[2:], *ends[:2]))
    np.testing.assert_allclose(back, x, rtol=1e-12)
    np.testing.assert_allclose(reversed_height[::-1], height, rtol=0.0, atol=1e-11)


def test_a_line_is_sampled_evenly_at_about_the_smaller_pitch():
    x, _ = trace_of(RANDOM, line(1e-5, 7e-6, 6.3e-5, 8.1e-5))
    assert x[0] == 0.0
    assert x[-1] == pytest.approx(np.hypot(5.3e-5, 7.4e-5), rel=1e-14)
    steps = np.diff(x)
    assert np.ptp(steps) < 1e-12 * steps[0]
    assert steps[0] == pytest.approx(ALONG, rel=0.02)


def test_cubics_pass_exactly_up_to_the_edges():
    u, v = X / 8e-5 - 0.4, Y / 9e-5 - 0.3
    surface = of(1.0 + u - 2.0 * v**2 + 3.0 * u**3 * v**3 - u**2 * v)
    x, height = trace_of(surface, line(8e-5, 0.0, 0.0, 9e-5))
    share = x / x[-1]
    u, v = (1.0 - share) - 0.4, share - 0.3
    wanted = 1.0 + u - 2.0 * v**2 + 3.0 * u**3 * v**3 - u**2 * v
    np.testing.assert_allclose(height, wanted, rtol=0.0, atol=1e-12)


def test_interpolation_is_of_fourth_order():
    errors = []
    for refined in (1, 2, 4, 8):
        count = 20 * refined + 1
        pitch = 1.0 / (count - 1)
        v, u = np.meshgrid(pitch * np.arange(count), pitch * np.arange(count), indexing="ij")
        surface = of(np.sin(6.0 * u + 2.0) * np.cos(5.0 * v), pitch=(pitch, pitch))
        x, height = trace_of(surface, line(0.02, 0.07, 0.93, 0.71))
        u, v = 0.02 + 0.91 * x / x[-1], 0.07 + 0.64 * x / x[-1]
        errors.append(np.max(np.abs(height - np.sin(6.0 * u + 2.0) * np.cos(5.0 * v))))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(orders - 4.0) < 0.4), orders


def test_heights_that_were_not_measured_reach_no_further_than_the_cubics():
    heights = np.zeros((ROWS, COLUMNS))
    heights[10, 20] = np.nan
    _, height = trace_of(of(heights), line(0.0, 11.5 * ACROSS, 40 * ALONG, 11.5 * ACROSS))
    lost = np.flatnonzero(np.isnan(height))
    assert lost.tolist() == [20]  # on a column the other columns do not count
    between = line(0.5 * ALONG, 11.5 * ACROSS, 39.5 * ALONG, 11.5 * ACROSS)
    _, height = trace_of(of(heights), between)
    assert np.flatnonzero(np.isnan(height)).tolist() == [18, 19, 20, 21]
    assert np.all(height[~np.isnan(height)] == 0.0)
    _, height = trace_of(of(heights), line(0.0, 13.5 * ACROSS, 40 * ALONG, 13.5 * ACROSS))
    assert not np.any(np.isnan(height))


def test_line_scans_need_no_choice():
    x, height = trace_of(of(np.arange(6.0)), None)
    np.testing.assert_allclose(x, ALONG * np.arange(6))
    uneven = np.array([0.0, 1.0, 4.0, 5.0])
    x, height = trace_of(of(np.arange(4.0), pitch=None, x=uneven), None)
    assert np.array_equal(x, uneven)
    assert np.array_equal(height, np.arange(4.0))


SIZE = "31 rows and 41 columns, 8e-05 m by 9e-05 m"


@pytest.mark.parametrize(
    ("topography", "chosen", "words"),
    [
        (RANDOM, None, f"is a map of {SIZE}, and a profile is one line of it; allowed is row, col"),
        (RANDOM, MapLine(row=31), f"has no row 31 (a map of {SIZE}); allowed is from 0 to 30"),
        (RANDOM, MapLine(column=-1), "has no column -1"),
        (RANDOM, line(0, 0, 9e-5, 1e-5), f"line leaves the map ({SIZE}); allowed are x and y in"),
        (RANDOM, line(1e-5, 1e-5, 1e-5, 1e-5), "line starts and ends at the same point"),
        (of(np.zeros((3, 9))), line(0, 0, 1e-6, 1e-6), "is a map of 3 rows and 9 columns"),
        (of(np.zeros(9)), MapLine(row=0), "is a line scan, which has no rows; allowed is to leave"),
        (of(np.zeros(9)), line(0, 0, 1, 1), "is a line scan, which has no lines"),
    ],
)
def test_choices_that_make_no_sense(topography, chosen, words):
    message = str(refused(topography, profile_of, chosen=chosen))
    assert message.startswith(f"map.x3p: {words}")
