"""Partial slip: exact solutions with their orders, cycles, bulk stress, unlike bodies, limits."""

from dataclasses import replace

import numpy as np
import pytest
from exact_partial_slip import SlippingContact, pressed_stick_ratio

from analytic.contact.equilibrium import Constraints
from analytic.contact.partial_slip import Loads, half_planes, pressed_in, stepped, stick_zones
from analytic.contact.patches import contact_patches
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap

MODULUS, RADIUS, LOAD, FRICTION, SHARE = 115e9, 8e-3, 4e5, 0.3, 0.6
HERTZ = hertz_from_load(LOAD, RADIUS, MODULUS)
LIMIT = FRICTION * LOAD
EXACT = SlippingContact(HERTZ, FRICTION, SHARE)
ELEMENTS = 21.3, 42.6, 85.2, 170.4  # on a half-width
PLACES = np.arange(8) / 16.0  # of the apex off a node, in pitches


def pair_of(elements: float, place: float = 0.0, beta: float = 0.0, wave: float = 0.0):
    """Both half-planes, the apex off a node; `wave` [m] is the amplitude of a rough surface."""
    pitch, a = HERTZ.half_width / elements, HERTZ.half_width
    grid = HatGrid.within(-1.4 * a, 1.4 * a, pitch)
    off = place * pitch

    def height(x):
        x = (x - off) / a
        return wave * (np.cos(23.0 * x) + 0.6 * np.cos(41.0 * x + 1.0) + 0.3 * np.sin(9.0 * x))

    smooth = roller_gap(RADIUS)
    gap = grid.hat_integrals(lambda x: smooth(x - off) - height(x))
    return grid, off, half_planes(grid, gap, MODULUS, beta, FRICTION)


def history(pair, steps):
    """The states after each step, from bodies that do not touch."""
    state = None
    for loads in steps:
        state = stepped(pair, state, loads)
        yield state


def swept(*shares: float, strain: float = 0.0) -> list[Loads]:
    """A press, then tangential loads with a strain in phase."""
    return [Loads(LOAD, share * LIMIT, share * strain) for share in (0.0, *shares)]


def errors(elements: float) -> np.ndarray:
    """Root mean square over PLACES of the relative errors of stick length, traction, energy lost
    in a cycle and displacement beyond that of surfaces that stick."""
    rows = []
    for place in PLACES:
        grid, off, pair = pair_of(elements, place)
        _, first, back, again = history(pair, swept(SHARE, -SHARE, SHARE))
        length = np.ptp(stick_zones(grid.x, first, FRICTION)) / EXACT.stick_half_width / 2.0
        traction = EXACT.traction(grid.x - off)
        energy = (back.work + again.work) / EXACT.energy_of_cycle
        # a bonded contact moves as a punch does, by 2 Q ln(2 L/a)/(pi E*)
        datum = (grid.count + 1) * grid.pitch
        bonded = 2.0 * SHARE * LIMIT / (np.pi * MODULUS) * np.log(2.0 * datum / HERTZ.half_width)
        displacement = first.displacement / (bonded + EXACT.beyond_stick)
        error = np.linalg.norm(first.traction - traction) / np.linalg.norm(traction)
        rows.append([length - 1.0, error, energy - 1.0, displacement - 1.0])
    return np.sqrt(np.mean(np.square(rows), axis=0))


def test_cattaneo_and_mindlin_with_orders():
    table = np.array([errors(elements) for elements in ELEMENTS])
    orders = -np.polyfit(np.log2(ELEMENTS), np.log2(table), 1)[0]
    low, high = np.array([[1.3, 0.9, 1.5, 1.8], [2.2, 1.1, 2.4, 2.8]])
    assert np.all((low < orders) & (orders < high))
    assert np.all(table[-1] < [2e-4, 5e-3, 2e-4, 5e-6])


def test_bulk_stress_moves_the_stick_zone():
    stress = 0.4 * FRICTION * HERTZ.peak_pressure
    exact = replace(EXACT, bulk_stress=stress)
    grid, _, pair = pair_of(ELEMENTS[-1])
    _, state = history(pair, swept(SHARE, strain=stress / (2.0 * MODULUS) / SHARE))
    [zone] = stick_zones(grid.x, state, FRICTION)
    pitch = 0.05 * grid.pitch
    assert zone.mean() == pytest.approx(exact.offset, abs=pitch)
    assert 0.5 * np.ptp(zone) == pytest.approx(exact.stick_half_width, abs=pitch)
    traction = exact.traction(grid.x)
    assert np.linalg.norm(state.traction - traction) < 5e-3 * np.linalg.norm(traction)


