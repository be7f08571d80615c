"""A body pressed without linearisation: Newton's convergence, the linear limit, finite effects.

Lengths in half-widths of the contact that Hertz expects, stresses in Young's moduli.
"""

import numpy as np
import pytest
from nodal_stress import nodal_stress
from pressed_bodies import press_finitely, press_linearly, under_a_circle
from scenes import hat_nodes

from analytic.exact.westergaard import westergaard_from_mean_pressure
from analytic.material import Material
from analytic.stress_state import von_mises
from fem.body.elasticity import Support, elastic_body
from fem.contact import nonlinear as nonlinear_contact
from fem.contact.nonlinear import RESIDUAL
from fem.contact.rigid_roller import CurrentContact, circle, parabola
from fem.solver.mumps import FemError
from fem.stress.maximum import highest_node
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

POISSON = 0.3
MODULUS = 1.0 / (1.0 - POISSON**2)
EDGE = 0.1
HATS = hat_nodes(-1.3, EDGE, 27)
X = HATS[1:-1]
HERTZ = np.sqrt(np.maximum(1.0 - X**2, 0.0))


def peak(curvature):
    """Hertz's peak pressure for a/R."""
    return 0.5 * MODULUS * curvature


def make(size=1.0, height=None, modulus=1.0):
    refined = size * np.array([[-1.5, 1.5]])
    mesh = build_block(BlockSpec(60.0 * size, 60.0 * size, refined, EDGE * size, 0.25))
    if height is not None:
        mesh = roughen(mesh, height)
    return elastic_body(mesh, Material(modulus, POISSON), Support("bonded", "fixed"))


@pytest.fixture(scope="module")
def body():
    return make()


def pressed(body, curvature, **wanted):
    return under_a_circle(body, HATS, curvature, 0.5 * np.pi * peak(curvature), **wanted)


def test_newton_converges_quadratically(body):
    """Once the hats' states stay: each residual is about the square of the one before."""
    _, state = pressed(body, 0.2)
    history = np.array(state.solution.residuals[-1])
    late = np.log10(history[(history < 0.5) & (history > 1e-11)])  # below is round-off
    orders = np.diff(late[1:]) / np.diff(late[:-1])
    assert len(orders) >= 1
    assert np.all((orders > 1.7) & (orders < 2.4)), history
    assert history[-1] < RESIDUAL
    assert len(state.solution.residuals) == 1
    assert state.solution.iterations <= 8


def test_small_loads_are_the_linear_theorys(body):
    """Pressure and stresses: the difference vanishes in proportion to p0/E."""
    left = []
    for curvature in (0.04, 0.02, 0.01):
        start, state = pressed(body, curvature)
        stress = nodal_stress(body, start.displacements[0], HATS, start.pressure).stress
        deep = (body.points[:, 1] > 0.3) & (body.points[:, 1] < 2.0)
        off = np.abs(state.cauchy.nodal.stress.tau1 - stress.tau1)[deep].max()
        peaks = state.pressure.max() - start.pressure.max()
        cauchy = state.cauchy_pressure.max() - start.pressure.max()
        left.append(np.abs([peaks, cauchy, off]) / peak(curvature))
    orders = np.log2(np.divide(left[:-1], left[1:]))
    assert np.all(np.abs(orders - 1.0) < 0.15), orders
    assert left[0][1] == pytest.approx(0.0028, rel=0.1)


def test_a_sinusoid_under_a_flat_differs_by_less_than_half_a_per_cent():
    """Peak slope 0.025, p0/E = 0.015: the pressure rises by 0.42 %, per undeformed length it falls.

    Other laws of the same small strains give 0.29 and 0.22 % (lambda/4 (J^2 - 1 - 2 ln J) and
    lambda/2 (J - 1)^2 in place of lambda/2 (ln J)^2).
    """
    wave = 1.0
    amplitude = 0.025 * wave / (2.0 * np.pi)
    closing = np.pi * MODULUS * amplitude / wave
    mean = closing * (0.015 / (2.0 * closing)) ** 2
    exact = westergaard_from_mean_pressure(mean, wave, amplitude, MODULUS)
    assert exact.peak_pressure == pytest.approx(0.015)
    edge = wave / 64.0
    spec = BlockSpec(0.5 * wave, wave, np.array([[-0.5, 0.5]]) * wave, edge, 0.2)
    mesh = roughen(build_block(spec), lambda x: amplitude * np.cos(2.0 * np.pi * x / wave))
    body = elastic_body(mesh, Material(1.0, POISSON), Support("bonded", "rollers"))
    hats = hat_nodes(-20 * edge, edge, 41)
    flat, start = parabola(np.inf), exact.pressure(hats[1:-1])
    gap = CurrentContact(body, hats, flat).at(0.0 * body.nodes, start).gap
    load = exact.load_per_wavelength
    rest = press_linearly(body, hats, gap, start, load).pressure
    assert rest.max() == pytest.approx(0.015, rel=5e-3)
    state = press_finitely(body, hats, flat, rest, load=load)
    assert state.cauchy_pressure.max() / rest.max() - 1.0 == pytest.approx(0.0042, abs=1e-4)
    assert state.pressure.max() / rest.max() - 1.0 == pytest.approx(-0.0016, abs=1e-4)


