"""The integrals behind the estimated number of unknowns, against closed forms."""

import numpy as np
import pytest

from meshes.block import BlockSpec, MeshError
from meshes.size_law import estimate_unknowns, sum_of_integrals


def spec(half_width, depth, intervals, size, growth=0.2, window=None):
    return BlockSpec(half_width, depth, np.array(intervals), size, growth, window)


def test_integral_of_a_constant_size_is_exact():
    block = spec(3.0, 2.0, [[-1.0, 1.0]], 0.1, growth=0.0)
    box = [-3.0, 3.0, 0.0, 2.0]
    assert sum_of_integrals(block, [box], [1.0]) == pytest.approx(12.0 / 0.01, rel=1e-12)
    assert sum_of_integrals(block, [[-3.0, 3.0, 0.0, 0.0]], [1.0]) == pytest.approx(60.0, rel=1e-12)


def test_integral_of_a_linear_size_along_a_side():
    block = spec(50.0, 1000.0, [[-50.0, 50.0]], 0.1)
    exact = np.log((0.1 + 0.2 * 100.0) / 0.1) / 0.2  # below, the size is capped
    found = sum_of_integrals(block, [[50.0, 50.0, 0.0, 100.0]], [1.0])
    assert found == pytest.approx(exact, rel=1e-3)


def test_integral_of_a_linear_size_over_the_block():
    block = spec(50.0, 1000.0, [[-50.0, 50.0]], 0.1)
    exact = 100.0 * (1.0 / 0.1 - 1.0 / (0.1 + 0.2 * 100.0)) / 0.2
    found = sum_of_integrals(block, [[-50.0, 50.0, 0.0, 100.0]], [1.0])
    assert found == pytest.approx(exact, rel=2e-2)


def test_blocks_too_large_to_build_are_estimated():
    assert estimate_unknowns(spec(0.2, 1.0, [[-0.1, 0.1]], 1e-6)) > 1e6
    assert estimate_unknowns(spec(1000.0, 1e-2, [[-1.0, 1.0]], 0.01)) > 1e7


def test_impossible_block_is_refused():
    with pytest.raises(MeshError, match="depth"):
        estimate_unknowns(spec(1.0, -1.0, [[-0.5, 0.5]], 0.1))


def test_what_is_beyond_counting_is_refused():
    """Each halving of the boxes doubles them: it would take all memory."""
    with pytest.raises(MeshError, match=r"elements of 1e-12 m in a body of 1 m are too many"):
        estimate_unknowns(spec(1.0, 1.0, [[-0.5, 0.5]], 1e-12))
