"""The load [N/m] under which a scene has the approach that it prescribes.

Only a body with a datum has an approach: a layer on its base under a rigid roller."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from comparisons.common.errors import SceneError
from comparisons.models.nearest_operator import nearest_operator
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels, Problem, patches_of, pressed_on
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface

LAST_LOAD_CHANGE = 1e-3  # relative change of the load that no longer moves the mesh
MOST_ROUNDS = 12  # of loads for a prescribed approach


def settled(
    scene: Scene,
    surface: SceneSurface,
    pressed: Callable[[Problem], tuple[float, np.ndarray]],
    levels: Levels | None = None,
) -> Problem:
    """The scene's problem under the load of its approach, to LAST_LOAD_CHANGE or better.

    pressed  load [N/m] and patches (k, 2) [m] of a problem at the approach, on its own grid
    Each round solves on the grid for the load of the one before. Raises SceneError if the rounds
    do not settle."""
    wanted = scene.load.value
    # a rigid body of the roller's shape would cut the surface over twice this half-width
    half_width = np.sqrt(scene.roller.radius * wanted)
    modulus = scene.body.material.plane_strain_modulus
    load = np.pi * modulus * half_width**2 / (4.0 * scene.roller.radius)
    for _ in range(MOST_ROUNDS):
        problem = problem_of(scene, surface, load, levels)
        pitch = problem.pitches[-1]
        before, (load, patches) = load, pressed(problem)
        low, high = problem.extent
        if patches[0, 0] < low + pitch or patches[-1, 1] > high - pitch:
            load = 2.0 * before  # the contact fills the grid: it carries more than that
        elif abs(load - before) <= LAST_LOAD_CHANGE * load:
            return problem_of(scene, surface, load, levels)
    raise SceneError(
        f"{scene.source}: load.approach: no load was found that gives {wanted:g} m; allowed is a "
        "load (per_length) instead"
    )


def load_on_layer(scene: Scene, surface: SceneSurface) -> float:
    """The load [N/m] of the scene's approach on the endless layer, without friction."""

    def pressed(problem: Problem) -> tuple[float, np.ndarray]:
        grid = problem.grid(problem.pitches[-1])
        depth = scene.load.value + problem.first_touch
        limits = replace(problem.constraints(), load=None, approach=depth)
        solution = pressed_on(problem, grid, nearest_operator(scene, grid), limits)
        return solution.load, patches_of(grid, solution)

    return settled(scene, surface, pressed).hertz.load_per_length
