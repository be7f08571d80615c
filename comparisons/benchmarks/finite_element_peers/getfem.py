"""getfem under comparison: quadratic triangles and its integral contact with a rigid obstacle.

The program runs in whatever interpreter has getfem: Debian's. Settings, each the best of those
tried on a cylinder: the augmented Lagrangian by Alart and Curnier (option 1) with a linear
multiplier on the ground (quadratic ones take longer to the same error), r = 10 E (1 is less
accurate, 100 takes twice the steps), four Gauss points an edge; the obstacle by its signed distance
at the quadratic nodes. Generalised Newton with MUMPS; the line search that getfem's contact
examples use.
"""

import sys

import numpy as np

from comparisons.benchmarks.finite_element_peers.task import Task, run_program

HELD, GROUND = 1, 2  # regions
AUGMENTATION = 10.0  # r over Young's modulus
RESIDUAL = 1e-9  # of the forces, for E d
MOST_STEPS = 100


def solve(task: Task) -> tuple[np.ndarray, np.ndarray, int, int]:
    """x, pressure, unknowns and steps."""
    import getfem

    getfem.util_trace_level(0)
    mesh = getfem.Mesh("empty", 2)
    corners = task.vertices[task.triangles[:, :3]].transpose(2, 1, 0)
    mesh.add_convex(getfem.GeoTrans("GT_PK(2,1)"), np.ascontiguousarray(corners))
    border = mesh.outer_faces()
    top = mesh.normal_of_faces(border)[1] < -0.5
    mesh.set_region(HELD, border[:, ~top])
    ground = np.flatnonzero(task.touchable(*mesh.pts()))
    mesh.set_region(GROUND, mesh.faces_from_pid(ground))
    displacement, scalar, multiplier = (getfem.MeshFem(mesh, size) for size in (2, 1, 1))
    displacement.set_fem(getfem.Fem("FEM_PK(2,2)"))
    scalar.set_fem(getfem.Fem("FEM_PK(2,2)"))
    multiplier.set_fem(getfem.Fem("FEM_PK(2,1)"))
    volume, surface = (getfem.MeshIm(mesh, getfem.Integ(f"IM_TRIANGLE({k})")) for k in (2, 4))

    model = getfem.Model("real")
    model.add_fem_variable("u", displacement)
    for name, value in zip(("lambda", "mu"), task.lame, strict=True):
        model.add_initialized_data(name, [value])
    model.add_isotropic_linearized_elasticity_brick(volume, "u", "lambda", "mu")
    model.add_Dirichlet_condition_with_simplification("u", HELD)
    model.add_filtered_fem_variable("p", multiplier, GROUND)
    x, z = scalar.basic_dof_nodes()
    model.add_initialized_fem_data("obstacle", scalar, z + task.gap(x) - task.approach)
    model.add_initialized_data("r", [AUGMENTATION * task.youngs_modulus])
    model.add_integral_contact_with_rigid_obstacle_brick(surface, "u", "p", "obstacle", "r", GROUND)
    residual = RESIDUAL * task.youngs_modulus * task.approach
    search = ("lsearch", "simplest", "alpha min", 0.8)
    options = ("max_res", residual, "max_iter", MOST_STEPS, "lsolver", "mumps", *search)
    steps, converged = model.solve(*options)
    if not converged:
        raise RuntimeError(f"Newton's method has not converged after {steps} steps")
    nodes = multiplier.basic_dof_nodes()[0, multiplier.basic_dof_on_region(GROUND)]
    return nodes, -model.variable("p"), displacement.nbdof(), int(steps)


if __name__ == "__main__":
    run_program(solve, *sys.argv[1:])
