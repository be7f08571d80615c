"""Finite elements on extreme scenes: stiffness, locking, friction, hardness, units, layers.

References: Hertz, the sliding and the flattened cylinder, exact; the same scene in other units;
for layers and coatings the analytic layer's contact on the same hats, which knows no mesh and no
locking (and is held to its own references by the half-plane's rows)."""

from functools import lru_cache
from typing import Any

import numpy as np

from analytic.contact.problem import solve_contact
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.sliding import sliding_from_load
from analytic.material import dundurs_constants
from comparisons.campaigns.cases import CaseFigures, bounded, relative_error
from comparisons.campaigns.robustness.bodies import MOST_STEPS, finite_element_findings
from comparisons.campaigns.robustness.half_plane import flowed_figure
from comparisons.campaigns.robustness.loaded_contact import deviation, peak_and_length
from comparisons.common.progress import Stages
from comparisons.figures.figure import Figure
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.level import Level
from comparisons.models.nearest_operator import nearest_operator
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import window_of
from comparisons.scenes.scene import Origin, Scene

Tables = dict[str, dict[str, Any]]

STEEL = {"youngs_modulus": 207e9, "poissons_ratio": 0.3}
RIGID = {"radius": 8e-3, "rigid": True}
LOAD = {"per_length": 1e6}
ORDINARY: Tables = {"roller": RIGID, "body": STEEL, "load": LOAD}
MOST_COUPLED_STEPS = 40
PEAK, LENGTH, PLACE = 2e-3, 3e-3, 4e-3  # of Hertz's, with 19 hats on a half-width
SAME = 1e-7  # what another unit may change: a mesh's coordinates are rounded to 1e-9 of an edge
# L2 of the pressure on the coarsest level: of a thick layer that of the half-plane, of a thin one
# (rows.toml) that of springs; quadratic elements near nu = 1/2 leave more.
THICK = 8e-3


def changed(tables: Tables) -> Tables:
    """The ordinary scene with other fields."""
    return ORDINARY | {name: ORDINARY.get(name, {}) | fields for name, fields in tables.items()}


def problem_from(tables: Tables) -> Problem:
    return problem_of(Scene.of(tables, Origin("stability", source="stability")))


def finite_element_solution(tables: Tables, refinement: int = 0) -> tuple[Problem, Level]:
    """A scene solved on the coarsest level, or on one `refinement` levels finer."""
    problem = problem_from(tables)
    plan = make_plan(problem, ("finite_element",))
    pitch = problem.pitches[0] / 2.0**refinement
    window = None if problem.scene.stress is None else window_of(problem)
    return problem, finite_element_level(problem, plan, Refinement(pitch), window, Stages())


@lru_cache
def ordinary_level() -> Level:
    return finite_element_solution(ORDINARY)[1]


def findings(level: Level, *figures: Figure, most: int = MOST_STEPS) -> CaseFigures:
    """Of a level, its steps beside those of the ordinary scene."""
    ordinary = ordinary_level().solution.iterations["steps"]
    return finite_element_findings(level.solution, *figures, most=most, ordinary=ordinary)


def hertz_findings(peak: float = PEAK, **tables: dict) -> CaseFigures:
    """Of the ordinary scene with other fields; `peak`, what its relative error may be."""
    problem, level = finite_element_solution(changed(tables))
    exact = (problem.hertz.peak_pressure, problem.hertz.half_width)
    return findings(level, *peak_and_length(level, exact, (peak, LENGTH), "Hertz, exact"))


def shear_findings(**tables: dict) -> CaseFigures:
    problem, level = finite_element_solution(changed(tables | {"stress": {"points": [40, 20]}}))
    hertz, largest = problem.hertz, level.stresses[0].extremes["tau1"]
    depth, reference = hertz.tau1_max_depth, "Hertz, exact"
    return findings(
        level,
        relative_error("tau1", largest.value, hertz.tau1_max, 1e-2, reference),
        relative_error("depth of tau1", largest.z, depth, 3e-2, reference),
    )


