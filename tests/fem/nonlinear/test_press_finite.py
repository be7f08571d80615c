"""A roller on a body that flows at finite strains: the elastic limit, the limit of small strains,
first yield, energy, limit load, release."""

import numpy as np
import pytest
from flat_punch import LIMIT, punch_pressures
from scenes import hat_nodes

from analytic.material import Law, Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.rigid_roller import CurrentContact, circle, parabola
from fem.nonlinear import finite_deformation, hyperelastic
from fem.nonlinear.finite_deformation import FiniteContact
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_finite import press_plastically_finitely
from fem.nonlinear.press_plastic import plastic_fields, press_plastically
from meshes.block import BlockSpec
from meshes.build import build_block

NU = 0.3
METAL = Material(1.0, NU, Law("hencky"))
EDGE = 1.0 / 6.0
HATS = hat_nodes(-11 * EDGE, EDGE, 23)
X = HATS[1:-1]
HERTZ = np.sqrt(np.maximum(1.0 - X**2, 0.0))


@pytest.fixture(scope="module")
def body(structured_block, graded):
    beyond = graded(6.0, 0.3, 1.4)
    x = np.concatenate([-2.0 - beyond[:0:-1], np.linspace(-2.0, 2.0, 25), 2.0 + beyond[1:]])
    return elastic_body(structured_block(x, graded(8.0, 0.14, 1.2)), METAL, Support())


@pytest.fixture(scope="module")
def roller(structured_block, graded):
    """Elastic, of radius 10 as a parabola, in its own frame on the body's hats."""
    beyond = graded(6.0, 0.3, 1.4)
    x = np.concatenate([-2.0 - beyond[:0:-1], np.linspace(-2.0, 2.0, 25), 2.0 + beyond[1:]])
    mesh = structured_block(x, graded(8.0, 0.14, 1.2), lambda x: -0.05 * x**2)
    return FiniteElementCompliance(elastic_body(mesh, METAL, Support()), HATS)


def touching(body, curvature, friction=0.0, roller=None):
    """Contact on half-width 1 of linear bodies, the load [N/m] and the peak pressure [Pa]."""
    peak = 0.5 * METAL.plane_strain_modulus * curvature / (1 + (roller is not None))
    shape = roller or circle(1.0 / curvature)
    return FiniteContact(body, HATS, shape, peak * HERTZ, friction), 0.5 * np.pi * peak, peak


@pytest.mark.parametrize(("elastic", "friction"), [(False, 0.0), (True, 0.2)])
def test_without_flow_it_is_henckys_law(body, roller, monkeypatch, elastic, friction):
    monkeypatch.setattr(hyperelastic, "quadrature_degree", lambda *_: 2)
    monkeypatch.setattr(finite_deformation, "ASIDE", 1e-7)
    monkeypatch.setattr(finite_deformation, "LEANING", 1e-11)
    contact, load, peak = touching(body, 0.1, friction, roller if elastic else None)
    wanted = contact.by_newton(load)
    metal = ElasticPlastic(METAL, Hardening(1e3))
    _, (state,) = press_plastically_finitely(contact, metal, [load])
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
        _, (small,) = press_plastically(contact.compliance, metal, gap, weights, [load], start, 0.1)
        _, (finite,) = press_plastically_finitely(contact, metal, [load])
        off = np.linalg.norm(finite.pressure - small.pressure) / np.linalg.norm(small.pressure)
        strains = [one.state.equivalent.max() for one in (finite, small)]
        left.append([off, strains[0] / strains[1] - 1.0, finite.approach / small.approach - 1.0])
        assert strains[1] > 0.05 * curvature
    orders = np.log2(np.abs(np.divide(*left)))
    assert np.all((orders > 0.6) & (orders < 1.6)), (left, orders)
    assert np.abs(left[-1]).max() < 0.03


