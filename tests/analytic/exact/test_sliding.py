"""Sliding with coupling against high-precision values, its integral equation and quadrature."""

import json

import numpy as np
import pytest
from exact_stresses import sliding_stress
from scenes import DATA
from scipy.integrate import quad
from scipy.linalg import toeplitz
from scipy.special import roots_jacobi

from analytic.exact.hertz import hertz_from_load, hertz_stress
from analytic.exact.sliding import SlidingContact, sliding_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane
from analytic.stress.points import stress_at

CASES = json.loads((DATA / "f_rounded_punch_and_sliding.json").read_text())["sliding_cylinder"]
NAMES = ("sx", "sz", "txz")


def fraction(text: str) -> float:
    numerator, _, denominator = text.partition("/")
    return float(numerator) / float(denominator or 1.0)


def identifier(case: dict) -> str:
    return f"beta {case['beta']}, mu {case['mu']}"


@pytest.mark.parametrize("case", CASES, ids=identifier)
def test_reference_values(case):
    """Half-plane below, cylinder sliding in +x: the contact moves to -x."""
    value = {k: float(v) for k, v in case.items() if not isinstance(v, list) and k != "beta"}
    beta = fraction(case["beta"])
    contact = sliding_from_load(value["P_R_over_Estar_ahalf2"], 1.0, 1.0, value["mu"], beta)
    assert contact.half_width == pytest.approx(1.0, rel=3e-16)
    assert contact.exponent_shift == pytest.approx(value["eta"], rel=1e-15)
    left, right = contact.edges
    assert left == pytest.approx(-value["b_trailing_over_ahalf"], rel=1e-15)
    assert right == pytest.approx(value["c_leading_over_ahalf"], rel=1e-15)
    assert 0.5 * (left + right) == pytest.approx(value["centre_shift_over_ahalf"], rel=1e-14)
    assert contact.peak_pressure == pytest.approx(value["peak_p_R_over_Estar_ahalf"], rel=1e-15)
    assert contact.peak_position == pytest.approx(value["peak_x_over_ahalf"], rel=1e-15)
    assert contact.load_position == pytest.approx(value["load_line_x_over_ahalf"], rel=1e-15)
    hertz = hertz_from_load(contact.load_per_length, 1.0, 1.0)
    assert contact.half_width / hertz.half_width == pytest.approx(
        value["ahalf_over_aHertz_same_load"], rel=1e-15
    )
    assert contact.peak_pressure / hertz.peak_pressure == pytest.approx(
        value["peak_over_p0Hertz_same_load"], rel=1e-15
    )
    xi = np.array([float(row["xi"]) for row in case["profile_about_contact_centre"]])
    expected = [float(row["p_R_over_Estar_ahalf"]) for row in case["profile_about_contact_centre"]]
    assert len(xi) == 5
    np.testing.assert_allclose(contact.pressure(0.5 * (left + right) + xi), expected, rtol=3e-15)


@pytest.mark.parametrize("product", [0.0, 0.02, -0.15, 0.5, -2.0])
def test_integral_equation_and_load(product):
    contact = sliding_from_load(0.7, 2.0, 3.0, 2.0 * product, 0.5)
    left, right = contact.edges
    for share in (0.1, 0.35, 0.5, 0.8):
        x = left + share * (right - left)
        principal, _ = quad(contact.pressure, left, right, weight="cauchy", wvar=x, limit=400)
        slope = -principal / np.pi - product * contact.pressure(x)
        assert slope == pytest.approx(3.0 * x / 4.0, abs=1e-6)
    load, _ = quad(contact.pressure, left, right, limit=400)
    moment, _ = quad(lambda x: x * contact.pressure(x), left, right, limit=400)
    assert load == pytest.approx(0.7, rel=1e-8)
    assert moment / load == pytest.approx(contact.load_position, abs=1e-8)


def test_without_coupling_it_is_hertz():
    hertz = hertz_from_load(3.0e5, 8e-3, 110e9)
    a = hertz.half_width
    x, z = a * np.linspace(-3.0, 3.0, 61), a * np.array([[0.0], [1e-9], [0.3], [1.0], [4.0]])
    for friction, beta in ((0.0, 0.3), (0.3, 0.0)):
        contact = sliding_from_load(3.0e5, 8e-3, 110e9, friction, beta)
        assert contact.edges == pytest.approx((-a, a), rel=1e-15)
        assert contact.peak_pressure == pytest.approx(hertz.peak_pressure, rel=1e-15)
        inside = np.abs(x) < 0.99 * a
        np.testing.assert_allclose(
            contact.pressure(x)[inside], hertz.pressure(x)[inside], rtol=1e-13
        )
        expected, found = hertz_stress(hertz, x, z, friction), sliding_stress(contact, x, z)
        for name in NAMES:
            difference = np.abs(getattr(found, name) - getattr(expected, name)).max()
            # where the square root's edge moves by rounding, sx changes by the root of that
            assert difference < 5e-8 * hertz.peak_pressure


