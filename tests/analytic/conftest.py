"""A roller over rough ground, alike for plain and for sliding contact; each solution converges."""

from collections.abc import Callable

import numpy as np
import pytest
from hats import pressed, solved

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.exact.hertz import HertzContact, hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.operators.tangential import coupled_half_planes

Gap = Callable[[np.ndarray], np.ndarray]


class Roller:
    """Radius [m], combined modulus [Pa] and load [N/m] of a contact, and its solutions."""

    radius, modulus, load = 7.5706e-3, 115.385e9, 3.55e6
    grid = HatGrid.within(-1.1e-3, 1.1e-3, 4e-6)

    @property
    def hertz(self) -> HertzContact:
        return hertz_from_load(self.load, self.radius, self.modulus)

    def smooth(self) -> Gap:
        return roller_gap(self.radius)

    def rough(self, seed: int, amplitude: float = 0.4e-6) -> Gap:
        """Over a seeded sum of waves from 20 um to 200 um."""
        rng = np.random.default_rng(seed)
        waves = 2.0 * np.pi / np.geomspace(20e-6, 200e-6, 12)
        phases, heights = rng.uniform(0, 2 * np.pi, 12), rng.normal(0, amplitude / 3, 12)

        def gap(x):
            ripple = np.cos(np.multiply.outer(x, waves) + phases) @ heights
            return roller_gap(self.radius)(x) - ripple

        return gap

    def pressed(
        self, grid: HatGrid, gap: Gap, constraints: Constraints | None = None, knots=None
    ) -> ContactSolution:
        """Solution on a grid, load prescribed unless said otherwise."""
        limits = vars(constraints or Constraints(load=self.load))
        return pressed(grid, self.modulus, gap, knots, **limits)

    def sliding(
        self,
        grid: HatGrid,
        gap: Gap,
        friction_dundurs: float,
        constraints: Constraints | None = None,
        start: np.ndarray | None = None,
    ) -> ContactSolution:
        """Contact while it slides, with friction times Dundurs' beta."""
        pair = coupled_half_planes(grid.count, grid.pitch, self.modulus, friction_dundurs)
        limits = vars(constraints or Constraints(load=self.load))
        return solved(pair, grid.hat_integrals(gap), start, **limits)


@pytest.fixture(scope="session")
def roller() -> Roller:
    return Roller()


@pytest.fixture(params=[0.05, 0.3, 0.75])
def friction_dundurs(request) -> float:
    """mu beta; the last is friction 1.5 at the largest beta."""
    return request.param


@pytest.fixture(scope="session")
def wave_rule() -> Callable[[float, int], tuple[np.ndarray, np.ndarray]]:
    """`wave_rule(pitch, offset)`: wave numbers k and weights of the integral of hats' spectrum
    times cos or sin of k times the offset: panels that halve towards k = 0, then half waves."""
    points, weights = np.polynomial.legendre.leggauss(20)

    def rule(pitch: float, offset: int) -> tuple[np.ndarray, np.ndarray]:
        waves = np.arange(1, 200 * offset) * np.pi / (offset * pitch)
        edges = np.concatenate([[0.0], waves[0] * 0.5 ** np.arange(90, 0, -1.0), waves])
        width = np.diff(edges)[:, None]
        k = edges[:-1, None] + 0.5 * (1.0 + points) * width
        return k, 0.5 * width * weights * np.sinc(0.5 * k * pitch / np.pi) ** 4

    return rule
