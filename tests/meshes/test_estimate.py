"""The number of unknowns foretold against the mesh built, and against closed forms."""

import numpy as np
import pytest

from meshes.block import BlockSpec, MeshError
from meshes.build import build_block
from meshes.size_law import estimate_unknowns, integral_of_power


def spec(half_width, depth, intervals, size, growth=0.2, window=None):
    return BlockSpec(half_width, depth, np.array(intervals), size, growth, window)


@pytest.mark.parametrize(
    "block",
    [
        spec(200.0, 400.0, [[-1.5, 1.5]], 0.05),
        spec(200.0, 400.0, [[-1.5, 1.5]], 0.05, growth=0.1),
        spec(200.0, 400.0, [[-1.5, -1.0], [-0.5, 0.5], [0.75, 1.0]], 0.025),
        spec(20.0, 40.0, [[-1.0, 1.0]], 0.1, window=(-1.5, 1.5, 1.0, 0.05)),
        spec(5e5, 1e6, [[0.0, 1.0]], 1.0),
        spec(1.0, 0.05, [[-0.5, 0.5]], 0.05),
        spec(1.0, 8.0, [[0.5, 1.0]], 0.05),
        spec(200.0, 400.0, [[-1.0, 1.0]], 0.05, growth=0.5),
        spec(1.0, 1.0, [[-0.5, 0.5]], 0.1, growth=0.0),
    ],
)
def test_estimate_is_within_a_quarter(block):
    built = build_block(block).quality["unknowns"]
    assert estimate_unknowns(block) == pytest.approx(built, rel=0.25)


def test_integral_of_a_constant_size_is_exact():
    block = spec(3.0, 2.0, [[-1.0, 1.0]], 0.1, growth=0.0)
    box = [-3.0, 3.0, 0.0, 2.0]
    assert integral_of_power(block, box, -2.0) == pytest.approx(12.0 / 0.01, rel=1e-12)
    assert integral_of_power(block, [-3.0, 3.0, 0.0, 0.0], -1.0) == pytest.approx(60.0, rel=1e-12)


def test_integral_of_a_linear_size_along_a_side():
    block = spec(50.0, 1000.0, [[-50.0, 50.0]], 0.1)
    exact = np.log((0.1 + 0.2 * 100.0) / 0.1) / 0.2  # below, the size is capped
    found = integral_of_power(block, [50.0, 50.0, 0.0, 100.0], -1.0)
    assert found == pytest.approx(exact, rel=1e-3)


def test_integral_of_a_linear_size_over_the_block():
    block = spec(50.0, 1000.0, [[-50.0, 50.0]], 0.1)
    exact = 100.0 * (1.0 / 0.1 - 1.0 / (0.1 + 0.2 * 100.0)) / 0.2
    found = integral_of_power(block, [-50.0, 50.0, 0.0, 100.0], -2.0)
    assert found == pytest.approx(exact, rel=2e-2)


def test_what_could_never_be_built_is_still_estimated():
    assert estimate_unknowns(spec(0.2, 1.0, [[-0.1, 0.1]], 1e-6)) > 1e6
    assert estimate_unknowns(spec(1000.0, 1e-2, [[-1.0, 1.0]], 0.01)) > 1e7


def test_impossible_block_is_refused():
    with pytest.raises(MeshError, match="depth"):
        estimate_unknowns(spec(1.0, -1.0, [[-0.5, 0.5]], 0.1))
