"""The rough body where it is not linear: at finite deformation, or flowing.

Both start from the linear solution.
"""

import numpy as np

from analytic.contact import ContactSolution, assessed
from analytic.equilibrium import Constraints
from comparisons.finite_element_contact import MutualCompliance
from comparisons.finite_element_stress import Pressed
from comparisons.problem import Problem
from fem.compliance import FiniteElementCompliance
from fem.finite_deformation import press_finitely
from fem.rigid_roller import circle, parabola


def pressed_finitely(
    problem: Problem,
    operator: MutualCompliance,
    linear: ContactSolution,
    constraints: Constraints,
) -> Pressed:
    """The body at finite strains, met by the roller where its surface has come to.

    Pressures are vertical forces per undeformed length of x, as in the linear theory.
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
    solution = reached(found.pressure, found.gap, found.approach, rough, constraints, counts)
    # of the surface, along z: what the roller's normal adds belongs to the gap
    down = FiniteElementCompliance(rough.body, rough.hats)
    return Pressed(
        rough.body, solution, down.weighted(found.displacement), lambda friction: found.stress
    )


def reached(
    pressure: np.ndarray,
    gap: np.ndarray,
    approach: float,
    compliance: FiniteElementCompliance,
    constraints: Constraints,
    counts: dict[str, int],
) -> ContactSolution:
    """A contact (count,) [Pa], [m] of a nonlinear body, assessed as the linear ones are."""
    weights = 0.5 * (compliance.hats[2:] - compliance.hats[:-2])
    moved = (gap + approach) * weights
    return assessed(moved, pressure, np.zeros_like(moved), weights, approach, constraints, counts)
