"""The loaded rough body: its surface, its stresses on the window and at the mesh's points."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.stress_state import Extremum, StressState
from comparisons.common.mpi import from_first
from comparisons.models.finite_element.contact import MutualCompliance, roller_normal
from comparisons.models.level import MeshField, StressResult, highest
from comparisons.models.problem import Problem, ends_of, mean_height
from comparisons.models.window import Window
from fem.body.elasticity import ElasticBody
from fem.body.surface import straight_down
from fem.nonlinear.hyperelastic import along_surface
from fem.stress.maximum import maxima, maximum
from fem.stress.stress import NodalStress, evaluate, nodal_stress


@dataclass(frozen=True)
class LoadedBody:
    """The rough body in contact.

    displacement  (count,) [m^2] of its surface into the body, weighted by each hat
    stress        by friction coefficient
    patches       (k, 2) [m] contact patches
    others        further fields at the mesh's points (n,), by name
    material      (count,) [m] where what now stands at the grid's nodes stood without load; None:
                  there
    """

    body: ElasticBody
    solution: ContactSolution
    displacement: np.ndarray
    stress: Callable[[float], NodalStress]
    patches: np.ndarray
    others: dict[str, np.ndarray] = field(default_factory=dict)
    material: np.ndarray | None = None


def pressed_linearly(
    problem: Problem,
    operator: MutualCompliance,
    grid: HatGrid,
    solution: ContactSolution,
    gap: np.ndarray,
) -> LoadedBody:
    """The linear elastic body under the pressures of a contact; gap (count,) [m^2] is the initial
    one, weighted by each hat.

    Where the gap is on the deformed surface, so are the pressures.
    """
    rough, settings = operator.rough, problem.scene.finite_element
    displaced = settings.gap == "displaced"
    direction = roller_normal(problem) if displaced else straight_down
    pressure, x = solution.pressure, grid.x
    ends = ends_of(problem, grid, solution)

    def stress(friction: float) -> NodalStress:
        moved = rough.displacement(pressure, friction)
        return from_first(
            lambda: nodal_stress(
                rough.body, moved, rough.hats, pressure, friction, direction, ends.at(friction)
            )
        )

    dragged = problem.scene.friction[0] if settings.coupled else 0.0
    patches = contact_patches(x, pressure, solution.gap)
    if not displaced:
        if len(operator.parts) == 1 and not dragged:  # its share of what closed the gap
            both = (solution.gap + solution.approach) * grid.weights - gap
            own = both / operator.parts[0].factor
        else:
            own = rough.apply(pressure, dragged)
        return LoadedBody(rough.body, solution, own, stress, patches)
    moved = rough.displacement(pressure, dragged)
    top = rough.body.top
    along, down = rough.body.at_points(moved)[top.point].T
    place, depth = x + np.interp(x, top.x, along), np.interp(x, top.x, down)
    stretch = np.interp(x, top.x, 1.0 + along_surface(top.x, along[:, None])[:, 0])
    solution = replace(solution, pressure=pressure / stretch)
    loaded = LoadedBody(rough.body, solution, depth * grid.weights, stress, patches)
    return on_undeformed_grid(problem, grid, place, depth, loaded)


def on_undeformed_grid(
    problem: Problem, grid: HatGrid, place: np.ndarray, depth: np.ndarray, loaded: LoadedBody
) -> LoadedBody:
    """What was found at displaced nodes, interpolated to the grid's x.

    place, depth  (count,) [m] where the nodes are along x, and by how much they have sunk

    The residuals stay those of the equations that were solved, over the undeformed surface.
    """
    x, height, solution = grid.x, mean_height(problem, grid), loaded.solution
    pressure, gap, now = (
        np.interp(x, place, value) for value in (solution.pressure, solution.gap, height - depth)
    )
    return replace(
        loaded,
        solution=replace(solution, pressure=pressure, gap=gap),
        displacement=(height - now) * grid.weights,
        patches=np.interp(loaded.patches, x, place),
        material=np.interp(x, place, x),
    )


def stresses_of(
    pressed: LoadedBody,
    frictions: tuple[float, ...],
    window: Window,
    asperities: tuple[float, ...] = (),
) -> tuple[tuple[StressResult, ...], MeshField]:
    """Extremes and fields on the window, one set a friction coefficient, and all on the mesh.

    asperities  (k,) [m] where one ends and the next begins: each has its own largest stresses
    """
    body, results, on_mesh = pressed.body, [], {}
    bounds = (-window.extent, window.extent, window.z[-1])
    shears = {"tau1": lambda stress: stress.tau1, "txz": lambda stress: np.abs(stress.txz)}
    for friction in frictions:
        nodal = pressed.stress(friction)
        found = {n: maxima(body, nodal, of, bounds, asperities) for n, of in shears.items()}
        extremes = {name: highest(each) for name, each in found.items()}
        extremes["von_mises"] = maximum(
            body, nodal, lambda stress: stress.von_mises(stress.poissons_ratio), bounds
        )
        if "von_mises" in pressed.others:  # it does not follow from the stresses
            von_mises, (x, z) = pressed.others["von_mises"], body.points.T
            inside = (np.abs(x) <= window.extent) & (z <= window.z[-1])
            top = np.argmax(np.where(inside, von_mises, -np.inf))
            extremes["von_mises"] = Extremum(float(von_mises[top]), float(x[top]), float(z[top]))
        x, z = np.meshgrid(window.x, window.z)
        results.append(StressResult(friction, extremes, evaluate(body, nodal, x, z), found))
        stress, nodes = nodal.stress, nodal.nodes
        on_mesh[friction] = StressState(stress.sx, stress.sz, stress.txz)
    mesh_field = MeshField(
        body.points[nodes.point], nodes.triangles, on_mesh, stress.poissons_ratio, pressed.others
    )
    return tuple(results), mesh_field
