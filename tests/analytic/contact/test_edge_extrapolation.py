"""Edges that are extrapolated from the tension or the overlap that a wrong set shows."""

import numpy as np
import pytest

from analytic.contact.active_set import ActiveSet, Violations, extrapolated
from analytic.contact.equilibrium import Constraints, EquilibriumProblem
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane

MODULUS, RADIUS, LOAD = 1e11, 1e-2, 1e5
HERTZ = hertz_from_load(LOAD, RADIUS, MODULUS)
GRID = HatGrid.within(-2.0 * HERTZ.half_width, 2.0 * HERTZ.half_width, HERTZ.half_width / 400)
NONE = np.zeros(GRID.count, dtype=bool)


def violations_with_edges(half_nodes: int) -> tuple[Violations, ActiveSet]:
    """What Hertz's contact shows with this many nodes free on either side of its centre."""
    operator = HalfPlane(GRID.count, GRID.pitch, MODULUS)
    weighted_gap = GRID.hat_integrals(roller_gap(RADIUS))
    constraints = Constraints(load=LOAD)
    spent = {"exchanges": 0, "applications": 0}
    problem = EquilibriumProblem(operator, weighted_gap, GRID.weights, constraints, spent)
    free = np.abs(np.arange(GRID.first, GRID.last + 1)) <= half_nodes
    active = ActiveSet(~free, NONE)
    rest = problem.equilibrium(HERTZ.pressure(GRID.x), active, 0.0)
    return problem.violations(rest, active), active


def left_over(active: ActiveSet) -> int:
    """Nodes by which the free set is wrong."""
    return abs(np.count_nonzero(active.free) - 801)


@pytest.mark.parametrize("excess", [10, 20, 40])
def test_tension_shows_half_of_an_excess(excess):
    violated, active = violations_with_edges(400 + excess)
    assert np.count_nonzero(violated.tensile) == pytest.approx(excess, abs=0.2 * excess + 2)
    assert not violated.joining.any()
    better, plain = map(active.exchanged, (extrapolated(violated, active), violated))
    assert left_over(better) <= 0.3 * left_over(plain)


@pytest.mark.parametrize("lack", [12, 24, 48])
def test_overlap_shows_one_and_a_half_times_a_lack(lack):
    violated, active = violations_with_edges(400 - lack)
    assert np.count_nonzero(violated.joining) == pytest.approx(3 * lack, abs=0.4 * lack + 2)
    assert not violated.tensile.any()
    better, plain = map(active.exchanged, (extrapolated(violated, active), violated))
    assert left_over(better) <= 0.4 * left_over(plain)


def marks(text: str) -> np.ndarray:
    return np.array([letter == "x" for letter in text])


@pytest.mark.parametrize(
    ("free", "tensile", "joining", "expected"),
    [  # tensile runs grow inwards
        ("..xxxxxx..", "..xxx.....", "", "..xxxxx..."),  # from the left edge, as far less one
        ("..xxxxxx..", ".....xxx..", "", "...xxxxx.."),
        ("xxxxxxxx..", "xxx.......", "", "xxxxx....."),  # the end of the grid is an edge
        ("..xxxxxx..", "..x.......", "", "..x......."),  # single nodes as they are
        ("..xxxxxx..", "....xx....", "", "....xx...."),  # within the patch: no edge to move
        ("...xxx....", "...xxx....", "", "...xxx...."),  # the whole patch
        (".xxxx.xxxx", ".xxx......", "", ".xxxx....."),  # no farther than the patch goes
        # joining runs shrink towards their patch
        ("xxx.......", "", "...xxxxxx.", "...xxxx..."),  # the two thirds beside the patch
        (".......xxx", "", ".xxxxxx...", "...xxxx..."),
        ("xx......xx", "", "..xxxxxx..", "..xxxxxx.."),  # a gap that closes
        ("..........", "", "..xxxxxx..", "..xxxxxx.."),  # a new patch
        ("xxx.......", "", "...xx.....", "...xx....."),
    ],
)
def test_runs_grow_inwards_or_shrink_towards_their_patch(free, tensile, joining, expected):
    none = np.zeros(len(free), dtype=bool)
    shown = [marks(runs) if runs else none for runs in (tensile, joining)]
    violations = Violations(shown[0], none, shown[1], none)
    ends = extrapolated(violations, ActiveSet(~marks(free), none))
    assert (ends.tensile if tensile else ends.joining).tolist() == marks(expected).tolist()
