"""Displacements continued over the gaps: what the continuation is, and what it buys."""

import numpy as np
import pytest
from scipy.linalg import toeplitz

from analytic.contact.active_set import ActiveSet
from analytic.contact.equilibrium import Constraints, EquilibriumProblem
from analytic.contact.preconditioner import Extension, RowExtension, extension_from
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane

COUNT = 60
SETS = {
    "one node": np.array([17]),
    "first node": np.array([0]),
    "last node": np.array([COUNT - 1]),
    "all nodes": np.arange(COUNT),
    "both ends": np.array([0, COUNT - 1]),
    "patches": np.r_[4:11, 12:13, 20:33, 50:58],
    "every third": np.arange(1, COUNT, 3),
}


def preconditioner(operator, nodes: np.ndarray) -> np.ndarray:
    """E' B E on these nodes, as a matrix."""
    extension, columns = Extension(nodes, operator.ring, closed=True), np.eye(len(nodes))
    return np.stack([extension.gather(operator.precondition(extension.extend(c))) for c in columns])


@pytest.mark.parametrize("nodes", SETS.values(), ids=SETS.keys())
@pytest.mark.parametrize("kind", [HalfPlane, PeriodicHalfPlane], ids=["open", "closed"])
def test_the_preconditioner_is_symmetric_positive_definite(nodes, kind):
    product = preconditioner(kind(COUNT, 1.0, 1.0), nodes)
    assert product == pytest.approx(product.T, abs=1e-13 * np.abs(product).max())
    assert np.linalg.eigvalsh(product).min() > 0.0


class TestIterations:
    """Conjugate gradients on patches of 14 touching and 14 open nodes, for any displacements."""

    PERIOD = 28

    def applications(self, patches: int) -> int:
        count = self.PERIOD * patches
        operator, weights = PeriodicHalfPlane(count, 1.0, 1.0), np.ones(count)
        rng = np.random.default_rng(7)
        lower = np.arange(count) % self.PERIOD >= self.PERIOD // 2
        gap = np.cumsum(rng.standard_normal(count)) * 1e-3
        spent = {"exchanges": 0, "applications": 0}
        problem = EquilibriumProblem(operator, gap, weights, Constraints(load=count), spent)
        active = ActiveSet(lower, np.zeros(count, dtype=bool))
        rest = problem.equilibrium(np.ones(count), active, 1e-8)
        touching = ~lower
        assert np.abs(rest.weighted_gap[touching]).max() < 1e-5 * np.ptp(rest.weighted_gap)
        return spent["applications"]

    def test_their_number_hardly_grows_with_the_patches(self):
        few, many = self.applications(20), self.applications(400)
        assert many < 1.5 * few
        assert many < 40


def test_the_free_half_planes_ring_is_long_enough():
    """Closing the line for the inverse must not join what happens at its two ends."""
    operator = HalfPlane(512, 1.0, 1.0)
    inverse = np.linalg.inv(toeplitz(operator.column))
    product = preconditioner(operator, np.arange(512))
    spectrum = np.linalg.eigvals(np.linalg.solve(inverse, product)).real
    assert np.sort(spectrum)[-2] / np.sort(spectrum)[1] < 4.0


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("nodes", [range(5, 30), range(30), range(30, 60), range(60), range(7, 8)])
def test_a_row_of_nodes_is_continued_alike(nodes, closed):
    nodes = np.array(nodes)
    row, any_set = extension_from(nodes, COUNT, closed), Extension(nodes, COUNT, closed)
    assert isinstance(row, RowExtension)
    rng = np.random.default_rng(12)
    moved, forces = rng.normal(size=len(nodes)), rng.normal(size=COUNT)
    assert row.extend(moved) == pytest.approx(any_set.extend(moved), abs=1e-14)
    assert row.gather(forces) == pytest.approx(any_set.gather(forces), abs=1e-13)