def test_the_surface_lies_on_the_circle_where_it_is_pressed(body):
    """And what presses on the deformed surface bears the load."""
    curvature = 0.2
    _, state = pressed(body, curvature)
    place = (body.points + body.at_points(state.displacement))[body.top.point]
    inner = np.abs(body.top.x) < 0.7
    x, z = place[inner].T
    depth = state.approach - (1.0 / curvature - np.sqrt(1.0 / curvature**2 - x**2))
    assert np.abs(z - depth).max() < 1e-4 * state.approach
    assert state.gap.min() > -1e-9 * state.approach
    assert np.all(state.gap[state.pressure > 0.0] < 1e-9 * state.approach)
    width = np.diff(state.place, prepend=np.nan, append=np.nan)
    width = 0.5 * (width[:-1] + width[1:])[1:-1]
    total = (state.cauchy_pressure[1:-1] * width).sum()
    assert total == pytest.approx(state.solution.state.load, rel=1e-3)
    assert state.solution.state.load == pytest.approx(EDGE * state.pressure.sum(), rel=1e-12)


def test_stress_at_the_surface_is_the_pressures(body):
    """Across the deformed surface -p, along it friction p, at every point that is pressed."""
    _, state = pressed(body, 0.2, friction=0.2)
    top = body.top.point
    place = (body.points + body.at_points(state.displacement))[top]
    chord = place[2::2] - place[:-2:2]
    t = chord / np.linalg.norm(chord, axis=1)[:, None]
    n = np.column_stack([t[:, 1], -t[:, 0]])
    stress = state.cauchy.nodal.stress
    sx, sz, txz = (value[top][1::2] for value in (stress.sx, stress.sz, stress.txz))
    across = sx * n[:, 0] ** 2 + sz * n[:, 1] ** 2 + 2.0 * txz * n[:, 0] * n[:, 1]
    shear = sx * n[:, 0] * t[:, 0] + sz * n[:, 1] * t[:, 1]
    shear += txz * (n[:, 0] * t[:, 1] + n[:, 1] * t[:, 0])
    pressure = np.interp(body.top.x[1::2], X, state.cauchy_pressure)
    scale = pressure.max()
    np.testing.assert_allclose(across, -pressure, atol=5e-3 * scale)
    np.testing.assert_allclose(shear, 0.2 * pressure, atol=2e-3 * scale)


def test_the_largest_von_mises_stress_is_looked_for_where_it_is_high(body):
    """And found without most of the other stresses."""
    _, state = pressed(body, 0.2, friction=0.2)
    whole, across = state.cauchy.nodal.stress, state.cauchy.across
    _, again = pressed(body, 0.2, friction=0.2)
    window = (-1.0, 1.0, 1.0)
    top = highest_node(body, again.cauchy.nodal, again.cauchy.across, window)
    x, z = body.points.T
    mises = np.where((np.abs(x) <= 1.0) & (z <= 1.0), von_mises(whole, across), 0.0)
    assert top.value == pytest.approx(mises.max(), rel=1e-9)
    assert [top.x, top.z] == list(body.points[np.argmax(mises)])
    assert again.cauchy.known.mean() < 0.6


