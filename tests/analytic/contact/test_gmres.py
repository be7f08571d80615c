"""The inner step of a sliding contact: Krylov's subspace and where it stops."""

import numpy as np
import pytest

from analytic.contact.coupled import krylov_step


@pytest.mark.parametrize("size", [1, 2, 12])
def test_krylov_step_solves_what_it_spans(size):
    rng = np.random.default_rng(size)
    matrix = np.eye(size) + 0.5 * rng.standard_normal((size, size)) / np.sqrt(size)
    target = rng.standard_normal(size)
    found, left = krylov_step(lambda v: matrix @ v, target, 0.0)
    assert left < 1e-12
    assert matrix @ found == pytest.approx(target, abs=1e-12)


def test_krylov_step_stops_at_its_goal():
    applied = []
    matrix = np.diag(np.linspace(1.0, 2.0, 40))
    target = np.ones(40)

    def apply(vector):
        applied.append(vector)
        return matrix @ vector

    found, left = krylov_step(apply, target, 1e-3)
    assert 1e-5 < left <= 1e-3
    assert np.linalg.norm(target - matrix @ found) == pytest.approx(left, rel=1e-6)
    assert len(applied) < 10
    found, left = krylov_step(apply, target, 7.0)
    assert not found.any() and left == np.sqrt(40.0)
