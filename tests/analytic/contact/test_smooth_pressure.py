"""The smooth pressure behind hats, on Hertz's contact and on others."""

import numpy as np
import pytest
from scipy.optimize import brentq
from unequal_hats import half_plane_matrix, hat_weights

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.contact.smooth_pressure import (
    LEAST_NODES,
    contact_ends,
    nodal_values,
    smooth_pressure,
)
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import hat_integrals
from analytic.operators.half_plane import DenseCompliance

HERTZ = hertz_from_peak_pressure(1.0, 0.5, 1.0)  # half-width 1
NORM = np.sqrt(4.0 / 3.0)


def parabola(x):
    return x**2


def contact(hats, gap=parabola, load=HERTZ.load_per_length):
    operator = DenseCompliance(half_plane_matrix(hats, 1.0))
    weighted_gap = hat_integrals(hats, gap)
    return solve_contact(operator, weighted_gap, hat_weights(hats), Constraints(load=load))


def graded(edges, end=1.003):
    """Nodes towards an end that is not quite that of contact, and beyond it."""
    half = end * (1.0 - np.linspace(1.0, 0.0, edges + 1) ** 2)
    steps = (half[-1] - half[-2]) * 1.3 ** np.arange(100)
    half = np.concatenate([half, end + np.cumsum(steps)])
    half = half[half < 1.5]
    return np.concatenate([-half[:0:-1], half])


def equal(per_half):
    return np.arange(-int(1.6 * per_half), int(1.6 * per_half) + 1) / per_half


def distance(curve, other, points=40_001):
    """L2 distance relative to Hertz's pressure, along the angle that square roots like."""
    angle = np.linspace(0.0, np.pi, points)
    x = -1.2 * np.cos(angle)
    error = (curve(x) - other(x)) ** 2 * 1.2 * np.sin(angle)
    return np.sqrt(error.sum() * (angle[1] - angle[0])) / NORM


def errors(hats):
    """L2 errors of hats and of the curve, the estimate; of ends in pitches there; of peaks."""
    solution = contact(hats)
    (patch,) = smooth_pressure(hats, solution.pressure, solution.gap)
    whole = np.concatenate([[0.0], solution.pressure, [0.0]])
    square = (whole[1:] ** 2 + whole[1:] * whole[:-1] + whole[:-1] ** 2) / 3.0
    assert patch.norm**2 == pytest.approx(square @ np.diff(hats), rel=1e-12)
    at_end = np.diff(hats)[patch.last + 1]
    return {
        "hats": distance(lambda x: np.interp(x, hats, whole), HERTZ.pressure),
        "curve": distance(lambda x: np.where(np.abs(x) < 1.2, patch.curve(x), 0.0), HERTZ.pressure),
        "estimate": patch.error / patch.norm,
        "end": max(abs(patch.ends[0] + 1.0), abs(patch.ends[1] - 1.0)) / at_end,
        "node": abs(solution.pressure.max() - 1.0),
        "peak": abs(patch.peak[0] - 1.0),
    }


@pytest.mark.parametrize("hats", [graded(6), graded(8), graded(16), equal(10.25), equal(20.5)])
def test_estimate_is_the_error(hats):
    found = errors(hats)
    assert 0.85 < found["estimate"] / found["hats"] < 1.25


@pytest.mark.parametrize("end", [0.98, 0.995, 1.0, 1.003, 1.01])
@pytest.mark.parametrize("edges", [8, 16])
def test_curve_is_closer_than_the_hats_wherever_the_end_lies_between_nodes(edges, end):
    found = errors(graded(edges, end))
    assert found["curve"] < 0.75 * found["hats"]
    assert found["peak"] < 0.1 * found["node"]
    assert found["end"] < 0.3


