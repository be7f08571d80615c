"""A roller on a body that flows at finite strains: the elastic limit, the limit of small strains,
first yield, energy, limit load, release; wedge and cylinder sunk into a nearly rigid metal, beside
slip lines.

A smooth wedge raises straight lips. Its slip lines are straight below flank and lip, both of one
length, with a fan between them: it bears 2 k (1 + fan) (Hill, Lee and Tupper 1947, Proc. R. Soc.
A 188, 273-289; Hill 1950, The Mathematical Theory of Plasticity, ch. VIII), k = Y / sqrt 3."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from blocks import graded, structured_block, widened
from flat_punch import LIMIT, past_the_limit
from flow_energy import AccountedFiniteHistory
from scenes import hat_nodes
from scipy.optimize import brentq

from analytic.material import Law, Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.nonlinear import state_at_rest
from fem.contact.rigid_roller import CurrentContact, circle, parabola
from fem.contact.system import ReusedFactor
from fem.nonlinear import finite_deformation, hyperelastic
from fem.nonlinear.finite_deformation import FiniteContact
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.newton import ACCURACY, newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_finite import FiniteLoadHistory
from fem.nonlinear.press_plastic import LoadHistory, plastic_fields
from fem.solver.mumps import FemError
from meshes.block import BlockSpec
from meshes.build import build_block

NU = 0.3
METAL = Material(1.0, NU, Law("hencky"))
EDGE = 1.0 / 6.0
HATS = hat_nodes(-11 * EDGE, EDGE, 23)
X = HATS[1:-1]
HERTZ = np.sqrt(np.maximum(1.0 - X**2, 0.0))


@pytest.fixture(scope="module")
def made():
    """Bodies by the height of their surface."""
    x = widened(np.linspace(-2.0, 2.0, 25), graded(6.0, 0.3, 1.4))
    mesh = partial(structured_block, x, graded(8.0, 0.14, 1.2))
    return lambda height: elastic_body(mesh(height), METAL, Support())


@pytest.fixture(scope="module")
def body(made):
    return made(None)


@pytest.fixture(scope="module")
def roller(made):
    """Elastic, of radius 10 as a parabola, in its own frame on the body's hats."""
    return FiniteElementCompliance(made(lambda x: -0.05 * x**2), HATS)


def touching(body, curvature, friction=0.0, roller=None):
    """Contact on half-width 1 of linear bodies, the load [N/m] and the peak pressure [Pa]."""
    peak = 0.5 * METAL.plane_strain_modulus * curvature / (1 + (roller is not None))
    shape = roller or circle(1.0 / curvature)
    contact = FiniteContact(FiniteElementCompliance(body, HATS), shape, peak * HERTZ, friction)
    return contact, 0.5 * np.pi * peak, peak


@pytest.mark.parametrize(("elastic", "friction"), [(False, 0.0), (True, 0.2)])
def test_without_flow_it_is_henckys_law(body, roller, monkeypatch, elastic, friction):
    monkeypatch.setattr(hyperelastic, "quadrature_degree", lambda *_: 2)
    monkeypatch.setattr(finite_deformation, "ASIDE", 1e-7)
    monkeypatch.setattr(finite_deformation, "LEANING", 1e-11)
    contact, load, peak = touching(body, 0.1, friction, roller if elastic else None)
    wanted = contact.by_newton(load)
    metal = ElasticPlastic(METAL, Hardening(1e3))
    [state] = FiniteLoadHistory(contact, metal).through([load])
    assert state.deformed.load == pytest.approx(load, rel=1e-10)
    np.testing.assert_allclose(state.pressure, wanted.pressure, atol=1e-9 * peak)
    assert state.approach == pytest.approx(wanted.approach, rel=1e-9)
    np.testing.assert_allclose(state.displacement, wanted.displacement, atol=1e-9)
    np.testing.assert_allclose(state.deformed.gap, wanted.gap, atol=1e-9)


def test_light_loads_are_those_of_small_strains(body):
    """The difference falls with the curvature, of which strains, slopes and rotations are a part;
    the roller's height over a hat is that of a parabola in both."""
    left = []
    for curvature in (0.02, 0.01):
        contact, load, peak = touching(body, curvature, 0.1)
        metal = ElasticPlastic(METAL, Hardening(peak / 2.4, peak))
        gap = EDGE * 0.5 * curvature * (X**2 + EDGE**2 / 6.0)
        weights, start = contact.weights, contact.start
        way = LoadHistory(contact.compliance, metal, gap, weights, start, 0.1)
        [small], [finite] = (
            one.through([load]) for one in (way, FiniteLoadHistory(contact, metal))
        )
        off = np.linalg.norm(finite.pressure - small.pressure) / np.linalg.norm(small.pressure)
        strains = [one.state.equivalent.max() for one in (finite, small)]
        left.append([off, strains[0] / strains[1] - 1.0, finite.approach / small.approach - 1.0])
        assert strains[1] > 0.05 * curvature
    orders = np.log2(np.abs(np.divide(*left)))
    assert np.all((orders > 0.6) & (orders < 1.6)), (left, orders)
    assert np.abs(left[-1]).max() < 0.03


