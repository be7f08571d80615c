"""Normal displacement under sliding traction: kernel, sign, operators, and a whole matrix."""

import json
from itertools import pairwise

import numpy as np
import pytest
from hats import of_narrow_hats
from numpy.polynomial.legendre import leggauss
from scenes import reference
from scipy.integrate import quad
from scipy.linalg import toeplitz

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.grid import HatGrid, roller_gap
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.half_plane import DenseCompliance, HalfPlane
from analytic.operators.tangential import (
    CoupledPair,
    coupled_half_planes,
    hat_sign,
)

PITCH, MODULUS, BETA = 0.7e-6, 115e9, 2.0 / 7.0
RADIUS, LOAD = 7.5706e-3, 1.0e6
GRID = HatGrid.within(-0.5e-3, 0.5e-3, 2e-6)


def hat(x):
    return np.maximum(1.0 - np.abs(x), 0.0)


def tangential(count: int, modulus: float, dundurs: float) -> np.ndarray:
    """T (n, n) [m^2/Pa]: what friction adds to the normal part of a coupled half-plane."""
    coupled = coupled_half_planes(count, PITCH, modulus, dundurs)
    nodes = np.arange(count)
    return coupled.block(nodes) - coupled.normal.block(nodes)


@pytest.mark.parametrize("offset", [0.0, 0.25, 1.0, 1.5, 1.9, 2.0, 7.3])
def test_hat_sign_is_the_mean_sign_of_the_distance(offset):
    """Quadrature of the sign of one hat over the other, interval by interval."""
    points, weights = leggauss(12)

    def over_one_hat(x):  # int hat(s) sign(x - s) ds, by its distribution function
        x = np.clip(x, -1.0, 1.0)
        below = np.where(x < 0.0, 0.5 * (1.0 + x) ** 2, 1.0 - 0.5 * (1.0 - x) ** 2)
        return 2.0 * below - 1.0

    ends = np.unique(np.clip([-1.0, 0.0, 1.0, -1.0 - offset, -offset, 1.0 - offset], -1.0, 1.0))
    total = 0.0
    for low, high in pairwise(ends):
        t = 0.5 * (low + high) + 0.5 * (high - low) * points
        total += 0.5 * (high - low) * np.sum(weights * hat(t) * over_one_hat(offset + t))
    assert hat_sign(offset) == pytest.approx(total, rel=1e-13, abs=1e-15)
    assert hat_sign(-offset) == -hat_sign(offset)


@pytest.mark.parametrize("nu", [0.0, 0.2, 0.3, 0.45])
@pytest.mark.parametrize("x", [-1.3, -0.2, 0.5, 2.0])
def test_one_body_moves_as_the_strains_below_a_tangential_line_load_say(x, nu):
    """u_z(x, 0) - u_z(x, Z) is the integral of -e_z; far below, both sides move alike.

    The field of a tangential line load Q in +x is radial: s_r = -(2 Q/pi) x / r^2.
    """
    young, load = 200e9, 3.0

    def strain(z):
        square = x**2 + z**2
        radial = -(2.0 * load / np.pi) * x / square
        return (1.0 + nu) / young * radial * ((1.0 - nu) * z**2 - nu * x**2) / square

    surface = -quad(strain, 0.0, np.inf, epsabs=0.0, epsrel=1e-11)[0]
    body = Material(young, nu)
    beta = dundurs_constants(body, None)[1]
    kernel = beta / body.plane_strain_modulus * load * np.sign(x)
    assert surface == pytest.approx(kernel, rel=1e-9, abs=1e-25)


def test_reference_gives_the_same_slope_below_the_traction():
    """du_z/dx = (1-2nu)(1+nu) q/E: between two hats of a long row of them."""
    known = reference("c_influence_coefficients")
    assert "du_z/dx = +((1-2nu)(1+nu)/E) q(x)" in json.dumps(known)
    body = Material(210e9, 0.3)
    beta = dundurs_constants(body, None)[1]
    operator = tangential(40, body.plane_strain_modulus, beta)
    displacement = operator @ np.full(40, 5e6) / PITCH
    slope = np.diff(displacement)[10:-10] / PITCH
    assert slope == pytest.approx((1.0 - 2.0 * 0.3) * (1.0 + 0.3) * 5e6 / 210e9, rel=1e-12)


def test_two_bodies_add_what_each_does_under_its_own_traction():
    """The roller takes -q and is turned over: beta/E* is the difference of the bodies' own."""
    body, roller = Material(70e9, 0.33), Material(210e9, 0.3)
    traction = np.random.default_rng(5).standard_normal(30)

    def by_traction(material):
        beta = dundurs_constants(material, None)[1]
        return tangential(30, material.plane_strain_modulus, beta) @ traction

    beta = dundurs_constants(body, roller)[1]
    mutual = tangential(30, combined_modulus(body, roller), beta)
    expected = by_traction(body) - by_traction(roller)
    assert mutual @ traction == pytest.approx(expected, rel=1e-12, abs=1e-12 * expected.max())


