"""Coated bodies at finite deformation: one of a kind is the plain body, small loads are linear; an
elastic coating on a body that flows: its limits, first flow below it, work and energy.

Lengths in half-widths of the contact that Hertz expects on the plain body; stresses in its modulus,
where it flows in its yield stress."""

from functools import cache

import numpy as np
import pytest
from blocks import graded, structured_block, widened
from flow_energy import AccountedHistory
from nodal_stress import nodal_stress
from pressed_bodies import MetalScene, press_linearly, under_a_circle
from scenes import hat_nodes

from analytic.exact.hertz import hertz_from_peak_pressure, hertz_stress
from analytic.material import Law, Material
from analytic.material.hardening import Hardening
from fem.body.coating import Coating
from fem.body.elasticity import Support, elastic_body
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_plastic import plastic_fields
from fem.stress.recovery import stress_nodes
from meshes.block import BlockSpec
from meshes.build import build_block

PLAIN = Material(1.0, 0.3)
HARDER = Material(3.0, 0.2)
OF_COATING, EDGE = 0.4, 0.1
HATS = hat_nodes(-1.6, EDGE, 33)


@cache
def mesh():
    ranges = np.array([[-1.7, 1.7]])
    return build_block(BlockSpec(60.0, 60.0, ranges, EDGE, 0.25, interface=OF_COATING))


@cache
def body(coat: Material | None, below: Material = PLAIN):
    coating = coat and Coating(coat, OF_COATING)
    return elastic_body(mesh(), below, Support("bonded", "fixed"), coating=coating)


def pressed(solid, curvature: float):
    """Contact by the linear theory and at finite deformation."""
    return under_a_circle(solid, HATS, curvature, 0.25 * np.pi * curvature / (1.0 - 0.3**2))


@pytest.mark.parametrize("law", [Law(), Law("st-venant-kirchhoff")], ids=lambda law: law.name)
def test_a_coating_of_the_bodys_own_kind_is_none(law):
    kind = Material(1.0, 0.3, law)
    (_, plain), (_, coated) = (pressed(body(coat, kind), 0.2) for coat in (None, kind))
    assert coated.cauchy_pressure == pytest.approx(plain.cauchy_pressure, rel=1e-6, abs=1e-8)
    point = stress_nodes(body(kind, kind)).point
    assert len(point) > len(mesh().points)  # two nodes where the materials meet
    assert coated.cauchy.estimate.shape == (len(point), 3)
    inside = np.abs(mesh().points[point]).max(axis=1) < 2.0
    inside &= np.abs(mesh().points[point, 1] - OF_COATING) > 0.3  # patches are of one material
    other, layered = plain.cauchy.nodal.values[point], coated.cauchy.nodal.values
    assert layered[inside] == pytest.approx(other[inside], abs=2e-3 * np.abs(other).max())


def test_small_loads_are_the_linear_theorys():
    """The difference vanishes in proportion to the strain."""
    left = []
    for curvature in (0.04, 0.02, 0.01):
        solid = body(HARDER)
        linear, finite = pressed(solid, curvature)
        small = nodal_stress(solid, linear.displacements[0], HATS, linear.pressure).values
        inside = np.abs(mesh().points[stress_nodes(solid).point]).max(axis=1) < 1.5
        nodal, scale = finite.cauchy.nodal.values, np.abs(small[inside]).max()
        change = np.abs(nodal - small)[inside].max() / scale
        pressure = np.abs(finite.pressure - linear.pressure).max() / linear.pressure.max()
        left.append((pressure, change))
    for column in np.array(left).T:
        assert column[2] < 0.02
        assert column[1:] / column[:-1] == pytest.approx(0.5, abs=0.12)


def test_each_region_has_its_own_law():
    """A harder law in the coating alone lies between both laws in all of the body."""
    hencky = Law("st-venant-kirchhoff")
    both = {
        name: pressed(body(Material(3.0, 0.2, coat), Material(1.0, 0.3, below)), 0.3)[1]
        for name, coat, below in (
            ("neo", Law(), Law()), ("mixed", hencky, Law()), ("other", hencky, hencky)
        )
    }  # fmt: skip
    peaks = {name: finite.cauchy_pressure.max() for name, finite in both.items()}
    low, high = sorted((peaks["neo"], peaks["other"]))
    assert low < peaks["mixed"] < high and high / low > 1.005
    surface = both["mixed"].cauchy.nodal.values[:, 1].min()
    assert -surface == pytest.approx(peaks["mixed"], rel=0.05)


