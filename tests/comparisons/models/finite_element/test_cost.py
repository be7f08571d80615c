"""What levels are expected to take, over all scenes that come along."""

import numpy as np
import pytest

from comparisons.models.finite_element.mesh import (
    Refinement,
    block_spec,
    expected_unknowns,
    roller_spec,
)
from comparisons.models.posing import problem_of
from comparisons.scenes.files import scene_names
from comparisons.scenes.scene import Scene
from meshes.build import build_block


@pytest.mark.parametrize("name", scene_names())
def test_unknowns_are_those_of_the_meshes(name):
    """Of the first level, as if contact were all over the extent; with quadratic elements."""
    scene = Scene.read(name)
    problem = problem_of(scene.unchecked({"finite_element.element": "P2"}))
    refinement, patches = Refinement(problem.pitches[0]), np.array([problem.extent])
    specs = [block_spec(problem, refinement, patches)]
    if not problem.scene.roller.rigid and not problem.shares_factor:
        specs.append(roller_spec(problem, specs[0]))
    made = sum(2 * len(build_block(spec).points) for spec in specs)
    expected = expected_unknowns(problem, refinement, patches)
    assert expected == pytest.approx(made, rel=0.2)
