"""Hats against the printed fields of line and triangle loads, and of strips that they stand for.

    P, Q at x = 0             line load [N/m]
    p, q at x = 0, linear to zero at -a and a    triangle [Pa]

P and p press into the body, Q and q act on it in +x; r, t distance and angle from x, r1, t1 from
x - a and r2, t2 from x + a, t = atan2(z, x). Stresses, tension positive (Johnson 1985, sections
2.2 to 2.5):

    line      sx, txz, sz = -(2/pi) (x^2 z, x z^2, z^3) P/r^4
              sx, txz, sz = -(2/pi) (x^3, x^2 z, x z^2) Q/r^4
    triangle  sz = (p/pi a) ((x-a) t1 + (x+a) t2 - 2 x t),  sx = sz + (2 p z/pi a) ln(r1 r2/r^2)
              txz = -(p z/pi a) (t1 + t2 - 2 t)
              sx = (q/pi a) (3 z (t1+t2-2t) - 2 ((x-a) ln r1 + (x+a) ln r2 - 2 x ln r))

and sz, txz under q are txz, sx under p. As printed they are right to rounding of p and q.
"""

from functools import partial

import numpy as np
import pytest
from exact_stresses import hat_stress
from scipy.special import xlogy
from strips import strip_stress

from analytic.stress.elements import FrictionStress
from analytic.stress.points import stress_at
from analytic.stress_state import StressState

GAUSS, WEIGHT = np.polynomial.legendre.leggauss(200)


def line(x: np.ndarray, z: np.ndarray) -> FrictionStress:
    """Stresses under P and Q of 1 N/m."""
    sines = x**2 * z, z**3, x * z**2, x**3
    sx, sz, txz, sx_traction = (-2.0 / np.pi * part / np.hypot(x, z) ** 4 for part in sines)
    return FrictionStress(StressState(sx, sz, txz), sx_traction)


def triangle(x: np.ndarray, z: np.ndarray, a: float = 1.0) -> FrictionStress:
    """Stresses under p and q of 1 Pa at x = 0."""
    x, z = x / a, z / a
    places = (x - 1.0, x + 1.0, x)
    t1, t2, t = (np.arctan2(z, y) for y in places)
    r1, r2, r = (np.hypot(y, z) for y in places)
    level = (x - 1.0) * t1 + (x + 1.0) * t2 - 2.0 * x * t
    turn = z * (t1 + t2 - 2.0 * t)
    logs = xlogy(z, r1) + xlogy(z, r2) - 2.0 * xlogy(z, r)
    stretch = xlogy(x - 1.0, r1) + xlogy(x + 1.0, r2) - 2.0 * xlogy(x, r)
    parts = np.array([level + 2.0 * logs, level, -turn, 3.0 * turn - 2.0 * stretch]) / np.pi
    return FrictionStress(StressState(*parts[:3]), parts[3])


def test_line_load_is_in_equilibrium_and_compatible():
    """Divergence of the stress, Laplacian of sx + sz: zero to the differences' fourth order."""
    rng = np.random.default_rng(1)
    x, z = rng.uniform(-2.0, 2.0, 50), rng.uniform(0.5, 2.0, 50)

    def at(dx: float, dz: float) -> tuple[np.ndarray, ...]:
        stress = line(x + dx, z + dz).at(0.5)
        return stress.sx, stress.txz, stress.sz

    left = []
    for step in (0.02, 0.01):
        weights = {-2: 1.0, -1: -8.0, 1: 8.0, 2: -1.0}
        along = sum(w * np.array(at(k * step, 0.0)) for k, w in weights.items()) / (12.0 * step)
        down = sum(w * np.array(at(0.0, k * step)) for k, w in weights.items()) / (12.0 * step)
        ring = [at(step, 0.0), at(-step, 0.0), at(0.0, step), at(0.0, -step)]
        mean = sum(s[0] + s[2] for s in ring) - 4.0 * (at(0, 0)[0] + at(0, 0)[2])
        force = np.abs(along[:2] + down[1:]).max()
        left.append((force, np.abs(mean / step**2).max()))
    orders = np.log2(np.array(left[0]) / np.array(left[1]))
    assert orders == pytest.approx([4.0, 2.0], abs=0.1)


@pytest.mark.parametrize("friction", [0.0, 0.3, -1.0])
@pytest.mark.parametrize(
    ("field", "resultant"),
    [(line, 1.0), (partial(hat_stress, pitch=1.0), 1.0)],
    ids=["line", "hat"],
)
def test_stresses_carry_the_load_through_any_arc(field, resultant, friction):
    """Tractions on half-circles about the load carry P down and friction P along."""
    angle = 0.5 * np.pi * (1.0 + GAUSS)
    cosine, sine = np.cos(angle), np.sin(angle)
    for radius in (1.5, 20.0, 1e5):
        stress = field(radius * cosine, radius * sine).at(friction)
        measure = 0.5 * np.pi * radius * WEIGHT
        along = measure @ (stress.sx * cosine + stress.txz * sine)
        down = measure @ (stress.txz * cosine + stress.sz * sine)
        assert down == pytest.approx(-resultant, rel=1e-10)
        assert along == pytest.approx(-friction * resultant, rel=1e-10, abs=1e-10)


def test_a_triangle_is_a_sum_of_line_loads():
    a = 2e-3
    rng = np.random.default_rng(2)
    x, z = a * rng.uniform(-5.0, 5.0, 300), a * rng.uniform(0.15, 5.0, 300)
    expected = np.zeros((3, 300))
    for start in (-1.0, 0.0):
        point = start + 0.5 * (1.0 + GAUSS)
        shape = 1.0 - np.abs(point)
        for at, weight in zip(point, 0.5 * a * WEIGHT * shape, strict=True):
            expected += weight * line(x - a * at, z).at(0.3).parts
    for field in (triangle, hat_stress):
        stress = field(x, z, a).at(0.3).parts
        np.testing.assert_allclose(stress, expected, rtol=0.0, atol=8e-15)


def test_a_hat_is_the_triangle():
    """The recast formulas of the hat against the printed ones, anywhere."""
    rng = np.random.default_rng(3)
    x = rng.uniform(-4.0, 4.0, 1000)
    z = 10.0 ** rng.uniform(-9.0, 0.6, 1000)
    z[:20] = 0.0
    for friction in (0.0, 0.7):
        here, there = triangle(x, z).at(friction), hat_stress(x, z, 1.0).at(friction)
        np.testing.assert_allclose(here.parts, there.parts, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("friction", [0.0, 0.3, -1.0])
@pytest.mark.parametrize(
    ("load", "ends"), [(partial(strip_stress, half_width=1.0), 0.5), (triangle, 0.0)]
)
def test_hats_that_stand_for_a_load_meet_it(load, ends, friction):
    """A triangle exactly, a uniform strip to the pitch squared."""
    x, z = np.meshgrid(np.linspace(-2.0, 2.0, 33), [0.5, 1.0, 2.0])
    exact, errors, counts = load(x, z).at(friction), [], np.array([10, 20, 40, 80])
    for count in counts:
        nodes = np.arange(-count, count + 1) / count
        pressure = 1.0 - np.abs(nodes) if load is triangle else np.ones_like(nodes)
        pressure[[0, -1]] = ends
        stress = stress_at(nodes, pressure, friction, x, z)
        errors.append(np.abs(stress.parts - exact.parts).max())
    if load is triangle:
        assert max(errors) < 1e-13
        return
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < 2e-4
