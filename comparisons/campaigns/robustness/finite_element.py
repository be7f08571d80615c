"""Finite elements at their worst: rough lines, and whole scenes.

Rough lines: contact of every node, and on slopes of 1. References: elimination on the whole
compliance matrix, cubic elements on the same mesh.

Scenes: stiffness, locking, friction, hardness, units, layers. References: Hertz, the sliding and
the flattened cylinder, exact; the same scene in other units; for layers and coatings the analytic
layer's contact on the same hats, which knows no mesh and no locking (and is held to its own
references by the half-plane's rows)."""

from functools import lru_cache
from typing import Any

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.sliding import sliding_from_load
from analytic.grid import HatGrid
from analytic.material import Material, dundurs_constants
from analytic.operators.half_plane import HalfPlane
from comparisons.campaigns.cases import CaseFigures, bounded, relative_error
from comparisons.campaigns.robustness.measures import (
    costs,
    deviation,
    flowed_figure,
    peak_and_length,
    residual_figures,
)
from comparisons.common.tasks import Here
from comparisons.figures.figure import Figure
from comparisons.models.level import Level
from comparisons.models.model import scene_model
from comparisons.models.operators import operator_of, pressed_on
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Origin, Scene
from fem.body.elasticity import elastic_body
from fem.body.support import Support
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

Tables = dict[str, dict[str, Any]]

# Steps of the outer iteration: the most, those of a coupled contact, those of the ordinary one.
MOST_STEPS, MOST_COUPLED_STEPS, ORDINARY_STEPS = 20, 40, 4
# Of the peak: the iteration's own tolerance, and more than what another unit changes, where a
# mesh's coordinates are rounded to 1e-9 of an edge.
SAME = 1e-7
PRESSED = Material(0.91, 0.3)  # plane-strain modulus 1 Pa
# Half-width, depth, refined on |x| <=, edge there [m], growth.
PLAIN = BlockSpec(40.0, 40.0, np.array([[-1.5, 1.5]]), 0.1, 0.3)
FINE = BlockSpec(8.0, 8.0, np.array([[-3.0, 3.0]]), 0.05, 0.3)
STEEL = {"youngs_modulus": 207e9, "poissons_ratio": 0.3}
RIGID = {"radius": 8e-3, "rigid": True}
LOAD = {"per_length": 1e6}
ORDINARY: Tables = {"roller": RIGID, "body": STEEL, "load": LOAD}
PEAK, LENGTH, PLACE = 2e-3, 3e-3, 4e-3  # of Hertz's, with 19 hats on a half-width
# L2 of the pressure on the coarsest level: of a thick layer that of the half-plane, of a thin one
# (rows.toml) that of springs; quadratic elements near nu = 1/2 leave more.
THICK = 8e-3


def _wave(x: np.ndarray) -> np.ndarray:
    return np.exp(-((x / 2.0) ** 8)) * np.sqrt(2.0) / np.pi * np.cos(np.pi * x)


def pressed(
    height: np.ndarray, load: float, grid: HatGrid, mesh: BlockMesh, degree: int = 2
) -> tuple[FiniteElementCompliance, ContactSolution]:
    """A rigid flat on heights (n,) [m] of a body, by way of a half-plane."""
    body = elastic_body(mesh, PRESSED, Support("bonded", "fixed"), degree=degree)
    compliance = FiniteElementCompliance(body, grid.hats)
    model, constraints = HalfPlane(grid.count, grid.pitch, 1.0), Constraints(load=load)
    gap = -grid.pitch * height
    return compliance, solve_with_model(compliance, model, gap, grid.weights, constraints)


def closed_figures() -> CaseFigures:
    """A load that closes all gaps of a rough line: every node touches."""
    grid, load = HatGrid(0.1, -14, 14), 10.0
    height = 1e-3 * np.random.default_rng(8).standard_normal(grid.count)
    compliance, solution = pressed(height, load, grid, build_block(PLAIN))
    matrix, weights = compliance.matrix(), grid.weights
    system = np.block([[matrix, -weights[:, None]], [weights, np.zeros((1, 1))]])
    expected = np.linalg.solve(system, np.append(grid.pitch * height, load))[:-1]
    touching = np.count_nonzero(solution.pressure)
    return solution_figures(
        solution,
        deviation(solution.pressure, expected, "pressure", SAME, "elimination on the whole matrix"),
        bounded("nodes in contact", touching, grid.count, "all", low=grid.count),
    )


def slope_figures() -> CaseFigures:
    """A rough boundary of rms slope 1: quadratic against cubic displacements on one mesh."""
    grid = HatGrid(0.1, -12, 12)
    line = -(grid.x**2) / 20.0, 0.05, grid, roughen(build_block(FINE), _wave)
    (_, quadratic), (_, cubic) = (pressed(*line, degree) for degree in (2, 3))
    reference = "cubic elements, same mesh"
    figure = deviation(quadratic.pressure, cubic.pressure, "pressure", 2e-2, reference)
    return solution_figures(quadratic, figure)


def solution_figures(
    solution: ContactSolution,
    *figures: Figure,
    most: int = MOST_STEPS,
    ordinary: int = ORDINARY_STEPS,
) -> CaseFigures:
    """The figures, the contact conditions, and steps of the outer iteration, `most` at most."""
    steps = float(solution.iterations["steps"])
    limit = bounded("steps", steps, float(most), "the most of an outer iteration")
    return *figures, *residual_figures(solution), limit, *costs(solution, steps / ordinary)


def problem_with(tables: Tables) -> Problem:
    """Problem of the ordinary scene with other fields."""
    changed = {name: ORDINARY.get(name, {}) | fields for name, fields in tables.items()}
    return problem_of(Scene.of(ORDINARY | changed, Origin("stability", source="stability")))


