"""A roller of its true circular shape: its compliance, and Hertz's contact with it.

Reference is the exact solution or the half-plane on the same pressure elements. What a disc
does otherwise is of second order in a/R: the sector's depth (0.6 R here) makes most of it, as it
does with a flat block; the arc instead of the parabola a quarter of (a/R)^2 at the contact's edge.
"""

from functools import cache

import numpy as np
import pytest
from blocks import Manufactured, SumOfBodies, structured_block
from scenes import hat_nodes

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import Support, elastic_body
from fem.body.exact_load import forces_of
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.real_shape import bent, sagitta

MATERIAL = Material(1.0, 0.3)
EDGES = 40  # a half-width
HALF_WIDTH, DEPTH = 0.7, 0.6  # of the radius
REFINED = np.array([[-1.2, 1.2]])  # in half-widths


class TestSector:
    def test_compliance_tends_to_the_flat_block_s_with_the_curvature(self):
        """A block, 2 wide and 1 deep, is bent less and less: a difference of order 1 in 1/R."""
        flat = structured_block(np.linspace(-1, 1, 41), np.linspace(0, 1, 21), seed=4)
        hats = hat_nodes(-0.5, 0.05, 21)

        def matrix(mesh):
            body = elastic_body(mesh, MATERIAL, Support())
            return FiniteElementCompliance(body, hats).matrix()

        straight = matrix(flat)
        radii = np.array([16.0, 32.0, 64.0])
        difference = [np.linalg.norm(matrix(bent(flat, r)) - straight) for r in radii]
        order = np.log2(np.divide(difference[:-1], difference[1:]))
        assert order == pytest.approx(1.0, abs=0.1)
        assert 0.05 < radii[-1] * difference[-1] / np.linalg.norm(straight) < 5.0

    @pytest.mark.parametrize("radius", [1.5, 10.0])
    def test_displacement_of_a_bent_body_is_of_order_three(self, radius):
        """A smooth displacement that vanishes on the inner arc, from its forces."""

        class Held(Manufactured):
            def displacement(self, x, z):
                out = (x**2 + (radius - z) ** 2 - (radius - 1.0) ** 2) / radius
                return out * np.sin(1.3 * x + 0.4 * z), out * np.cos(0.7 * x - 0.9 * z)

        exact, errors = Held(MATERIAL), []
        for cells in (8, 16, 32):
            line = np.linspace(-1, 1, 2 * cells + 1)
            mesh = bent(structured_block(line, line[cells:], seed=6), radius)
            body = elastic_body(mesh, MATERIAL, Support())
            moved = body.solve(forces_of(mesh, exact.stress, exact.body_force))
            wanted = np.stack(exact.displacement(*body.points.T), axis=1)
            errors.append(np.sqrt(np.mean((moved - wanted) ** 2) / np.mean(wanted**2)))
        order = np.log2(np.divide(errors[:-1], errors[1:]))
        assert np.all((order > 2.8) & (order < 4.2)), order
        assert errors[-1] < 1e-5


@cache
def half_plane(edge: float):
    """Block so large that it stands for a half-plane, refined as the disc is."""
    block = build_block(BlockSpec(4000.0, 4000.0, REFINED, edge))
    return elastic_body(block, MATERIAL, Support(sides="fixed"))


@cache
def disc(radius: float, edge: float):
    """Sector of the disc, free to the sides."""
    flat = build_block(BlockSpec(HALF_WIDTH * radius, DEPTH * radius, REFINED, edge))
    return elastic_body(bent(flat, radius), MATERIAL, Support())


class Pressed:
    """A disc of radius 1 / (a/R) on a rigid flat, or on a half-plane of its own material, under
    the load that gives Hertz's half-width 1."""

    def __init__(self, ratio: float, on_half_plane: bool = False) -> None:
        radius, pitch = 1.0 / ratio, 1.0 / EDGES
        grid = HatGrid.within(-1.2, 1.2, pitch)
        hats = hat_nodes(grid.x[0], pitch, grid.count)
        modulus = MATERIAL.plane_strain_modulus / (2.0 if on_half_plane else 1.0)
        bodies = [FiniteElementCompliance(disc(radius, pitch), hats)]
        if on_half_plane:
            bodies.append(FiniteElementCompliance(half_plane(pitch), hats))
        self.hertz = hertz_from_load(np.pi * modulus / (4.0 * radius), radius, modulus)
        self.grid = grid
        constraints = Constraints(load=self.hertz.load_per_length)
        model = HalfPlane(grid.count, pitch, modulus)
        gap = grid.hat_integrals(lambda x: sagitta(x, radius))
        self.solution = solve_with_model(
            SumOfBodies(*bodies), model, gap, grid.weights, constraints
        )
        parabola = grid.hat_integrals(lambda x: x**2 / (2.0 * radius))
        flat = solve_contact(model, parabola, grid.weights, constraints).pressure
        # relative differences from the half-plane: of the largest pressure, and in the 2-norm
        self.peak = self.solution.pressure.max() / flat.max() - 1.0
        self.norm = np.linalg.norm(self.solution.pressure - flat) / np.linalg.norm(flat)


pressed = cache(Pressed)


class TestHertz:
    def test_a_small_contact_is_hertz_s(self):
        case = pressed(0.01)
        assert case.solution.converged and case.solution.iterations["steps"] <= 6
        x = case.grid.x
        error = case.solution.pressure - case.hertz.pressure(x)
        assert case.solution.pressure.max() == pytest.approx(case.hertz.peak_pressure, rel=5e-4)
        assert np.abs(error[np.abs(x) < 0.9]).max() < 2e-3 * case.hertz.peak_pressure
        pressure, near = case.solution.pressure, 1e-3 * case.hertz.peak_pressure
        assert pressure == pytest.approx(pressure[::-1], abs=near)

    @pytest.mark.parametrize(("on_half_plane", "amount"), [(False, 1.2), (True, 0.63)])
    def test_what_the_disc_does_otherwise_is_of_second_order(self, on_half_plane, amount):
        """The half-plane's half of the compliance of two bodies has no part in it."""
        ratios = np.array([0.1, 0.05, 0.025])
        cases = [pressed(ratio, on_half_plane) for ratio in ratios]
        peak = np.array([case.peak for case in cases])
        assert np.log2(peak[:-1] / peak[1:]) == pytest.approx(2.0, abs=0.1)
        assert peak[0] == pytest.approx(amount * ratios[0] ** 2, rel=0.05)
        norm = np.array([case.norm for case in cases])
        assert np.log2(norm[:-1] / norm[1:]) == pytest.approx(2.0, abs=0.25)
