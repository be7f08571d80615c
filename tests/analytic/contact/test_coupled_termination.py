"""Sliding contacts end whatever they start from; what exchanges and contractions take."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic.contact import coupled as coupled_contact
from analytic.contact.coupled import CoupledEquilibrium
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactError
from analytic.grid import HatGrid


class TestContraction:
    """The part with a proof, alone: what exchanges that never settle are left to."""

    @pytest.fixture
    def unsettled(self, monkeypatch):
        monkeypatch.setattr(
            coupled_contact, "exchange_blocks", lambda problem, start: (start, None, False)
        )

    @pytest.mark.parametrize("friction_dundurs", [0.05, 0.3, 0.75, 1.5])
    def test_it_finds_the_same_solution(self, roller, friction_dundurs, monkeypatch, unsettled):
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        solution = roller.sliding(grid, roller.rough(1), friction_dundurs)
        monkeypatch.undo()
        expected = roller.sliding(grid, roller.rough(1), friction_dundurs)
        assert solution.converged and solution.iterations["contractions"] > 1
        assert expected.converged and expected.iterations["contractions"] == 0
        error = np.abs(solution.pressure - expected.pressure).max()
        assert error < 1e-7 * expected.pressure.max()
        assert solution.approach == pytest.approx(expected.approach, rel=1e-8)

    @pytest.mark.parametrize("hardness", [np.inf, 6e9])
    def test_prescribed_approach_and_hardness(self, roller, hardness, monkeypatch, unsettled):
        grid = HatGrid.within(-1.1e-3, 1.1e-3, 10e-6)
        constraints = Constraints(approach=3e-5, hardness=hardness)
        solution = roller.sliding(grid, roller.rough(1), 0.3, constraints)
        monkeypatch.undo()
        expected = roller.sliding(grid, roller.rough(1), 0.3, constraints)
        assert solution.converged
        assert solution.load == pytest.approx(expected.load, rel=1e-7)


def test_a_set_that_returns_ends_the_exchanges(roller, monkeypatch):
    """A node that changes active for ever: the contraction finishes what they cannot."""
    violations = CoupledEquilibrium.violations

    def restless(self, rest, active):
        violated = violations(self, rest, active)
        tensile, joining = violated.tensile.copy(), violated.joining.copy()
        tensile[0], joining[0] = not active.lower[0], active.lower[0]
        return replace(violated, tensile=tensile, joining=joining)

    monkeypatch.setattr(CoupledEquilibrium, "violations", restless)
    solution = roller.sliding(roller.grid, roller.rough(1), 0.3)
    assert solution.converged and solution.iterations["contractions"] > 1
    assert solution.iterations["exchanges"] < 100


class TestCost:
    """Applications, not seconds."""

    @pytest.mark.parametrize("amplitude", [0.0, 0.4e-6, 4e-6])
    def test_three_times_the_uncoupled_problem_at_most(self, roller, amplitude, friction_dundurs):
        grid = HatGrid.within(-1.3e-3, 1.3e-3, 2.6e-3 / 4000)
        gap = roller.rough(1, amplitude)
        plain, coupled = roller.pressed(grid, gap), roller.sliding(grid, gap, friction_dundurs)
        assert coupled.converged and coupled.iterations["contractions"] == 0
        assert coupled.iterations["applications"] < 3.0 * plain.iterations["applications"]

    def test_hardly_grows_with_the_number_of_elements(self, roller, friction_dundurs):
        """A profile of fixed bandwidth: each doubling adds a level, which takes as many as the
        last, about a dozen."""
        spent = []
        for elements in (2000, 8000, 32000):
            grid = HatGrid.within(-1.1e-3, 1.1e-3, 2.2e-3 / elements)
            solution = roller.sliding(grid, roller.rough(3), friction_dundurs)
            assert solution.converged
            spent.append(solution.iterations["applications"])
        assert spent[-1] < 150
        assert max(np.diff(spent)) < 2 * 20

    def test_a_bad_start_costs_no_more_than_a_search_in_vain(self, roller):
        """All nodes touching, or one: where exchanges do not settle the coarser grids help."""
        expected = roller.sliding(roller.grid, roller.rough(1), 0.75)
        for start in (np.ones(roller.grid.count), np.eye(roller.grid.count)[3]):
            solution = roller.sliding(roller.grid, roller.rough(1), 0.75, start=start)
            assert solution.converged
            error = np.abs(solution.pressure - expected.pressure).max()
            assert error < 1e-7 * expected.pressure.max()


@settings(max_examples=40, deadline=None, derandomize=True, database=None)
@given(
    seed=st.integers(0, 10**6),
    friction_dundurs=st.floats(-0.75, 0.75),
    amplitude=st.floats(0.0, 5e-6),
    load=st.floats(1e3, 5e6),
    hardness=st.sampled_from([np.inf, 1e10]),
)
def test_any_contact_ends_and_holds(roller, seed, friction_dundurs, amplitude, load, hardness):
    grid = HatGrid.within(-1.6e-3, 1.6e-3, 8e-6)
    constraints = Constraints(load=load, hardness=hardness)
    solution = roller.sliding(grid, roller.rough(seed, amplitude), friction_dundurs, constraints)
    assert solution.converged
    assert solution.pressure.min() >= 0.0 and solution.pressure.max() <= hardness


def test_more_load_than_the_hardness_carries_is_refused(roller):
    with pytest.raises(ContactError, match="exceeds what the surface can carry"):
        too_soft = Constraints(load=roller.load, hardness=1e9)
        roller.sliding(roller.grid, roller.rough(1), 0.3, too_soft)


def test_a_vanishing_load_rests_on_one_crest(roller):
    solution = roller.sliding(roller.grid, roller.rough(1), 0.5, Constraints(load=1e-9))
    assert solution.converged
    assert np.count_nonzero(solution.pressure) <= 2
