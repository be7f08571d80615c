"""Properties of every contact, whatever its profile: units, mirror, shift, order, hardness.

Where nothing but the units or the side changes, pressures agree to EXACT of their peak. Profiles
are sums of waves that the grid resolves, drawn by hypothesis from seeds.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hats import solved
from hypothesis import example, given, settings
from hypothesis import strategies as st
from strips import PeriodicStrips, StripHalfPlane

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane

EXACT = 1e-10

seeds = st.integers(0, 10**9)
factors = st.floats(1e-9, 1e9)


def examples(number: int):
    return settings(max_examples=number, deadline=None, derandomize=True, database=None)


@dataclass(frozen=True)
class Contact:
    """A contact problem in units of its own length and modulus: gaps (n,) averaged, per pitch."""

    periodic: bool
    pitch: float
    modulus: float
    gap: np.ndarray
    constraints: Constraints
    element: str = "hat"

    @property
    def operator(self) -> HalfPlane | PeriodicHalfPlane:
        hats, strips = (
            (PeriodicHalfPlane, PeriodicStrips) if self.periodic else (HalfPlane, StripHalfPlane)
        )
        kind = hats if self.element == "hat" else strips
        return kind(len(self.gap), self.pitch, self.modulus)

    def solved(self) -> ContactSolution:
        return solved(self.operator, self.pitch * self.gap, **vars(self.constraints))

    def under(self, **limits: float) -> "Contact":
        return replace(self, constraints=replace(self.constraints, **limits))

    def at_approach(self, approach: float) -> "Contact":
        return self.under(load=None, approach=approach)


def waves(seed: int, slope: float):
    """Heights of eight waves, 1/40 to 1/3 of the length 1, each of about this slope."""
    rng = np.random.default_rng(seed)
    orders = rng.choice(np.arange(3, 41), 8, replace=False)
    phases = rng.uniform(0.0, 2.0 * np.pi, 8)
    heights = slope * rng.standard_normal(8) / (2.0 * np.pi * orders)
    return lambda x: np.cos(np.multiply.outer(2.0 * np.pi * x, orders) + phases) @ heights


def surface(seed: int):
    """Gap of a roller over waves, which may repeat after the length 1 with them."""
    rng = np.random.default_rng([seed, 2])
    ripple = waves(seed, 10.0 ** rng.uniform(-3.0, 0.0))
    curvature = 10.0 ** rng.uniform(-2.0, 0.0)

    def gap(x, periodic=False):
        bow = (1.0 - np.cos(2.0 * np.pi * x)) / (2.0 * np.pi) ** 2 if periodic else 0.5 * x**2
        return curvature * bow - ripple(x)

    return gap


def contact(seed: int, periodic: bool, hardness: bool = False) -> Contact:
    """A load between a few touching crests and nearly full contact; a hardness below the peaks."""
    rng = np.random.default_rng([seed, 1])
    count = int(rng.integers(120, 400))
    grid = HatGrid(1.0 / count, -(count // 2), count - 1 - count // 2)
    gap = surface(seed)
    mean_gap = grid.hat_integrals(lambda x: gap(x, periodic)) / grid.pitch
    load = np.ptp(mean_gap) * 10.0 ** rng.uniform(-3.0, 0.5)
    free = Contact(periodic, grid.pitch, 1.0, mean_gap, Constraints(load=load))
    if not hardness:
        return free
    peak = free.solved().pressure.max()
    return free.under(hardness=max(rng.uniform(0.3, 0.9) * peak, 1.2 * load))


def assert_close(values, expected, tolerance=EXACT):
    values, expected = np.asarray(values), np.asarray(expected)
    assert np.max(np.abs(values - expected)) <= tolerance * np.max(np.abs(expected))


both_ends = pytest.mark.parametrize("periodic", [False, True], ids=["free", "periodic"])


@pytest.mark.parametrize(("datum", "most", "least"), [(None, 1e-8, 0.0), (10.0, np.inf, 0.1)])
def test_a_datum_that_is_not_in_proportion_is_seen(datum, most, least):
    """A broken kernel: the approach is then no length of the problem any more."""
    here, approaches = contact(3, periodic=False), []
    for metre in (1.0, 2.0**10):
        operator = HalfPlane(len(here.gap), metre * here.pitch, 1.0, datum)
        weighted_gap = metre**2 * here.pitch * here.gap
        solution = solved(operator, weighted_gap, load=here.constraints.load * metre)
        approaches.append(solution.approach / metre)
    assert least <= abs(approaches[1] / approaches[0] - 1.0) <= most


@both_ends
class TestUnits:
    @given(seed=seeds, length=factors, modulus=factors, cap=st.booleans())
    @examples(25)
    def test_length_and_modulus(self, periodic, seed, length, modulus, cap):
        here = contact(seed, periodic, cap)
        limits = here.constraints
        there = Contact(
            periodic,
            length * here.pitch,
            modulus * here.modulus,
            length * here.gap,
            Constraints(load=limits.load * length * modulus, hardness=limits.hardness * modulus),
        ).solved()
        expected = here.solved()
        assert_close(there.pressure, modulus * expected.pressure)
        lengths = EXACT * length * np.ptp(here.gap)
        assert there.gap == pytest.approx(length * expected.gap, abs=lengths)
        assert there.approach == pytest.approx(length * expected.approach, abs=lengths)

    @given(seed=seeds, length=st.integers(-40, 40), modulus=st.integers(-25, 25))
    @examples(10)
    def test_powers_of_two_change_no_digit(self, periodic, seed, length, modulus):
        """Moduli change by powers of four, whose roots have no more digits."""
        here, (metre, pascal) = contact(seed, periodic), np.exp2([length, 2 * modulus])
        load = Constraints(load=here.constraints.load * metre * pascal)
        there = Contact(periodic, metre * here.pitch, pascal, metre * here.gap, load).solved()
        expected = here.solved()
        assert np.array_equal(there.pressure, pascal * expected.pressure)
        assert there.iterations == expected.iterations

    @given(seed=seeds, factor=factors)
    @examples(15)
    def test_gap_and_load_together(self, periodic, seed, factor):
        """Linear elasticity: heights, load and hardness in proportion, pressures in proportion."""
        here = contact(seed, periodic)
        there = replace(here, gap=factor * here.gap).under(load=factor * here.constraints.load)
        assert_close(there.solved().pressure, factor * here.solved().pressure)

    @given(seed=seeds, factor=factors)
    @example(seed=1872, factor=1e-9)  # pressures of 1e-10 Pa, far below any start's
    @examples(15)
    def test_modulus_at_a_given_approach(self, periodic, seed, factor):
        here = contact(seed, periodic)
        here = here.at_approach(here.solved().approach)
        there = replace(here, modulus=factor * here.modulus)
        assert_close(there.solved().pressure, factor * here.solved().pressure)


@both_ends
class TestPlace:
    @given(seed=seeds, cap=st.booleans())
    @examples(25)
    def test_mirror(self, periodic, seed, cap):
        here = contact(seed, periodic, cap)
        there = replace(here, gap=here.gap[::-1])
        assert_close(there.solved().pressure[::-1], here.solved().pressure)

    @given(seed=seeds, height=st.floats(-10.0, 10.0))
    @examples(20)
    def test_a_constant_gap_changes_the_approach_alone(self, periodic, seed, height):
        here = contact(seed, periodic)
        lifted = replace(here, gap=here.gap + height * np.ptp(here.gap)).solved()
        expected = here.solved()
        assert_close(lifted.pressure, expected.pressure)
        span = np.ptp(here.gap)
        assert lifted.approach - expected.approach == pytest.approx(height * span, abs=EXACT * span)


@given(seed=seeds, turn=st.integers(0, 1000), cap=st.booleans())
@examples(25)
def test_a_periodic_contact_may_begin_anywhere(seed, turn, cap):
    here = contact(seed, True, cap)
    turned = replace(here, gap=np.roll(here.gap, turn))
    assert_close(turned.solved().pressure, np.roll(here.solved().pressure, turn))


@given(seed=seeds, first=st.integers(-5000, 5000))
@examples(20)
def test_the_profile_may_stand_anywhere(seed, first):
    """Grid and profile moved together by whole pitches; a parabola of 10^6 pitches is rounded."""
    gap, pitch, solutions = surface(seed), 2.0**-8, []
    for origin in (0, first):
        grid = HatGrid(pitch, origin - 100, origin + 100)
        mean_gap = grid.hat_integrals(lambda x, o=origin: gap(x - o * pitch)) / pitch
        load = 0.05 * np.ptp(mean_gap)
        solutions.append(Contact(False, pitch, 1.0, mean_gap, Constraints(load=load)).solved())
    assert_close(solutions[1].pressure, solutions[0].pressure)


@both_ends
class TestOrder:
    @given(seed=seeds, cap=st.booleans())
    @examples(12)
    def test_more_load_more_of_everything(self, periodic, seed, cap):
        """Approach, area and every single pressure grow with the load."""
        here = contact(seed, periodic, cap)
        loads = here.constraints.load * np.array([0.1, 0.3, 0.6, 0.9, 1.0])
        solutions = [here.under(load=load).solved() for load in loads]
        assert np.all(np.diff([solution.approach for solution in solutions]) > 0.0)
        assert np.all(np.diff([np.count_nonzero(s.pressure) for s in solutions]) >= 0)
        steps = np.diff([solution.pressure for solution in solutions], axis=0)
        assert steps.min() >= -EXACT * solutions[-1].pressure.max()

    @given(seed=seeds, cap=st.booleans())
    @examples(12)
    def test_load_and_approach_lie_on_one_rising_curve(self, periodic, seed, cap):
        here = contact(seed, periodic, cap)
        by_load = here.solved()
        low = np.min(here.gap)
        depths = (by_load.approach - low) * np.array([0.05, 0.2, 0.5, 1.0])
        solutions = [here.at_approach(low + depth).solved() for depth in depths]
        loads = np.array([solution.load for solution in solutions])
        # capped nodes alone carry the same load until the next one is reached
        assert np.all(np.diff(loads) >= -EXACT * loads[-1])
        assert cap or np.all(np.diff(loads) > 0.0)
        assert loads[-1] == pytest.approx(by_load.load, rel=EXACT)
        assert_close(solutions[-1].pressure, by_load.pressure)

    @given(seed=seeds, where=st.floats(0.0, 1.0))
    @examples(15)
    def test_a_node_dug_out_is_unloaded(self, periodic, seed, where):
        """At a given approach its own pressure falls and so does the load."""
        here = contact(seed, periodic)
        solution = here.solved()
        touching = np.flatnonzero(solution.pressure)
        node = touching[int(where * (len(touching) - 1))]
        dug = here.gap.copy()
        dug[node] += 0.01 * (solution.approach - np.min(here.gap))
        here = here.at_approach(solution.approach)
        before, after = here.solved(), replace(here, gap=dug).solved()
        assert after.pressure[node] < before.pressure[node]
        assert after.load < before.load

    @given(seed=seeds, cap=st.booleans(), by_load=st.booleans(), size=st.floats(1e-3, 1.0))
    @examples(30)
    def test_pressures_give_way_to_gaps(self, periodic, seed, cap, by_load, size):
        """(p1 - p2)'(G1 - G2) <= -(p1 - p2)'C(p1 - p2), as the convex problem has it."""
        here = contact(seed, periodic, cap)
        if not by_load:
            here = here.at_approach(here.solved().approach)
        rng = np.random.default_rng([seed, 3])
        moved = size * np.ptp(here.gap) * rng.standard_normal(len(here.gap))
        first, second = here.solved(), replace(here, gap=here.gap + moved).solved()
        change = second.pressure - first.pressure
        yielded = here.operator.apply(change)
        assert here.pitch * (change @ moved) <= -(1.0 - EXACT) * (change @ yielded)


@both_ends
class TestCap:
    @given(seed=seeds)
    @examples(20)
    def test_the_load_moves_to_the_sides(self, periodic, seed):
        """Uses strips: a pressure then lowers the surface most where it acts, which hats do not."""
        here = replace(contact(seed, periodic, hardness=True), element="strip")
        hardness = here.constraints.hardness
        capped, free = here.solved(), here.under(hardness=np.inf).solved()
        assert capped.pressure.max() <= hardness
        assert capped.load == pytest.approx(here.constraints.load, rel=1e-12)
        assert np.count_nonzero(capped.pressure) >= np.count_nonzero(free.pressure)
        assert capped.approach >= free.approach
        below = capped.pressure < hardness
        slack = EXACT * free.pressure.max()
        assert np.all(capped.pressure[below] >= free.pressure[below] - slack)

    @given(seed=seeds, above=st.floats(1.0 + 1e-6, 1e6))
    @examples(15)
    def test_a_cap_above_the_peak_changes_nothing(self, periodic, seed, above):
        here = contact(seed, periodic)
        free = here.solved()
        capped = here.under(hardness=above * free.pressure.max()).solved()
        assert_close(capped.pressure, free.pressure)

    @given(seed=seeds)
    @examples(10)
    def test_a_lower_cap_takes_in_more(self, periodic, seed):
        here = contact(seed, periodic, hardness=True)
        hardness, mean = here.constraints.hardness, here.constraints.load
        lower = max(0.8 * hardness, 1.1 * mean)
        approaches = [here.under(hardness=cap).solved().approach for cap in (hardness, lower)]
        assert approaches[1] >= approaches[0]
