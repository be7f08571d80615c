"""Linear bodies by Newton's method and by PETSc's variational inequality: dense solutions, and
the project's own solver; Newton's method with an active set on bodies that are not linear.
Systems of Newton steps by the factor of a former one: as by their own."""

import numpy as np
import pytest
from blocks import structured_block
from nodal_stress import displacement_under
from pressed_bodies import dense_contact

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import Support, elastic_body
from fem.body.surface import hat_forces
from fem.compliance.operator import FiniteElementCompliance
from fem.contact import system as module
from fem.contact.nonlinear import RESIDUAL, solve_nonlinear_contact, state_at_rest
from fem.contact.system import ContactSystem, ReusedFactor
from fem.contact.terms import LinearContact
from fem.contact.variational_inequality import VariationalSolution, solve_variational_inequality
from fem.solver.mumps import FemError, solve_once


def by_newton(grid, bodies, gap, load, hardness=np.inf):
    pairs = [grid.linear(body) for body in bodies]
    start = state_at_rest(pairs, np.ones(grid.count))
    solution = solve_nonlinear_contact(pairs, gap, grid.weights, start, load, hardness=hardness)
    return VariationalSolution(
        solution.state.pressure, solution.state.approach, solution.iterations
    )


def by_inequality(grid, bodies, gap, load, hardness=np.inf):
    pairs = [(body, hat_forces(body.surface, grid.hats)) for body in bodies]
    return solve_variational_inequality(pairs, gap, grid.weights, load, hardness)


@pytest.fixture(params=[by_newton, by_inequality])
def solve(request, grid):
    return lambda *problem: request.param(grid, *problem)


def test_pressure_and_approach_are_the_dense_ones(grid, block, block_matrix, gap_and_load, solve):
    gap, load = gap_and_load
    contact = solve([block], gap, load)
    pressure, approach = dense_contact(block_matrix, gap, grid.weights, load)
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-9 * pressure.max())
    assert contact.approach == pytest.approx(approach, rel=1e-9)
    assert contact.iterations <= 15
    assert grid.weights @ contact.pressure == pytest.approx(load, rel=1e-10)


def test_pressure_is_capped_at_the_hardness(grid, block, block_matrix, solve):
    """The conditions themselves, on the dense compliance: open, in contact or at the hardness."""
    hardness, load = 0.4, 0.6
    contact = solve([block], grid.rough, load, hardness)
    pressure = contact.pressure
    opening = (grid.rough + block_matrix @ pressure) / grid.pitch - contact.approach
    none, full = pressure < 1e-9, pressure > hardness * (1 - 1e-9)
    assert none.sum() > 5
    assert full.sum() > 5
    assert pressure.min() >= 0.0
    assert pressure.max() <= hardness * (1 + 1e-12)
    scale = np.ptp(block_matrix @ pressure) / grid.pitch
    assert opening[none].min() > -1e-9 * scale
    assert opening[full].max() < 1e-9 * scale
    assert np.abs(opening[~none & ~full]).max() < 1e-9 * scale
    assert grid.weights @ pressure == pytest.approx(load, rel=1e-10)


@pytest.mark.parametrize("ratio", [1.0, 0.5, 1e-6, 1e6])
def test_an_elastic_roller_is_a_second_body(grid, block, block_matrix, ratio, solve):
    roller = grid.body(ratio, 0.2, support=Support("bonded", "fixed"))
    load = 0.6 * min(1.0, ratio)
    contact = solve([block, roller], grid.rough, load)
    pressure, _ = dense_contact(
        block_matrix + grid.compliance(roller).matrix(), grid.rough, grid.weights, load
    )
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-8 * pressure.max())


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_units_of_pressure_do_not_matter(grid, block, size, solve):
    unit = solve([block], grid.rough, 0.3)
    scaled = solve([grid.body(size)], grid.rough, 0.3 * size)
    np.testing.assert_allclose(scaled.pressure / size, unit.pressure, atol=1e-12)
    assert scaled.approach == pytest.approx(unit.approach, rel=1e-12)


def test_both_solvers_agree(grid, block, solve):
    """The project's own operator and solver, on the same mesh."""
    model = HalfPlane(grid.count, grid.pitch, block.material.plane_strain_modulus)
    ours = solve_with_model(
        grid.compliance(block), model, grid.rough, grid.weights, Constraints(load=0.3)
    )
    other = solve([block], grid.rough, 0.3)
    assert ours.converged
    np.testing.assert_allclose(other.pressure, ours.pressure, atol=1e-6 * ours.pressure.max())
    assert ours.approach == pytest.approx(other.approach, rel=1e-6)


