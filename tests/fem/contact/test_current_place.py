"""A rigid roller at the current position: its shapes, the gap's derivative, forces in balance; two
deformed bodies: forces in balance, the tangent, conforming surfaces, and known limits.

Lengths of pressed bodies in half-widths of the contact that Hertz expects, stresses in Young's
moduli.
"""

from functools import cache

import numpy as np
import pytest
from blocks import moved, structured_block
from pressed_bodies import neo_hookean_energy, press_finitely
from scenes import hat_nodes
from scipy.integrate import trapezoid

from analytic.contact.patches import contact_patches
from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.body.surface import hat_forces
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.deformed_roller import DeformedSurface, PairContact
from fem.contact.nonlinear import solve_nonlinear_contact, state_at_rest
from fem.contact.rigid_roller import STEEPEST, CurrentContact, circle, parabola
from fem.contact.terms import LinearContact, LinearResponse
from fem.solver.mumps import FemError
from fem.stress.maximum import maximum
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

RADIUS = 3.0
HATS = hat_nodes(-0.8, 0.16, 11)
PRESSURE = 1.0 + np.cos(3.0 * HATS[1:-1])
DEPTHS = np.linspace(0.0, 1.0, 4)


def rough(x):
    return 0.1 * np.cos(3 * x)


@pytest.fixture(scope="module")
def wavy():
    mesh = structured_block(np.linspace(-1.5, 1.5, 13), DEPTHS, rough, seed=2)
    return elastic_body(mesh, Material(1.0, 0.3), Support())


@pytest.mark.parametrize("roller", [circle(RADIUS), parabola(RADIUS), parabola(np.inf)])
def test_slopes_and_curvatures_are_derivatives(roller):
    x, h = np.linspace(-0.85 * RADIUS, 0.85 * RADIUS, 41), 1e-5
    rise, slope, bend = roller(x)
    ahead, behind = roller(x + h), roller(x - h)
    np.testing.assert_allclose(slope, (ahead[0] - behind[0]) / (2 * h), atol=1e-8)
    np.testing.assert_allclose(bend, (ahead[1] - behind[1]) / (2 * h), atol=1e-7)
    assert rise[20] == 0.0


def test_the_circle_is_one_and_goes_on_straight():
    x = np.linspace(-0.85 * RADIUS, 0.85 * RADIUS, 41)
    rise, _, _ = circle(RADIUS)(x)
    np.testing.assert_allclose(x**2 + (RADIUS - rise) ** 2, RADIUS**2, rtol=1e-14)
    far = np.array([STEEPEST * RADIUS, 2.0 * RADIUS, 5.0 * RADIUS])
    rise, slope, bend = circle(RADIUS)(far)
    np.testing.assert_allclose(slope, 2.0)
    np.testing.assert_allclose(np.diff(rise), 2.0 * np.diff(far))
    assert np.all(bend[1:] == 0.0)


