"""The finite elements' contact once more by PETSc's variational inequality, on the same mesh.

It shares mesh, stiffness and hats with the product's own road, but neither its operator nor its
contact solver, so that a mistake of either shows.
"""

from pathlib import Path

import numpy as np

from comparisons.common.progress import Stages
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.verify.checks import Check

AGREE = 1e-6  # relative, in pressure and in load
REFERENCE = "PETSc's vinewtonrsls on the whole system"
STEEL = {"youngs_modulus": 207e9, "poissons_ratio": 0.3}
WAVES = {"kind": "sinusoid", "wavelength": "100 um", "amplitude": "0.3 um"}
ROLLER, LOAD = {"radius": 8.2e-3}, {"hertz_peak_pressure": 1e9}
SCENES = {
    "smooth": {"roller": ROLLER | {"rigid": True}, "body": STEEL, "load": LOAD},
    "wavy, with a hardness": {
        "roller": ROLLER | {"rigid": True},
        "body": STEEL | {"hardness": 1.6e9},
        "profile": WAVES,
        "load": LOAD,
    },
    "elastic roller of another material": {
        "roller": ROLLER | {"youngs_modulus": 70e9, "poissons_ratio": 0.33},
        "body": STEEL,
        "load": LOAD,
    },
}


def second_road() -> list[Check]:
    """Both roads on the coarsest level of a few scenes."""
    return [check for name, tables in SCENES.items() for check in both_roads(name, tables)]


def both_roads(name: str, tables: dict) -> list[Check]:
    """Largest difference of the pressures under one load, over the largest pressure; and that of
    the loads under one approach."""
    from comparisons.models.finite_element.bodies import BodyStore, bodies_of
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement
    from fem.body.surface import hat_forces
    from fem.contact.variational_inequality import solve_variational_inequality

    scene = resolve_tables(tables, name="verify", folder=Path("."), source=f"verify: {name}")
    problem = problem_of(scene)
    plan = make_plan(problem, ("finite_element",))
    refinement, store = Refinement(problem.pitches[0]), BodyStore()
    own = finite_element_level(problem, plan, refinement, None, Stages(), store=store)
    grid = own.grid
    # the mesh that the level was solved on, by the ground that it refined
    bodies = bodies_of(problem, plan, refinement, own.patches, Stages(), store)
    hats = np.concatenate([[grid.x[0] - grid.pitch], grid.x, [grid.x[-1] + grid.pitch]])
    other = solve_variational_inequality(
        [(body, hat_forces(body.surface, hats)) for body in bodies.all],
        grid.hat_integrals(problem.finite_element_gap, problem.knots),
        grid.weights,
        problem.hertz.load_per_length,
        np.inf if scene.hardness is None else scene.hardness,
    )
    pressure, load = own.solution.pressure, problem.hertz.load_per_length
    apart = float(np.abs(pressure - other.pressure).max() / pressure.max())
    approach = other.approach - problem.first_touch
    pushed = finite_element_level(problem, plan, refinement, None, Stages(), approach, store)
    loads = float(abs(grid.weights @ pushed.solution.pressure - load) / load)
    if not all(mesh is own.mesh for mesh in (bodies.rough.mesh, pushed.mesh)):
        raise RuntimeError(f"{name}: the roads were on different meshes")
    return [
        Check("second road", f"{name}: pressure", REFERENCE, apart, 0.0, AGREE),
        Check("second road", f"{name}: load", REFERENCE, loads, 0.0, AGREE),
    ]
