"""Newton's method with an active set: linear bodies against dense solutions, nonlinear ones."""

import numpy as np
import pytest

from analytic.material import Material
from fem.compliance import FiniteElementCompliance
from fem.contact_newton import RESIDUAL
from fem.contact_terms import LinearContact, LinearResponse
from fem.elasticity import Support, elastic_body
from fem.mumps import FemError
from fem.nonlinear_contact import solve_nonlinear_contact, state_at_rest
from fem.surface import hat_nodes

COUNT = 21
PITCH = 2.6 / (COUNT + 1)
X = PITCH * (np.arange(COUNT) - COUNT // 2)
WEIGHTS = np.full(COUNT, PITCH)
SMOOTH = 0.5 * PITCH * X**2
ROUGH = SMOOTH + PITCH * (0.05 * np.cos(17 * X) + 0.03 * np.cos(7 * X + 1) + 0.08)


def make(structured_block, graded, modulus=1.0, poisson=0.3, support=None):
    outer = graded(10.0, 0.1, 1.6)
    x = np.concatenate([-1.5 - outer[:0:-1], np.linspace(-1.5, 1.5, 31), 1.5 + outer[1:]])
    mesh = structured_block(x, graded(10.0, 0.1, 1.6))
    return elastic_body(mesh, Material(modulus, poisson), support or Support())


def compliance(body):
    return FiniteElementCompliance(body, hat_nodes(X[0], PITCH, COUNT))


def contact(body, friction=0.0):
    forces = compliance(body)
    return LinearContact(len(body.nodes), body.surface, forces.normal, friction, forces.tangential)


def solve(bodies, gap, start=None, **wanted):
    start = state_at_rest(bodies, np.ones(COUNT)) if start is None else start
    return solve_nonlinear_contact(bodies, gap, WEIGHTS, start, **wanted)


@pytest.fixture(scope="module")
def body(structured_block, graded):
    return make(structured_block, graded)


@pytest.fixture(scope="module")
def matrix(body):
    return compliance(body).matrix()


@pytest.mark.parametrize(
    ("gap", "load"),
    [(SMOOTH, 0.6), (ROUGH, 0.6), (ROUGH, 1e-6), (0.002 * SMOOTH, 3.0)],
    ids=["smooth", "rough", "one hat", "everywhere"],
)
def test_linear_bodies_have_the_dense_solution(body, matrix, dense, gap, load):
    bodies = [(LinearResponse(body), contact(body))]
    found = solve(bodies, gap, load=load)
    pressure, approach = dense(matrix, gap, WEIGHTS, load)
    np.testing.assert_allclose(found.state.pressure, pressure, atol=1e-9 * pressure.max())
    assert found.state.approach == pytest.approx(approach, rel=1e-9)
    assert found.state.load == load
    opening = (gap + matrix @ pressure) / PITCH - approach
    np.testing.assert_allclose(found.gap, opening, atol=1e-9 * np.ptp(matrix @ pressure) / PITCH)
    assert found.iterations <= 15
    assert found.cuts == 0
    # the approach leads to the same
    again = solve(bodies, gap, approach=found.state.approach)
    np.testing.assert_allclose(again.state.pressure, pressure, atol=1e-9 * pressure.max())
    assert again.state.load == pytest.approx(load, rel=1e-8)


def test_increments_lead_to_the_same(body):
    bodies = [(LinearResponse(body), contact(body))]
    once = solve(bodies, ROUGH, load=0.6)
    often = solve(bodies, ROUGH, load=0.6, increments=4)
    np.testing.assert_allclose(often.state.pressure, once.state.pressure, atol=1e-9)
    assert often.parts == pytest.approx((0.25, 0.5, 0.75, 1.0))
    on = solve(bodies, ROUGH, start=once.state, load=0.3)
    back = solve(bodies, ROUGH, load=0.3)
    np.testing.assert_allclose(on.state.pressure, back.state.pressure, atol=1e-9)


def test_pressure_is_capped_at_the_hardness(body, matrix):
    """The conditions themselves, on the dense compliance: open, touching or crushed."""
    hardness, load = 0.4, 0.6
    found = solve([(LinearResponse(body), contact(body))], ROUGH, load=load, hardness=hardness)
    pressure = found.state.pressure
    opening = (ROUGH + matrix @ pressure) / PITCH - found.state.approach
    none, full = pressure == 0.0, pressure == hardness
    assert none.sum() > 5
    assert full.sum() > 5
    scale = np.ptp(matrix @ pressure) / PITCH
    assert opening[none].min() > -1e-8 * scale
    assert opening[full].max() < 1e-8 * scale
    assert np.abs(opening[~none & ~full]).max() < 1e-8 * scale
    assert WEIGHTS @ pressure == pytest.approx(load, rel=1e-9)


@pytest.mark.parametrize("ratio", [1.0, 1e-6, 1e6])
def test_an_elastic_roller_is_a_second_body(structured_block, graded, body, matrix, dense, ratio):
    roller = make(structured_block, graded, ratio, 0.2, Support("bonded", "fixed"))
    load = 0.6 * min(1.0, ratio)
    bodies = [(LinearResponse(b), contact(b)) for b in (body, roller)]
    found = solve(bodies, ROUGH, load=load)
    pressure, _ = dense(matrix + compliance(roller).matrix(), ROUGH, WEIGHTS, load)
    np.testing.assert_allclose(found.state.pressure, pressure, atol=1e-8 * pressure.max())


def test_friction_is_coupled(body, dense):
    """Unsymmetric: the sliding traction moves the surface that the pressure has to follow."""
    forces, friction = compliance(body), 0.3
    columns = [forces.apply(unit, friction) for unit in np.eye(COUNT)]
    found = solve([(LinearResponse(body), contact(body, friction))], SMOOTH, load=0.6)
    assert found.iterations <= 10
    pressure, _ = dense(np.array(columns).T, SMOOTH, WEIGHTS, 0.6)
    np.testing.assert_allclose(found.state.pressure, pressure, atol=1e-9 * pressure.max())
    without, _ = dense(forces.matrix(), SMOOTH, WEIGHTS, 0.6)
    assert np.abs(pressure - without).max() > 1e-2 * pressure.max()
    with pytest.raises(ValueError, match="sliding traction"):
        LinearContact(len(body.nodes), body.surface, forces.normal, friction)


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_units_do_not_matter(structured_block, graded, body, size):
    unit = solve([(LinearResponse(body), contact(body))], ROUGH, load=0.3)
    other = make(structured_block, graded, size)
    scaled = solve([(LinearResponse(other), contact(other))], ROUGH, load=0.3 * size)
    np.testing.assert_allclose(scaled.state.pressure / size, unit.state.pressure, atol=1e-12)


class Stiffening:
    """K u (1 + s |u|^2): a smooth nonlinear body whose tangent is known, as a stand-in."""

    symmetric = True

    def __init__(self, body, stiffening, limit=np.inf):
        self.held, self.limit = body.held, limit
        self.matrix, self.by = body.stiffness(), stiffening
        self.accepted = []

    def linearised(self, displacement):
        """Componentwise strengthening of springs to the ground beside the linear body."""
        from scipy.sparse import diags

        u = displacement.ravel()
        if np.abs(u).max() > self.limit:
            raise FemError("too far")
        force = self.matrix @ u + self.by * u**3
        return force.reshape(-1, 2), self.matrix + diags(3.0 * self.by * u**2)

    def accept(self, displacement):
        self.accepted.append(displacement)


def test_newton_converges_quadratically(body):
    """From one load to the next with every hat touching before and after."""
    bodies, gap = [(Stiffening(body, 0.02), contact(body))], 0.002 * SMOOTH
    start = solve(bodies, gap, load=0.6).state
    found = solve(bodies, gap, start=start, load=1.2)
    history = np.array(found.residuals[-1])
    assert history[-1] <= RESIDUAL
    late = np.log(history[(history > 1e-11) & (history < 0.1)])  # below is round-off
    orders = np.diff(late[1:]) / np.diff(late[:-1])
    assert len(orders) >= 2
    assert np.all((orders > 1.7) & (orders < 2.3)), history


def test_a_body_that_cannot_follow_a_whole_step_is_led_there(body):
    """Increments are halved, each is accepted once, and the end is where it is without limit."""
    free = solve([(Stiffening(body, 0.02), contact(body))], SMOOTH, load=0.6)
    reach = np.abs(free.state.displacements[0]).max()
    limited = Stiffening(body, 0.02, 1.02 * reach)
    found = solve([(limited, contact(body))], SMOOTH, load=0.6)
    np.testing.assert_allclose(found.state.pressure, free.state.pressure, atol=1e-7)
    assert len(limited.accepted) == len(found.parts)
    np.testing.assert_array_equal(limited.accepted[-1], found.state.displacements[0])
    assert found.parts[-1] == 1.0


def test_what_does_not_converge_is_an_error(body):
    stuck = Stiffening(body, 0.02, 1e-6)
    with pytest.raises(FemError, match=r"did not converge beyond 0 % of the load: .*too far"):
        solve([(stuck, contact(body))], SMOOTH, load=0.6)
    assert stuck.accepted == []


def test_loads_that_cannot_be_borne_are_refused(body):
    bodies = [(LinearResponse(body), contact(body))]
    for wanted in ({"load": 0.0}, {"load": 3.0, "hardness": 1.0}, {}, {"load": 1, "approach": 1}):
        with pytest.raises(ValueError):
            solve(bodies, SMOOTH, **wanted)
