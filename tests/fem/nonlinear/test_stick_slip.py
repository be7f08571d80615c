"""Partial slip at finite strains: limits of small loads, of sliding and without friction, energy,
a roller of which the rigid one is the limit.

Lengths in half-widths of the contact that Hertz expects, stresses in Young's moduli."""

from functools import partial

import numpy as np
import pytest
from scenes import hat_nodes

from analytic.contact.partial_slip import Loads, SurfacePair, history
from analytic.contact.problem import solve_contact
from analytic.material import Material
from analytic.operators.half_plane import DenseCompliance
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.rigid_roller import circle, parabola
from fem.nonlinear.finite_deformation import FiniteContact
from fem.nonlinear.stick_slip import HeldContact

SOFT = Material(1.0, 0.3)
EDGE = 1.0 / 6.0
HATS = hat_nodes(-9 * EDGE, EDGE, 19)
X = HATS[1:-1]
HERTZ = np.sqrt(np.maximum(1.0 - X**2, 0.0))
FRICTION = 0.3
# parts of the load, shares of sliding
STEPS = [(0.25, 0.0), (1.0, 0.0), (1.0, 0.3), (1.0, 0.6), (1.0, 0.1)]


def block(structured_block, graded, material=SOFT, height=None):
    beyond = graded(6.0, 0.4, 1.8)
    x = np.concatenate([-1.6 - beyond[:0:-1], np.linspace(-1.6, 1.6, 21), 1.6 + beyond[1:]])
    return elastic_body(structured_block(x, graded(7.0, 0.16, 1.4), height), material, Support())


@pytest.fixture(scope="module")
def body(structured_block, graded):
    return block(structured_block, graded)


def touching(body, curvature, roller=None):
    """Undeformed bodies and the load [N/m]."""
    peak = 0.5 * SOFT.plane_strain_modulus * curvature
    contact = FiniteContact(body, HATS, roller or circle(1.0 / curvature), peak * HERTZ)
    return contact, 0.5 * np.pi * peak


def held(contact, load, steps=STEPS, friction=FRICTION):
    pressed = HeldContact(contact, friction)
    return list(pressed.history((part * load, share) for part, share in steps))


@pytest.fixture(scope="module")
def pressed(body):
    contact, load = touching(body, 0.1)
    return contact, load, held(contact, load)


def linear(body, gap, load):
    """The same loads on the linear body."""
    compliance, zero, unit = FiniteElementCompliance(body, HATS), np.zeros_like(X), np.eye(len(X))
    normal, across = np.moveaxis([compliance.moved(one, zero) for one in unit], 0, 2)
    along = np.stack([compliance.moved(zero, one)[1] for one in unit], axis=1)
    pair = SurfacePair(
        weighted_gap=gap,
        weights=np.full_like(X, EDGE),
        x=X,
        friction=FRICTION,
        hardness=np.inf,
        tangential=lambda traction: along @ traction,
        solve_normal=partial(solve_contact, DenseCompliance(normal)),
        solve_tangential=partial(solve_contact, DenseCompliance(along)),
        raised=lambda traction: across.T @ traction,
        dragged=lambda pressure: across @ pressure,
    )
    return list(history(pair, (Loads(p * load, s * FRICTION * p * load) for p, s in STEPS)))


def test_small_loads_are_those_of_small_strains(body):
    """Tractions, way and work, loading and unloading: the difference falls with the load."""
    left = []
    for curvature in (0.02, 0.01):
        contact, load = touching(body, curvature)
        rows = zip(held(contact, load), linear(body, contact.gap, load), strict=True)
        for finite, small in list(rows)[2:]:
            apart = finite.traction - small.traction
            left.append(
                [
                    np.linalg.norm(apart) / np.linalg.norm(small.traction),
                    abs(finite.way / small.displacement - 1.0),
                    abs(finite.work / small.work - 1.0),
                ]
            )
    before, after = np.split(np.array(left), 2)
    orders = np.log2(before / after)
    assert np.all(np.abs(orders - 1.0) < 0.03) and after[1].max() < 0.02


def test_near_sliding_it_is_what_slides(body, pressed):
    """Pressures, where they are on the roller: the difference falls with what sticks, until the
    last hat does."""
    contact, load, states = pressed
    sliding = FiniteContact(body, HATS, contact.roller, contact.start, FRICTION).by_newton(load)
    friction, state, off = HeldContact(contact, FRICTION), states[3], []
    for share in (0.9, 0.99, 0.999):
        state = friction.stepped(state, load, share)
        there = np.interp(sliding.place, state.place, state.pressure)
        off.append(np.abs(there - sliding.pressure).max() / sliding.pressure.max())
    assert off[1] < 0.2 * off[0] and off[2] < off[1] < 0.006  # the same hats stand elsewhere
    assert state.approach == pytest.approx(sliding.approach, rel=5e-4)


def test_little_friction_is_none(body):
    contact, load = touching(body, 0.1)
    smooth, off = contact.by_newton(load), []
    for friction in (2e-3, 1e-3):
        state = held(contact, load, STEPS[:3], friction)[-1]
        off.append(np.abs(state.pressure - smooth.pressure).max() / smooth.pressure.max())
    assert abs(np.log2(off[0] / off[1]) - 1.0) < 0.1 and off[1] < 0.01


def elastic_energy(contact, displacement):
    """Work of the internal forces [J/m] on the straight way there."""
    at, weight = np.polynomial.legendre.leggauss(5)
    forces = [contact.response.force(0.5 * (1.0 + t) * displacement) for t in at]
    return 0.5 * sum(w * np.sum(f * displacement) for w, f in zip(weight, forces, strict=True))


def test_work_is_elastic_energy_and_friction(pressed, body):
    """Up to what steps leave out: of second order in their length."""
    contact, load, states = pressed
    off = []
    for count in (2, 4, 8):
        friction, before = HeldContact(contact, FRICTION), states[2]
        start, work, lost = before, 0.0, 0.0
        for share in 0.3 + 0.5 * np.arange(1, count + 1) / count:
            after = friction.stepped(before, load, share)
            pulls = [forces(contact, state) for state in (before, after)]
            way = after.way - before.way, after.approach - before.approach
            work += 0.5 * np.sum(pulls, axis=0) @ way
            lost += after.work
            before = after
        stored = [elastic_energy(contact, state.displacement) for state in (start, before)]
        off.append(abs(work - lost - np.diff(stored)[0]) / lost)
    orders = np.log2(np.divide(off[:-1], off[1:]))
    assert np.all((orders > 1.8) & (orders < 3.0)) and off[-1] < 1e-3


def forces(contact, state):
    """On the body along x and down [N/m]."""
    terms = contact.contact.at(state.displacement, state.pressure, state.traction)
    applied = terms.gradient @ state.pressure + terms.drag.force @ state.traction
    return applied.reshape(-1, 2)[: len(contact.body.nodes)].sum(axis=0)


def test_a_stiff_roller_is_the_rigid_one(body, structured_block, graded):
    curvature = 0.1
    steel = Material(1e4, 0.3)
    roller = block(structured_block, graded, steel, lambda x: -0.5 * curvature * x**2)
    shapes = parabola(1.0 / curvature), FiniteElementCompliance(roller, HATS)
    ends = []
    for shape in shapes:
        contact, load = touching(body, curvature, shape)
        ends.append(held(contact, load)[3])
    rigid, stiff = ends
    for name in ("pressure", "traction", "slip", "way", "work", "approach"):
        one, other = (np.asarray(getattr(state, name)) for state in (stiff, rigid))
        assert np.abs(one - other).max() < 1e-3 * np.abs(other).max(), name
