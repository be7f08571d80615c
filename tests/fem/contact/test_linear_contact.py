"""Linear bodies by Newton's method and by PETSc's variational inequality: dense solutions, and
the project's own solver; Newton's method with an active set on bodies that are not linear.
Systems of Newton steps by the factor of a former one: as by their own."""

import numpy as np
import pytest
from blocks import graded, structured_block, widened
from nodal_stress import displacement_under
from pressed_bodies import dense_contact
from scenes import hat_nodes

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.body.surface import hat_forces
from fem.compliance.operator import FiniteElementCompliance
from fem.contact import system as module
from fem.contact.nonlinear import RESIDUAL, solve_nonlinear_contact, state_at_rest
from fem.contact.system import ContactSystem, ReusedFactor
from fem.contact.terms import LinearContact, LinearResponse
from fem.contact.variational_inequality import VariationalSolution, solve_variational_inequality
from fem.solver.mumps import FemError, solve_once


class HatGrid:
    """21 hats from -1.3 to 1.3, blocks that meet there, a smooth gap and a rough one [m^2]."""

    count = 21
    pitch = 2.6 / (count + 1)
    x = pitch * (np.arange(count) - count // 2)
    weights = np.full(count, pitch)
    hats = hat_nodes(x[0], pitch, count)
    smooth = 0.5 * pitch * x**2
    rough = smooth + pitch * (0.05 * np.cos(17 * x) + 0.03 * np.cos(7 * x + 1) + 0.08)

    def body(self, modulus=1.0, poisson=0.3, height=None, support=None) -> ElasticBody:
        outer = graded(10.0, 0.1, 1.6)
        mesh = structured_block(widened(np.linspace(-1.5, 1.5, 31), outer), outer, height)
        return elastic_body(mesh, Material(modulus, poisson), support or Support())

    def compliance(self, body: ElasticBody) -> FiniteElementCompliance:
        return FiniteElementCompliance(body, self.hats)

    def linear(self, body: ElasticBody, friction=0.0) -> tuple[LinearResponse, LinearContact]:
        return LinearResponse(body), LinearContact(self.compliance(body), friction)


GRID = HatGrid()


@pytest.fixture(scope="module")
def block() -> ElasticBody:
    return GRID.body()


@pytest.fixture(scope="module")
def block_matrix(block) -> np.ndarray:
    return GRID.compliance(block).matrix()


@pytest.fixture(
    params=[
        ("smooth", 1.0, 0.6),
        ("rough", 1.0, 0.6),
        ("rough", 1.0, 1e-6),
        ("smooth", 0.002, 3.0),
    ],
    ids=["smooth", "rough", "one hat", "everywhere"],
)
def gap_and_load(request) -> tuple[np.ndarray, float]:
    name, times, load = request.param
    return times * getattr(GRID, name), load


def by_newton(bodies, gap, load, hardness=np.inf):
    pairs = [GRID.linear(body) for body in bodies]
    solution = newton(pairs, gap, load=load, hardness=hardness)
    return VariationalSolution(
        solution.state.pressure, solution.state.approach, solution.iterations
    )


def by_inequality(bodies, gap, load, hardness=np.inf):
    pairs = [(body, hat_forces(body.surface, GRID.hats)) for body in bodies]
    return solve_variational_inequality(pairs, gap, GRID.weights, load, hardness)


@pytest.fixture(params=[by_newton, by_inequality])
def solve(request):
    return request.param


def test_pressure_and_approach_are_the_dense_ones(block, block_matrix, gap_and_load, solve):
    gap, load = gap_and_load
    contact = solve([block], gap, load)
    pressure, approach = dense_contact(block_matrix, gap, GRID.weights, load)
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-9 * pressure.max())
    assert contact.approach == pytest.approx(approach, rel=1e-9)
    assert contact.iterations <= 15
    assert GRID.weights @ contact.pressure == pytest.approx(load, rel=1e-10)