def test_it_mirrors_when_the_sliding_reverses_or_the_bodies_change_places():
    here = sliding_from_load(1.0, 1.0, 1.0, 0.4, 0.3)
    x, z = np.linspace(-2.5, 2.5, 41), np.array([[0.0], [0.2], [3.0]])
    for friction, beta in ((-0.4, 0.3), (0.4, -0.3)):
        there = sliding_from_load(1.0, 1.0, 1.0, friction, beta)
        assert there.edges == (-here.edges[1], -here.edges[0])
        np.testing.assert_allclose(there.pressure(-x), here.pressure(x), rtol=1e-14)
    reversed_ = sliding_stress(sliding_from_load(1.0, 1.0, 1.0, -0.4, 0.3), -x, z)
    forward = sliding_stress(here, x, z)
    for name, sign in (("sx", 1.0), ("sz", 1.0), ("txz", -1.0)):
        np.testing.assert_allclose(
            sign * getattr(reversed_, name), getattr(forward, name), rtol=1e-12, atol=1e-15
        )


@pytest.mark.parametrize("product", [0.1, -0.4, 1.5])
def test_stresses_are_the_sum_of_line_loads(product):
    contact = sliding_from_load(np.pi / 4.0, 1.0, 1.0, 2.0 * product, 0.5)
    n, h = contact.exponent_shift, contact.half_width
    left, right = contact.edges
    point, weight = roots_jacobi(400, 0.5 + n, 0.5 - n)
    load = 0.5 * h * np.cos(np.pi * n) * weight * h
    assert load.sum() == pytest.approx(np.pi / 4.0, rel=1e-12)
    rng = np.random.default_rng(3)
    x, z = rng.uniform(-4.0, 4.0, 300), rng.uniform(0.1, 4.0, 300)
    along = x[:, None] - 0.5 * (left + right) - h * point
    kernel = -2.0 / np.pi * load / (along**2 + z[:, None] ** 2) ** 2
    mu, stress = contact.friction, sliding_stress(contact, x, z)
    radial = [np.sum(kernel * along**k, axis=1) * z ** (3 - k) for k in range(4)]
    np.testing.assert_allclose(stress.sx, radial[2] + mu * radial[3], rtol=0.0, atol=2e-14)
    np.testing.assert_allclose(stress.sz, radial[0] + mu * radial[1], rtol=0.0, atol=2e-14)
    np.testing.assert_allclose(stress.txz, radial[1] + mu * radial[2], rtol=0.0, atol=2e-14)


def test_far_away_each_component_keeps_its_digits():
    """The resultant's line load at its own place; what is left falls like the distance squared."""
    contact = sliding_from_load(np.pi / 4.0, 1.0, 1.0, 0.3, 0.5)
    for distance in (1e3, 1e6):
        for slope in (1e-6, 0.7, 3.0):
            x = distance / np.hypot(1.0, slope)
            z = slope * x
            along = x - contact.load_position
            load = -2.0 / np.pi * contact.load_per_length / (along**2 + z**2) ** 2
            push = along + 0.0 * z
            stress = sliding_stress(contact, x, z)
            expected = {
                "sx": load * (push**2 * z + 0.3 * push**3),
                "sz": load * (z**3 + 0.3 * push * z**2),
                "txz": load * (push * z**2 + 0.3 * push**2 * z),
            }
            for name in NAMES:
                assert getattr(stress, name) == pytest.approx(
                    expected[name], rel=10.0 / distance**2 + 1e-13, abs=0
                )


def test_surface_and_edges():
    contact = sliding_from_load(np.pi / 4.0, 1.0, 1.0, 0.6, 0.5)
    left, right = contact.edges
    x = np.array([-1.9, left, 0.7 * left, 0.0, 0.5, right, 1.4, 30.0])
    stress = sliding_stress(contact, x, 0.0)
    np.testing.assert_allclose(stress.sz, -contact.pressure(x), atol=3e-16)
    np.testing.assert_allclose(stress.txz, -0.6 * contact.pressure(x), atol=3e-16)
    # inside, sx = -p - 2 mu (x/2R + beta mu p): the cylinder's slope and the coupling's
    inside = (x >= left) & (x <= right)
    slope = 0.5 * x + contact.dundurs_beta * 0.6 * contact.pressure(x)
    expected = -contact.pressure(x) - 1.2 * slope
    np.testing.assert_allclose(stress.sx[inside], expected[inside], atol=2e-15)


