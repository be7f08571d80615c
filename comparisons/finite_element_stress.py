"""What a pressed body shows: its surface, its stresses on the window and at the mesh's points."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from analytic.contact import ContactSolution
from analytic.patches import contact_patches
from analytic.plane_stress import Extremum, PlaneStress
from comparisons.finite_element_contact import MutualCompliance, roller_normal
from comparisons.level import MeshField, StressResult, Window
from comparisons.problem import Problem
from comparisons.rank import from_first
from fem.elasticity import ElasticBody
from fem.maximum import maximum
from fem.stress import NodalStress, evaluate, nodal_stress
from fem.surface import straight_down


@dataclass(frozen=True)
class Pressed:
    """The rough body in contact.

    displacement  (count,) [m^2] of its surface into the body, weighted by each hat
    stress        by friction coefficient
    patches       (k, 2) [m] contact patches
    others        further fields at the mesh's points (n,), by name with their unit
    """

    body: ElasticBody
    solution: ContactSolution
    displacement: np.ndarray
    stress: Callable[[float], NodalStress]
    patches: np.ndarray
    others: dict[str, np.ndarray] = field(default_factory=dict)


def pressed_linearly(
    problem: Problem, operator: MutualCompliance, solution: ContactSolution
) -> Pressed:
    """The linear elastic body under the pressures of a contact."""
    rough, settings = operator.rough, problem.scene.finite_element
    direction = roller_normal(problem) if settings.gap == "displaced" else straight_down
    pressure = solution.pressure

    def stress(friction: float) -> NodalStress:
        moved = rough.displacement(pressure, friction)
        return from_first(
            lambda: nodal_stress(rough.body, moved, rough.hats, pressure, friction, direction)
        )

    dragged = problem.scene.friction[0] if settings.coupled else 0.0
    patches = contact_patches(rough.hats[1:-1], pressure, solution.gap)
    return Pressed(rough.body, solution, rough.apply(pressure, dragged), stress, patches)


def stresses_of(
    pressed: Pressed, frictions: tuple[float, ...], window: Window
) -> tuple[tuple[StressResult, ...], MeshField]:
    """Extremes and fields on the window, one set a friction coefficient, and all on the mesh."""
    body, results, on_mesh = pressed.body, [], {}
    for friction in frictions:
        nodal = pressed.stress(friction)
        results.append(_on_window(body, nodal, friction, window, pressed.others.get("von_mises")))
        stress, nodes = nodal.stress, nodal.nodes
        on_mesh[friction] = PlaneStress(stress.sx, stress.sz, stress.txz)
    mesh_field = MeshField(
        body.points[nodes.point], nodes.triangles, on_mesh, stress.poissons_ratio, pressed.others
    )
    return tuple(results), mesh_field


def _on_window(
    body: ElasticBody,
    nodal: NodalStress,
    friction: float,
    window: Window,
    von_mises: np.ndarray | None,
) -> StressResult:
    """`von_mises` (n,) [Pa] at the mesh's points where it does not follow from the stresses."""
    bounds = (-window.reach, window.reach, window.z[-1])
    quantities = {
        "tau1": lambda stress: stress.tau1,
        "txz": lambda stress: np.abs(stress.txz),
        "von_mises": lambda stress: stress.von_mises(stress.poissons_ratio),
    }
    extremes = {
        name: maximum(body, nodal, quantity, bounds) for name, quantity in quantities.items()
    }
    if von_mises is not None:
        x, z = body.points.T
        inside = (np.abs(x) <= window.reach) & (z <= window.z[-1])
        top = np.argmax(np.where(inside, von_mises, -np.inf))
        extremes["von_mises"] = Extremum(float(von_mises[top]), float(x[top]), float(z[top]))
    x, z = np.meshgrid(window.x, window.z)
    return StressResult(friction, extremes, evaluate(body, nodal, x, z))