def energies(body, metal, contact):
    """Elastic and plastic energies [J/m]: Hooke's of Kirchhoff's stress, Voce's law integrated."""
    inside, across = body.stress(contact.displacement, contact.state)
    volume = np.linalg.det(np.eye(2) + body.gradient(contact.displacement))
    xx, zz, xz, yy = np.column_stack([inside, across]).T * volume
    elastic = (1.0 + NU) * (xx**2 + zz**2 + yy**2 + 2.0 * xz**2) - NU * (xx + zz + yy) ** 2
    elastic *= 0.5 / METAL.youngs_modulus
    line, weight = np.polynomial.legendre.leggauss(8)
    equivalent = contact.state.equivalent
    k = equivalent[:, None] * 0.5 * (1.0 + line)
    plastic = 0.5 * equivalent * (metal.hardening.stress(k) @ weight)
    area = body.areas.ravel()
    return area @ elastic, area @ plastic


def test_work_is_elastic_and_plastic_and_friction(body):
    """Of the load on the approach and of the support, which moves the body back along x, less what
    the tractions take: on finite strains, over increments that follow the contact."""
    contact, load, peak = touching(body, 0.1, 0.2)
    start = peak / 3.0
    metal = ElasticPlastic(METAL, Hardening(start, voce=(1.5 * start, 20.0)))
    loads = list(load * np.linspace(0.0, 1.0, 17)[1:])
    plastic, history = press_plastically_finitely(contact, metal, loads)
    normal, sliding = [np.zeros(body.unknowns)], [np.zeros(body.unknowns)]
    for state in history:
        both = contact.contact.loaded(state.displacement, state.pressure)[1]
        alone = CurrentContact(body, HATS, contact.roller)
        normal.append(alone.loaded(state.displacement, state.pressure)[1])
        sliding.append(both - normal[-1])
    moved = [np.zeros(body.unknowns), *(state.displacement.ravel() for state in history)]
    approach = [0.0, *(state.approach for state in history)]
    borne = [state.deformed.load for state in history]
    np.testing.assert_allclose(borne, loads, rtol=1e-7)
    loads = [0.0, *(float(contact.weights @ s.pressure) for s in history)]  # the rest rubs
    assert abs(loads[-1] / borne[-1] - 1.0) > 1e-4
    aside = [u.reshape(-1, 2)[body.held.all(axis=1)][0, 0] for u in moved]
    work = pushed = rubbed = supported = 0.0
    for k in range(1, len(loads)):
        work += 0.5 * (loads[k] + loads[k - 1]) * (approach[k] - approach[k - 1])
        way = moved[k] - moved[k - 1]
        pushed += 0.5 * (normal[k] + normal[k - 1]) @ way
        rubbed += 0.5 * (sliding[k] + sliding[k - 1]) @ way
        along = 0.5 * sum((normal[j] + sliding[j])[::2].sum() for j in (k, k - 1))
        supported -= along * (aside[k] - aside[k - 1])
    elastic, flowed = energies(plastic, metal, history[-1])
    assert history[-1].state.equivalent.max() > 0.02
    assert flowed > 0.2 * work
    assert pushed == pytest.approx(work, rel=2e-3)
    assert elastic + flowed - rubbed == pytest.approx(work + supported, rel=2e-3)
    assert abs(rubbed + supported) > 0.02 * work


def punched(edges):
    """Of a metal that is nearly rigid."""
    elastic, approaches = Material(2e6, NU), [1.5e-5, 3e-5, 5e-5]

    def contact_of(body, hats):
        return CurrentContact(body, hats, parabola(np.inf))

    return punch_pressures(edges, approaches, elastic, FinitePlasticBody, contact_of)


def test_elements_do_not_lock_in_flow():
    """The limit of a flat punch, (2 + pi) Y / sqrt 3, from above and to first order also at finite
    strains, where flow keeps the volume to the last digit."""
    coarse, fine = (punched(edges) for edges in (4, 8))
    errors = np.array([coarse[-1], fine[-1]]) / LIMIT - 1.0
    assert 0.0 < errors[1] < 0.035
    assert 0.7 < np.log2(errors[0] / errors[1]) < 1.3
    assert abs(fine[-1] / fine[-2] - 1.0) < 2e-3


