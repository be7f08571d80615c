"""Bodies to test on: structured blocks with exact control of the nodes; a pressed half-plane."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from blocks import graded, structured_block, widened
from nodal_stress import nodal_stress
from pressed_bodies import dense_contact
from scenes import hat_nodes

from analytic.exact.hertz import hertz_from_peak_pressure, hertz_stress
from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.stress.stress import NodalStress, evaluate
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block


@pytest.fixture(scope="module", params=[1, 2, 3])
def degree(request) -> int:
    """Degree of the displacement's elements."""
    return request.param


@pytest.fixture(scope="session")
def small_block() -> BlockMesh:
    """A block of vertical lines 12 half-widths wide and 6 deep: 2200 unknowns."""
    x = widened(np.linspace(-2.0, 2.0, 25), graded(4.0, 0.3, 1.4))
    return structured_block(x, graded(6.0, 0.14, 1.2))


class Pressed:
    """A half-plane's stand-in and a rigid cylinder that would press it on half-width 1, peak 1."""

    def __init__(
        self,
        edges: int,
        growth: float = 0.2,
        half_width: float = 4000.0,
        depth: float = 4000.0,
        poisson: float = 0.3,
        **held,
    ) -> None:
        self.hertz = hertz_from_peak_pressure(1.0, 0.5, 1.0)
        spec = BlockSpec(half_width, depth, np.array([[-1.4, 1.4]]), 1.0 / edges, growth)
        material = Material(1.0 - poisson**2, poisson)
        self.body = elastic_body(build_block(spec), material, Support(**held))
        pitch = 1.0 / edges
        reach = edges + 8
        self.x = pitch * np.arange(-reach, reach + 1)
        hats = hat_nodes(self.x[0], pitch, len(self.x))
        self.compliance = FiniteElementCompliance(self.body, hats)
        self.gap = pitch * (self.x**2 + pitch**2 / 6.0)
        self.weights = np.full(len(self.x), pitch)
        self.pressure, self.approach = dense_contact(
            self.compliance.matrix(), self.gap, self.weights, self.hertz.load_per_length
        )

    def pressure_at(self, x: np.ndarray) -> np.ndarray:
        return np.interp(x, self.x, self.pressure)

    def displacement(self, friction: float) -> np.ndarray:
        return self.compliance.displacement(self.pressure, friction)

    def stress(self, friction: float) -> NodalStress:
        moved = self.displacement(friction)
        return nodal_stress(self.body, moved, self.compliance.hats, self.pressure, friction)

    def error(self, friction: float, low: float, high: float) -> float:
        """Relative L2 error of the three stresses from a depth to another, over |x| < 1.5."""
        x, z = np.meshgrid(np.linspace(-1.5, 1.5, 61), np.linspace(0.0, 1.5, 41))
        inside = (z >= low) & (z < high)
        exact = hertz_stress(self.hertz, x[inside], z[inside], friction)
        stress = evaluate(self.body, self.stress(friction), x[inside], z[inside])
        stress, exact = (np.stack([s.sx, s.sz, s.txz]) for s in (stress, exact))
        return np.sqrt(np.sum((stress - exact) ** 2) / np.sum(exact**2))


@pytest.fixture(scope="session")
def pressed() -> Callable[..., Pressed]:
    return cache(Pressed)
