"""Every case of the gallery: consistent in itself, and met by the numerical half-plane."""

from functools import partial
from itertools import pairwise

import hats
import numpy as np
import pytest
from exact_stresses import sliding_stress
from scipy.integrate import quad

from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.exact.cases import ALUMINIUM, CERAMIC, STEEL, ExactContact, exact_contacts, hertz_case
from analytic.exact.hertz import hertz_from_load, hertz_stress
from analytic.exact.sliding import sliding_from_load
from analytic.grid import HatGrid
from analytic.operators.periodic import PeriodicHalfPlane
from analytic.operators.tangential import coupled_half_planes
from analytic.stress.points import stress_at

CASES = {case.name: case for case in exact_contacts()}
FULL = "Westergaard, full contact"
# Corners and edges narrower than the coarsest elements of these tests need finer ones.
COARSEST = {"rounded punch, flat 0.99": 1024, "flattened cylinder, hardness 0.7": 512}
# Error times elements on a half-width: a corner on a hundredth of it has the pressure's edge there.
LARGEST = {"rounded punch, flat 0.99": 22.0}
OFFSETS = (0.0, 0.25, 0.5, 0.75)

every_case = pytest.mark.parametrize("case", CASES.values(), ids=CASES)


@every_case
def test_figures_belong_to_the_pressure(case: ExactContact):
    left, right = case.quantities["left_edge"], case.quantities["right_edge"]
    assert case.quantities["contact_length"] == pytest.approx(right - left, rel=1e-15)
    assert -case.half_range <= left < right <= case.half_range
    middle, half = 0.5 * (left + right), 0.5 * (right - left)
    inner = [k for k in (*case.knots, -0.5 * case.quantities.get("flowed_length", 0.0)) if k > left]
    inner += [-k for k in inner]
    # x = middle + half cos t takes the singularity from the edges
    breaks = sorted({0.0, np.pi, *(float(np.arccos((k - middle) / half)) for k in inner)})

    def pressed(t):
        return float(case.pressure(middle + half * np.cos(t))) * half * np.sin(t)

    how = {"epsabs": 0.0, "epsrel": 1e-9, "limit": 200}
    load = sum(quad(pressed, *ends, **how)[0] for ends in pairwise(breaks))
    assert load == pytest.approx(case.load, rel=1e-7)
    x = np.linspace(left, right, 20003)[1:-1]
    pressure = case.pressure(x)
    assert np.all(pressure > 0.0)
    peak = case.quantities["peak_pressure"]
    assert peak * (1.0 - 1e-4) < pressure.max() <= peak * (1.0 + 1e-12)
    if "peak_position" in case.quantities:
        assert case.pressure(case.quantities["peak_position"]) == pytest.approx(peak, rel=1e-14)
    if case.period is None:
        assert not case.pressure(np.array([left - 1e-6 * half, right + 1e-6 * half, 9.0])).any()
    else:
        np.testing.assert_allclose(case.pressure(x + case.period), pressure, 1e-6, 1e-9 * peak)
        gap = case.gap(x)
        np.testing.assert_allclose(case.gap(x + case.period), gap, 0.0, 1e-9 * np.ptp(gap))


def test_friction_between_unlike_bodies_is_no_hertz_contact():
    with pytest.raises(ValueError, match="is a sliding case"):
        hertz_case("", (ALUMINIUM, CERAMIC), 1.0, 1e6, friction=0.1)
    assert hertz_case("", (STEEL, STEEL), 1.0, 1e6, friction=0.1).quantities["tau1_max"] > 0.3e6


def solved(
    case: ExactContact, elements: int, offset: float = 0.0
) -> tuple[np.ndarray, ContactSolution]:
    """Nodes (n,) [m] in the case's own x, whose zero is `offset` pitches off a node; solution."""
    pitch = 2.0 * case.half_range / elements
    if case.period:
        grid = HatGrid(pitch, -(elements // 2), elements - elements // 2 - 1)
    else:
        grid = HatGrid.within(-case.half_range, case.half_range, pitch)
    shift = offset * pitch
    gap = grid.hat_integrals(lambda x: case.gap(x - shift), np.array(case.knots) + shift)
    size = grid.count, pitch, case.combined_modulus
    if case.period:
        operator = PeriodicHalfPlane(*size)
    else:
        operator = coupled_half_planes(*size, case.friction * case.dundurs_beta)
    solution = hats.solved(operator, gap, load=case.load, hardness=case.hardness)
    return grid.x - shift, solution


@every_case
def test_numerical_half_plane_meets_it(case: ExactContact):
    """Orders: 1 in L2 at the edges' square root, 2 where there is no edge.

    Errors are averaged over where the edges fall between two nodes.
    """
    errors = []
    coarsest = COARSEST.get(case.name, 128)
    for elements in (coarsest, 4 * coarsest):
        square = []
        for offset in OFFSETS:
            x, solution = solved(case, elements, offset)
            exact = case.pressure(x)
            square.append(np.sum((solution.pressure - exact) ** 2) / np.sum(exact**2))
        errors.append(np.sqrt(np.mean(square)))
    order = np.log2(errors[0] / errors[-1]) / 2.0
    assert order == pytest.approx(2.0 if case.name == FULL else 1.0, abs=0.07)
    half = 0.5 * case.quantities["contact_length"] / (x[1] - x[0])
    assert errors[-1] < LARGEST.get(case.name, 4.0) / half
    assert solution.pressure.max() == pytest.approx(case.quantities["peak_pressure"], rel=1e-3)
    if case.name != FULL:
        patches = contact_patches(x, solution.pressure, solution.gap)
        assert len(patches) == 1
        exact = case.quantities["left_edge"], case.quantities["right_edge"]
        assert np.abs(patches[0] - exact).max() < 0.1 * (x[1] - x[0])
    if "mean_gap" in case.quantities and case.name != FULL:
        assert solution.gap.mean() == pytest.approx(case.quantities["mean_gap"], rel=1e-3)


def assert_second_order(case: ExactContact, exact, half_width: float) -> None:
    """Check the largest errors over the peak pressure, 0.1 to 2 half-widths deep."""
    x = half_width * np.linspace(-2.0, 2.0, 41)
    z = half_width * np.array([[0.1], [0.2], [0.5], [1.0], [2.0]])
    expected = exact(x, z)
    errors = []
    for elements in (512, 1024, 2048):
        largest = []
        for offset in OFFSETS:
            nodes, solution = solved(case, elements, offset)
            stress = stress_at(nodes, solution.pressure, case.friction, x, z)
            largest.append(np.abs(stress.parts - expected.parts).max())
        errors.append(np.mean(largest) / case.quantities["peak_pressure"])
    assert np.log2(errors[0] / errors[-1]) / 2.0 == pytest.approx(2.0, abs=0.2)
    assert errors[-1] < 2e-5


class TestStresses:
    """Fields of the numerical pressure against closed forms, of order 2 below the edges."""

    @pytest.mark.parametrize("friction", ["0.1", "0.3"])
    def test_sliding_without_coupling(self, friction):
        case = CASES[f"Hertz, steel on steel, friction {friction}"]
        hertz = hertz_from_load(case.load, 8.2e-3, case.combined_modulus)
        exact = partial(hertz_stress, hertz, friction=case.friction)
        assert_second_order(case, exact, hertz.half_width)

    def test_sliding_with_coupling(self):
        case = CASES["sliding, rigid on steel, friction 0.5"]
        pair = case.combined_modulus, case.friction, case.dundurs_beta
        contact = sliding_from_load(case.load, 10e-3, *pair)
        assert_second_order(case, partial(sliding_stress, contact), contact.half_width)
