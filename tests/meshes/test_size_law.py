"""The size law: values, growth, caps, its two forms; integrals behind the estimated unknowns."""

import numpy as np
import pytest
from blocks import SPECS

from meshes.block import BlockSpec, MeshError
from meshes.size_law import (
    edges_per_size,
    estimate_unknowns,
    largest_size,
    point_size,
    sum_of_integrals,
    surface_edge,
    uncapped_size,
    wanted_size,
)

INTERVALS = np.array([[-3.0, -1.0], [-0.5, 0.0], [0.0, 0.5], [2.0, 2.25]])
PLAIN = BlockSpec(50.0, 100.0, INTERVALS, 0.25, 0.2)
WINDOWED = BlockSpec(50.0, 100.0, INTERVALS, 0.25, 0.2, (-4.0, 4.0, 2.0, 0.3))
THIN = BlockSpec(50.0, 0.6, INTERVALS, 0.25, 0.2)


def random_points(n, spec, seed=0):
    rng = np.random.default_rng(seed)
    x = rng.choice([1.0, 0.1], n) * rng.uniform(-spec.half_width, spec.half_width, n)
    return x, spec.depth * rng.random(n) ** 3


def test_distance_is_that_to_the_nearest_interval():
    x, z = random_points(400, PLAIN)
    nearest = np.clip(x[:, None], INTERVALS[:, 0], INTERVALS[:, 1])
    distance = np.hypot(nearest - x[:, None], z[:, None]).min(axis=1)
    assert uncapped_size(PLAIN, x, z) == pytest.approx(0.25 + 0.2 * distance, rel=1e-14)


@pytest.mark.parametrize("spec", [PLAIN, WINDOWED, THIN, *SPECS["own vertices"].values()])
def test_both_forms_agree(spec):
    x, z = random_points(500, spec)
    ends = INTERVALS.ravel() if spec.vertices is None else spec.vertices
    x = np.concatenate([x, ends, [-spec.half_width, spec.half_width]])
    z = np.concatenate([z, np.zeros(len(ends) + 2)])
    size = point_size(spec)
    one_by_one = [size(*point) for point in zip(x.tolist(), z.tolist(), strict=True)]
    accuracy = 1e-14 if spec.vertices is None else 1e-12
    assert wanted_size(spec, x, z) == pytest.approx(one_by_one, rel=accuracy)


@pytest.mark.parametrize("spec", [PLAIN, WINDOWED])
def test_grows_no_faster_than_asked_for(spec):
    x, z = random_points(2000, spec, seed=1)
    step = np.random.default_rng(2).normal(scale=0.5, size=(2, len(x)))
    change = np.abs(wanted_size(spec, x + step[0], z + np.abs(step[1])) - wanted_size(spec, x, z))
    assert (change <= spec.growth * np.hypot(*step) + 1e-12).all()
    assert (change > 0.9 * spec.growth * np.hypot(*step)).any()


def test_window_caps_the_size_and_nothing_is_larger_for_it():
    x, z = random_points(4000, WINDOWED, seed=3)
    windowed, plain = wanted_size(WINDOWED, x, z), wanted_size(PLAIN, x, z)
    inside = (np.abs(x) <= 4.0) & (z <= 2.0)
    assert inside.any()
    assert windowed[inside].max() <= 0.3
    assert (windowed <= plain).all()
    assert (windowed[~inside] > 0.3).any()
    assert wanted_size(WINDOWED, 7.0, 6.0) == pytest.approx(0.3 + 0.2 * 5.0)


def test_thin_block_caps_the_size_and_cuts_the_edges_into_whole_parts():
    assert largest_size(THIN) == pytest.approx(0.15)
    assert largest_size(BlockSpec(0.5, 100.0, np.array([[-0.1, 0.1]]), 0.1)) == 0.25  # narrow
    assert edges_per_size(THIN) == 2
    assert surface_edge(THIN) == 0.125
    assert wanted_size(THIN, 40.0, 0.5) == pytest.approx(0.15)
    assert edges_per_size(PLAIN) == 1


def test_an_edge_that_just_fits_is_not_cut():
    for depth in (0.7, 1.1, 3.3):
        assert edges_per_size(BlockSpec(50.0, depth, INTERVALS, depth / 4)) == 1
        assert edges_per_size(BlockSpec(50.0, depth, INTERVALS, depth / 4 * 1.01)) == 2
        assert edges_per_size(BlockSpec(50.0, depth, INTERVALS, depth / 4 * 3)) == 3


def spec(half_width, depth, intervals, size, growth=0.2):
    return BlockSpec(half_width, depth, np.array(intervals), size, growth)


def test_integral_of_a_constant_size_is_exact():
    block = spec(3.0, 2.0, [[-1.0, 1.0]], 0.1, growth=0.0)
    box = [-3.0, 3.0, 0.0, 2.0]
    assert sum_of_integrals(block, [box], [1.0]) == pytest.approx(12.0 / 0.01, rel=1e-12)
    assert sum_of_integrals(block, [[-3.0, 3.0, 0.0, 0.0]], [1.0]) == pytest.approx(60.0, rel=1e-12)


def test_integrals_of_a_linear_size():
    """Along a side, and over the block."""
    block, far = spec(50.0, 1000.0, [[-50.0, 50.0]], 0.1), 0.1 + 0.2 * 100.0  # below it is capped
    side = sum_of_integrals(block, [[50.0, 50.0, 0.0, 100.0]], [1.0])
    assert side == pytest.approx(np.log(far / 0.1) / 0.2, rel=1e-3)
    whole = sum_of_integrals(block, [[-50.0, 50.0, 0.0, 100.0]], [1.0])
    assert whole == pytest.approx(100.0 * (1.0 / 0.1 - 1.0 / far) / 0.2, rel=2e-2)


def test_blocks_too_large_to_build_are_estimated():
    assert estimate_unknowns(spec(0.2, 1.0, [[-0.1, 0.1]], 1e-6)) > 1e6
    assert estimate_unknowns(spec(1000.0, 1e-2, [[-1.0, 1.0]], 0.01)) > 1e7


@pytest.mark.parametrize(
    ("depth", "size", "words"),
    [
        (-1.0, 0.1, "depth"),
        # each halving of the boxes doubles them: it would take all memory
        (1.0, 1e-12, r"elements of 1e-12 m in a body of 1 m are too many"),
    ],
)
def test_what_is_beyond_counting_is_refused(depth, size, words):
    with pytest.raises(MeshError, match=words):
        estimate_unknowns(spec(1.0, depth, [[-0.5, 0.5]], size))
