"""Ends and curve of the smooth pressure behind hats, on Hertz's contact and on others."""

import numpy as np
import pytest
from scipy.optimize import brentq

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.contact.smooth_pressure import contact_ends, curves_between, nodal_values
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import hat_integrals
from analytic.operators.half_plane import DenseCompliance, HalfPlane

HERTZ = hertz_from_peak_pressure(1.0, 0.5, 1.0)  # half-width 1
GRAIN = 2.0**-11


def parabola(x):
    return x**2


def weights(hats):
    return 0.5 * (hats[2:] - hats[:-2])


def compliance(hats):
    """Compliance of equal hats; or, with nodes at whole GRAINs, as sums of hats a GRAIN wide."""
    pitch = np.diff(hats)
    if np.ptp(pitch) < 1e-9:
        return HalfPlane(len(hats) - 2, pitch[0], 1.0)
    fine = np.arange(hats[0] + GRAIN, hats[-1] - 0.5 * GRAIN, GRAIN)
    spread = np.array([np.interp(fine, hats, hat) for hat in np.eye(len(hats))[1:-1]])
    grains = HalfPlane(len(fine), GRAIN, 1.0)
    moved = np.array([grains.apply(pressure) for pressure in spread])
    return DenseCompliance(moved @ spread.T)


def contact(hats, gap=parabola, load=HERTZ.load_per_length):
    return solve_contact(
        compliance(hats), hat_integrals(hats, gap), weights(hats), Constraints(load=load)
    )


def graded(edges, end=1.003):
    """Nodes towards an end that is not quite that of contact, and beyond it."""
    half = end * (1.0 - np.linspace(1.0, 0.0, edges + 1) ** 2)
    steps = (half[-1] - half[-2]) * 1.3 ** np.arange(100)
    half = np.concatenate([half, end + np.cumsum(steps)])
    half = GRAIN * np.round(half[half < 1.5] / GRAIN)
    return np.concatenate([-half[:0:-1], half])


def equal(per_half):
    return np.arange(-int(1.6 * per_half), int(1.6 * per_half) + 1) / per_half


def ends_of(hats, gap=parabola):
    """Ends [m] of a single patch, and its last touching node."""
    solution = contact(hats, gap)
    [(_, last)], [ends] = contact_ends(hats, solution.pressure, solution.gap)
    return ends, last


@pytest.mark.parametrize("end", [0.98, 0.995, 1.0, 1.003, 1.01])
@pytest.mark.parametrize("edges", [8, 16])
def test_ends_are_found_wherever_they_lie_between_nodes(edges, end):
    hats = graded(edges, end)
    ends, last = ends_of(hats)
    assert np.abs(ends - [-1.0, 1.0]).max() < 0.3 * np.diff(hats)[last + 1]


@pytest.mark.parametrize("fraction", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_on_equal_hats_too(fraction):
    hats = equal(20.0 + fraction)
    assert np.abs(ends_of(hats)[0] - [-1.0, 1.0]).max() < 0.2 * (hats[1] - hats[0])


def test_the_curve_of_nodal_values_is_closer_to_the_pressure_than_the_hats():
    hats = equal(20.5)
    solution = contact(hats)
    nodes, ends = contact_ends(hats, solution.pressure, solution.gap)
    held = slice(nodes[0, 0] + 2, nodes[0, 1] - 1)
    x, nodal = hats[1:-1], nodal_values(hats, solution.pressure)
    alone = np.zeros(len(x[held]), dtype=int)
    curve = curves_between(ends, x[held], nodal[held], alone)
    at = np.linspace(-0.999, 0.999, 4001)
    exact, found = HERTZ.pressure(at), curve(at, np.zeros(4001, dtype=int))
    by_hats = np.interp(at, x, solution.pressure)
    assert np.linalg.norm(found - exact) < 0.55 * np.linalg.norm(by_hats - exact)
    assert abs(found.max() - 1.0) < 2e-4
    assert np.array_equal(curve(np.array([-1.2, 1.2]), np.zeros(2, dtype=int)), np.zeros(2))
    # beside others each patch has the curve that it has alone
    both = np.concatenate([ends, ends + 3.0])
    twice = np.concatenate([x[held], x[held] + 3.0]), np.tile(nodal[held], 2)
    curve = curves_between(both, *twice, np.concatenate([alone, alone + 1]))
    np.testing.assert_allclose(curve(at + 3.0, np.ones(4001, dtype=int)), found, atol=1e-12)


def test_a_mirrored_contact_has_mirrored_ends():
    def lopsided(x):
        return (x - 0.123) ** 2 - 0.02 * np.sin(9.0 * x)

    hats = np.linspace(-1.5, 1.7, 130)
    there, back = ends_of(hats, lopsided)[0], ends_of(-hats[::-1], lambda x: lopsided(-x))[0]
    assert there == pytest.approx(-back[::-1], abs=1e-7)


def test_nodal_values_undo_the_overshoot_of_hats_on_a_parabola():
    pitch = 0.1
    hats = pitch * np.arange(-5, 6)
    wanted = 3.0 - 2.0 * hats[1:-1] + 1.5 * hats[1:-1] ** 2
    values = nodal_values(hats, wanted - 3.0 * pitch**2 / 12.0)
    assert values[1:-1] == pytest.approx(wanted[1:-1], rel=1e-13)


def test_all_ends_at_once_are_those_of_a_search_one_by_one(rng):
    """On unequal hats; the same equation for each end alone, by quadrature and brentq."""
    hats, gap = np.cumsum(rng.uniform(0.8, 1.2, 402)), np.zeros(400)
    for start in range(0, 400, 40):  # open, then in contact
        depth = np.minimum(np.arange(20), np.arange(20)[::-1]) + rng.uniform(0.0, 1.0)
        gap[start : start + 20] = depth**1.5 * (1.0 + 0.02 * depth)
    nodes, ends = contact_ends(hats, np.where(gap > 0.0, 0.0, 1.0), gap)
    assert len(nodes) == 10
    for node, place, side in [
        *zip(nodes[:, 0], ends[:, 0], [-1] * 10, strict=True),
        *zip(nodes[:-1, 1], ends[:-1, 1], [1] * 9, strict=True),
    ]:
        near = node + side * np.arange(2, 5)
        some = slice(near.min(), near.max() + 3)

        def mismatch(end, near=near, some=some, side=side):
            rows = [
                hat_integrals(
                    hats[some],
                    lambda x, p=p: np.maximum(side * (x - end), 0.0) ** p,
                    np.array([end]),
                )
                / weights(hats[some])
                for p in (1.5, 2.5)
            ]
            return np.linalg.det(np.array([*rows, gap[near.min() : near.max() + 1]]))

        assert place == pytest.approx(brentq(mismatch, place - 0.05, place + 0.05), abs=1e-4)
