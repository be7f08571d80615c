"""Sliding on finite elements: traction q = mu p that moves the surfaces, and with them the contact.

Requirement: position and pressures of the contact of a sliding cylinder are the exact ones within
1 % of its half-width; reference: the closed solution (analytic), tabulated to 30 digits.
"""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from blocks import SumOfBodies, structured_block
from pressed_bodies import dense_contact
from scenes import hat_nodes, reference

from analytic.contact.coupled import solve_coupled
from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.exact.sliding import SlidingContact, sliding_from_load
from analytic.grid import HatGrid
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.half_plane import DenseCompliance
from analytic.operators.tangential import coupled_half_planes
from analytic.surface.synthetic import self_affine
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockSpec
from meshes.build import build_block

TABLE = reference("f_rounded_punch_and_sliding")["sliding_cylinder"]
STEEL, SOFT, CORK = Material(1.0, 0.3), Material(1.0, 0.49), Material(1.0, 0.0)
LOAD = 0.5 * np.pi  # with a radius of E*/2: half-width and peak pressure 1 without friction
EDGES = 20
GRID = HatGrid.within(-1.7, 1.7, 1.0 / EDGES)
HATS = hat_nodes(GRID.x[0], GRID.pitch, GRID.count)


@dataclass(frozen=True)
class Sliding:
    """A body under pressures and what they drag along."""

    compliance: FiniteElementCompliance
    friction: float

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        return self.compliance.apply(pressure, self.friction)


@cache
def block_of(extent: float = 1000.0, mirrored: bool = False):
    mesh = build_block(BlockSpec(extent, extent, np.array([[-1.8, 1.8]]), GRID.pitch))
    if not mirrored:
        return mesh
    return replace(
        mesh, points=mesh.points * [-1.0, 1.0], triangles=mesh.triangles[:, [0, 2, 1, 5, 4, 3]]
    )


@cache
def surface(material: Material, extent: float = 1000.0, mirrored: bool = False):
    """Surface of so large a block that it stands for a half-plane."""
    body = elastic_body(block_of(extent, mirrored), material, Support(sides="fixed"))
    return FiniteElementCompliance(body, HATS)


def solved(body: Material, roller: Material | None, friction: float, **how):
    """Solution on finite elements under the load, and the exact one."""
    modulus, beta = combined_modulus(body, roller), dundurs_constants(body, roller)[1]
    radius = 0.5 * modulus
    # the roller is dragged the other way, in a frame with the same x
    pair = ((body, friction), (roller, -friction))
    solution = solve_with_model(
        SumOfBodies(*(Sliding(surface(m, **how), f) for m, f in pair if m is not None)),
        coupled_half_planes(GRID.count, GRID.pitch, modulus, friction * beta),
        GRID.hat_integrals(lambda x: 0.5 * x**2 / radius),
        GRID.weights,
        Constraints(load=LOAD),
    )
    return solution, sliding_from_load(LOAD, radius, modulus, friction, beta)


def load_line(solution) -> float:
    return float(GRID.x @ solution.pressure / solution.pressure.sum())


def is_exact(solution, exact: SlidingContact) -> None:
    """The load line to 0.2 % of a half-width, the edges and the pressure away from them to 1 %."""
    assert solution.converged and solution.iterations["steps"] <= 7
    assert load_line(solution) == pytest.approx(exact.load_position, abs=2e-3)
    (patch,) = contact_patches(GRID.x, solution.pressure, solution.gap)
    assert patch == pytest.approx(exact.edges, abs=0.01)
    peak = exact.peak_pressure
    assert solution.pressure.max() == pytest.approx(peak, rel=1e-3)
    left, right = exact.edges
    inner = (GRID.x > left + 0.3) & (GRID.x < right - 0.3)
    error = solution.pressure - exact.pressure(GRID.x)
    assert np.abs(error[inner]).max() < 0.01 * peak
    assert np.linalg.norm(error) < 0.08 * np.linalg.norm(exact.pressure(GRID.x))


class TestRigidRoller:
    @pytest.mark.parametrize("row", [TABLE[k] for k in (0, 1, 2, 4)], ids=lambda r: r["mu"])
    def test_tabulated_solutions(self, row):
        """nu = 0.3 (beta = 2/7) and nu = 0 (beta = 1/2)."""
        body, friction = (STEEL if row["beta"] == "2/7" else CORK), float(row["mu"])
        solution, exact = solved(body, None, friction)
        is_exact(solution, exact)
        wider = float(row["ahalf_over_aHertz_same_load"])
        shift = float(row["load_line_x_over_ahalf"]) * wider
        assert shift < -0.02
        assert load_line(solution) == pytest.approx(shift, rel=0.01)

    @pytest.mark.parametrize("body", [SOFT, STEEL, CORK], ids=["nu 0.49", "nu 0.3", "nu 0"])
    def test_as_much_friction_as_pressure(self, body):
        """mu = 1: mu beta 0.01, 2/7 and 1/2."""
        solution, exact = solved(body, None, 1.0)
        is_exact(solution, exact)
        assert load_line(solution) < -0.01

    def test_what_is_left_is_the_block_s_size(self):
        """It shears and tilts: inversely as its size."""
        ends = [solved(STEEL, None, 0.5, extent=extent) for extent in (60.0, 120.0, 240.0)]
        errors = [load_line(solution) - exact.load_position for solution, exact in ends]
        order = np.log2(np.divide(errors[:-1], errors[1:]))
        assert order == pytest.approx(1.0, abs=0.25)
        assert 1e-4 < errors[-1] < 3e-3

    def test_reversed_sliding_is_the_mirrored_contact(self):
        """To the tolerance of the iteration, on the mirrored mesh."""
        there, _ = solved(STEEL, None, 0.4)
        back, _ = solved(STEEL, None, -0.4, mirrored=True)
        assert back.pressure == pytest.approx(there.pressure[::-1], abs=1e-6)
        assert load_line(back) > 0.05


