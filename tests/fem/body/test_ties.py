"""A block whose sides move as one, against the waves of a half-plane that repeats."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.periodic import PeriodicHalfPlane
from fem.body.elasticity import elastic_body
from fem.body.support import Support
from fem.compliance.operator import FiniteElementCompliance
from fem.solver.mumps import FemError
from meshes.block import structured

PERIOD, COUNT, STEEL = 1e-3, 32, Material(2e11, 0.3)
TIED = Support("bonded", "tied")
GRID = HatGrid.around(PERIOD, COUNT)


def compliance(edges_a_hat: int) -> FiniteElementCompliance:
    x = np.linspace(-0.5 * PERIOD, 0.5 * PERIOD, edges_a_hat * COUNT + 1)
    z = 1.5 * PERIOD * np.linspace(0.0, 1.0, 12 * edges_a_hat + 1) ** 2
    body = elastic_body(structured(x, z), STEEL, TIED)
    return FiniteElementCompliance(body, GRID.hats)


@pytest.mark.parametrize("wave", [1, 4])
def test_waves_sink_as_on_a_half_plane(wave):
    """The order is at least 2 in the elements, which are too stiff, never too soft."""
    exact = PeriodicHalfPlane(COUNT, GRID.pitch, STEEL.plane_strain_modulus)
    pressure = np.cos(2.0 * np.pi * wave * GRID.x / PERIOD + 0.3)
    work = pressure @ exact.apply(pressure)
    off = [1.0 - pressure @ compliance(edges).apply(pressure) / work for edges in (1, 2)]
    assert 0.0 < off[1] < off[0] < 2e-2
    assert 3.0 < off[0] / off[1] < 20.0


def test_no_place_of_the_period_is_special():
    """The operator is a circulant: the seam of the block does not show."""
    matrix = compliance(1).matrix()
    moved = np.roll(matrix, (5, 5), (0, 1))
    assert np.abs(matrix - moved).max() < 1e-9 * np.abs(matrix).max()
    assert np.abs(matrix - matrix.T).max() < 1e-12 * np.abs(matrix).max()


def test_sides_that_do_not_match_are_refused():
    x, z = np.linspace(-0.5, 0.5, 9), np.linspace(0.0, 1.0, 5)
    mesh = structured(x, z)
    points = mesh.points.copy()
    points[(points[:, 0] == 0.5) & (points[:, 1] == 0.5), 1] += 0.01
    with pytest.raises(FemError, match="sides do not stand at the same depths"):
        elastic_body(replace(mesh, points=points), STEEL, TIED)
