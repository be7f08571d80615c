"""Finite elements on extreme scenes: stiffness, locking, friction, hardness, units, layers.

References: Hertz, the sliding and the flattened cylinder, exact; the same scene in other units;
for layers and coatings the analytic layer's contact on the same hats, which knows no mesh and no
locking (and is held to its own references by the half-plane's rows).
"""

from collections.abc import Callable
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from analytic.contact.problem import solve_contact
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.sliding import sliding_from_load
from analytic.material import dundurs_constants
from comparisons.common.progress import Stages
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.level import Level
from comparisons.models.nearest_operator import nearest_operator
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import window_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.checks import BoundedFigure, Findings, Groups, relative_error
from comparisons.studies.robustness.cases.smooth import flowed_figure
from comparisons.studies.robustness.finite_element.loaded_body import (
    MOST_COUPLED_STEPS,
    MOST_STEPS,
    finite_element_findings,
)
from comparisons.studies.robustness.loaded_contact import deviation, peak_and_length

Tables = dict[str, dict[str, Any]]

STEEL = {"youngs_modulus": 207e9, "poissons_ratio": 0.3}
RIGID = {"radius": 8e-3, "rigid": True}
LOAD = {"per_length": 1e6}
ORDINARY: Tables = {"roller": RIGID, "body": STEEL, "load": LOAD}
CUBIC = {"finite_element": {"element": "P3"}}
PEAK, LENGTH, PLACE = 2e-3, 3e-3, 4e-3  # of Hertz's, with 19 hats on a half-width
CUBIC_PEAK = 1e-3
LOCKING_RATIO = 0.49  # Poisson's ratio from which cubic elements are due (`fem.body.elasticity`)
SAME = 1e-7  # what another unit may change: a mesh's coordinates are rounded to 1e-9 of an edge
# L2 of the pressure on the coarsest level: of a thick layer that of the half-plane, of a thin one
# that of springs. Quadratic elements near nu = 1/2 leave more.
THICK, MEDIUM, THIN, LOCKING = 8e-3, 3e-3, 1e-4, 1.5e-2


def problem_from(tables: Tables) -> Problem:
    return problem_of(
        resolve_tables(tables, name="stability", folder=Path("."), source="stability")
    )


def finite_element_solution(tables: Tables, refinement: int = 0) -> tuple[Problem, Level]:
    """A scene solved on the coarsest level, or on one `refinement` levels finer."""
    problem = problem_from(tables)
    plan = make_plan(problem, ("finite_element",))
    pitch = problem.pitches[0] / 2.0**refinement
    window = None if problem.scene.stress is None else window_of(problem)
    return problem, finite_element_level(problem, plan, Refinement(pitch), window, Stages())


@lru_cache
def ordinary_level() -> Level:
    """A rigid roller on steel: what the others' steps are compared with."""
    return finite_element_solution(ORDINARY)[1]


def findings(level: Level, *figures: BoundedFigure, most: int = MOST_STEPS) -> Findings:
    """Findings of a level, its steps beside those of the ordinary scene."""
    ordinary = ordinary_level().solution.iterations["steps"]
    return finite_element_findings(level.solution, *figures, most=most, ordinary=ordinary)


def hertz_findings(tables: Tables, peak: float = PEAK) -> Findings:
    problem, level = finite_element_solution(tables)
    exact = (problem.hertz.peak_pressure, problem.hertz.half_width)
    return findings(level, *peak_and_length(level, exact, (peak, LENGTH), "Hertz, exact"))


def shear_findings(tables: Tables) -> Findings:
    problem, level = finite_element_solution({**tables, "stress": {"points": [40, 20]}})
    hertz, found = problem.hertz, level.stresses[0].extremes["tau1"]
    depth, reference = hertz.tau1_max_depth, "Hertz, exact"
    return findings(
        level,
        relative_error("tau1", found.value, hertz.tau1_max, 1e-2, reference),
        relative_error("depth of tau1", found.z, depth, 3e-2, reference),
    )


def sliding_findings(friction: float, poissons_ratio: float) -> Findings:
    """A rigid roller that slides, its traction moving the surface."""
    tables = {
        **with_body(poissons_ratio=poissons_ratio),
        "load": {**LOAD, "friction": friction, "coupled": True},
        **(CUBIC if poissons_ratio > LOCKING_RATIO else {}),
    }
    problem, level = finite_element_solution(tables)
    beta = dundurs_constants(problem.scene.body, None)[1]
    hertz = problem.hertz
    exact = sliding_from_load(hertz.load_per_length, hertz.radius, problem.modulus, friction, beta)
    x, pressure, reference = level.grid.x, level.solution.pressure, "sliding cylinder, exact"
    place = abs(x @ pressure / pressure.sum() - exact.load_position) / exact.half_width
    return findings(
        level,
        relative_error("peak pressure", pressure.max(), exact.peak_pressure, PEAK, reference),
        BoundedFigure("place of the load", place, PLACE, reference),
        most=MOST_COUPLED_STEPS,
    )


