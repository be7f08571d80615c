"""The load that brings the bodies together by a prescribed approach, from finite elements.

Only a body with a datum has an approach: a layer on its base under a rigid roller. The half-plane
is then compared under the load that the layer carries.
"""

import numpy as np

from comparisons.common.errors import SceneError
from comparisons.common.progress import ProgressCallback, Stages
from comparisons.models.finite_element.bodies import BodyStore
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem, problem_of
from comparisons.scenes.scene import ResolvedScene

SETTLED = 1e-3  # relative change of the load that no longer moves the mesh
MOST_ROUNDS = 12


def problem_of_approach(scene: ResolvedScene, callback: ProgressCallback) -> Problem:
    """The scene's problem with the load [N/m] that goes with its approach, to SETTLED or better.

    Each round meshes for the load of the one before and prescribes the approach there. Raises
    SceneError if the rounds do not settle.
    """
    wanted = scene.load.value
    # a rigid body of the roller's shape would cut the surface over twice this half-width
    half_width = np.sqrt(scene.roller_radius * wanted)
    modulus = scene.body.plane_strain_modulus
    load = np.pi * modulus * half_width**2 / (4.0 * scene.roller_radius)
    store = BodyStore()
    for _ in range(MOST_ROUNDS):
        problem = problem_of(scene, load)
        plan = make_plan(problem, ("finite_element",))
        pitch = problem.pitches[-1]
        callback("finite elements: load of the prescribed approach")
        level = finite_element_level(
            problem, plan, Refinement(pitch), None, Stages(), approach=wanted, store=store
        )
        before, load = load, level.solution.load
        low, high = problem.extent
        if level.patches[0, 0] < low + pitch or level.patches[-1, 1] > high - pitch:
            load = 2.0 * before  # the contact fills the grid: it carries more than that
        elif abs(load - before) <= SETTLED * load:
            return problem_of(scene, load)
    raise SceneError(
        f"{scene.source}: load.approach: no load was found that gives {wanted:g} m; allowed is a "
        "load (per_length) instead"
    )