class TestElasticRoller:
    @pytest.mark.parametrize(
        ("body", "roller"),
        [(STEEL, Material(5.0, 0.0)), (STEEL, CORK), (Material(0.3, 0.1), Material(1.0, 0.4))],
    )
    def test_unlike_bodies(self, body, roller):
        solution, exact = solved(body, roller, 1.0)
        is_exact(solution, exact)
        assert abs(exact.load_position) > 0.03
        changed, _ = solved(roller, body, 1.0)
        assert load_line(changed) == pytest.approx(-load_line(solution), abs=1e-3)

    def test_equal_bodies_stay_where_they_are(self):
        solution, _ = solved(STEEL, STEEL, 1.0)
        still, _ = solved(STEEL, STEEL, 0.0)
        assert solution.converged
        assert solution.pressure == pytest.approx(still.pressure, abs=1e-6)


@cache
def rough_surface():
    pitch = 1.0 / EDGES
    block = BlockSpec(200.0, 200.0, np.array([[-3.1, 3.1]]), pitch)
    body = elastic_body(build_block(block), CORK, Support(sides="fixed"))
    grid = HatGrid.within(-3.0, 3.0, pitch)
    return grid, FiniteElementCompliance(body, hat_nodes(grid.x[0], pitch, grid.count))


def rough_gap(grid: HatGrid, seed: int) -> np.ndarray:
    """Waves down to ten pressure elements; contact in several patches."""
    curve = self_affine(
        hurst=0.8,
        samples=1025,
        length=12.0,
        seed=seed,
        rms_slope=2.0,
        shortest_wavelength=0.5,
        longest_wavelength=3.0,
    ).spline()
    return grid.hat_integrals(lambda x: x**2 - curve(x))


def as_the_whole_matrix(compliance, model, gap, weights, constraints) -> ContactSolution:
    """The solution by the whole matrix, which the one with a model is, too; friction 0.5."""
    problem = gap, weights, constraints
    solution = solve_with_model(Sliding(compliance, 0.5), model, *problem)
    direct = solve_coupled(DenseCompliance(compliance.matrix(0.5), skew=True), *problem)
    assert solution.converged and direct.converged
    assert solution.pressure == pytest.approx(direct.pressure, abs=1e-5 * direct.pressure.max())
    return direct


class TestRoughProfiles:
    @pytest.mark.parametrize("friction", [0.1, -0.3, 1.0])
    @pytest.mark.parametrize("seed", [1, 2, 3])
    def test_few_steps_to_what_an_independent_solver_finds(self, seed, friction):
        """nu = 0: mu beta of 0.05, 0.15 and 0.5, in as few steps as without friction."""
        grid, compliance = rough_surface()
        matrix = compliance.matrix(friction)
        gap = rough_gap(grid, seed)
        model = coupled_half_planes(grid.count, grid.pitch, 1.0, 0.5 * friction)
        problem = model, gap, grid.weights, Constraints(load=LOAD)
        solution = solve_with_model(Sliding(compliance, friction), *problem)
        assert solution.converged and solution.iterations["steps"] <= 7
        pressure, approach = dense_contact(matrix, gap, grid.weights, LOAD)
        assert solution.pressure == pytest.approx(pressure, abs=1e-5 * pressure.max())
        assert solution.approach == pytest.approx(approach, rel=1e-8)
        assert len(contact_patches(grid.x, solution.pressure, solution.gap)) > 1

    def test_under_a_hardness_the_whole_matrix_gives_the_same(self):
        grid, compliance = rough_surface()
        model = coupled_half_planes(grid.count, grid.pitch, 1.0, 0.25)
        constraints = Constraints(load=LOAD, hardness=2.0)
        as_the_whole_matrix(compliance, model, rough_gap(grid, 4), grid.weights, constraints)


@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_a_layer_a_third_as_thick_as_the_contact(base):
    """Far from a half-plane: the iteration says whether it arrived, the whole matrix serves."""
    x = np.linspace(-4.0, 4.0, 161)
    mesh = structured_block(x, np.linspace(0.0, 0.3, 7))
    sides = "free" if base == "bonded" else "rollers"
    body = elastic_body(mesh, Material(1.0, 0.2), Support(base, sides))
    compliance = FiniteElementCompliance(body, HATS)
    beta = dundurs_constants(body.material, None)[1]
    modulus = body.material.plane_strain_modulus
    gap = GRID.hat_integrals(lambda x: 0.05 * x**2)
    model = coupled_half_planes(GRID.count, GRID.pitch, modulus, 0.5 * beta)
    direct = as_the_whole_matrix(compliance, model, gap, GRID.weights, Constraints(load=0.1))
    assert direct.residuals.worst < 1e-12
    assert 0.5 < np.ptp(contact_patches(GRID.x, direct.pressure, direct.gap)) < 3.0