def test_a_rough_body_with_tilted_pressure(grid):
    def height(x):
        return 0.02 * np.cos(5 * x) * np.exp(-((x / 2.0) ** 4))

    def direction(x):
        return 0.3 * x, np.ones_like(x)

    body = grid.body(height=height)
    b = hat_forces(body.surface, grid.hats, direction)
    contact = solve_variational_inequality([(body, b)], grid.smooth, grid.weights, 0.6)
    units = np.eye(grid.count)
    moved = [displacement_under(body, grid.hats, unit, 0.0, direction) for unit in units]
    matrix = np.array([u[body.surface.point].ravel() @ b for u in moved])
    pressure, _ = dense_contact(matrix, grid.smooth, grid.weights, 0.6)
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-8 * pressure.max())


def test_what_hats_do_to_held_components_is_nothing(grid, solve):
    """The outer hats reach over points that the support holds."""
    body = grid.body(support=Support(within=(1.25, np.inf)))
    assert body.held[body.surface.point[np.abs(body.surface.x) < 1.3]].any()
    contact = solve([body], 0.002 * grid.smooth, 3.0)
    pressure, _ = dense_contact(
        grid.compliance(body).matrix(), 0.002 * grid.smooth, grid.weights, 3.0
    )
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-8 * pressure.max())


def test_loads_that_cannot_be_borne_are_refused(grid, block, solve):
    with pytest.raises(ValueError, match=r"must be positive|not between zero"):
        solve([block], grid.smooth, 0.0)
    with pytest.raises(ValueError, match=r"exceeds the hardness|not between zero"):
        solve([block], grid.smooth, 3.0, 1.0)


@pytest.fixture(scope="module")
def newton(grid):
    def solved(bodies, gap, start=None, **wanted):
        start = state_at_rest(bodies, np.ones(grid.count)) if start is None else start
        return solve_nonlinear_contact(bodies, gap, grid.weights, start, **wanted)

    return solved


def test_gaps_are_the_dense_ones_and_the_approach_leads_to_the_same(
    grid, block, block_matrix, gap_and_load, newton
):
    gap, load = gap_and_load
    bodies = [grid.linear(block)]
    solution = newton(bodies, gap, load=load)
    pressure, approach = dense_contact(block_matrix, gap, grid.weights, load)
    assert solution.state.load == load
    opening = (gap + block_matrix @ pressure) / grid.pitch - approach
    scale = np.ptp(block_matrix @ pressure) / grid.pitch
    np.testing.assert_allclose(solution.gap, opening, atol=1e-9 * scale)
    assert len(solution.residuals) == 1
    again = newton(bodies, gap, approach=solution.state.approach)
    np.testing.assert_allclose(again.state.pressure, pressure, atol=1e-9 * pressure.max())
    assert again.state.load == pytest.approx(load, rel=1e-8)


def test_the_way_to_a_load_does_not_matter(grid, block, newton):
    bodies = [grid.linear(block)]
    once = newton(bodies, grid.rough, load=0.6)
    on = newton(bodies, grid.rough, start=once.state, load=0.3)
    back = newton(bodies, grid.rough, load=0.3)
    np.testing.assert_allclose(on.state.pressure, back.state.pressure, atol=1e-9)


def test_friction_is_coupled(grid, block, newton):
    """Unsymmetric: the sliding traction moves the surface that the pressure has to follow."""
    forces, friction = grid.compliance(block), 0.3
    columns = [forces.apply(unit, friction) for unit in np.eye(grid.count)]
    sliding = newton([grid.linear(block, friction)], grid.smooth, load=0.6)
    assert sliding.iterations <= 10
    pressure, _ = dense_contact(np.array(columns).T, grid.smooth, grid.weights, 0.6)
    np.testing.assert_allclose(sliding.state.pressure, pressure, atol=1e-9 * pressure.max())
    without, _ = dense_contact(forces.matrix(), grid.smooth, grid.weights, 0.6)
    assert np.abs(pressure - without).max() > 1e-2 * pressure.max()


class Stiffening:
    """K u (1 + s |u|^2): a smooth nonlinear body whose tangent is known, as a stand-in."""

    symmetric, softness = True, np.ones(1)

    def __init__(self, body, stiffening, limit=np.inf):
        self.held, self.limit = body.held, limit
        self.matrix, self.by = body.stiffness(), stiffening
        self.accepted = []

    def linearised(self, displacement):
        """Componentwise stiffening of springs beside the linear body."""
        from scipy.sparse import diags

        u = displacement.ravel()
        if np.abs(u).max() > self.limit:
            raise FemError("too far")
        force = self.matrix @ u + self.by * u**3
        return force.reshape(-1, 2), self.matrix + diags(3.0 * self.by * u**2)

    def accept(self, displacement):
        self.accepted.append(displacement)


def stiffening(grid, block, limit=np.inf):
    return Stiffening(block, 0.02, limit), grid.linear(block)[1]