def test_work_is_elastic_and_plastic_and_friction(made):
    """Work of pressures and tractions, and of the support, which moves the body back along x; of a
    wavy body at finite strains, pressed and released. Steps miss work of second order."""
    left, body = [], made(lambda x: 0.004 * np.cos(2.0 * np.pi * x))
    for steps in (2, 4):
        contact, load, peak = touching(body, 0.1, 0.2)
        start = peak / 3.0
        metal = ElasticPlastic(METAL, Hardening(start, voce=(1.5 * start, 20.0)))
        parts = np.linspace(0.0, 1.0, 2 * steps + 1)
        loads = [*(load * parts[1:]), *(load * parts[-3:0:-2]), 0.0]
        way = AccountedFiniteHistory(contact, metal)
        assert way.through(loads)[2 * steps - 1].state.equivalent.max() > 0.02
        loaded, released = way.energies[2 * steps - 1], way.energies[-1]
        assert loaded.plastic_work > 0.2 * loaded.work
        assert abs(loaded.left) < 5e-4 * loaded.plastic_work
        off = released.plastic_work / released.flowed - 1.0
        left.append([released.left / released.plastic_work, off])
    orders = np.log2(np.abs(np.divide(*left)))
    assert np.all((orders > 1.6) & (orders < 2.4)) and np.abs(left[-1]).max() < 1e-3


def test_elements_do_not_lock_in_flow():
    """The limit of a flat punch, (2 + pi) Y / sqrt 3, from above and to first order also at finite
    strains, where flow keeps the volume to the last digit; in a metal that is nearly rigid."""

    def contact_of(body, hats):
        return CurrentContact(body, hats, parabola(np.inf))

    further = past_the_limit([3e-5, 5e-5], Material(2e6, NU), FinitePlasticBody, contact_of)
    assert abs(further - 1.0) < 2e-3


def test_first_yield():
    """At 1.79 times the yield stress (von Mises), as in the linear theory for small p0/E."""
    window = (-1.3, 1.3, 1.0, 0.1)
    mesh = build_block(BlockSpec(100.0, 100.0, np.array([[-2.0, 2.0]]), 0.125, 0.3, window))
    body, flows = elastic_body(mesh, METAL, Support()), []
    for ratio in (1.79 * 0.98, 1.79 * 1.02):
        contact, load, peak = touching(body, 2e-3)
        metal = ElasticPlastic(METAL, Hardening(peak / ratio))
        [state] = FiniteLoadHistory(contact, metal).through([load])
        flows.append(bool(state.state.equivalent.any()))
    assert flows == [False, True]


def test_released(body):
    """Without the roller nothing is left on any node."""
    contact, load, peak = touching(body, 0.1, 0.1)
    metal = ElasticPlastic(METAL, Hardening(peak / 2.4, peak))
    way = FiniteLoadHistory(contact, metal)
    plastic, (pressed, released) = way.body, way.through([load, 0.0])
    assert not released.pressure.any()
    free = ~plastic.held
    left = plastic.force(released.displacement)[free]
    force = contact.contact.loaded(pressed.displacement, pressed.pressure)[1]
    stress, _ = plastic.stress(released.displacement, released.state)
    assert np.abs(stress).max() > 0.1 * metal.hardening.yield_stress
    fields = plastic_fields(plastic, released)
    assert np.abs(fields.stress.sz[body.surface.point]).max() < 0.2 * np.abs(stress).max()
    assert np.abs(left).max() < 1e-6 * np.abs(force).max()
    assert np.abs(force).max() > 1e-3 and released.displacement.max() > 1e-3


SUNK_EDGE, TWICE_SHEAR = 0.1, 2.0 / np.sqrt(3.0)
SOFT = ElasticPlastic(Material(1e3, NU, Law("hencky")), Hardening(1.0))


def soft(size, reach, beside):
    """A body that is nearly rigid beside its flow, and hats on |x| < `reach`."""
    window = (-beside, beside, reach, 2.2 * SUNK_EDGE)
    spec = BlockSpec(size, size, np.array([[-reach, reach]]), SUNK_EDGE, 0.3, window)
    body = elastic_body(build_block(spec), SOFT.elastic, Support("bonded", "fixed"))
    return body, np.linspace(-reach, reach, round(2.0 * reach / SUNK_EDGE) + 1)


def on_a_cylinder(half_width):
    """Mean pressure that a cylinder of radius 1 bears. Slip lines of a smooth face at the angle t
    to a level surface turn by pi/2 - t, so that it bears 2 k (1 + pi/2 - t); the material that
    rises beside the roller is left out (Jackson 2018, J. Appl. Mech. 85, 024501)."""
    angle = np.arcsin(half_width)
    return TWICE_SHEAR * (1.0 + np.pi / 2.0 - angle + np.tan(angle / 2.0))