def test_friction_moves_the_contact_as_in_the_linear_theory(body):
    """Coupled there too: a rigid roller on a body that is not incompressible."""
    curvature, friction = 0.005, 0.3
    load = 0.5 * np.pi * peak(curvature)
    gap = 0.5 * EDGE * curvature * (X**2 + EDGE**2 / 6.0)
    rest = press_linearly(body, HATS, gap, peak(curvature) * HERTZ, load, friction)
    one, other = (
        press_finitely(
            body, HATS, circle(1.0 / curvature), rest.pressure, load=load, friction=sense * friction
        )
        for sense in (1.0, -1.0)
    )

    def centre(place, pressure):
        return place @ pressure / pressure.sum()

    expected = centre(X, rest.pressure)
    assert expected < -0.05  # against the sliding
    assert centre(one.place, one.pressure) == pytest.approx(expected, rel=0.01)
    assert centre(other.place, other.pressure) == pytest.approx(-expected, rel=0.01)
    # dragged along, the body stands back by as much under the roller
    for state in (one, other):
        along = np.interp(X, body.top.x, body.at_points(state.displacement)[body.top.point, 0])
        assert abs(centre(along, state.pressure)) < 1e-3 * EDGE
    held = body.held[:, 0]
    assert one.displacement[held, 0].max() < -1e-3 and other.displacement[held, 0].min() > 1e-3


def test_a_reversed_profile_gives_the_mirrored_pressure():
    def height(x):
        return 0.004 * np.sin(7.0 * x + 0.6) * np.exp(-((x / 1.6) ** 6))

    curvature = 0.05
    states = [
        press_finitely(
            make(height=way),
            HATS,
            circle(1.0 / curvature),
            peak(curvature) * HERTZ,
            load=0.5 * np.pi * peak(curvature),
        )
        for way in (height, lambda x: height(-x))
    ]
    left, right = (state.cauchy_pressure for state in states)
    assert np.abs(left - left[::-1]).max() > 0.2 * left.max()
    # the triangles below are not mirrored
    np.testing.assert_allclose(left, right[::-1], atol=5e-3 * left.max())


def test_the_approach_and_units_lead_to_the_same(body):
    curvature = 0.1
    _, state = pressed(body, curvature)
    _, again = pressed(body, curvature, load=None, approach=state.approach)
    np.testing.assert_allclose(again.pressure, state.pressure, atol=1e-7 * state.pressure.max())
    size, modulus = 1e-6, 1e11
    small = make(size, modulus=modulus)
    other = press_finitely(
        small,
        size * HATS,
        circle(size / curvature),
        modulus * state.pressure,
        load=size * modulus * state.solution.state.load,
    )
    near = 3e-6 * state.pressure.max()
    np.testing.assert_allclose(other.pressure / modulus, state.pressure, atol=near)
    assert other.approach == pytest.approx(size * state.approach, rel=1e-6)


def test_pressure_is_capped_at_the_hardness(body):
    hardness = 0.7 * peak(0.1)
    _, state = pressed(body, 0.1, hardness=hardness)
    full = state.cauchy_pressure > hardness * (1.0 - 1e-5)
    assert np.all(state.cauchy_pressure < hardness * (1.0 + 1e-5))
    assert 15 < full.sum() < 25
    assert np.ptp(state.pressure[full]) > 1e-4 * hardness  # by undeformed area it is no constant
    assert np.all(state.gap[full] < 1e-9)
    assert state.solution.state.load == pytest.approx(EDGE * state.pressure.sum(), rel=1e-9)


def test_a_load_that_inverts_elements_is_an_error(body, monkeypatch):
    monkeypatch.setattr(nonlinear_contact, "LEAST_INCREMENT", 0.4)
    with pytest.raises(FemError, match="did not converge beyond"):
        press_finitely(body, HATS, parabola(np.inf), HERTZ, load=50.0)


@pytest.mark.parametrize("hardness", [np.inf, 1.02])
def test_pressure_and_friction_bear_the_load_together(body, hardness):
    """The vertical force on the body, friction's on tilted tangents included; under a contact that
    friction shifts, pressures alone press with another."""
    curvature, friction = 0.2, 0.5
    top, load = peak(curvature), 0.5 * np.pi * peak(curvature)
    options = {"friction": friction, "hardness": hardness * top}
    state = press_finitely(body, HATS, circle(1.0 / curvature), top * HERTZ, load, **options)
    contact = CurrentContact(body, HATS, circle(1.0 / curvature), friction)
    _, force = contact.loaded(state.displacement, state.pressure)
    assert force[1::2].sum() == pytest.approx(load, rel=2e-7)
    assert state.load == pytest.approx(load, rel=2e-7)
    pressing = state.pressure.sum() * EDGE / load
    assert 0.98 < pressing < 0.999
