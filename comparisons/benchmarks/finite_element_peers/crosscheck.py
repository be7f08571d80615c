"""This project's finite elements under comparison, as a scene uses them.

Block, elastic body, its compliance on hats, and the contact on it with the half-plane as the model
of the outer iteration. The first argument of the program gives the degree of the displacements and
how many hats stand on an element edge, in two digits; an s after them asks for the smooth curves
behind the hats (`analytic.contact.smooth_pressure`) in place of the hats.
"""

import sys
from typing import TYPE_CHECKING

import numpy as np

from comparisons.benchmarks.finite_element_peers.task import Task, run_program

SAMPLES = 200  # of the smooth curve of a patch

if TYPE_CHECKING:
    from analytic.contact.equilibrium import Constraints
    from analytic.contact.problem import ContactSolution


def contact_of(
    task: Task, degree: int, hats: int, constraints: "Constraints"
) -> tuple[np.ndarray, "ContactSolution", int]:
    """Nodes (n + 2,) [m] of the hats with the outer feet, pressures on them, and unknowns.

    Raises RuntimeError where the contact has not converged.
    """
    from analytic.contact.defect_correction import solve_with_model
    from analytic.grid import HatGrid
    from analytic.material import Material
    from analytic.operators.half_plane import HalfPlane
    from fem.body.elasticity import elastic_body
    from fem.body.support import Support
    from fem.compliance.operator import FiniteElementCompliance
    from meshes.block import BlockMesh, BlockSpec

    spec = BlockSpec(task.half_width, task.depth, task.ground[None], task.surface_size, task.growth)
    mesh = BlockMesh(task.points, task.triangles, np.zeros_like(task.points), spec)
    material = Material(float(task.youngs_modulus), float(task.poissons_ratio))
    body = elastic_body(mesh, material, Support("bonded", "fixed"), degree=degree)
    grid = HatGrid.within(*task.ground, task.surface_size / hats)
    feet = np.arange(grid.first - 1, grid.last + 2) * grid.pitch
    solution = solve_with_model(
        FiniteElementCompliance(body, feet),
        HalfPlane(grid.count, grid.pitch, material.plane_strain_modulus),
        grid.hat_integrals(task.gap),
        grid.weights,
        constraints,
    )
    if not solution.converged:
        raise RuntimeError(f"not converged: {solution.residuals}")
    return feet, solution, body.unknowns


def smooth_curves(feet: np.ndarray, solution: "ContactSolution") -> tuple[np.ndarray, np.ndarray]:
    """Places [m], dense towards the ends of each patch, and the smooth pressure [Pa] there."""
    from analytic.contact.smooth_pressure import smooth_pressure

    share = 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, SAMPLES)))
    places, pressure = [], []
    for patch in smooth_pressure(feet, solution.pressure, solution.gap):
        start, stop = patch.ends
        x = start + (stop - start) * share
        places.append(x)
        pressure.append(np.concatenate([[0.0], patch.curve(x[1:-1]), [0.0]]))
    return np.concatenate(places), np.concatenate(pressure)


def main(settings: str, *files: str) -> None:
    """Solve the task in the first file into the second."""
    from analytic.contact.equilibrium import Constraints

    def solve(task: Task) -> tuple[np.ndarray, np.ndarray, int, int]:
        degree, hats = map(int, settings[:2])
        given = Constraints(approach=float(task.approach))
        feet, solution, unknowns = contact_of(task, degree, hats, given)
        steps = solution.iterations["steps"]
        if settings.endswith("s"):
            return *smooth_curves(feet, solution), unknowns, steps
        return feet, np.concatenate([[0.0], solution.pressure, [0.0]]), unknowns, steps

    run_program(solve, *files)


if __name__ == "__main__":
    main(*sys.argv[1:])
