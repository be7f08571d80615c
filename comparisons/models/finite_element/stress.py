"""The loaded rough body: its surface, its stresses on the window and at the mesh's points."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from analytic.contact.problem import ContactSolution
from analytic.stress_state import von_mises
from comparisons.models.finite_element.contact import SmallStrainContact
from comparisons.models.level import MeshField, RecoverableField, StressResult, highest
from comparisons.models.operators import patches_of
from comparisons.models.readings import ends_of
from comparisons.models.window import Window
from fem.body.elasticity import ElasticBody
from fem.body.triangle import shapes
from fem.stress.maximum import Samples, highest_node, maxima, maximum
from fem.stress.stress import NodalStress, evaluate_all


@dataclass(frozen=True)
class LoadedBody:
    """The rough body in contact."""

    body: ElasticBody
    solution: ContactSolution
    displacement: np.ndarray  # (count,) [m^2] of its surface into the body, weighted by each hat
    patches: np.ndarray  # (k, 2) [m] contact patches
    # what stresses of a linear body are recovered from under some friction coefficients; of any
    # other body `stress` and `moved` are known
    linear: Callable[[tuple[float, ...]], RecoverableField] | None = None
    stress: NodalStress | None = None
    moved: np.ndarray | None = None  # (n, 2) [m] at the nodes of the displacement
    # stress across the plane (n,) [Pa] at the mesh's points; a linear body's is nu (sx + sz)
    across: np.ndarray | None = None
    others: dict[str, np.ndarray] = field(default_factory=dict)  # further fields there, by name
    # (n,) [Pa] largest principal shear that a metal bears there; None: any
    bearable: np.ndarray | None = None
    # (count,) [m] where what now stands at the grid's nodes stood without load; None: there
    material: np.ndarray | None = None


def pressed_linearly(contact: SmallStrainContact) -> LoadedBody:
    """The linear elastic body under the pressures of a contact."""
    problem, grid, solution = contact.problem, contact.grid, contact.solution
    rough, pressure, parts = contact.operator.rough, solution.pressure, contact.operator.parts

    def linear(frictions: tuple[float, ...]) -> RecoverableField:
        moved = np.stack([rough.displacement(pressure, friction) for friction in frictions], axis=1)
        body, ends = rough.body, ends_of(problem, grid, solution)
        placed = body.mesh, body.material, body.coating, body.degree, moved
        return RecoverableField(*placed, rough.hats, pressure, frictions, ends)

    scene = problem.scene
    dragged = scene.load.friction[0] if scene.finite_element.coupled else 0.0
    if len(parts) == 1 and not dragged:  # its share of what closed the gap
        both = (solution.gap + solution.approach) * grid.weights - contact.gap
        displacement = both / parts[0].factor
    else:
        displacement = rough.apply(pressure, dragged)
    return LoadedBody(rough.body, solution, displacement, patches_of(grid, solution), linear)


def _borne(pressed: LoadedBody, nodal: NodalStress, largest: np.ndarray) -> np.ndarray:
    """Largest shears with their places (3, k) [Pa], [m], no larger than what a metal bears there:
    between nodes on the yield surface a recovered field may be beyond it."""
    if pressed.bearable is None:
        return largest
    known = np.flatnonzero(~np.isnan(largest[1]))
    element, at = pressed.body.locator(largest[1:, known].T)
    around = pressed.bearable[nodal.nodes.triangles[element]]
    flows = np.isfinite(around).all(axis=1)  # a coating does not
    known, limit = known[flows], (shapes(at[flows]) * around[flows]).sum(axis=1)
    largest[0, known] = np.minimum(largest[0, known], limit)
    return largest


def stresses_of(
    pressed: LoadedBody,
    frictions: tuple[float, ...],
    window: Window,
    asperities: tuple[float, ...] = (),
    fields: bool = True,
) -> tuple[tuple[StressResult, ...], MeshField | RecoverableField | None]:
    """Extremes and fields on the window, one set a friction coefficient, and all on the mesh.

    asperities  (k,) [m] where one ends and the next begins: each has its own largest stresses
    fields      whether these are wanted; else stresses are computed only where they may be the
                largest
    """
    body, results = pressed.body, []
    linear = pressed.linear and pressed.linear(frictions)
    nodal = linear.on(body) if linear else (pressed.stress,) * len(frictions)
    bounds = (*window.ends, window.z[-1])
    shears = {"tau1": lambda stress: stress.tau1, "txz": lambda stress: np.abs(stress.txz)}
    shown = [None] * len(frictions)
    if fields:
        shown = evaluate_all(body, nodal, *np.meshgrid(window.x, window.z))
    for friction, stresses, on_window in zip(frictions, nodal, shown, strict=True):
        samples = Samples(body, stresses)
        searched = bounds, asperities, samples
        highest_places = {
            name: _borne(pressed, stresses, maxima(body, stresses, of, *searched))
            for name, of in shears.items()
        }
        extremes = {name: highest(most) for name, most in highest_places.items()}
        if linear:
            where = bounds, samples
            mises = maximum(body, stresses, lambda s: s.von_mises(s.poissons_ratio), *where)
        else:
            mises = highest_node(body, stresses, pressed.across, bounds)
        extremes["von_mises"] = mises
        results.append(StressResult(friction, extremes, highest_places, on_window))
    if linear or not fields:
        return tuple(results), linear if fields else None
    mises = von_mises(nodal[0].stress, pressed.across)
    others = {"sy": pressed.across, "von_mises": mises, **pressed.others}
    moved = np.stack([pressed.moved] * len(frictions), axis=1)
    return tuple(results), MeshField.of(body, frictions, nodal, moved, others)