def hardness_findings(share: float) -> Findings:
    """A hardness of `share` of the peak without one."""
    hardness = share * float(ordinary_level().solution.pressure.max())
    tables = with_body(hardness=hardness)
    if share >= 1.0:
        return hertz_findings(tables)
    problem, level = finite_element_solution(tables)
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


def unit_findings(metre: float, pascal: float) -> Findings:
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
        BoundedFigure("unknowns", unknowns, 1.0, "in metres: the same mesh", low=1.0),
    )


def layer_findings(tables: Tables, high: float = THICK, refinement: int = 0) -> Findings:
    """A scene with a layer or a coating against the analytic one on the same hats."""
    problem, level = finite_element_solution(tables, refinement)
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
        BoundedFigure("pressure, L2", error, high, reference),
        relative_error("peak pressure", pressure.max(), expected.max(), high, reference),
    )


def with_body(**fields: object) -> Tables:
    return {**ORDINARY, "body": {**STEEL, **fields}}


def with_roller(times_as_stiff: float) -> Tables:
    modulus = times_as_stiff * STEEL["youngs_modulus"]
    roller = {"radius": RIGID["radius"], "youngs_modulus": modulus, "poissons_ratio": 0.2}
    return {**ORDINARY, "roller": roller}


def cases() -> Groups:
    half_width = problem_from(ORDINARY).hertz.half_width
    cubic = {**with_body(poissons_ratio=0.4999), **CUBIC}
    held_close_by = {**ORDINARY, "finite_element": {"far_field": "half-plane"}}

    def layer(a_over_t: float, high: float, **fields: object) -> Callable[[], Findings]:
        return partial(layer_findings, with_body(thickness=half_width / a_over_t, **fields), high)

    def coated(times_as_stiff: float, part: float, refinement: int = 0) -> Callable[[], Findings]:
        modulus = times_as_stiff * STEEL["youngs_modulus"]
        coating = {"youngs_modulus": modulus, "poissons_ratio": 0.25}
        coating["thickness"] = half_width / part
        return partial(layer_findings, {**ORDINARY, "coating": coating}, refinement=refinement)

    thin_cubic = {**with_body(thickness=half_width / 10.0, poissons_ratio=0.4999), **CUBIC}
    materials = {
        "ordinary: rigid on steel": ORDINARY,
        "roller 1e+06 times as stiff": with_roller(1e6),
        "roller 1e-06 times as stiff": with_roller(1e-6),
        "Poisson's ratio 0": with_body(poissons_ratio=0.0),
        "Poisson's ratio 0.49": with_body(poissons_ratio=0.49),
        "Poisson's ratio 0.4999": with_body(poissons_ratio=0.4999),
        "held like a half-plane close by": held_close_by,
    }
    return {
        "materials": {name: partial(hertz_findings, given) for name, given in materials.items()}
        | {
            "Poisson's ratio 0.4999, cubic": partial(hertz_findings, cubic, CUBIC_PEAK),
            "stresses": partial(shear_findings, ORDINARY),
            "stresses, Poisson's ratio 0.4999, cubic": partial(shear_findings, cubic),
        },
        "friction": {
            f"friction {mu:g}, nu = {nu:g}": partial(sliding_findings, mu, nu)
            for mu, nu in ((0.5, 0.3), (1.0, 0.0), (1.0, 0.4999))
        },
        "hardness": {
            f"hardness {share:g} of the peak": partial(hardness_findings, share)
            for share in (1.0 + 1e-6, 1.0 - 1e-2)
        },
        "units": {
            f"lengths in {m:g} m, stresses in {p:g} Pa": partial(unit_findings, m, p)
            for m, p in ((1e-9, 1.0), (1e3, 1.0), (1.0, 1e-6), (2.0**-20, 2.0**10))
        },
        "layer": {
            "a/t = 0.001, bonded": layer(1e-3, THICK),
            "a/t = 0.1, bonded": layer(0.1, THICK),
            "a/t = 1, bonded": layer(1.0, THICK),
            "a/t = 10, bonded": layer(10.0, MEDIUM),
            "a/t = 100, bonded": layer(100.0, THIN),
            "a/t = 1, frictionless": layer(1.0, THICK, base="frictionless"),
            "a/t = 100, frictionless": layer(100.0, THIN, base="frictionless"),
            "a/t = 1, bonded, nu = 0.4999": layer(1.0, LOCKING, poissons_ratio=0.4999),
            "a/t = 10, bonded, nu = 0.4999, cubic": partial(layer_findings, thin_cubic, MEDIUM),
        },
        "coating": {
            # a stiff one concentrates the pressure: one level finer
            "coating a/10 thick, 1000 times as stiff": coated(1e3, 10.0, refinement=1),
            "coating a/10 thick, 0.001 times as stiff": coated(1e-3, 10.0),
            "coating a/0.5 thick, 1e-06 times as stiff": coated(1e-6, 0.5),
            "coating a/50 thick, 3 times as stiff": coated(3.0, 50.0),
        },
    }