def test_undeformed_it_is_the_linear_theorys(wavy):
    """Forces along the roller's normal, and the gap to the real boundary."""
    terms = CurrentContact(wavy, HATS, parabola(RADIUS)).at(0.0 * wavy.nodes, PRESSURE)
    forces = hat_forces(wavy.surface, HATS, lambda x: (x / RADIUS, np.ones_like(x)))
    component = (2 * wavy.surface.point[:, None] + np.arange(2)).ravel()
    np.testing.assert_allclose(terms.force.toarray()[component], forces.toarray(), atol=1e-15)
    assert abs(terms.force).sum() == pytest.approx(abs(forces).sum())
    hat = np.interp(fine := np.linspace(-1.0, 1.0, 200001), HATS, np.eye(len(HATS))[4])
    x, z = wavy.points[wavy.top.point].T
    edge = np.clip(np.searchsorted(x[::2], fine) - 1, 0, len(x) // 2 - 1)
    t = (fine - x[::2][edge]) / np.diff(x[::2])[edge]
    surface = z[::2][edge] * (1 - t) * (1 - 2 * t) + z[1::2][edge] * 4 * t * (1 - t)
    surface = surface + z[2::2][edge] * t * (2 * t - 1)
    wanted = trapezoid(hat * (surface + fine**2 / (2 * RADIUS)), fine)
    assert terms.gap[3] == pytest.approx(wanted, rel=1e-7)


def differences(contact, at, step, h):
    """The terms of a contact, and what gap and force change by along a step."""
    terms = contact.at(at, PRESSURE)
    ahead, behind = (contact.at(at + way * h * step, PRESSURE) for way in (1, -1))
    force = (ahead.force - behind.force) @ PRESSURE / (2 * h)
    assert (terms.force is terms.gradient) == contact.frictionless
    return terms, (ahead.gap - behind.gap) / (2 * h), force


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_derivatives(wavy, friction):
    contact = CurrentContact(wavy, HATS, circle(RADIUS), friction)
    step = moved(wavy, 1.0, 2)
    terms, gap, force = differences(contact, moved(wavy, 0.1, 1), step, 1e-5)
    assert contact.frictionless is not bool(friction)
    np.testing.assert_allclose(terms.gradient.T @ step.ravel(), gap, atol=1e-9 * abs(gap).max())
    scale = np.abs(force).max()
    np.testing.assert_allclose(terms.stiffness @ step.ravel(), force, atol=1e-8 * scale)


def test_forces_are_along_the_current_normal_and_tangent(wavy):
    """Sums: the load is the pressure's, and friction pulls towards +x along the tangent."""
    friction, at = 0.3, moved(wavy, 0.1, 1)
    force = CurrentContact(wavy, HATS, circle(RADIUS)).at(at, PRESSURE).force @ PRESSURE
    pulled = CurrentContact(wavy, HATS, circle(RADIUS), friction).at(at, PRESSURE).force @ PRESSURE
    along, down = force.reshape(-1, 2).sum(axis=0)
    assert down == pytest.approx(0.16 * PRESSURE.sum(), rel=1e-13)
    pulled_along, pulled_down = pulled.reshape(-1, 2).sum(axis=0)
    assert pulled_along - along == pytest.approx(friction * down, rel=1e-13)
    assert pulled_down - down == pytest.approx(-friction * along, rel=1e-12)


POISSON = 0.3
MODULUS = 1.0 / (1.0 - POISSON**2)
SIZE = 60.0  # of a block that is pressed


def blocks(cells=12):
    """A rough body and a roller whose edges end elsewhere."""
    lower = structured_block(np.linspace(-1.5, 1.5, cells + 1), DEPTHS, rough)
    roller = structured_block(np.linspace(-1.6, 1.6, cells + 2), DEPTHS, lambda x: -0.2 * x**2)
    return [elastic_body(mesh, Material(1.0, POISSON), Support()) for mesh in (lower, roller)]


def some(bodies, size):
    places = [body.nodes.T for body in bodies]
    moved = [np.column_stack([np.sin(2 * x + z), np.cos(x - 2 * z)]) for x, z in places]
    moved[1] = 0.5 * moved[1][:, ::-1]
    return size * np.vstack(moved)


class TestTerms:
    @pytest.mark.parametrize("friction", [0.0, 0.3])
    def test_derivatives(self, friction):
        """Up to the jumps of slope that are left out: of second order in the edges' length, the
        tangent's of first."""
        off = []
        for cells in (24, 48, 96):
            bodies = blocks(cells)
            contact = PairContact(bodies[0], HATS, bodies[1], friction)
            step = some(bodies, 1.0) * [0.7, -1.0]
            terms, gap, force = differences(contact, some(bodies, 0.05), step, 1e-6)
            work = terms.stiffness @ step.ravel()
            other = some(bodies, 1.0)[:, ::-1].ravel()  # smooth, as solutions are
            off.append(
                [
                    np.abs(terms.gradient.T @ step.ravel() - gap).max() / np.abs(gap).max(),
                    abs(other @ (work - force)) / abs(other @ force),
                ]
            )
        assert off[-1][0] < 1e-3 and off[-1][1] < 2e-3
        orders = np.log2(np.divide(off[0], off[-1])) / 2.0
        assert orders[0] > 1.7 and orders[1] > 0.9, off
        assert contact.frictionless is not bool(friction)
        if not friction:
            stiffness = terms.stiffness
            assert abs(stiffness - stiffness.T).max() < 1e-13 * abs(stiffness).max()

    @pytest.mark.parametrize("friction", [0.0, 0.3])
    def test_forces_and_moments_are_in_balance(self, friction):
        """Forces on the rough body push the roller back, at the same points: the moment is that of
        the gap between them. The roller's frame is mirrored."""
        bodies = blocks()
        at = some(bodies, 0.05)
        place = np.vstack([body.nodes for body in bodies]) + at
        terms = PairContact(bodies[0], HATS, bodies[1], friction).at(at, PRESSURE)
        force = (terms.force @ PRESSURE).reshape(-1, 2)
        of_body = np.arange(len(force)) < len(bodies[0].nodes)
        mirror = np.where(of_body, 1.0, -1.0)[:, None] * [0.0, 1.0] + [1.0, 0.0]
        force, place = force * mirror, place * mirror
        load = 0.16 * PRESSURE.sum()
        assert friction or force[of_body, 1].sum() == pytest.approx(load, rel=1e-12)
        np.testing.assert_allclose(force.sum(axis=0), 0.0, atol=1e-12 * load)
        upright = (place[:, 0] * force[:, 1]).sum()
        assert abs(upright) < 1e-12 * np.abs(place[:, 0] * force[:, 1]).sum()

    def test_constant_pressure_between_conforming_bodies_is_exact(self):
        """The roller's nodal forces are its own hats', though its edges end elsewhere."""
        lines = np.linspace(-1.5, 1.5, 13), np.linspace(-1.6, 1.6, 15)
        meshes = [structured_block(line, DEPTHS) for line in lines]
        bodies = [elastic_body(mesh, Material(1.0, POISSON), Support()) for mesh in meshes]
        terms = PairContact(bodies[0], HATS, bodies[1]).at(0.0 * some(bodies, 1.0), PRESSURE)
        np.testing.assert_allclose(terms.gap, 0.0, atol=1e-15)
        forces, first = terms.force.toarray(), 0
        for body in bodies:
            rows = 2 * (first + body.surface.point) + 1
            wanted = hat_forces(body.surface, HATS).toarray()[1::2]
            np.testing.assert_allclose(forces[rows], wanted, atol=1e-15)
            first += len(body.nodes)
        # a common stretch of both along x moves nothing apart
        moved = np.vstack([0.1 * body.nodes * [1.0, 0.0] for body in bodies])
        again = PairContact(bodies[0], HATS, bodies[1]).at(moved, PRESSURE)
        np.testing.assert_allclose(again.force.toarray(), forces, atol=1e-15)

    def test_a_surface_that_folds_or_ends_is_refused(self):
        _, roller = blocks()
        with pytest.raises(FemError, match="folds"):
            DeformedSurface(roller, -2.0 * roller.nodes)
        with pytest.raises(FemError, match="beyond the end"):
            DeformedSurface(roller, 0.0 * roller.nodes)(np.array([1.7]))


def levelled(radius):
    """The parabola, whose slope fades beyond 1.5."""

    def height(x):
        inside = np.minimum(np.abs(x), 1.5)
        t = np.clip((np.abs(x) - 1.5) / 3.0, 0.0, 1.0)
        return -(inside**2 / 2.0 + 4.5 * (t - t**3 + 0.5 * t**4)) / radius

    return height


@cache
def flat(edge, aside=0.0):
    refined = np.array([[aside - 1.5, aside + 1.5]])
    growth = 0.25 * np.sqrt(edge / 0.1)  # elements below are refined too
    return build_block(BlockSpec(SIZE, SIZE, refined, edge, growth))


@cache
def body(edge, radius=None, modulus=1.0, aside=0.0):
    mesh = flat(edge, aside)
    mesh = mesh if radius is None else roughen(mesh, levelled(radius))
    return elastic_body(mesh, Material(modulus, POISSON), Support("bonded", "fixed"))


class Pressed:
    """Two bodies of a/R = `curvature`: the figures of the rough one."""

    def __init__(self, curvature, edge, moduli=(1.0, 1.0), on_rough=False, friction=0.0, aside=0.0):
        self.modulus = MODULUS / sum(1.0 / m for m in moduli)
        self.peak = 0.5 * self.modulus * curvature
        count = round(1.3 / edge)
        self.hats = hat_nodes(-count * edge, edge, 2 * count + 1)
        self.x = self.hats[1:-1]
        radii = (1.0 / curvature, None) if on_rough else (None, 1.0 / curvature)
        self.rough = body(edge, radii[0], moduli[0])
        self.roller = body(edge, radii[1], moduli[1], aside)
        self.start = self.peak * np.sqrt(np.maximum(1.0 - self.x**2, 0.0))
        self.load = 0.5 * np.pi * self.peak
        against = FiniteElementCompliance(self.roller, self.hats)
        self.state = press_finitely(
            self.rough, self.hats, against, self.start, load=self.load, friction=friction
        )
        self.pressure = self.state.cauchy_pressure / self.peak
        patches = contact_patches(self.x, self.state.pressure, self.state.gap)
        place = np.interp(patches, self.x, self.state.place)
        self.length = float(np.diff(place).sum()) / 2.0

    @property
    def centre(self):
        pressure = self.state.pressure
        return self.state.place @ pressure / pressure.sum()

    @property
    def tau1(self):
        where, nodal = (-1.2, 1.2, 2.0), self.state.cauchy.nodal
        return maximum(self.rough, nodal, lambda stress: stress.tau1, where).value / self.peak


pressed = cache(Pressed)


class TestPressed:
    def test_newton_takes_few_steps_with_friction_too(self):
        for friction in (0.0, 0.2):
            state = pressed(0.1, 0.1, friction=friction).state
            assert state.solution.iterations <= 6
            assert len(state.solution.residuals) == 1

    def test_small_loads_are_the_linear_theorys(self):
        """Two linear bodies on the same block: the difference vanishes in proportion to p0/E."""
        left = []
        for curvature in (0.04, 0.02, 0.01):
            case = pressed(curvature, 0.1)
            compliance = FiniteElementCompliance(case.rough, case.hats)
            weights = np.diff(case.hats)[1:]
            gap = weights * curvature * (case.x**2 / 2.0 + 0.1**2 / 12.0)
            bodies = 2 * [(LinearResponse(case.rough), LinearContact(compliance))]
            rest = state_at_rest(bodies, case.start)
            linear = solve_nonlinear_contact(bodies, gap, weights, rest, case.load).state.pressure
            left.append(np.abs(case.state.pressure - linear).max() / case.peak)
        orders = np.log2(np.divide(left[:-1], left[1:]))
        assert np.all(np.abs(orders - 1.0) < 0.25), left

    def test_a_very_stiff_roller_is_the_rigid_one(self):
        case = pressed(0.1, 0.1, moduli=(1.0, 1e6))
        rigid = press_finitely(case.rough, case.hats, parabola(10.0), case.start, load=case.load)
        near = 1e-5 * rigid.pressure.max()
        np.testing.assert_allclose(case.state.pressure, rigid.pressure, atol=near)
        assert case.state.approach == pytest.approx(rigid.approach, rel=1e-4)

    def test_body_and_roller_can_be_exchanged(self):
        """The cylinder as the rough body, the flat as the roller."""
        case, other = pressed(0.1, 0.05), pressed(0.1, 0.05, on_rough=True)
        assert case.pressure.max() == pytest.approx(other.pressure.max(), rel=2e-4)
        assert case.pressure.max() == pytest.approx(1.0107, abs=5e-4)
        assert case.length == pytest.approx(other.length, rel=3e-4)
        np.testing.assert_allclose(case.pressure, case.pressure[::-1], atol=5e-3)

    def test_unlike_bodies_can_be_exchanged(self):
        case = pressed(0.1, 0.05, moduli=(1.0, 3.0), friction=0.2)
        other = pressed(0.1, 0.05, moduli=(3.0, 1.0), on_rough=True, friction=-0.2)
        assert case.pressure.max() == pytest.approx(other.pressure.max(), rel=2e-3)
        assert case.length == pytest.approx(other.length, rel=2e-3)
        at = np.linspace(-0.8, 0.8, 81)
        here, there = (
            np.interp(at + one.centre, one.state.place, one.pressure) for one in (case, other)
        )
        np.testing.assert_allclose(here, there, atol=5e-3)
        assert np.abs(here - here[::-1]).max() > 8e-3

    def test_edges_of_the_roller_that_end_elsewhere_do_not_matter(self):
        case, other = pressed(0.1, 0.1), pressed(0.1, 0.1, aside=0.37 * 0.1)
        inner = np.abs(case.x) < 0.9
        np.testing.assert_allclose(case.pressure[inner], other.pressure[inner], atol=1e-3)

    @pytest.mark.parametrize("on_rough", [False, True])
    def test_the_load_is_the_energys_derivative_by_the_approach(self, on_rough):
        """Energy: both bodies' strain energy, by a quadrature of its own."""
        case = pressed(0.1, 0.1, on_rough=on_rough)
        against = FiniteElementCompliance(case.roller, case.hats)
        energies, h = [], 1e-3 * case.state.approach
        start = case.rough, case.hats, against, case.state.pressure
        for approach in case.state.approach + np.array([-h, h]):
            state = press_finitely(*start, approach=approach)
            moved = np.split(state.solution.state.displacements[0], [len(case.rough.nodes)])
            energies.append(sum(map(neo_hookean_energy, (case.rough, case.roller), moved)))
        assert np.diff(energies)[0] / (2.0 * h) == pytest.approx(case.load, rel=2e-4)

    @pytest.mark.parametrize("on_rough", [False, True])
    def test_figures_converge_with_the_edges(self, on_rough):
        cases = [pressed(0.1, edge, on_rough=on_rough) for edge in (0.1, 0.05, 0.025)]
        peak = np.array([case.pressure.max() for case in cases])
        tau1 = np.array([case.tau1 for case in cases])
        assert abs(peak[1] - peak[2]) < 0.5 * abs(peak[0] - peak[1])
        assert abs(peak[1] - peak[2]) < 6e-4
        assert abs(tau1[1] - tau1[2]) < 0.5 * abs(tau1[0] - tau1[1])
