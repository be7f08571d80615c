"""Contacts on meshes that they choose themselves: error met and foretold, and with how little."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import DenseCompliance, HalfPlane
from comparisons.models.finite_element.adaptive import (
    Pressing,
    adapted_contact,
    half_plane_block,
    joined_patches,
    next_sizes,
)
from fem.body.elasticity import Support, elastic_body
from fem.compliance.far_field import FarField
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockSpec
from meshes.build import build_block

HERTZ = hertz_from_peak_pressure(1.0, 0.5, 1.0)  # half-width 1
STEEL = Material(0.91, 0.3)  # plane-strain modulus 1
ROLLER = Pressing(
    gap=lambda x: x**2, load=HERTZ.load_per_length, material=STEEL, extent=(-1.5, 1.5)
)


def distance(found, exact):
    """L2 distance of two functions of x relative to the second."""
    x = -1.45 * np.cos(np.linspace(0.0, np.pi, 60_001))
    share = np.gradient(x)
    return np.sqrt(share @ (found(x) - exact(x)) ** 2 / (share @ exact(x) ** 2))


def of_hats(contact):
    whole = np.concatenate([[0.0], contact.solution.pressure, [0.0]])
    return lambda x: np.interp(x, contact.hats, whole)


@pytest.fixture(scope="module")
def pressed():
    return {tolerance: adapted_contact(ROLLER, tolerance) for tolerance in (1e-2, 1e-3)}


def smooth(contact):
    """The smooth pressure at x, zero outside the patches."""

    def pressure(x):
        total = np.zeros_like(x)
        for patch in contact.patches:
            inside = (x > patch.ends[0]) & (x < patch.ends[1])
            total[inside] = patch.curve(x[inside])
        return total

    return pressure


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_error_is_met_and_foretold(pressed, tolerance):
    contact = pressed[tolerance]
    true = distance(of_hats(contact), HERTZ.pressure)
    assert contact.converged
    assert 0.15 * tolerance < true < tolerance
    assert 0.7 < contact.rounds[-1].estimate / true < 1.5


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_smooth_pressure_is_closer_and_so_are_peak_and_length(pressed, tolerance):
    contact = pressed[tolerance]
    curve = distance(smooth(contact), HERTZ.pressure)
    assert curve < 0.9 * distance(of_hats(contact), HERTZ.pressure)
    assert contact.peak_pressure == pytest.approx(1.0, rel=0.2 * tolerance)
    assert contact.contact_length == pytest.approx(2.0, rel=0.3 * tolerance)


def test_each_round_is_better_and_the_last_alone_meets_the_tolerance(pressed):
    estimates = [each.estimate for each in pressed[1e-3].rounds]
    assert len(estimates) > 1
    assert (np.diff(estimates) < 0.0).all()
    assert min(estimates[:-1]) > 1e-3 >= estimates[-1]


def equal_edges(per_half):
    """Error and unknowns of equal hats on as many equal edges, on the same kind of block."""
    reach = 1.0 + 3.0 / per_half
    grid = HatGrid.within(-reach, reach, 1.0 / per_half)
    hats = np.arange(grid.first - 1, grid.last + 2) / per_half
    half_width, depth, support = half_plane_block(1.25)
    body = elastic_body(
        build_block(BlockSpec(half_width, depth, hats[[0, -1]].reshape(1, 2), 1.0 / per_half)),
        STEEL,
        support,
    )
    far = FarField(body, hats[0], hats[-1])
    operator = DenseCompliance(FiniteElementCompliance(body, hats, far=far).matrix())
    solution = solve_contact(
        operator, grid.hat_integrals(ROLLER.gap), grid.weights, Constraints(load=ROLLER.load)
    )
    whole = np.concatenate([[0.0], solution.pressure, [0.0]])
    return distance(lambda x: np.interp(x, hats, whole), HERTZ.pressure), body.unknowns


def test_far_fewer_unknowns_than_equal_edges_for_the_same_pressure(pressed):
    (coarse, fewer), (fine, more) = equal_edges(10.25), equal_edges(40.25)
    order = np.log(coarse / fine) / np.log(more / fewer)
    needed = {}
    for tolerance, contact in pressed.items():
        true = distance(of_hats(contact), HERTZ.pressure)
        needed[tolerance] = more * (fine / true) ** (1.0 / order)
        needed[tolerance] /= contact.rounds[-1].unknowns
    assert 4.0 < needed[1e-2] < 9.0, needed
    assert 10.0 < needed[1e-3] < 25.0, needed


def fine_half_plane(pressing, pitch=2e-4):
    grid = HatGrid.within(*pressing.extent, pitch)
    solution = solve_contact(
        HalfPlane(grid.count, grid.pitch, 1.0),
        grid.hat_integrals(pressing.gap, pressing.knots),
        grid.weights,
        Constraints(load=pressing.load),
    )
    return lambda x: np.interp(x, grid.x, solution.pressure)


WAVY = {
    "waves in one patch": 0.01,
    "patches": 0.12,
}


@pytest.mark.parametrize("amplitude", WAVY.values(), ids=WAVY)
def test_wavy_surface_is_that_of_the_half_plane(amplitude):
    wavelength = 0.5
    pressing = replace(
        ROLLER,
        gap=lambda x: x**2 - amplitude * np.cos(2.0 * np.pi * (x - 0.05) / wavelength),
        shortest=wavelength,
    )
    contact, exact = adapted_contact(pressing, 1e-2), fine_half_plane(pressing)
    assert contact.converged
    assert len(contact.patches) == (1 if amplitude < 0.05 else 3)
    true = distance(of_hats(contact), exact)
    assert true < 1e-2
    assert 0.7 < contact.rounds[-1].estimate / true < 2.0
    assert distance(smooth(contact), exact) < 5e-3
    x = np.linspace(-1.4, 1.4, 200_001)
    assert contact.peak_pressure == pytest.approx(exact(x).max(), rel=5e-3)


def test_body_of_its_own_shape_is_solved_on_that_shape():
    """A bonded layer one half-width thick: stiffer than the half-plane; against equal edges."""
    block = (6.0, 1.0, Support("bonded", "free"))
    contact = adapted_contact(replace(ROLLER, block=block), 3e-3)
    assert contact.converged
    body = elastic_body(
        build_block(BlockSpec(6.0, 1.0, np.array([[-1.2, 1.2]]), 1.0 / 40)), STEEL, block[2]
    )
    grid = HatGrid.within(-1.2, 1.2, 1.0 / 40)
    hats = np.arange(grid.first - 1, grid.last + 2) / 40
    solution = solve_contact(
        DenseCompliance(FiniteElementCompliance(body, hats).matrix()),
        grid.hat_integrals(ROLLER.gap),
        grid.weights,
        Constraints(load=ROLLER.load),
    )
    assert contact.peak_pressure == pytest.approx(solution.pressure.max(), rel=1e-3)
    assert contact.peak_pressure > 1.05
    assert contact.contact_length < 1.95


def test_elastic_roller_doubles_the_compliance():
    stiff, both = (
        adapted_contact(replace(ROLLER, stiffening=factor, load=load), 1e-2)
        for factor, load in ((1.0, HERTZ.load_per_length), (2.0, 0.5 * HERTZ.load_per_length))
    )
    assert both.contact_length == pytest.approx(stiff.contact_length, rel=1e-4)
    assert both.peak_pressure == pytest.approx(0.5 * stiff.peak_pressure, rel=1e-4)


def test_other_units_same_contact(pressed):
    length, stress = 3.7e-6, 2.1e11
    scaled = Pressing(
        gap=lambda x: length * (x / length) ** 2,
        load=HERTZ.load_per_length * length * stress,
        material=Material(0.91 * stress, 0.3),
        extent=(-1.5 * length, 1.5 * length),
    )
    there, here = adapted_contact(scaled, 1e-2), pressed[1e-2]
    assert [each.unknowns for each in there.rounds] == [each.unknowns for each in here.rounds]
    assert there.hats == pytest.approx(length * here.hats, rel=1e-6, abs=1e-9 * length)
    assert there.solution.pressure == pytest.approx(
        stress * here.solution.pressure, rel=1e-5, abs=1e-6 * stress
    )


def test_a_tolerance_that_is_not_met_is_told():
    contact = adapted_contact(ROLLER, 1e-5, rounds=1)
    assert not contact.converged
    assert len(contact.rounds) == 1


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_next_sizes_leave_the_wanted_error_equally_spread(degree):
    energy = np.exp(np.random.default_rng(0).normal(size=50))
    factor = next_sizes(energy, 0.3, degree)
    alike = energy * factor ** (degree + 1)
    assert alike == pytest.approx(alike[0], rel=1e-12)
    assert np.sum(factor**-2.0 * alike**2) == pytest.approx(0.3, rel=1e-12)


def test_patches_without_room_for_edges_between_them_are_taken_as_one():
    ends = np.array([[0.0, 1.0], [1.001, 2.0], [2.5, 3.0]])
    joined, edges = joined_patches(ends, np.array([6.0, 7.0, 5.0]))
    assert np.array_equal(joined, [[0.0, 2.0], [2.5, 3.0]])
    assert np.array_equal(edges, [13.0, 5.0])