def test_pressure_is_capped_at_the_hardness(block, block_matrix, solve):
    """The conditions themselves, on the dense compliance: open, in contact or at the hardness."""
    hardness, load = 0.4, 0.6
    contact = solve([block], GRID.rough, load, hardness)
    pressure = contact.pressure
    opening = (GRID.rough + block_matrix @ pressure) / GRID.pitch - contact.approach
    none, full = pressure < 1e-9, pressure > hardness * (1 - 1e-9)
    assert none.sum() > 5
    assert full.sum() > 5
    assert pressure.min() >= 0.0
    assert pressure.max() <= hardness * (1 + 1e-12)
    scale = np.ptp(block_matrix @ pressure) / GRID.pitch
    assert opening[none].min() > -1e-9 * scale
    assert opening[full].max() < 1e-9 * scale
    assert np.abs(opening[~none & ~full]).max() < 1e-9 * scale
    assert GRID.weights @ pressure == pytest.approx(load, rel=1e-10)


@pytest.mark.parametrize("ratio", [1.0, 0.5, 1e-6, 1e6])
def test_an_elastic_roller_is_a_second_body(block, block_matrix, ratio, solve):
    roller = GRID.body(ratio, 0.2, support=Support("bonded", "fixed"))
    load = 0.6 * min(1.0, ratio)
    contact = solve([block, roller], GRID.rough, load)
    pressure, _ = dense_contact(
        block_matrix + GRID.compliance(roller).matrix(), GRID.rough, GRID.weights, load
    )
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-8 * pressure.max())


@pytest.mark.parametrize("size", [1e-9, 1e9])
def test_units_of_pressure_do_not_matter(block, size, solve):
    unit = solve([block], GRID.rough, 0.3)
    scaled = solve([GRID.body(size)], GRID.rough, 0.3 * size)
    np.testing.assert_allclose(scaled.pressure / size, unit.pressure, atol=1e-12)
    assert scaled.approach == pytest.approx(unit.approach, rel=1e-12)


def test_both_solvers_agree(block, solve):
    """The project's own operator and solver, on the same mesh."""
    model = HalfPlane(GRID.count, GRID.pitch, block.material.plane_strain_modulus)
    ours = solve_with_model(
        GRID.compliance(block), model, GRID.rough, GRID.weights, Constraints(load=0.3)
    )
    other = solve([block], GRID.rough, 0.3)
    assert ours.converged
    np.testing.assert_allclose(other.pressure, ours.pressure, atol=1e-6 * ours.pressure.max())
    assert ours.approach == pytest.approx(other.approach, rel=1e-6)


def test_a_rough_body_with_tilted_pressure():
    def height(x):
        return 0.02 * np.cos(5 * x) * np.exp(-((x / 2.0) ** 4))

    def direction(x):
        return 0.3 * x, np.ones_like(x)

    body = GRID.body(height=height)
    b = hat_forces(body.surface, GRID.hats, direction)
    contact = solve_variational_inequality([(body, b)], GRID.smooth, GRID.weights, 0.6)
    units = np.eye(GRID.count)
    moved = [displacement_under(body, GRID.hats, unit, 0.0, direction) for unit in units]
    matrix = np.array([u[body.surface.point].ravel() @ b for u in moved])
    pressure, _ = dense_contact(matrix, GRID.smooth, GRID.weights, 0.6)
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-8 * pressure.max())


def test_what_hats_do_to_held_components_is_nothing(solve):
    """The outer hats reach over points that the support holds."""
    body = GRID.body(support=Support(within=(1.25, np.inf)))
    assert body.held[body.surface.point[np.abs(body.surface.x) < 1.3]].any()
    contact = solve([body], 0.002 * GRID.smooth, 3.0)
    pressure, _ = dense_contact(
        GRID.compliance(body).matrix(), 0.002 * GRID.smooth, GRID.weights, 3.0
    )
    np.testing.assert_allclose(contact.pressure, pressure, atol=1e-8 * pressure.max())


def test_loads_that_cannot_be_borne_are_refused(block, solve):
    with pytest.raises(ValueError, match=r"must be positive|not between zero"):
        solve([block], GRID.smooth, 0.0)
    with pytest.raises(ValueError, match=r"exceeds the hardness|not between zero"):
        solve([block], GRID.smooth, 3.0, 1.0)


