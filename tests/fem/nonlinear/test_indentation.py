"""Wedge and cylinder sunk into a nearly rigid metal at finite strains, beside slip lines.

A smooth wedge raises straight lips. Its slip lines are straight below flank and lip, both of one
length, with a fan between them: it bears 2 k (1 + fan) (Hill, Lee and Tupper 1947, Proc. R. Soc.
A 188, 273-289; Hill 1950, The Mathematical Theory of Plasticity, ch. VIII), k = Y / sqrt 3."""

from dataclasses import replace

import numpy as np
import pytest
from flat_punch import LIMIT
from scipy.optimize import brentq

from analytic.material import Law, Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import Support, elastic_body
from fem.contact.nonlinear import state_at_rest
from fem.contact.rigid_roller import CurrentContact, circle
from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.newton import newton_by_contacts
from fem.nonlinear.plasticity import ElasticPlastic
from fem.solver.mumps import FemError
from meshes.block import BlockSpec
from meshes.build import build_block

EDGE, TWICE_SHEAR = 0.1, 2.0 / np.sqrt(3.0)


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
    metal, reach = Material(1e3, 0.3, Law("hencky")), 1.2
    window = (-1.5, 1.5, 1.2, 2.2 * EDGE)
    spec = BlockSpec(12.0, 12.0, np.array([[-reach, reach]]), EDGE, 0.3, window)
    body = elastic_body(build_block(spec), metal, Support("bonded", "fixed"))
    hats = np.linspace(-reach, reach, round(2.0 * reach / EDGE) + 1)
    at, weights = hats[1:-1], np.full(len(hats) - 2, EDGE)
    plastic = FinitePlasticBody(body, ElasticPlastic(metal, Hardening(1.0)))
    bodies = [(plastic, CurrentContact(body, hats, roller))]
    state = last = state_at_rest(bodies, (np.abs(at) < 0.5 * EDGE).astype(float))
    gap, rows = bodies[0][1].loaded(np.zeros_like(body.nodes), 0.0 * at)[0] / weights, []
    now, way = gap.min(), step
    while now < depth:
        part = way / max(state.approach - last.approach, way)
        moved = state.displacements[0] + part * (state.displacements[0] - last.displacements[0])
        start = replace(state, displacements=(moved,))
        try:
            end, _ = newton_by_contacts(
                bodies, 0.0 * at, weights, start, approach=now + way, residual=1e-5
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
    half_width, pressure, rise = sunk(wedge(tangent), EDGE * tangent / 8.0, 0.178)
    slip = TWICE_SHEAR * (1.0 + fan(np.pi / 3.0))
    late = half_width > 3.2 * EDGE  # a hat that has just touched bears little of its share
    assert late.sum() > 4 and rise[-1] > 0.09
    np.testing.assert_allclose(pressure[late], slip, rtol=0.09)
    assert pressure[late].mean() == pytest.approx(slip, rel=0.04)


def test_a_cylinder_is_followed_to_four_fifths_of_its_radius():
    """Slip lines of a smooth face at the angle t to a level surface turn by pi/2 - t, so that it
    bears 2 k (1 + pi/2 - t); the material that rises beside the roller takes from that (Jackson
    2018, J. Appl. Mech. 85, 024501, neglects it, too)."""
    half_width, pressure, rise = sunk(circle(1.0), 0.01, 0.25)
    angle = np.arcsin(half_width)
    slip = TWICE_SHEAR * (1.0 + np.pi / 2.0 - angle + np.tan(angle / 2.0))
    late = half_width > 0.66
    assert half_width[-1] > 0.77 and rise[-1] > 0.14
    np.testing.assert_allclose(pressure[late], slip[late], rtol=0.055)