@pytest.mark.parametrize("fraction", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_on_equal_hats_too(fraction):
    found = errors(equal(20.0 + fraction))
    assert found["curve"] < 0.55 * found["hats"]
    assert found["peak"] < 2e-4
    assert found["end"] < 0.2


def test_orders_of_both():
    """Graded hats of second order in their number, equal ones of first, the peak of third."""
    coarse, fine = errors(graded(8, 1.0)), errors(graded(16, 1.0))
    order = {name: np.log2(coarse[name] / fine[name]) for name in coarse}
    assert order["hats"] == pytest.approx(2.0, abs=0.1)
    assert order["estimate"] == pytest.approx(2.0, abs=0.15)
    assert 2.5 < order["peak"] < 3.5
    coarse, fine = errors(equal(10.25)), errors(equal(40.25))
    assert np.log2(coarse["hats"] / fine["hats"]) / 2.0 == pytest.approx(1.0, abs=0.1)
    assert np.log2(coarse["curve"] / fine["curve"]) / 2.0 == pytest.approx(1.0, abs=0.15)


def test_nodal_values_undo_the_overshoot_of_hats_on_a_parabola():
    pitch = 0.1
    hats = pitch * np.arange(-5, 6)
    wanted = 3.0 - 2.0 * hats[1:-1] + 1.5 * hats[1:-1] ** 2
    found = nodal_values(hats, wanted - 3.0 * pitch**2 / 12.0)
    assert found[1:-1] == pytest.approx(wanted[1:-1], rel=1e-13)


def test_all_ends_at_once_are_those_of_a_search_one_by_one(rng):
    """On unequal hats; the same equation for each end alone, by quadrature and brentq."""
    hats, gap = np.cumsum(rng.uniform(0.8, 1.2, 402)), np.zeros(400)
    for start in range(0, 400, 40):  # open, then in contact
        depth = np.minimum(np.arange(20), np.arange(20)[::-1]) + rng.uniform(0.0, 1.0)
        gap[start : start + 20] = depth**1.5 * (1.0 + 0.02 * depth)
    nodes, ends = contact_ends(hats, np.where(gap > 0.0, 0.0, 1.0), gap)
    assert len(nodes) == 10
    for node, found, side in [
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
                / hat_weights(hats[some])
                for p in (1.5, 2.5)
            ]
            return np.linalg.det(np.array([*rows, gap[near.min() : near.max() + 1]]))

        assert found == pytest.approx(brentq(mismatch, found - 0.05, found + 0.05), abs=1e-4)


def test_several_patches_each_with_their_own_ends():
    """A load that closes two crests of a sinusoid, against the same on far finer hats."""

    def waves(x):
        return -0.05 * np.cos(2.0 * np.pi * (x - 0.5))

    coarse, fine = np.linspace(-1.0, 1.0, 162), np.linspace(-1.0, 1.0, 502)
    found, exact = (
        smooth_pressure(hats, solution.pressure, solution.gap)
        for hats in (coarse, fine)
        for solution in [contact(hats, waves, 0.02)]
    )
    assert len(found) == len(exact) == 2
    for patch, finer in zip(found, exact, strict=True):
        assert patch.smooth
        assert patch.ends == pytest.approx(finer.ends, abs=0.2 * 2.0 / 161)
        assert patch.peak[0] == pytest.approx(finer.peak[0], rel=2e-3)
        assert patch.norm == pytest.approx(finer.norm, rel=1e-2)


def test_mirrored_contact_has_mirrored_patches():
    def lopsided(x):
        return (x - 0.123) ** 2 - 0.02 * np.sin(9.0 * x)

    hats = np.linspace(-1.5, 1.7, 130)
    there = contact(hats, lopsided)
    back = contact(-hats[::-1], lambda x: lopsided(-x))
    patches = smooth_pressure(hats, there.pressure, there.gap)
    mirrored = smooth_pressure(-hats[::-1], back.pressure, back.gap)[::-1]
    for one, other in zip(patches, mirrored, strict=True):
        assert one.ends == pytest.approx((-other.ends[1], -other.ends[0]), abs=1e-7)
        assert one.peak[0] == pytest.approx(other.peak[0], rel=1e-6)
        assert one.error == pytest.approx(other.error, rel=1e-4)


def test_a_patch_of_few_nodes_says_that_nothing_is_known_of_it():
    pressure = np.zeros(20)
    pressure[8 : 8 + LEAST_NODES - 1] = 1.0
    hats = np.linspace(0.0, 2.1, 22)
    (patch,) = smooth_pressure(hats, pressure, np.where(pressure > 0.0, 0.0, 1.0))
    assert not patch.smooth
    assert patch.error == patch.norm > 0.0
    x = np.linspace(*patch.ends, 7)
    assert np.array_equal(patch.curve(x), np.interp(x, hats, [0.0, *pressure, 0.0]))


def test_without_contact_there_are_no_patches():
    assert smooth_pressure(np.linspace(0.0, 1.0, 9), np.zeros(7), np.ones(7)) == ()
