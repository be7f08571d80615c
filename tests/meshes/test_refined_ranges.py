"""Refined ranges from predicted patches, and contact outside of them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshes.block import BlockSpec, MeshError
from meshes.boundary import top_nodes
from meshes.refined_ranges import MERGE_EDGES, merge, refined_ranges, unrefined_contact

SIZE = 0.125

contact = st.lists(
    st.tuples(st.floats(-9.0, 9.0), st.floats(0.0, 3.0)).map(lambda p: (p[0], p[0] + p[1])),
    min_size=1,
    max_size=12,
)


def refined(patches, margin=0.0, half_width=10.0):
    return refined_ranges(np.array(patches), SIZE, margin=margin, half_width=half_width)


@pytest.mark.parametrize(
    ("patch", "margin", "interval"),
    [
        ([0.1, 0.9], 0.0, [0.0, 1.0]),
        ([0.125, 0.875], 0.0, [0.125, 0.875]),
        ([0.0, 1.0], 0.25, [-0.25, 1.25]),
        # a single point gets one edge
        ([0.5, 0.5], 0.0, [0.5, 0.625]),
        ([0.55, 0.55], 0.0, [0.5, 0.625]),
    ],
)
def test_ends_move_outwards_to_the_grid_beyond_the_margin(patch, margin, interval):
    assert np.array_equal(refined([patch], margin), [interval])


def test_close_ranges_are_joined_and_distant_ones_are_not():
    for edges in range(1, 8):
        patches = [[1.0 + edges * SIZE, 3.0], [0.0, 1.0]]
        joined = len(refined(patches)) == 1
        assert joined == (edges < MERGE_EDGES)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(patches=contact, margin=st.floats(0.0, 1.0))
def test_result_covers_the_patches_and_can_be_meshed(patches, margin):
    half_width = 9.6
    patches = [p for p in patches if p[0] < half_width]
    intervals = refined(patches, margin, half_width)
    cells = intervals / SIZE
    assert cells == pytest.approx(np.round(cells), abs=1e-6)
    assert (intervals[:, 1] > intervals[:, 0]).all()
    assert (intervals[1:, 0] - intervals[:-1, 1] >= (MERGE_EDGES - 0.01) * SIZE).all()
    reach = half_width - 1.5 * SIZE  # up to one and a half edges stay free at the sides
    for start, end in patches:
        start, end = max(start - margin, -reach), min(end + margin, reach)
        covered = (intervals[:, 0] <= start + 1e-6) & (intervals[:, 1] >= end - 1e-6)
        assert end <= start or covered.any()
    x = top_nodes(BlockSpec(half_width, 20.0, intervals, SIZE))
    assert np.diff(x).min() > 0.4 * SIZE


@pytest.mark.parametrize("rest", [0.0, 0.01, 0.3, 0.5, 0.9])
def test_side_of_a_narrow_body_leaves_no_sliver(rest):
    half_width = (8 + rest) * SIZE
    intervals = refined([[-2.0, -0.5], [0.6, 2.0]], half_width=half_width)
    free = (half_width - np.abs(intervals[[0, 1], [0, 1]])) / SIZE
    assert ((np.abs(free) < 1e-6) | ((free >= 0.5) & (free < 1.5))).all()
    x = top_nodes(BlockSpec(half_width, 20.0, intervals, SIZE))
    assert np.diff(x).min() > 0.45 * SIZE


def test_mirrored_patches_give_mirrored_ranges():
    patches = np.array([[-3.03, -2.1], [0.4, 0.7], [5.01, 9.99]])
    there = refined(patches, 0.1, 9.97)
    back = refined(-patches[:, ::-1], 0.1, 9.97)
    assert there == pytest.approx(-back[::-1, ::-1], abs=1e-12)


def test_other_units_same_ranges():
    patches = np.array([[-3.03, -2.1], [0.4, 0.7]])
    small = refined_ranges(1e-6 * patches, 1e-6 * SIZE, margin=1e-7, half_width=1e-5)
    assert small == pytest.approx(1e-6 * refined(patches, 0.1), rel=1e-12)


def test_patch_beside_the_body_is_refused():
    with pytest.raises(MeshError, match="from 11 to 12 m is not on the body"):
        refined([[0.0, 1.0], [11.0, 12.0]])
    with pytest.raises(MeshError, match="no surface edge"):
        refined([[0.0, 0.01]], half_width=0.05)


def test_merge_covers_nested_and_touching_ranges():
    ranges = [[5.0, 6.0], [0.0, 4.0], [1.0, 2.0], [6.0, 7.0], [3.0, 4.5]]
    assert np.array_equal(merge(ranges), [[0.0, 4.5], [5.0, 7.0]])
    assert np.array_equal(merge(ranges, gap=0.5), [[0.0, 7.0]])


INTERVALS = np.array([[0.0, 1.0], [1.0, 2.0], [5.0, 6.0]])


@pytest.mark.parametrize(
    ("active", "reach", "missed"),
    [
        ([0.0, 0.5, 1.0, 2.0, 6.0], 0.0, []),
        ([0.1, 1.0, 1.9, 5.5], 0.1, []),
        ([], 0.1, []),
        ([0.5, 3.0], 0.0, [[3.0, 3.0]]),
        ([0.05], 0.1, [[-0.05, 0.15]]),
        ([2.0], 0.1, [[1.9, 2.1]]),
        ([7.0, 2.1, 2.25, 7.15], 0.1, [[2.0, 2.35], [6.9, 7.25]]),
    ],
)
def test_contact_outside_the_refined_ranges_is_found(active, reach, missed):
    outside = unrefined_contact(INTERVALS, np.array(active), reach)
    assert outside == pytest.approx(np.array(missed).reshape(-1, 2))


def test_everything_is_missed_when_nothing_was_refined():
    assert np.array_equal(unrefined_contact(np.empty((0, 2)), np.array([1.0]), 0.5), [[0.5, 1.5]])


def test_refining_what_was_missed_settles_it():
    patches = np.array([[0.0, 1.0]])
    active = np.array([0.5, 1.3, 1.4, 3.0])
    first = refined(patches)
    missed = unrefined_contact(first, active, SIZE)
    assert len(missed) > 0
    second = refined(np.concatenate([patches, missed]))
    assert len(unrefined_contact(second, active, SIZE)) == 0