def at_load(pair, load: float) -> np.ndarray:
    """Pressure (n,) [Pa] under a normal load [N/m]."""
    constraints = Constraints(load=load)
    return pair.solve_normal(pair.weighted_gap, pair.weights, constraints, None).pressure


def test_a_rough_cycle_is_a_sum_of_normal_solutions():
    """Ciavarella and Jaeger: a path leaves mu (p(P) - p(P - Q/mu)), and behind a reversal twice
    that for half of the way back; a load that is passed again forgets what was between."""
    _, _, pair = pair_of(85.2, wave=8e-8)
    whole = at_load(pair, LOAD)
    assert len(contact_patches(pair.x, whole, whole * 0.0)) == 5

    def moved(share: float) -> np.ndarray:
        return FRICTION * (whole - at_load(pair, (1.0 - share) * LOAD))

    first = moved(0.8)
    back = first - 2.0 * moved(0.5 * (0.8 + 0.3))
    wanted = {0.8: first, -0.3: back, 0.1: back + 2.0 * moved(0.2), 0.9: moved(0.9)}
    _, *states = history(pair, swept(*wanted))
    for state, traction in zip(states, wanted.values(), strict=True):
        assert state.converged and state.work > 0.0
        assert np.abs(state.traction - traction).max() < 1e-7 * FRICTION * whole.max()


def test_limits():
    """Next to no load hardly anything slips, next to sliding the traction is that of sliding."""
    grid, _, pair = pair_of(85.2, wave=8e-8)
    _, least, most = history(pair, swept(1e-6, 1.0 - 1e-12))
    touching = np.ptp(contact_patches(grid.x, least.normal.pressure, least.normal.gap), axis=1)
    stuck = np.ptp(stick_zones(grid.x, least, FRICTION), axis=1)
    assert touching.sum() - stuck.sum() < 0.02 * touching.sum()
    limit = FRICTION * most.normal.pressure
    assert np.abs(most.traction - limit).max() < 1e-5 * limit.max()
    assert np.ptp(stick_zones(grid.x, most, FRICTION), axis=1).sum() < 3.0 * grid.pitch


@pytest.mark.parametrize("acts_back", [True, False], ids=["coupled", "one way"])
def test_unlike_bodies_stick_as_spence_has_it(acts_back):
    """A cylinder as a flat punch, with an error of first order in the length of the steps; where
    tractions do not act back by Goodman's theory."""
    beta = 0.25
    grid, _, pair = pair_of(85.2, beta=beta)
    pair = pair if acts_back else replace(pair, raised=None)
    inside, ratios = np.abs(grid.x) <= HERTZ.half_width, []
    flat = replace(pair, weighted_gap=np.where(inside, 0.0, grid.weights))
    [state] = history(flat, [Loads(LOAD)])  # a punch is pressed in one step
    stuck = np.ptp(stick_zones(grid.x, state, FRICTION))
    punch = stuck / (grid.pitch * np.count_nonzero(inside))
    if not acts_back:
        assert punch == pytest.approx(pressed_stick_ratio(beta, FRICTION), rel=2e-3)
    for steps in (4, 8, 16):
        *_, state = history(pair, pressed_in(LOAD, steps))
        contact = contact_patches(grid.x, state.normal.pressure, state.normal.gap)
        ratios.append(np.ptp(stick_zones(grid.x, state, FRICTION)) / np.ptp(contact))
        assert state.converged
    errors = 1.0 - np.array(ratios) / punch
    orders = -np.diff(np.log2(errors))
    assert np.all((orders > 0.8) & (orders < 1.3)) and errors[-1] < 0.04


def test_a_mirrored_contact_is_the_mirrored_solution():
    _, _, pair = pair_of(42.6, beta=0.28, wave=8e-8)
    mirrored = replace(pair, weighted_gap=pair.weighted_gap[::-1])
    steps = [*pressed_in(LOAD, 3), *swept(0.5, 0.1)]
    other = [replace(loads, tangential=-loads.tangential) for loads in steps]
    for one, two in zip(history(pair, steps), history(mirrored, other), strict=True):
        highest = one.normal.pressure.max()
        assert np.abs(one.normal.pressure - two.normal.pressure[::-1]).max() < 1e-6 * highest
        assert np.abs(one.traction + two.traction[::-1]).max() < 1e-6 * highest


@pytest.mark.parametrize("share", [1.0, -1.2, np.nan])
def test_what_friction_cannot_hold_is_refused(share):
    with pytest.raises(ValueError, match="the tangential load must be below 120000 N/m"):
        list(history(pair_of(21.3)[2], swept(share)))
