"""Finite elements by the method of manufactured solutions, as `crosscheck verify` runs it.

Requirement, reference and tolerances: `comparisons.campaigns.verify.manufactured`.
"""

import numpy as np
import pytest

from comparisons.campaigns.cases import holds
from comparisons.campaigns.verify.manufactured import (
    BODIES,
    BODY,
    Exact,
    errors,
    manufactured_figures,
    skewed,
)
from fem.body import elasticity
from fem.body.elasticity import Support, elastic_body
from fem.body.exact_load import forces_of
from meshes.real_shape import roughen


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("kind", BODIES)
def test_orders(kind, degree):
    figures = manufactured_figures(kind, degree)
    assert len(figures) == 4
    assert [figure for figure in figures if not holds(figure)] == []


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_the_stiffness_quadrature_adds_little_even_on_steep_boundaries(monkeypatch, degree):
    """Slope 0.8, six edges to a wave. In the energy norm, against the error of the elements; a
    quadrature of two degrees less makes it 4, 7 and 23 %."""
    mesh = roughen(skewed(32), lambda x: 0.05 * np.sin(16.0 * x + 0.4))
    exact = Exact(BODY)
    load = forces_of(mesh, exact.stress, exact.body_force, degree)
    body = elastic_body(mesh, BODY, Support(), degree=degree)
    monkeypatch.setattr(elasticity, "quadrature_degree", lambda degree, curved: 12)
    fine = elastic_body(mesh, BODY, Support(), degree=degree)
    moved, better = body.solve(load), fine.solve(load)
    off = (moved - better).ravel()
    added = np.sqrt(off @ fine.stiffness() @ off) / errors(fine, better, exact)[1]
    assert 0.0 < added < 0.02
