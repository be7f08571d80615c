"""Thermal stresses of the finite elements' body, with those of the contact."""

from dataclasses import replace

import numpy as np

from comparisons.models.finite_element.bodies import rough_support
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.heat.conduction import solved_heat
from comparisons.studies.heat.half_plane_stress import HeatedStress, surface_places
from comparisons.studies.heat.half_space import friction_of
from fem.body.elasticity import elastic_body
from fem.heat.thermal_stress import thermal_stress
from fem.stress.maximum import maximum
from fem.stress.stress import evaluate_all


def finite_element_stress(
    problem: Problem, level: Level, window: Window, beyond: float = np.inf
) -> HeatedStress:
    """Of a level; an unbounded body is held `beyond` this part of its mesh."""
    heat, friction, field = problem.scene.heat, friction_of(problem), level.mesh_field
    made = field.mesh, field.material, rough_support(problem, field.mesh.spec, beyond)
    body = elastic_body(*made, degree=field.degree, coating=field.coating)
    expansion = np.where(body.coated, heat.coating_expansion or 0.0, heat.body_expansion)
    temperature = solved_heat(problem, level)[1]
    thermal, _ = thermal_stress(body, expansion, temperature(body.points))
    elastic = field.on(body)[field.frictions.index(friction)]
    both = replace(
        elastic,
        at=lambda node: elastic.at(node) + thermal.at(node),
        estimate=lambda: elastic.estimate() + thermal.values,
        together=None,
    )
    bounds = -window.extent, window.extent, window.z[-1]
    tau1 = maximum(body, both, lambda stress: stress.tau1, bounds)
    x = surface_places(level, window, field.ends)
    along = evaluate_all(body, (both, elastic), x, np.zeros_like(x))
    own = level.stress(friction).extremes["tau1"]
    return HeatedStress((tau1, own), x, np.array([each.sx for each in along]))