def solved(tables: Tables, refinement: int = 0) -> tuple[Problem, Level]:
    """Problem and its coarsest level, or the one `refinement` levels finer."""
    problem = problem_with(tables)
    model = scene_model("finite_element", problem, fields=True)
    level, *_ = model.solve(Here(), problem, 1 + refinement).values()
    return problem, level


@lru_cache
def ordinary_level() -> Level:
    return solved({})[1]


def level_figures(level: Level, *figures: Figure, most: int = MOST_STEPS) -> CaseFigures:
    """Figures of a level, its steps beside those of the ordinary scene."""
    ordinary = ordinary_level().solution.iterations["steps"]
    return solution_figures(level.solution, *figures, most=most, ordinary=ordinary)


def hertz_figures(peak: float = PEAK, **tables: dict) -> CaseFigures:
    """Figures of the ordinary scene with other fields, whose peak may be wrong by `peak`."""
    problem, level = solved(tables)
    exact = (problem.hertz.peak_pressure, problem.hertz.half_width)
    return level_figures(level, *peak_and_length(level, exact, (peak, LENGTH)))


def shear_figures(**tables: dict) -> CaseFigures:
    problem, level = solved(tables | {"stress": {"points": [40, 20]}})
    hertz, largest = problem.hertz, level.stress.extremes["tau1"]
    depth, reference = hertz.tau1_max_depth, "Hertz, exact"
    return level_figures(
        level,
        relative_error("tau1", largest.value, hertz.tau1_max, 1e-2, reference),
        relative_error("depth of tau1", largest.z, depth, 3e-2, reference),
    )


def sliding_figures(**tables: dict) -> CaseFigures:
    """A rigid roller that slides, its traction moving the surface."""
    problem, level = solved(tables)
    hertz, (friction,) = problem.hertz, problem.scene.load.friction
    beta = dundurs_constants(problem.scene.body.material, None)[1]
    exact = sliding_from_load(hertz.load_per_length, hertz.radius, problem.modulus, friction, beta)
    x, pressure, reference = level.grid.x, level.solution.pressure, "sliding cylinder, exact"
    place = abs(x @ pressure / pressure.sum() - exact.load_position) / exact.half_width
    return level_figures(
        level,
        relative_error("peak pressure", pressure.max(), exact.peak_pressure, PEAK, reference),
        bounded("place of the load", place, PLACE, reference),
        most=MOST_COUPLED_STEPS,
    )


def hardness_figures(share: float) -> CaseFigures:
    hardness = share * float(ordinary_level().solution.pressure.max())
    if share >= 1.0:
        return hertz_figures(body={"hardness": hardness})
    problem, level = solved({"body": {"hardness": hardness}})
    hertz = problem.hertz
    exact = flattened_cylinder(hertz.load_per_length, hertz.radius, problem.modulus, hardness)
    length, reference = 0.5 * level.contact_length, "flattened cylinder, exact"
    flowed = level.solution.pressure >= hardness * (1.0 - 1e-9)
    return level_figures(
        level,
        relative_error("contact length", length, exact.contact, LENGTH, reference),
        flowed_figure(flowed, level.grid.pitch, exact.flowed),
    )


def in_units(metre: float, pascal: float) -> Tables:
    """Fields of the ordinary scene with all lengths times `metre`, all stresses times `pascal`."""
    return {
        "roller": {"radius": RIGID["radius"] * metre},
        "body": {"youngs_modulus": STEEL["youngs_modulus"] * pascal},
        "load": {"per_length": LOAD["per_length"] * metre * pascal},
    }


def unit_figures(metre: float, pascal: float) -> CaseFigures:
    """Figures in other units: the same triangles must give the same."""
    usual = ordinary_level()
    _, level = solved(in_units(metre, pascal))
    length = level.contact_length / usual.contact_length
    pressure, expected = level.solution.pressure / pascal, usual.solution.pressure
    unknowns = level.unknowns / usual.unknowns
    return level_figures(
        level,
        deviation(pressure, expected, "pressure", SAME, "in metres"),
        relative_error("contact length", length, metre, 1e-5, "in metres"),
        bounded("unknowns", unknowns, 1.0, "in metres: the same mesh", low=1.0),
    )


def layer_figures(a_over_t: float, high: float = THICK, **tables: dict) -> CaseFigures:
    """A layer of thickness t on a rigid base against the analytic one on the same hats."""
    thickness = problem_with({}).hertz.half_width / a_over_t
    body = tables.get("body", {}) | {"thickness": thickness}
    return analytic_figures(tables | {"body": body}, high)


def coating_figures(times_as_stiff: float, a_over_t: float, refinement: int = 0) -> CaseFigures:
    """A coating against the analytic one on the same hats."""
    coating = {"youngs_modulus": times_as_stiff * STEEL["youngs_modulus"], "poissons_ratio": 0.25}
    coating["thickness"] = problem_with({}).hertz.half_width / a_over_t
    return analytic_figures({"coating": coating}, THICK, refinement)


def analytic_figures(tables: Tables, high: float, refinement: int = 0) -> CaseFigures:
    problem, level = solved(tables, refinement)
    grid, pressure = level.grid, level.solution.pressure
    expected = pressed_on(problem, grid, operator_of(problem, grid)).pressure
    error = float(np.linalg.norm(pressure - expected) / np.linalg.norm(expected))
    reference = "the analytic layer on the same hats"
    return level_figures(
        level,
        bounded("pressure, L2", error, high, reference),
        relative_error("peak pressure", pressure.max(), expected.max(), high, reference),
    )
