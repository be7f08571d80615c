"""A rigid roller at the current place: its shapes, the gap's derivative, forces in balance."""

import numpy as np
import pytest
from blocks import moved, structured_block
from scenes import hat_nodes
from scipy.integrate import trapezoid

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.body.surface import hat_forces
from fem.contact.rigid_roller import STEEPEST, CurrentContact, circle, parabola

RADIUS = 3.0
HATS = hat_nodes(-0.8, 0.16, 11)


@pytest.fixture(scope="module")
def body():
    mesh = structured_block(
        np.linspace(-1.5, 1.5, 13), np.linspace(0.0, 1.0, 4), lambda x: 0.1 * np.cos(3 * x), seed=2
    )
    return elastic_body(mesh, Material(1.0, 0.3), Support())


PRESSURE = 1.0 + np.cos(3.0 * HATS[1:-1])


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


def test_undeformed_it_is_the_linear_theorys(body):
    """Forces along the roller's normal, and the gap to the real boundary."""
    terms = CurrentContact(body, HATS, parabola(RADIUS)).at(0.0 * body.nodes, PRESSURE)
    forces = hat_forces(body.surface, HATS, lambda x: (x / RADIUS, np.ones_like(x)))
    component = (2 * body.surface.point[:, None] + np.arange(2)).ravel()
    np.testing.assert_allclose(terms.force.toarray()[component], forces.toarray(), atol=1e-15)
    assert abs(terms.force).sum() == pytest.approx(abs(forces).sum())
    hat = np.interp(fine := np.linspace(-1.0, 1.0, 200001), HATS, np.eye(len(HATS))[4])
    x, z = body.points[body.top.point].T
    edge = np.clip(np.searchsorted(x[::2], fine) - 1, 0, len(x) // 2 - 1)
    t = (fine - x[::2][edge]) / np.diff(x[::2])[edge]
    surface = z[::2][edge] * (1 - t) * (1 - 2 * t) + z[1::2][edge] * 4 * t * (1 - t)
    surface = surface + z[2::2][edge] * t * (2 * t - 1)
    wanted = trapezoid(hat * (surface + fine**2 / (2 * RADIUS)), fine)
    assert terms.gap[3] == pytest.approx(wanted, rel=1e-7)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_derivatives(body, friction):
    contact = CurrentContact(body, HATS, circle(RADIUS), friction)
    at, step, h = moved(body, 0.1, 1), moved(body, 1.0, 2), 1e-5
    terms = contact.at(at, PRESSURE)
    ahead, behind = (contact.at(at + way * h * step, PRESSURE) for way in (1, -1))
    gap = (ahead.gap - behind.gap) / (2 * h)
    np.testing.assert_allclose(terms.gradient.T @ step.ravel(), gap, atol=1e-9 * abs(gap).max())
    force = (ahead.force - behind.force) @ PRESSURE / (2 * h)
    scale = np.abs(force).max()
    np.testing.assert_allclose(terms.stiffness @ step.ravel(), force, atol=1e-8 * scale)
    assert contact.frictionless is not bool(friction)
    if not friction:
        assert terms.force is terms.gradient


def test_forces_are_along_the_current_normal_and_tangent(body):
    """In sum: the load is the pressure's, and friction pulls towards +x along the tangent."""
    friction, at = 0.3, moved(body, 0.1, 1)
    force = CurrentContact(body, HATS, circle(RADIUS)).at(at, PRESSURE).force @ PRESSURE
    pulled = CurrentContact(body, HATS, circle(RADIUS), friction).at(at, PRESSURE).force @ PRESSURE
    along, down = force.reshape(-1, 2).sum(axis=0)
    assert down == pytest.approx(0.16 * PRESSURE.sum(), rel=1e-13)
    pulled_along, pulled_down = pulled.reshape(-1, 2).sum(axis=0)
    assert pulled_along - along == pytest.approx(friction * down, rel=1e-13)
    assert pulled_down - down == pytest.approx(-friction * along, rel=1e-12)
