"""The rough body where it is not linear: at finite deformation, or flowing.

Both start from the linear solution.
"""

from dataclasses import replace

import numpy as np

from analytic.contact import ContactSolution, assessed
from analytic.equilibrium import Constraints
from analytic.patches import contact_patches
from comparisons.finite_element_contact import MutualCompliance
from comparisons.finite_element_stress import Pressed
from comparisons.problem import Problem
from fem.compliance import FiniteElementCompliance
from fem.finite_deformation import press_finitely
from fem.plastic_fields import plastic_fields
from fem.press_plastic import INCREMENTS, press_plastically
from fem.return_mapping import ElasticPlastic
from fem.rigid_roller import circle, parabola
from fem.stress import at_mesh_points

# What is left of the contact conditions after the last increment of flow.
FLOW_TOLERANCE = 1e-6
# Steps of the load on the coarsest levels; their number doubles from level to level, so that what
# they leave out belongs to the uncertainty of the discretisation.
FEWEST_INCREMENTS = 4


def pressed_finitely(
    problem: Problem,
    operator: MutualCompliance,
    linear: ContactSolution,
    constraints: Constraints,
) -> Pressed:
    """The body at finite strains, met by the roller where its surface has come to.

    Pressures are those on the deformed surface, where it has come to along x.
    """
    scene, rough = problem.scene, operator.rough
    shape = circle if scene.finite_element.roller_shape == "circle" else parabola
    found = press_finitely(
        rough.body,
        rough.hats,
        shape(scene.roller_radius),
        linear.pressure,
        load=constraints.load,
        approach=constraints.approach,
        friction=scene.friction[0],
        hardness=constraints.hardness,
    )
    counts = {
        "increments": len(found.solution.parts),
        "newton_steps": found.solution.iterations,
        **{f"linear_{name}": count for name, count in linear.iterations.items()},
    }
    weights, x = _weights(rough), rough.hats[1:-1]
    moved = (found.gap + found.approach) * weights
    solution = assessed(
        moved, found.pressure, np.zeros_like(moved), weights, found.approach, constraints, counts
    )
    patches = contact_patches(x, solution.pressure, solution.gap)
    # the residuals are those of the equations that were solved, over the undeformed surface
    solution = replace(
        solution,
        pressure=np.interp(x, found.place, found.cauchy_pressure),
        gap=np.interp(x, found.place, solution.gap),
    )
    # of the surface, along z: what the roller's normal adds belongs to the gap
    down = FiniteElementCompliance(rough.body, rough.hats)
    return Pressed(
        rough.body,
        solution,
        down.weighted(found.displacement),
        lambda friction: found.stress,
        np.interp(patches, x, found.place),
    )


def pressed_plastically(
    problem: Problem,
    operator: MutualCompliance,
    linear: ContactSolution,
    gap: np.ndarray,
    constraints: Constraints,
) -> Pressed:
    """The body flowing where it must, under its load and when the roller is gone again.

    gap  (count,) [m^2] initial, weighted by each hat
    """
    scene, rough, weights = problem.scene, operator.rough, _weights(operator.rough)
    friction = scene.friction[0]
    roller = operator.parts[1].compliance if len(operator.parts) > 1 else None
    metal = ElasticPlastic(scene.body, scene.yielding.stress, scene.yielding.hardening)
    increments = max(FEWEST_INCREMENTS, round(INCREMENTS / 2.0 ** problem.coarser(weights.mean())))
    body, (loaded, released) = press_plastically(
        rough,
        metal,
        gap,
        weights,
        (constraints.load, 0.0),
        linear.pressure,
        friction,
        roller,
        increments,
    )
    own = rough.weighted(loaded.displacement)
    both = own if roller is None else own + roller.apply(loaded.pressure, -friction)
    counts = {
        "linear_contacts": loaded.iterations,
        **{f"linear_{name}": count for name, count in linear.iterations.items()},
    }
    solution = assessed(
        both, loaded.pressure, gap, weights, loaded.approach, constraints, counts, FLOW_TOLERANCE
    )
    fields, left = plastic_fields(body, loaded), plastic_fields(body, released)
    others = {
        "sy": fields.sy,
        "von_mises": fields.von_mises,
        "equivalent_plastic_strain": fields.equivalent_strain,
        "residual_sx": left.stress.sx,
        "residual_sz": left.stress.sz,
        "residual_sy": left.sy,
        "residual_txz": left.stress.txz,
        "residual_von_mises": left.von_mises,
    }
    stress = at_mesh_points(rough.body, fields.stress)
    patches = contact_patches(rough.hats[1:-1], solution.pressure, solution.gap)
    return Pressed(rough.body, solution, own, lambda friction: stress, patches, others)


def _weights(compliance: FiniteElementCompliance) -> np.ndarray:
    """Integrals of the hats (count,) [m]."""
    return 0.5 * (compliance.hats[2:] - compliance.hats[:-2])