def fan(half_angle):
    """Angle of the fan by the volume: what is below the surface is what the lips have above it.
    By unit depth, with flank and lip of one length, the lip half_angle - fan below the level."""

    def missing(angle):
        lip = half_angle - angle
        length = 1.0 / (np.cos(half_angle) - np.sin(lip))
        raised = length * np.sin(lip)
        width = length * (np.sin(half_angle) + np.cos(lip)) - np.tan(half_angle)
        return raised * width - np.tan(half_angle)

    return brentq(missing, 1e-9, half_angle - 1e-9)


@pytest.mark.parametrize("half_angle", [0.5, 1.0, 1.3, 1.55])
def test_the_fan_is_that_of_hill_lee_and_tupper(half_angle):
    angle = fan(half_angle)
    assert np.cos(2.0 * half_angle - angle) * (1.0 + np.sin(angle)) == pytest.approx(np.cos(angle))


def test_a_blunt_wedge_is_prandtls_punch():
    assert TWICE_SHEAR * (1.0 + fan(0.5 * np.pi - 1e-4)) == pytest.approx(LIMIT, rel=1e-3)


def wedge(slope):
    def rise(x):
        return slope * np.abs(x), slope * np.sign(x), np.zeros_like(x)

    return rise


def sunk(roller, step, depth):
    """Half-width of the contact, mean pressure by the yield stress there, and the height to which
    the metal has risen, from depth to depth."""
    body, hats = soft(12.0, 1.2, 1.5)
    at, weights = hats[1:-1], np.full(len(hats) - 2, SUNK_EDGE)
    plastic = FinitePlasticBody(body, SOFT)
    bodies = [(plastic, CurrentContact(body, hats, roller))]
    state = last = state_at_rest(bodies, (np.abs(at) < 0.5 * SUNK_EDGE).astype(float))
    factor = ReusedFactor(ACCURACY)
    gap, rows = bodies[0][1].loaded(np.zeros_like(body.nodes), 0.0 * at)[0] / weights, []
    now, way = gap.min(), step
    while now < depth:
        part = way / max(state.approach - last.approach, way)
        moved = state.displacements[0] + part * (state.displacements[0] - last.displacements[0])
        start = replace(state, displacements=(moved,))
        try:
            end, _ = newton_by_contacts(
                *(bodies, 0.0 * at, weights, start, None, now + way), residual=1e-5, factor=factor
            )
        except FemError:
            way *= 0.5
            assert way > step / 64.0
            continue
        now, way, last, state = now + way, min(step, 1.5 * way), state, end
        plastic.accept(state.displacements[0])
        top = body.at_points(state.displacements[0])[body.top.point]
        place = at + np.interp(at, body.top.x, top[:, 0])
        ends = np.flatnonzero(state.pressure > 0.0)[[0, -1]]
        width = 0.5 * np.ptp(
            place[ends] + place[ends + np.array([-1, 1])]
        )  # of the last hats' shares
        rows.append((0.5 * width, weights @ state.pressure / width, -top[:, 1].min()))
    return np.array(rows).T


def test_a_wedge_bears_what_its_slip_lines_bear():
    """A flank of 30 degrees to the surface; the level surface's slip lines would bear 8 % more."""
    tangent = np.tan(np.pi / 6.0)
    half_width, pressure, rise = sunk(wedge(tangent), SUNK_EDGE * tangent / 10.0, 0.178)
    slip = TWICE_SHEAR * (1.0 + fan(np.pi / 3.0))
    late = half_width > 3.2 * SUNK_EDGE  # a hat that has just touched bears little of its share
    assert late.sum() > 4 and rise[-1] > 0.09
    np.testing.assert_allclose(pressure[late], slip, rtol=0.09)
    assert pressure[late].mean() == pytest.approx(slip, rel=0.04)


def test_a_cylinder_is_followed_to_four_fifths_of_its_radius():
    """The material that rises beside the roller takes from what slip lines bear."""
    half_width, pressure, rise = sunk(circle(1.0), 0.007, 0.25)
    slip = on_a_cylinder(half_width)
    late = half_width > 0.66
    assert half_width[-1] > 0.77 and rise[-1] > 0.14
    np.testing.assert_allclose(pressure[late], slip[late], rtol=0.055)


def test_a_cylinder_sinks_into_a_nearly_rigid_metal():
    """Metal that rises beside the roller is left out. Loads alone lead to a contact of 0.3 of the
    radius: between two hats that touch they hardly rise."""
    body, hats = soft(8.0, 0.6, 1.2)
    start = 20.0 * np.sqrt(np.maximum(0.15**2 - hats[1:-1] ** 2, 0.0))
    contact = FiniteContact(FiniteElementCompliance(body, hats), circle(1.0), start)
    slip = on_a_cylinder(0.5)
    way = FiniteLoadHistory(contact, SOFT)
    [sunk] = way.through([2.0 * 0.5 * slip])
    place, on = sunk.deformed.place, np.flatnonzero(sunk.pressure)
    ends = 0.5 * (place[on[[0, -1]]] + place[on[[0, -1]] + [-1, 1]])  # of the last hats' shares
    assert sunk.load / np.ptp(ends) == pytest.approx(slip, rel=0.05)
    assert sunk.deformed.load == pytest.approx(sunk.load, rel=1e-9)
