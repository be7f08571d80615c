"""Direct sums of element stresses: what superposition, scaling and equilibrium demand."""

from itertools import pairwise

import numpy as np
import pytest
from exact_stresses import hat_stress, strip_stress
from scipy.integrate import trapezoid

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.stress.points import friction_stress_at, stress_at

RNG = np.random.default_rng(17)
PITCH = 2.0**-9
NODES = (np.arange(40) - 13.0) * PITCH
PRESSURE = np.maximum(RNG.standard_normal(40), 0.0) * 1e9
X, Z = RNG.uniform(-0.1, 0.15, 60), RNG.uniform(0.0, 0.05, 60)


@pytest.mark.parametrize(
    ("element", "unit", "size"), [("hat", hat_stress, PITCH), ("strip", strip_stress, 0.5 * PITCH)]
)
def test_sum_of_the_elements(element, unit, size):
    total = stress_at(NODES, PRESSURE, 0.3, X, Z, element)
    states = [unit(X - node, Z, size).at(0.3) for node in NODES]
    expected = sum(p * stress.parts for p, stress in zip(PRESSURE, states, strict=True))
    assert np.abs(total.parts - expected).max() < 1e-14 * PRESSURE.max()


@pytest.mark.parametrize("count", [20, 2000])  # one by one, and by the tree
def test_the_surface_has_no_sign(count):
    """A depth of -0.0 is the surface."""
    load = np.tile(PRESSURE, 10)
    nodes = np.arange(len(load)) * PITCH
    x = np.concatenate([nodes[::40], np.linspace(0.0, nodes[-1], count)])
    plus, minus = (stress_at(nodes, load, 0.3, x, zero * np.ones_like(x)) for zero in (0.0, -0.0))
    assert np.all(plus.sx == minus.sx) and np.all(plus.txz == minus.txz)


def test_many_elements_in_blocks_as_in_one():
    """More pairs than one block holds, and points of any shape."""
    x = np.linspace(-0.1, 0.2, 1900).reshape(19, 100)
    whole = friction_stress_at(NODES, np.full(40, 1e9), x, 0.01)
    assert whole.normal.sx.shape == (19, 100)
    single = [friction_stress_at(NODES, np.full(40, 1e9), x[k, 7], 0.01) for k in (0, 18)]
    np.testing.assert_allclose(
        whole.normal.sx[[0, 18], 7], [one.normal.sx for one in single], rtol=1e-13
    )
    idle = stress_at(NODES, np.zeros(40), 0.1, x, 0.01)
    np.testing.assert_array_equal(idle.sz, np.zeros((19, 100)))


@pytest.mark.parametrize(
    ("nodes", "pressure", "z", "element", "said"),
    [
        (NODES**2, PRESSURE, 1.0, "hat", "uniform and ascending"),
        (NODES[::-1], PRESSURE, 1.0, "hat", "uniform and ascending"),
        (NODES, PRESSURE[1:], 1.0, "hat", "equal length"),
        (NODES[:1], PRESSURE[:1], 1.0, "hat", "at least 2 nodes"),
        (NODES, np.where(PRESSURE > 0.0, np.nan, 0.0), 1.0, "hat", "finite"),
        (NODES, PRESSURE, -1.0, "hat", "z must not be negative"),
        (NODES, PRESSURE, 1.0, "spline", '"hat" or "strip"'),
    ],
)
def test_what_makes_no_stress_is_refused(nodes, pressure, z, element, said):
    with pytest.raises(ValueError, match=said):
        stress_at(nodes, pressure, 0.0, 0.0, z, element)


UNIT = hertz_from_peak_pressure(1.0, 1.0, 2.0)
UNIT_NODES = np.linspace(-1.0, 1.0, 401)
UNIT_PRESSURE = UNIT.pressure(UNIT_NODES)


def test_two_slanted_sections_carry_the_load_between_them():
    """A wedge under the contact is in equilibrium: tractions on its sides against p and q."""
    share, force = np.linspace(0.0, 1.0, 4001), np.zeros(2)
    corners = np.array([[-2.0, 0.0], [0.3, 1.5], [2.5, 0.0]])
    for start, stop in pairwise(corners):
        x, z = (start + share[:, None] * (stop - start)).T
        stress = stress_at(UNIT_NODES, UNIT_PRESSURE, 0.25, x, z)
        run, fall = stop - start
        # the normal of the wedge's side is (-fall, run) over its length
        along = trapezoid(run * stress.txz - fall * stress.sx, share)
        down = trapezoid(run * stress.sz - fall * stress.txz, share)
        force += along, down
    load = UNIT_PRESSURE.sum() * (UNIT_NODES[1] - UNIT_NODES[0])
    np.testing.assert_allclose(force, [-0.25 * load, -load], rtol=1e-5)