def sliding_findings(**tables: dict) -> CaseFigures:
    """A rigid roller that slides, its traction moving the surface."""
    problem, level = finite_element_solution(changed(tables))
    hertz, (friction,) = problem.hertz, problem.scene.load.friction
    beta = dundurs_constants(problem.scene.body.material, None)[1]
    exact = sliding_from_load(hertz.load_per_length, hertz.radius, problem.modulus, friction, beta)
    x, pressure, reference = level.grid.x, level.solution.pressure, "sliding cylinder, exact"
    place = abs(x @ pressure / pressure.sum() - exact.load_position) / exact.half_width
    return findings(
        level,
        relative_error("peak pressure", pressure.max(), exact.peak_pressure, PEAK, reference),
        bounded("place of the load", place, PLACE, reference),
        most=MOST_COUPLED_STEPS,
    )


def hardness_findings(share: float) -> CaseFigures:
    hardness = share * float(ordinary_level().solution.pressure.max())
    if share >= 1.0:
        return hertz_findings(body={"hardness": hardness})
    problem, level = finite_element_solution(changed({"body": {"hardness": hardness}}))
    hertz = problem.hertz
    exact = flattened_cylinder(hertz.load_per_length, hertz.radius, problem.modulus, hardness)
    length, reference = 0.5 * level.contact_length, "flattened cylinder, exact"
    flowed = level.solution.pressure >= hardness * (1.0 - 1e-9)
    return findings(
        level,
        relative_error("contact length", length, exact.contact, LENGTH, reference),
        flowed_figure(flowed, level.grid.pitch, exact.flowed),
    )


def in_units(metre: float, pascal: float) -> Tables:
    """The ordinary scene with all lengths times `metre` and all stresses times `pascal`."""
    return {
        "roller": {**RIGID, "radius": RIGID["radius"] * metre},
        "body": {**STEEL, "youngs_modulus": STEEL["youngs_modulus"] * pascal},
        "load": {"per_length": LOAD["per_length"] * metre * pascal},
    }


def unit_findings(metre: float, pascal: float) -> CaseFigures:
    """In other units the same triangles and the same figures."""
    usual = ordinary_level()
    _, level = finite_element_solution(in_units(metre, pascal))
    length = level.contact_length / usual.contact_length
    pressure, expected = level.solution.pressure / pascal, usual.solution.pressure
    unknowns = level.unknowns / usual.unknowns
    return findings(
        level,
        deviation(pressure, expected, "pressure", SAME, "in metres"),
        relative_error("contact length", length, metre, 1e-5, "in metres"),
        bounded("unknowns", unknowns, 1.0, "in metres: the same mesh", low=1.0),
    )


def layer_findings(a_over_t: float, high: float = THICK, **tables: dict) -> CaseFigures:
    """A layer of thickness t on a rigid base against the analytic one on the same hats."""
    thickness = problem_from(ORDINARY).hertz.half_width / a_over_t
    body = tables.get("body", {}) | {"thickness": thickness}
    return analytic_findings(tables | {"body": body}, high)


def coating_findings(times_as_stiff: float, a_over_t: float, refinement: int = 0) -> CaseFigures:
    """A coating against the analytic one on the same hats."""
    coating = {"youngs_modulus": times_as_stiff * STEEL["youngs_modulus"], "poissons_ratio": 0.25}
    coating["thickness"] = problem_from(ORDINARY).hertz.half_width / a_over_t
    return analytic_findings({"coating": coating}, THICK, refinement)


def analytic_findings(tables: Tables, high: float, refinement: int = 0) -> CaseFigures:
    problem, level = finite_element_solution(changed(tables), refinement)
    grid, pressure = level.grid, level.solution.pressure
    expected = solve_contact(
        nearest_operator(problem.scene, grid),
        grid.hat_integrals(problem.gap, problem.knots),
        grid.weights,
        problem.constraints(),
    ).pressure
    error = float(np.linalg.norm(pressure - expected) / np.linalg.norm(expected))
    reference = "the analytic layer on the same hats"
    return findings(
        level,
        bounded("pressure, L2", error, high, reference),
        relative_error("peak pressure", pressure.max(), expected.max(), high, reference),
    )