def test_first_yield():
    """At 1.79 times the yield stress (von Mises), as in the linear theory for small p0/E."""
    window = (-1.3, 1.3, 1.0, 0.1)
    mesh = build_block(BlockSpec(100.0, 100.0, np.array([[-2.0, 2.0]]), 0.125, 0.3, window))
    body, flows = elastic_body(mesh, METAL, Support()), []
    for ratio in (1.79 * 0.98, 1.79 * 1.02):
        contact, load, peak = touching(body, 2e-3)
        _, (state,) = press_plastically_finitely(
            contact, ElasticPlastic(METAL, Hardening(peak / ratio)), [load]
        )
        flows.append(bool(state.state.equivalent.any()))
    assert flows == [False, True]


def test_released_and_pressed_again(body):
    """Without the roller nothing is left on any node; the same load leads back to the same."""
    contact, load, peak = touching(body, 0.1, 0.1)
    metal = ElasticPlastic(METAL, Hardening(peak / 2.4, peak))
    plastic, (pressed, released, again) = press_plastically_finitely(
        contact, metal, [load, 0.0, load]
    )
    assert not released.pressure.any()
    free = ~plastic.held
    left = plastic.force(released.displacement)[free]
    force = contact.contact.loaded(pressed.displacement, pressed.pressure)[1]
    stress, _ = plastic.stress(released.displacement, released.state)
    assert np.abs(stress).max() > 0.1 * metal.hardening.yield_stress
    fields = plastic_fields(plastic, released)
    assert np.abs(fields.stress.sz[body.surface.point]).max() < 0.2 * np.abs(stress).max()
    assert np.abs(force).max() > 1e-3 and released.displacement.max() > 1e-3
    assert left.shape[1:] == ()
    np.testing.assert_allclose(again.pressure, pressed.pressure, atol=2e-3 * peak)
    assert again.approach == pytest.approx(pressed.approach, rel=1e-4)


def test_a_cylinder_sinks_into_a_nearly_rigid_metal():
    """Slip lines of a smooth face at the angle t to a level surface turn by pi/2 - t, so that it
    bears 2 k (1 + pi/2 - t); the material that rises beside the roller is left out (Jackson 2018,
    J. Appl. Mech. 85, 024501, neglects it, too). Loads alone lead to a contact of 0.3 of the
    radius: between two hats that touch they hardly rise."""
    edge, reach, metal = 0.1, 0.8, Material(1e3, NU, Law("hencky"))
    spec = BlockSpec(8.0, 8.0, np.array([[-reach, reach]]), edge, 0.3, (-1.2, 1.2, 0.8, 2.2 * edge))
    body = elastic_body(build_block(spec), metal, Support("bonded", "fixed"))
    hats = np.linspace(-reach, reach, round(2.0 * reach / edge) + 1)
    start = 20.0 * np.sqrt(np.maximum(0.15**2 - hats[1:-1] ** 2, 0.0))
    contact = FiniteContact(body, hats, circle(1.0), start)
    angle = np.arcsin(0.5)
    slip = 2.0 / np.sqrt(3.0) * (1.0 + np.pi / 2.0 - angle + np.tan(angle / 2.0))
    _, (sunk,) = press_plastically_finitely(
        contact, ElasticPlastic(metal, Hardening(1.0)), [2.0 * 0.5 * slip]
    )
    place, on = sunk.deformed.place, np.flatnonzero(sunk.pressure)
    ends = 0.5 * (place[on[[0, -1]]] + place[on[[0, -1]] + [-1, 1]])  # of the last hats' shares
    assert sunk.load / np.ptp(ends) == pytest.approx(slip, rel=0.05)
    assert sunk.deformed.load == pytest.approx(sunk.load, rel=1e-9)