def test_traction_does_no_work_on_what_it_moves():
    traction = np.random.default_rng(4).standard_normal(200)
    moved = tangential(200, MODULUS, BETA) @ traction
    assert abs(traction @ moved) < 1e-13 * np.linalg.norm(traction) * np.linalg.norm(moved)


@pytest.mark.parametrize("count", [1, 6, 129])
def test_coupled_half_plane_is_normal_and_tangential_together(count):
    pressure = np.random.default_rng(6).uniform(0.0, 1e9, count)
    coupled = coupled_half_planes(count, PITCH, MODULUS, 0.3 * BETA)
    column = 0.3 * BETA * PITCH**2 / MODULUS * hat_sign(np.arange(count))
    expected = HalfPlane(count, PITCH, MODULUS).apply(pressure)
    expected += toeplitz(column, -column) @ pressure
    assert coupled.apply(pressure) == pytest.approx(expected, rel=1e-12)
    if count > 1:
        half, refine = pressure[: count // 2], of_narrow_hats(count)
        coarse = coupled.coarser
        assert coarse.normal.datum == coupled.normal.datum
        if count % 2:
            moved, expected = coarse.apply(half), refine.T @ coupled.apply(refine @ half)
            assert moved == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("friction_dundurs", [0.1, -0.5, 0.75])
def test_approximate_inverse_is_positive_and_near_the_inverse(friction_dundurs):
    """Near: as near as that of the symmetric operator, whatever the friction."""
    coupled = coupled_half_planes(200, PITCH, MODULUS, friction_dundurs)
    columns = np.eye(200)
    inverse = np.array([coupled.precondition(column) for column in columns]).T
    product = np.array([coupled.precondition(coupled.apply(column)) for column in columns]).T
    assert np.linalg.eigvalsh(inverse + inverse.T).min() > 0.0
    values = np.linalg.eigvals(product)
    assert np.count_nonzero(np.abs(values - 1.0) > 0.01) <= 6  # the ends of the grid, the mean
    assert values.real.min() > 0.9 and np.abs(values).max() < 5.0


def body(friction_dundurs: float = 0.4) -> CoupledPair:
    return coupled_half_planes(GRID.count, GRID.pitch, MODULUS, friction_dundurs)


def whole(operator: CoupledPair) -> DenseCompliance:
    return DenseCompliance(operator.block(np.arange(operator.count)), skew=True)


def wavy_gap() -> np.ndarray:
    wave = 2.0 * np.pi / 60e-6
    return GRID.hat_integrals(lambda x: roller_gap(RADIUS)(x) - 0.3e-6 * np.cos(wave * x + 0.4))


@pytest.mark.parametrize(
    "constraints",
    [Constraints(load=LOAD), Constraints(load=LOAD, hardness=5e9), Constraints(approach=2e-6)],
)
@pytest.mark.parametrize("friction_dundurs", [-0.1, 0.4])
def test_contact_of_the_whole_matrix_is_that_of_the_body(friction_dundurs, constraints):
    right = solve_coupled(body(friction_dundurs), wavy_gap(), GRID.weights, constraints)
    solution = solve_coupled(whole(body(friction_dundurs)), wavy_gap(), GRID.weights, constraints)
    assert solution.converged
    assert solution.pressure == pytest.approx(right.pressure, abs=1e-8 * right.pressure.max())
    assert solution.iterations["exchanges"] <= 12


def test_coarser_hats_of_a_matrix_are_sums_of_finer_ones():
    """Equal to those of the half-plane, hats twice as wide; of an even count the last is short."""
    for count in (41, 40):
        fine = coupled_half_planes(count, 1e-6, MODULUS, 0.4)
        coarse = whole(fine).coarser
        exact = fine.coarser.block(np.arange(count // 2))
        inner = slice(None) if count % 2 else slice(None, -1)
        block = coarse.matrix[inner, inner]
        assert block == pytest.approx(exact[inner, inner], rel=1e-11)
        assert coarse.count == count // 2 and coarse.skew


def test_hats_that_the_body_cannot_resolve_away_from_the_contact_do_no_harm():
    """Displacements of every third hat, and between them: as over a mesh that is coarse there."""
    far = np.abs(GRID.x) > 0.42e-3
    places = np.flatnonzero(~far | (np.arange(GRID.count) % 3 == 0))
    spread = np.array([np.interp(GRID.x, GRID.x[places], row) for row in np.eye(len(places))]).T
    few = DenseCompliance(spread @ body().block(places) @ spread.T, skew=True)
    assert few.solve(np.arange(40), np.ones((40, 1))) is None
    constraints = Constraints(load=LOAD)
    solution = solve_coupled(few, wavy_gap(), GRID.weights, constraints)
    right = solve_coupled(body(), wavy_gap(), GRID.weights, constraints)
    assert solution.converged
    assert solution.pressure == pytest.approx(right.pressure, abs=1e-6 * right.pressure.max())