METAL, HARD = Material(200.0, 0.3, Law("hencky")), Material(500.0, 0.2, Law("hencky"))
REACH = 11.0 / 6.0


@pytest.fixture(scope="module")
def mesh_of():
    """A block with a row of elements of a thickness at its surface."""
    x = widened(np.linspace(-2.0, 2.0, 25), graded(4.0, 0.3, 1.4))
    return lambda thickness: structured_block(x, np.append(0.0, thickness + graded(6.0, 0.14, 1.2)))


def coated(mesh_of, ratio, thickness, coat, **hardening):
    return MetalScene(
        *(mesh_of(thickness), ratio, 6, REACH),
        coating=coat and Coating(coat, thickness),
        **hardening,
    )


def test_below_yield_it_is_the_elastic_coating(mesh_of):
    scene = coated(mesh_of, 2.4, 0.3, HARD)
    scene.metal = ElasticPlastic(scene.metal.elastic, Hardening(1e6))
    body, hats, start = scene.pressed.body, scene.pressed.hats, scene.hertz.pressure(scene.x)
    wanted = press_linearly(body, hats, scene.gap, start, scene.hertz.load_per_length)
    _, (contact,) = scene.press([1.0])
    np.testing.assert_allclose(contact.pressure, wanted.pressure, atol=1e-9)
    np.testing.assert_allclose(contact.displacement, wanted.displacements[0], atol=1e-11)


def test_a_thin_coating_of_the_bodys_own_kind_vanishes(mesh_of):
    """It holds what would flow at the surface: the difference falls with its thickness."""
    left = []
    for thickness in (0.1, 0.05, 0.025):
        scenes = (coated(mesh_of, 3.0, thickness, coat, hardening=2.0) for coat in (None, METAL))
        bare, under = (scene.press([1.0], 0.1)[1][0].pressure for scene in scenes)
        left.append(np.linalg.norm(under - bare) / np.linalg.norm(bare))
    orders = np.log2(np.divide(left[:-1], left[1:]))
    assert np.all((orders > 0.8) & (orders < 1.3)), (left, orders)
    assert left[-1] < 0.03


THICKNESS = 1.0


def test_first_flow_is_below_the_coating():
    """Where Hertz's equivalent stress below its lower side reaches the yield stress."""
    x, z = np.meshgrid(np.linspace(-1.0, 1.0, 81), np.linspace(THICKNESS, 2.0, 41))
    most = hertz_stress(hertz_from_peak_pressure(1.0, 0.5, 1.0), x, z, 0.0).von_mises(0.3).max()
    window = (-1.3, 1.3, 1.3, 0.06)
    spec = BlockSpec(300.0, 300.0, np.array([[-1.3, 1.3]]), 0.1, 0.3, window, interface=THICKNESS)
    mesh, coating = build_block(spec), Coating(METAL, THICKNESS)
    for part, flows in ((0.97, False), (1.03, True)):
        scene = MetalScene(mesh, part / most, 10, 1.2, elastic=True, coating=coating)
        plastic, (contact,) = scene.press([1.0], travel=np.inf)
        assert contact.state.equivalent.any() == flows
    below = plastic.points[contact.state.equivalent > 0.0]
    assert THICKNESS < below[:, 1].min() < below[:, 1].max() < THICKNESS + 0.2
    fields = plastic_fields(plastic, contact)
    nodes = stress_nodes(plastic.body)
    assert len(fields.equivalent_strain) == len(nodes.point) > len(mesh.points)


def test_work_is_elastic_and_plastic(mesh_of):
    """Work of the load on the approach, over increments of a frictionless contact."""
    scene, loads = coated(mesh_of, 4.0, 0.3, HARD, hardening=2.0), np.linspace(0.0, 1.0, 17)[1:]
    way, history = scene.led(AccountedHistory, loads, 0.0)
    load = np.append(0.0, [contact.load for contact in history])
    approach = np.append(0.0, [contact.approach for contact in history])
    work = np.sum(0.5 * (load[1:] + load[:-1]) * np.diff(approach))
    energies = way.energies[-1]
    assert energies.flowed > 0.1 * work
    assert energies.stored + energies.flowed == pytest.approx(work, rel=2e-3)
    assert not history[-1].state.equivalent[np.repeat(way.body.body.coated, 3)].any()
