"""Coated bodies at finite deformation: one of a kind is the plain body, small loads are linear.

Lengths in half-widths of the contact that Hertz expects on the plain body, stresses in its
modulus."""

from functools import cache

import numpy as np
import pytest
from nodal_stress import nodal_stress
from pressed_bodies import press_finitely, press_linearly
from scenes import hat_nodes

from analytic.material import Law, Material
from fem.body.coating import Coating
from fem.body.elasticity import Support, elastic_body
from fem.contact.rigid_roller import circle
from fem.stress.recovery import stress_nodes
from meshes.block import BlockSpec
from meshes.build import build_block

PLAIN = Material(1.0, 0.3)
HARD = Material(3.0, 0.2)
THICKNESS, EDGE = 0.4, 0.1
HATS = hat_nodes(-1.6, EDGE, 33)
X = HATS[1:-1]


@cache
def mesh():
    ranges = np.array([[-1.7, 1.7]])
    return build_block(BlockSpec(60.0, 60.0, ranges, EDGE, 0.25, interface=THICKNESS))


@cache
def body(coat: Material | None, below: Material = PLAIN):
    coating = coat and Coating(coat, THICKNESS)
    return elastic_body(mesh(), below, Support("bonded", "fixed"), coating=coating)


def pressed(solid, curvature: float):
    """Contact by the linear theory and at finite deformation."""
    peak = 0.5 * curvature / (1.0 - 0.3**2)
    load, start = 0.5 * np.pi * peak, peak * np.sqrt(np.maximum(1.0 - X**2, 0.0))
    gap = 0.5 * EDGE * curvature * (X**2 + EDGE**2 / 6.0)
    linear = press_linearly(solid, HATS, gap, start, load)
    return linear, press_finitely(solid, HATS, circle(1.0 / curvature), linear.pressure, load)


@pytest.mark.parametrize("law", [Law(), Law("st-venant-kirchhoff")], ids=lambda law: law.name)
def test_a_coating_of_the_bodys_own_kind_is_none(law):
    kind = Material(1.0, 0.3, law)
    (_, plain), (_, coated) = (pressed(body(coat, kind), 0.2) for coat in (None, kind))
    assert coated.cauchy_pressure == pytest.approx(plain.cauchy_pressure, rel=1e-6, abs=1e-8)
    point = stress_nodes(body(kind, kind)).point
    assert len(point) > len(mesh().points)  # two nodes where the materials meet
    assert coated.cauchy.estimate.shape == (len(point), 3)
    inside = np.abs(mesh().points[point]).max(axis=1) < 2.0
    inside &= np.abs(mesh().points[point, 1] - THICKNESS) > 0.3  # patches are of one material
    other, layered = plain.cauchy.nodal.values[point], coated.cauchy.nodal.values
    assert layered[inside] == pytest.approx(other[inside], abs=2e-3 * np.abs(other).max())


def test_small_loads_are_the_linear_theorys():
    """The difference vanishes in proportion to the strain."""
    left = []
    for curvature in (0.04, 0.02, 0.01):
        solid = body(HARD)
        linear, finite = pressed(solid, curvature)
        small = nodal_stress(solid, linear.displacements[0], HATS, linear.pressure).values
        inside = np.abs(mesh().points[stress_nodes(solid).point]).max(axis=1) < 1.5
        change = (
            np.abs(finite.cauchy.nodal.values - small)[inside].max() / np.abs(small[inside]).max()
        )
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
