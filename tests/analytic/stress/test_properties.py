"""Properties of every field of stress: superposition, linearity, mirror, shift, units, balance."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analytic.stress.points import stress_at
from analytic.stress_state import StressState

EXACT = 1e-12
COUNT = 40
PITCH = 1.0 / 64.0
NODES = (np.arange(COUNT) - COUNT // 2) * PITCH

seeds = st.integers(0, 10**9)
frictions = st.floats(-1.0, 1.0)


def examples(number: int):
    return settings(max_examples=number, deadline=None, derandomize=True, database=None)


def pressures(seed: int) -> np.ndarray:
    """Patches of pressure between open nodes, up to about 1."""
    rng = np.random.default_rng(seed)
    return np.maximum(np.convolve(rng.standard_normal(COUNT + 4), np.ones(5) / 3.0, "valid"), 0.0)


def places(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Points near and far, on the surface, under nodes and between them."""
    rng = np.random.default_rng([seed, 1])
    x = np.concatenate((rng.uniform(-0.5, 0.5, 20), rng.choice(NODES, 10), rng.uniform(-9, 9, 5)))
    z = np.where(rng.random(35) < 0.2, 0.0, 10.0 ** rng.uniform(-6.0, 1.0, 35))
    return x, z


def at(pressure, friction, x, z) -> StressState:
    return stress_at(NODES, pressure, friction, x, z)


def assert_equal(state: StressState, expected: StressState, size: float, txz: float = 1.0):
    """All components to EXACT of `size` [Pa], txz times a factor."""
    difference = state.parts - np.array([[1.0], [1.0], [txz]]) * expected.parts
    assert np.max(np.abs(difference)) <= EXACT * size


def combined(*parts: tuple[float, StressState]) -> StressState:
    return StressState(*sum(c * part.parts for c, part in parts))


class TestPoints:
    @given(first=seeds, second=seeds, share=st.floats(-2.0, 2.0), friction=frictions)
    @examples(40)
    def test_superposition(self, first, second, share, friction):
        x, z = places(first)
        p, q = pressures(first), pressures(second)
        together = at(p + share * q, friction, x, z)
        parts = combined((1.0, at(p, friction, x, z)), (share, at(q, friction, x, z)))
        assert_equal(together, parts, 10.0)

    @given(seed=seeds, friction=frictions)
    @examples(30)
    def test_friction_is_linear(self, seed, friction):
        x, z = places(seed)
        p = pressures(seed)
        none, unit = at(p, 0.0, x, z), at(p, 1.0, x, z)
        parts = combined((1.0 - friction, none), (friction, unit))
        assert_equal(at(p, friction, x, z), parts, 10.0)

    @given(seed=seeds, friction=frictions)
    @examples(30)
    def test_mirror(self, seed, friction):
        """The mirrored pressure that slides the other way gives the mirrored stresses."""
        x, z = places(seed)
        p = pressures(seed)
        there = stress_at(-NODES[::-1], p[::-1], -friction, -x, z)
        assert_equal(there, at(p, friction, x, z), 10.0, txz=-1.0)

    @given(seed=seeds, friction=frictions, length=st.floats(1e-9, 1e9), load=st.floats(1e-9, 1e9))
    @examples(30)
    def test_units(self, seed, friction, length, load):
        x, z = places(seed)
        p = pressures(seed)
        there = stress_at(length * NODES, load * p, friction, length * x, length * z)
        # points are rounded to 1e-16 of 10, and at depth 1e-6 stresses vary within 1e-2
        assert_equal(there, combined((load, at(p, friction, x, z))), 10.0 * load)

    @given(seed=seeds, friction=frictions, pitches=st.integers(-1000, 1000))
    @examples(30)
    def test_shift(self, seed, friction, pitches):
        x, z = places(seed)
        x = np.round(x * 2.0**30) / 2.0**30  # so that the shift is exact
        p = pressures(seed)
        there = stress_at(NODES + pitches * PITCH, p, friction, x + pitches * PITCH, z)
        assert_equal(there, at(p, friction, x, z), 10.0)

    @given(seed=seeds, friction=frictions, x=st.floats(-0.25, 0.25))
    @examples(30)
    def test_the_surface_carries_what_is_put_on_it(self, seed, friction, x):
        p = pressures(seed)
        there = np.interp(x, NODES, p)
        stress = at(p, friction, np.array([x]), np.array([0.0]))
        assert stress.sz[0] == pytest.approx(-there, abs=EXACT)
        assert stress.txz[0] == pytest.approx(-friction * there, abs=EXACT)


class TestBalance:
    """The load passes through every level: integrals of sz, txz over a line of depth z."""

    @given(seed=seeds, friction=frictions, depth=st.floats(0.3, 3.0))
    @examples(15)
    def test_of_forces(self, seed, friction, depth):
        p = pressures(seed)
        load = PITCH * p.sum()
        angle, weight = np.polynomial.legendre.leggauss(200)
        angle, weight = 0.5 * np.pi * angle, 0.5 * np.pi * weight
        x, step = depth * np.tan(angle), weight * depth / np.cos(angle) ** 2
        stress = at(p, friction, x, np.full(200, depth))
        assert stress.sz @ step == pytest.approx(-load, rel=1e-10)
        assert stress.txz @ step == pytest.approx(-friction * load, abs=1e-10 * load)

    @given(seed=seeds, friction=frictions, x=st.floats(-0.4, 0.4), z=st.floats(0.05, 2.0))
    @examples(20)
    def test_of_an_inner_point(self, seed, friction, x, z):
        """No body forces: sx,x + txz,z = 0 and txz,x + sz,z = 0, by differences of sixth order."""
        p, h = pressures(seed), 0.02 * z
        offsets, weights = np.arange(-3, 4), np.array([-1, 9, -45, 0, 45, -9, 1]) / (60.0 * h)
        across = at(p, friction, x + h * offsets, np.full(7, z))
        down = at(p, friction, np.full(7, x), z + h * offsets)
        size = np.max(p) / z
        assert abs(weights @ across.sx + weights @ down.txz) < 1e-6 * size
        assert abs(weights @ across.txz + weights @ down.sz) < 1e-6 * size

    @given(seed=seeds, depth=st.floats(1e-3, 10.0))
    @examples(20)
    def test_no_level_is_pressed_harder_than_the_surface(self, seed, depth):
        """Without friction sz averages the pressure with positive weights of sum 1."""
        p = pressures(seed)
        x = np.linspace(-2.0, 2.0, 401)
        stress = at(p, 0.0, x, np.full(401, depth))
        assert np.all(stress.sz <= 0.0) and np.all(stress.sx <= EXACT * p.max())
        assert np.min(stress.sz) >= -p.max() * (1.0 + EXACT)
