"""The finite elements' contact again by PETSc's variational inequality, on the same mesh.

It shares mesh, stiffness and hats with a level of `run`, but neither its compliance operator nor
its contact solver, so that a mistake of either shows."""

import tomllib
from functools import partial
from pathlib import Path

import numpy as np

from comparisons.campaigns.cases import CaseFigures, Trial, bounded
from comparisons.common.progress import Stages
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Origin, Scene

AGREE = 1e-6  # relative, in pressure and in load
SCENES = tomllib.loads(Path(__file__).with_name("independent_scenes.toml").read_text("utf-8"))


def independent_cases() -> list[Trial]:
    model, group = "finite_element", "independent solver"
    return [Trial(group, n, model, partial(independent_figures, n)) for n in SCENES]


def independent_figures(name: str) -> CaseFigures:
    """Largest difference of the pressures under one load, over the largest pressure; and relative
    difference of the loads at one approach."""
    from comparisons.models.finite_element.bodies import BodyCache, bodies_of
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement
    from fem.body.surface import hat_forces
    from fem.contact.variational_inequality import solve_variational_inequality

    scene = Scene.of(SCENES[name], Origin("verify", source=f"verify: {name}"))
    problem = problem_of(scene)
    refinement, body_cache = Refinement(problem.pitches[0]), BodyCache()
    how = problem, refinement, Stages(), body_cache
    level, *_ = finite_element_level(*how).values()
    grid = level.grid
    # the bodies that the level was solved on, by the patches that its mesh is refined at
    bodies = bodies_of(problem, refinement, level.patches, Stages(), body_cache)
    load = problem.hertz.load_per_length
    other = solve_variational_inequality(
        [(body, hat_forces(body.surface, grid.hats)) for body in bodies.all],
        grid.hat_integrals(problem.finite_element_gap, problem.knots),
        grid.weights,
        load,
        np.inf if scene.body.hardness is None else scene.body.hardness,
    )
    pressure = level.solution.pressure
    difference = float(np.abs(pressure - other.pressure).max() / pressure.max())
    approach = other.approach - problem.first_touch
    again, *_ = finite_element_level(*how, approach).values()
    loads = float(abs(grid.weights @ again.solution.pressure - load) / load)
    if not all(mesh is level.mesh for mesh in (bodies.rough.mesh, again.mesh)):
        raise RuntimeError(f"{name}: the solvers were on different meshes")
    reference = "PETSc's vinewtonrsls on the whole system"
    return (
        bounded("pressure", difference, AGREE, reference),
        bounded("load", loads, AGREE, reference),
    )