def newton(bodies, gap, start=None, **wanted):
    start = state_at_rest(bodies, np.ones(GRID.count)) if start is None else start
    return solve_nonlinear_contact(bodies, gap, GRID.weights, start, **wanted)


def test_gaps_are_the_dense_ones_and_the_approach_leads_to_the_same(
    block, block_matrix, gap_and_load
):
    gap, load = gap_and_load
    bodies = [GRID.linear(block)]
    solution = newton(bodies, gap, load=load)
    pressure, approach = dense_contact(block_matrix, gap, GRID.weights, load)
    assert solution.state.load == load
    opening = (gap + block_matrix @ pressure) / GRID.pitch - approach
    scale = np.ptp(block_matrix @ pressure) / GRID.pitch
    np.testing.assert_allclose(solution.gap, opening, atol=1e-9 * scale)
    assert len(solution.residuals) == 1
    again = newton(bodies, gap, approach=solution.state.approach)
    np.testing.assert_allclose(again.state.pressure, pressure, atol=1e-9 * pressure.max())
    assert again.state.load == pytest.approx(load, rel=1e-8)


def test_the_way_to_a_load_does_not_matter(block):
    bodies = [GRID.linear(block)]
    once = newton(bodies, GRID.rough, load=0.6)
    on = newton(bodies, GRID.rough, start=once.state, load=0.3)
    back = newton(bodies, GRID.rough, load=0.3)
    np.testing.assert_allclose(on.state.pressure, back.state.pressure, atol=1e-9)


def test_friction_is_coupled(block):
    """Unsymmetric: the sliding traction moves the surface that the pressure has to follow."""
    forces, friction = GRID.compliance(block), 0.3
    columns = [forces.apply(unit, friction) for unit in np.eye(GRID.count)]
    sliding = newton([GRID.linear(block, friction)], GRID.smooth, load=0.6)
    assert sliding.iterations <= 10
    pressure, _ = dense_contact(np.array(columns).T, GRID.smooth, GRID.weights, 0.6)
    np.testing.assert_allclose(sliding.state.pressure, pressure, atol=1e-9 * pressure.max())
    without, _ = dense_contact(forces.matrix(), GRID.smooth, GRID.weights, 0.6)
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


def stiffening(block, limit=np.inf):
    return Stiffening(block, 0.02, limit), GRID.linear(block)[1]


def test_newton_converges_quadratically(block):
    """From one load to the next with every hat touching before and after."""
    bodies, gap = [stiffening(block)], 0.002 * GRID.smooth
    start = newton(bodies, gap, load=0.6).state
    solution = newton(bodies, gap, start=start, load=1.2)
    history = np.array(solution.residuals[-1])
    assert history[-1] <= RESIDUAL
    late = np.log(history[(history > 1e-11) & (history < 0.1)])  # below is round-off
    orders = np.diff(late[1:]) / np.diff(late[:-1])
    assert len(orders) >= 2
    assert np.all((orders > 1.7) & (orders < 2.3)), history


def test_a_body_that_cannot_follow_a_whole_step_is_led_there(block):
    """Increments are bisected, each is accepted once, and the end is where it is without limit."""
    free = newton([stiffening(block)], GRID.smooth, load=0.6)
    reach = np.abs(free.state.displacements[0]).max()
    limited, contact = stiffening(block, 1.02 * reach)
    led = newton([(limited, contact)], GRID.smooth, load=0.6)
    np.testing.assert_allclose(led.state.pressure, free.state.pressure, atol=1e-7)
    assert len(limited.accepted) == len(led.residuals) > 1
    np.testing.assert_array_equal(limited.accepted[-1], led.state.displacements[0])


def test_what_does_not_converge_is_an_error(block):
    stuck, contact = stiffening(block, 1e-6)
    with pytest.raises(FemError, match=r"did not converge beyond 0 % of the load: .*too far"):
        newton([(stuck, contact)], GRID.smooth, load=0.6)
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
