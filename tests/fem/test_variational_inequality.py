"""The monolithic system by PETSc against dense solutions of the same contact problem."""

import numpy as np
import pytest

from analytic.defect import solve_with_model
from analytic.equilibrium import Constraints
from analytic.material import Material
from analytic.operators import HalfPlane
from fem.compliance import FiniteElementCompliance
from fem.elasticity import Support, elastic_body
from fem.surface import hat_forces, hat_nodes
from fem.variational_inequality import solve_variational_inequality

COUNT = 41
PITCH = 2.6 / (COUNT + 1)
X = PITCH * (np.arange(COUNT) - COUNT // 2)
HATS = hat_nodes(X[0], PITCH, COUNT)
WEIGHTS = np.full(COUNT, PITCH)
SMOOTH = 0.5 * PITCH * X**2
ROUGH = SMOOTH + PITCH * (0.05 * np.cos(17 * X) + 0.03 * np.cos(7 * X + 1) + 0.08)


def make(structured_block, graded, modulus=1.0, poisson=0.3, height=None, support=None):
    outer = graded(30.0, 0.05, 1.5)
    x = np.concatenate([-1.5 - outer[:0:-1], np.linspace(-1.5, 1.5, 61), 1.5 + outer[1:]])
    mesh = structured_block(x, graded(30.0, 0.05, 1.5), height)
    return elastic_body(mesh, Material(modulus, poisson), support or Support())


@pytest.fixture(scope="module")
def body(structured_block, graded):
    return make(structured_block, graded)


def forces(body):
    return hat_forces(body.surface, HATS)


def compliance(body):
    return FiniteElementCompliance(body, HATS)


@pytest.fixture(scope="module")
def matrix(body):
    return compliance(body).matrix()


@pytest.mark.parametrize(
    ("gap", "load"),
    [(SMOOTH, 0.6), (ROUGH, 0.6), (ROUGH, 1e-6), (0.002 * SMOOTH, 3.0)],
    ids=["smooth", "rough", "one hat", "everywhere"],
)
def test_pressure_and_approach_are_the_dense_ones(body, matrix, dense, gap, load):
    found = solve_variational_inequality([(body, forces(body))], gap, WEIGHTS, load)
    pressure, approach = dense(matrix, gap, WEIGHTS, load)
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-8 * pressure.max())
    assert found.approach == pytest.approx(approach, rel=1e-8)
    assert found.reason > 0
    assert found.iterations <= 15
    assert WEIGHTS @ found.pressure == pytest.approx(load, rel=1e-10)


def test_both_roads_agree(body):
    """The project's own operator and solver, on the same mesh."""
    model = HalfPlane(COUNT, PITCH, body.material.plane_strain_modulus)
    own = solve_with_model(compliance(body), model, ROUGH, WEIGHTS, Constraints(load=0.3))
    other = solve_variational_inequality([(body, forces(body))], ROUGH, WEIGHTS, 0.3)
    assert own.converged
    error = np.abs(own.pressure - other.pressure).max() / own.pressure.max()
    assert error < 1e-6
    assert own.approach == pytest.approx(other.approach, rel=1e-6)


def test_pressure_is_capped_at_the_hardness(body, matrix):
    """The conditions themselves, on the dense compliance: open, touching or crushed."""
    hardness, load = 0.4, 0.6
    found = solve_variational_inequality([(body, forces(body))], ROUGH, WEIGHTS, load, hardness)
    pressure = found.pressure
    opening = (ROUGH + matrix @ pressure) / PITCH - found.approach
    none, full = pressure < 1e-9, pressure > hardness * (1 - 1e-9)
    assert none.sum() > 5
    assert full.sum() > 5
    assert pressure.min() >= 0.0
    assert pressure.max() <= hardness * (1 + 1e-12)
    scale = np.ptp(matrix @ pressure) / PITCH
    assert opening[none].min() > -1e-9 * scale
    assert opening[full].max() < 1e-9 * scale
    assert np.abs(opening[~none & ~full]).max() < 1e-9 * scale
    assert WEIGHTS @ pressure == pytest.approx(load, rel=1e-10)


@pytest.mark.parametrize("ratio", [1.0, 0.5, 1e-6, 1e6])
def test_an_elastic_roller_is_a_second_body(structured_block, graded, body, matrix, dense, ratio):
    roller = make(structured_block, graded, ratio, 0.2, support=Support("bonded", "fixed"))
    load = 0.6 * min(1.0, ratio)
    both = [(body, forces(body)), (roller, forces(roller))]
    found = solve_variational_inequality(both, ROUGH, WEIGHTS, load)
    pressure, _ = dense(matrix + compliance(roller).matrix(), ROUGH, WEIGHTS, load)
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-8 * pressure.max())


def test_a_rough_body_with_tilted_pressure(structured_block, graded, dense):
    def height(x):
        return 0.02 * np.cos(5 * x) * np.exp(-((x / 2.0) ** 4))

    def direction(x):
        return 0.3 * x, np.ones_like(x)

    body = make(structured_block, graded, height=height)
    tilted = FiniteElementCompliance(body, HATS, direction)
    b = hat_forces(body.surface, HATS, direction)
    found = solve_variational_inequality([(body, b)], SMOOTH, WEIGHTS, 0.6)
    pressure, _ = dense(tilted.matrix(), SMOOTH, WEIGHTS, 0.6)
    np.testing.assert_allclose(found.pressure, pressure, atol=1e-8 * pressure.max())


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_units_of_pressure_do_not_matter(structured_block, graded, body, size):
    unit = solve_variational_inequality([(body, forces(body))], ROUGH, WEIGHTS, 0.3)
    other = make(structured_block, graded, size)
    scaled = solve_variational_inequality([(other, forces(other))], ROUGH, WEIGHTS, 0.3 * size)
    np.testing.assert_allclose(scaled.pressure / size, unit.pressure, atol=1e-12)
    assert scaled.approach == pytest.approx(unit.approach, rel=1e-12)


def test_loads_that_cannot_be_borne_are_refused(body):
    system = [(body, forces(body))]
    with pytest.raises(ValueError, match="must be positive"):
        solve_variational_inequality(system, SMOOTH, WEIGHTS, 0.0)
    with pytest.raises(ValueError, match="exceeds the hardness"):
        solve_variational_inequality(system, SMOOTH, WEIGHTS, 3.0, 1.0)