def test_stress_of_its_own_pressure_on_hats():
    """Closed form against hats through the exact pressure: of order 3/2, the edges' own."""
    contact = sliding_from_load(np.pi / 4.0, 1.0, 1.0, 0.6, 0.5)
    x, z = np.linspace(-2.0, 2.0, 21), np.array([[0.05], [0.5], [1.5]])
    exact, errors = sliding_stress(contact, x, z), []
    for count in (101, 201, 401):
        nodes = np.linspace(-1.5, 1.5, count)
        found = stress_at(nodes, contact.pressure(nodes), 0.6, x, z)
        errors.append(max(np.abs(getattr(found, k) - getattr(exact, k)).max() for k in NAMES))
    order = np.log2(errors[0] / errors[-1]) / 2.0
    assert order == pytest.approx(1.5, abs=0.3)
    assert errors[-1] < 2e-3


def coupled_solution(contact: SlidingContact, grid: HatGrid, apex: float) -> np.ndarray:
    """Pressures (n,) on hats: normal compliance and the traction's lift, contact set by signs.

    The traction's displacement into the body is (beta mu/E*) int p(s) sgn(x - s) ds; averaged
    over hats 0, 11/12 and then 1 times the square of the pitch.
    """
    n, modulus = grid.count, contact.combined_modulus
    lift = np.full(n, grid.pitch**2)
    lift[:2] = 0.0, 11.0 / 12.0 * grid.pitch**2
    lift *= contact.friction * contact.dundurs_beta / modulus
    matrix = toeplitz(HalfPlane(n, grid.pitch, modulus).column) + toeplitz(lift, -lift)
    roller = roller_gap(contact.radius)
    gap, touching = grid.hat_integrals(lambda x: roller(x - apex)), np.ones(n, dtype=bool)
    for _ in range(60):
        inside = np.flatnonzero(touching)
        system = np.zeros((len(inside) + 1, len(inside) + 1))
        system[:-1, :-1] = matrix[np.ix_(inside, inside)] * modulus / grid.pitch**2
        system[:-1, -1], system[-1, :-1] = -1.0, 1.0
        right = np.append(
            -gap[inside] * modulus / grid.pitch**2, contact.load_per_length / grid.pitch
        )
        solution = np.linalg.solve(system, right)
        pressure = np.zeros(n)
        pressure[inside] = solution[:-1]
        approach = solution[-1] * grid.pitch / modulus
        open_ = (gap + matrix @ pressure) / grid.pitch - approach
        following = (touching & (pressure > 0.0)) | (~touching & (open_ < 0.0))
        if np.array_equal(following, touching):
            return pressure
        touching = following
    raise AssertionError("the contact set does not settle")


@pytest.mark.parametrize("friction", [0.1, 0.5, -1.0])
def test_discretised_coupling_converges_to_it(friction):
    """Order 1 in L2 as without coupling; the uncoupled pressure misses by far more."""
    contact = sliding_from_load(1e6, 10e-3, 220e9, friction, 2.0 / 7.0)
    reach, errors = 1.5 * contact.half_width, []
    for elements in (100, 200, 400):
        grid, square = HatGrid.within(-reach, reach, 2.0 * reach / elements), []
        for offset in (0.0, 0.25, 0.5, 0.75):
            exact = contact.pressure(grid.x - offset * grid.pitch)
            found = coupled_solution(contact, grid, offset * grid.pitch)
            square.append(np.sum((found - exact) ** 2) / np.sum(exact**2))
        errors.append(np.sqrt(np.mean(square)))
    assert np.log2(errors[0] / errors[-1]) / 2.0 == pytest.approx(1.0, abs=0.15)
    assert errors[-1] < 4e-3
    uncoupled = hertz_from_load(1e6, 10e-3, 220e9).pressure(grid.x - offset * grid.pitch)
    assert np.linalg.norm(uncoupled - exact) / np.linalg.norm(exact) > 5.0 * errors[-1]


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="radius must be positive"):
        sliding_from_load(1.0, 0.0, 1.0, 0.1, 0.1)
    with pytest.raises(ValueError, match="must be finite"):
        sliding_from_load(1.0, 1.0, 1.0, np.nan, 0.1)
    with pytest.raises(ValueError, match="z must not be negative"):
        sliding_stress(sliding_from_load(1.0, 1.0, 1.0, 0.1, 0.1), 0.0, -1.0)