def test_newton_converges_quadratically(grid, block, newton):
    """From one load to the next with every hat touching before and after."""
    bodies, gap = [stiffening(grid, block)], 0.002 * grid.smooth
    start = newton(bodies, gap, load=0.6).state
    solution = newton(bodies, gap, start=start, load=1.2)
    history = np.array(solution.residuals[-1])
    assert history[-1] <= RESIDUAL
    late = np.log(history[(history > 1e-11) & (history < 0.1)])  # below is round-off
    orders = np.diff(late[1:]) / np.diff(late[:-1])
    assert len(orders) >= 2
    assert np.all((orders > 1.7) & (orders < 2.3)), history


def test_a_body_that_cannot_follow_a_whole_step_is_led_there(grid, block, newton):
    """Increments are bisected, each is accepted once, and the end is where it is without limit."""
    free = newton([stiffening(grid, block)], grid.smooth, load=0.6)
    reach = np.abs(free.state.displacements[0]).max()
    limited, contact = stiffening(grid, block, 1.02 * reach)
    led = newton([(limited, contact)], grid.smooth, load=0.6)
    np.testing.assert_allclose(led.state.pressure, free.state.pressure, atol=1e-7)
    assert len(limited.accepted) == len(led.residuals) > 1
    np.testing.assert_array_equal(limited.accepted[-1], led.state.displacements[0])


def test_what_does_not_converge_is_an_error(grid, block, newton):
    stuck, contact = stiffening(grid, block, 1e-6)
    with pytest.raises(FemError, match=r"did not converge beyond 0 % of the load: .*too far"):
        newton([(stuck, contact)], grid.smooth, load=0.6)
    assert stuck.accepted == []


HATS = np.linspace(-1.0, 1.0, 18)
WEIGHTS = np.full(16, HATS[1] - HATS[0])


@pytest.fixture(scope="module")
def compliance():
    mesh = structured_block(np.linspace(-2.0, 2.0, 21), np.linspace(0.0, 2.0, 9))
    return FiniteElementCompliance(elastic_body(mesh, Material(1.0, 0.3), Support()), HATS)


def system(compliance, hats, soft=0.0, friction=0.0, loaded=True):
    """System in which the stiffness of some nodes is less by a part."""
    body, count = compliance.body, compliance.body.unknowns
    part = np.where(np.arange(count) % 7 == 0, 1.0 - soft, 1.0)
    tangent = body.stiffness().multiply(part).multiply(part[:, None]).tocsr()
    terms = LinearContact(compliance, friction).at(np.zeros(body.held.shape), np.zeros(16))
    free = np.flatnonzero(~body.held.ravel())
    flexible = compliance.matrix(-friction)
    kind = 1.0, loaded, not friction
    return ContactSystem([(tangent, terms, free)], flexible, WEIGHTS, np.array(hats), *kind)


def counted(monkeypatch, worth, accuracy):
    """A reused factor of a worth in its solutions, and the systems that it has factorised."""
    monkeypatch.setattr(module, "FACTOR_WORTH", worth)
    reused, made = ReusedFactor(accuracy), []
    renew = reused._renew
    reused._renew = lambda system: (made.append(system), renew(system))
    return reused, made


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("loaded", [True, False])
def test_a_solution_is_that_of_the_systems_own_factor(compliance, monkeypatch, friction, loaded):
    """Hats join and leave, at ends and within, and the tangent changes."""
    reused, made = counted(monkeypatch, 1000, 1e-11)
    for soft, hats in [(0.0, [5, 6, 7, 9]), (0.0, [4, 6, 7, 8, 10]), (0.1, [6]), (0.1, [5, 6, 7])]:
        now = system(compliance, hats, soft, friction, loaded)
        right = np.random.default_rng(len(hats)).normal(size=now.size)
        x = solve_once(now.matrix(), right, symmetric=False)
        np.testing.assert_allclose(reused.solve(now, right), x, atol=1e-8 * np.abs(x).max())
    assert len(made) == 1


def test_a_factor_is_made_again_where_others_cost_more(compliance, monkeypatch):
    """Its solutions take ever more steps as the tangent softens; with one step each there is one
    factorisation for all."""
    reused, made = counted(monkeypatch, 2, 1e-3)
    for soft in (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6):
        reused.solve(now := system(compliance, [7, 8], soft), np.ones(now.size))
    assert 1 < len(made) < 7
    several = len(made)
    for _ in range(10):
        reused.solve(now, np.ones(now.size))
    assert len(made) <= several + 1


def test_a_singular_system_is_an_error(compliance):
    now = system(compliance, [7, 8], soft=1.0)
    with pytest.raises(FemError, match="singular"):
        ReusedFactor(1e-10).solve(now, np.ones(now.size))
