"""The compliance operator: symmetric, positive, and the half-plane's up to a datum; its columns
shifted."""

import numpy as np
import pytest
from blocks import graded, structured_block, widened
from scenes import hat_nodes

from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import hat_sign
from fem.body.elasticity import Support, elastic_body
from fem.compliance.condensed import ShiftInvariant
from fem.compliance.operator import FiniteElementCompliance

MATERIAL = Material(2.0, 0.3)
PITCH, COUNT = 0.1, 21
HATS = hat_nodes(-1.0, PITCH, COUNT)


def block(edge):
    middle = np.linspace(-1.5, 1.5, round(3.0 / edge) + 1)
    x = widened(middle, graded(298.5, 1.5 * edge, 1.25))
    return structured_block(x, graded(300.0, edge, 1.25))


@pytest.fixture(scope="module")
def fine():
    body = elastic_body(block(0.05), MATERIAL, Support())
    return FiniteElementCompliance(body, HATS)


def without_datum(matrix):
    """Differences of neighbouring rows and columns: no constant displacement left."""
    return np.diff(np.diff(matrix, axis=0), axis=1)


def test_matrix_is_symmetric_and_positive_definite(fine):
    matrix = fine.matrix()
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-13 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix).min() > 0.0


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_apply_is_the_matrix(fine, friction):
    pressure = np.random.default_rng(5).uniform(size=COUNT)
    moved = fine.matrix(friction) @ pressure
    np.testing.assert_allclose(fine.apply(pressure, friction), moved, rtol=1e-11)


def error_of(matrix, material):
    """Largest error of an entry with the datum removed, relative to the largest entry."""
    half_plane = HalfPlane(COUNT, PITCH, material.plane_strain_modulus)
    exact = without_datum(half_plane.block(np.arange(COUNT)))
    return np.abs(without_datum(matrix) - exact).max() / np.abs(exact).max()


def test_columns_are_the_half_planes_and_the_mesh_error_is_of_order_three():
    """The strain energy of a kinked (hat) pressure converges with the cube of the edge length."""
    bodies = (elastic_body(block(edge), MATERIAL, Support()) for edge in (0.05, 0.025, 0.0125))
    errors = [error_of(FiniteElementCompliance(body, HATS).matrix(), MATERIAL) for body in bodies]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert errors[0] < 1.5e-2
    assert np.all(np.abs(orders - 3.0) < 0.3), orders


def test_pressures_and_tractions_move_each_others_points_alike(fine):
    """Betti's reciprocity; a traction that goes with the pressure is the sliding one, and along
    the surface tractions move it as pressures do across, but for the mesh."""
    pressure, traction = np.random.default_rng(7).uniform(size=(2, COUNT))
    none = np.zeros(COUNT)
    _, dragged = fine.moved(pressure, none)
    raised, along = fine.moved(none, traction)
    assert pressure @ raised == pytest.approx(traction @ dragged, rel=1e-10)
    both = fine.moved(pressure, 0.3 * pressure)
    np.testing.assert_allclose(both[0], fine.apply(pressure, 0.3), rtol=1e-10)
    matrix = np.array([fine.moved(none, unit)[1] for unit in np.eye(COUNT)])
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-13 * np.abs(matrix).max())
    np.testing.assert_allclose(along, matrix @ traction, rtol=1e-10)
    assert error_of(matrix, MATERIAL) < 3e-2


def test_coupling_is_the_half_planes_up_to_the_mesh(fine):
    """(1 - 2 nu)/(2 (1 - nu)) of E' for a rigid counterpart, by the sign of the distance."""
    raised = np.array([fine.moved(np.zeros(COUNT), unit)[0] for unit in np.eye(COUNT)]).T
    beta, modulus = 0.4 / 1.4, MATERIAL.plane_strain_modulus
    distance = np.subtract.outer(np.arange(COUNT), np.arange(COUNT))
    exact = beta * PITCH**2 / modulus * hat_sign(distance)
    assert np.abs(raised - exact).max() < 2e-2 * exact.max()


def test_shifted_columns_are_those_of_any_compliance_that_does_not_depend_on_the_place():
    count, far = 40, np.arange(-39.0, 40.0)
    place = np.arange(count)
    exact = (np.exp(-(far**2) / 50.0) + 0.1 * np.arctan(far))[place[:, None] - place + count - 1]
    shifted = ShiftInvariant(lambda hats: exact[:, hats], count, place[10:30])
    pressure = np.random.default_rng(1).uniform(size=count)
    np.testing.assert_allclose(shifted @ pressure, exact @ pressure, rtol=1e-12)
    block = np.ix_(place[3:9], place[20:])
    np.testing.assert_allclose(shifted[block], exact[block], rtol=1e-12)
