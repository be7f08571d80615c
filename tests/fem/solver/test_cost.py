"""The estimate of a factorisation against what MUMPS says that it holds."""

import numpy as np
import pytest

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.solver.cost import estimate


def test_memory_of_a_uniform_mesh_is_estimated_within_a_third(structured_block):
    line = np.linspace(-1, 1, 121)
    body = elastic_body(structured_block(line, line[60:] - line[60]), Material(1.0, 0.3), Support())
    _, expected = estimate(body.unknowns)
    assert body.factor.bytes == pytest.approx(expected, rel=0.33)


def test_cost_grows_a_little_faster_than_the_unknowns():
    for few in (1e3, 1e5, 1e6):
        (less, smaller), (more, larger) = estimate(int(few)), estimate(int(2 * few))
        assert 2.0 * less < more < 2.0**1.5 * less
        assert 2.0 * smaller <= larger < 2.3 * smaller


def test_a_million_unknowns_take_half_a_minute_and_more_than_a_gigabyte():
    seconds, held = estimate(1_000_000)
    assert 10.0 < seconds < 60.0
    assert 1e9 < held < 2e9
