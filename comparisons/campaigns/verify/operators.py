"""Exact contacts that no scene describes: waves and rounded punches on the half-plane's operators,
rigid cylinders on the analytic layer. Each is solved on three grids, judged as a scene's levels."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.exact.cases import ExactContact, exact_contacts
from analytic.exact.layers import LayerReference, layer_references
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.periodic import PeriodicHalfPlane
from comparisons.campaigns.cases import CaseFigures, Trial
from comparisons.campaigns.verify.coverage import compared
from comparisons.campaigns.verify.scenes import (
    LAYER_MODULUS,
    LAYER_RADIUS,
    LAYER_SOURCE,
    LAYER_THICKNESS,
    NEARLY_INCOMPRESSIBLE,
    RESOLUTIONS,
    spread,
)
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import Reading, iteration, length_resolution
from comparisons.judging import contact
from comparisons.judging.rule import judged_by
from comparisons.models.level import Solution

LEVELS = 3
FULL = 1.0 - 1e-12  # of a period: contact without an edge
MARGIN = 0.5  # of the half-width: grid beyond the contact
FORMAL_ORDERS = {"mean_gap": 2.0}  # of figures that are not compared in scenes


@dataclass(frozen=True)
class OperatorContact:
    """A contact on an operator of the library."""

    name: str
    source: str
    kind: str  # wave | punch | layer | rough
    model: str  # half_plane | layer
    make: Callable[[int, float], ModelOperator]  # operator of a grid's count and pitch [m]
    gap: Callable[[np.ndarray], np.ndarray]  # g0(x) [m], smooth but for `knots` [m]
    load: float  # [N/m]
    span: tuple[float, float]  # (2,) ends of the grid [m]; a period's where it is periodic
    scale: float  # [m] of which the pitch is a part: half of the contact, or its rounded corner
    exact: dict[str, float]  # figures [SI] by quantity
    knots: tuple[float, ...] = ()
    periodic: bool = False
    patches: int = 1  # of contact, a period's


def operator_contacts() -> tuple[OperatorContact, ...]:
    contacts = [_contact(c) for c in exact_contacts() if c.period is not None or c.knots]
    layers = [_layer(r, r.poissons_ratio or NEARLY_INCOMPRESSIBLE) for r in layer_references()]
    return (*contacts, *layers)


def operator_cases(
    contacts: Sequence[OperatorContact], ends: tuple[float, float] = RESOLUTIONS
) -> list[Trial]:
    """Cases of each contact, with numbers of elements of its own on the third level."""
    return [
        Trial(
            contact.kind,
            f"{contact.name}, {elements:g} elements",
            contact.model,
            partial(operator_figures, contact, elements),
        )
        for contact, elements in zip(contacts, spread(len(contacts), ends), strict=True)
    ]


def operator_figures(case: OperatorContact, elements: float) -> CaseFigures:
    levels = tuple(_solved(case, elements / 2.0**k) for k in range(LEVELS - 1, -1, -1))
    grid, solution = levels[-1]

    def read(level: tuple[HatGrid, ContactSolution]) -> dict[str, float]:
        grid, solution = level
        patches = contact_patches(grid.x, solution.pressure, solution.gap)
        values = {
            "peak_pressure": float(solution.pressure.max()),
            "contact_length": float((patches[:, 1] - patches[:, 0]).sum()),
            "mean_gap": float(solution.gap.mean()),
        }
        return {name: values[name] for name in case.exact}

    def how(name: str, value: float) -> Reading:
        order = FORMAL_ORDERS.get(name) or QUANTITIES[name].formal_order
        edges = length_resolution(grid.pitch, case.patches) if name == "contact_length" else 0.0
        return Reading(order, abs(value), edges / abs(value), iteration(solution))

    how_solved = case.source, case.kind, all(solution.converged for _, solution in levels)
    figures = judged_by(contact.NAME, [Solution(case.model, levels)], read, how, {})
    pairs = (compared(f, case.exact[name], *how_solved) for name, f in figures.items())
    return tuple(chain.from_iterable(pairs))


def _solved(case: OperatorContact, elements: float) -> tuple[HatGrid, ContactSolution]:
    """One grid with about `elements` on the case's scale; a whole even number on a period."""
    pitch = case.scale / elements
    if case.periodic:
        half = round(case.span[1] / pitch)
        grid = HatGrid(case.span[1] / half, -half, half - 1)
    else:
        grid = HatGrid.within(*case.span, pitch)
    weighted_gap = grid.hat_integrals(case.gap, np.array(case.knots))
    load = Constraints(load=case.load)
    return grid, solve_contact(case.make(grid.count, grid.pitch), weighted_gap, grid.weights, load)


def _contact(case: ExactContact) -> OperatorContact:
    names = ("peak_pressure", "contact_length", "mean_gap")
    exact = {name: case.quantities[name] for name in names if name in case.quantities}
    half_width = 0.5 * case.quantities["contact_length"]
    if case.period is None:
        kind, operator, reach = "punch", HalfPlane, (1.0 + MARGIN) * half_width
    else:
        kind, operator, reach = "wave", PeriodicHalfPlane, 0.5 * case.period
        if half_width > FULL * reach:
            exact = {"peak_pressure": exact["peak_pressure"]}  # no edge, no gap
    return OperatorContact(
        *(case.name, case.source, kind, "half_plane"),
        make=partial(operator, modulus=case.combined_modulus),
        gap=case.gap,
        load=case.load,
        span=(-reach, reach),
        scale=half_width - max(case.knots, default=0.0),
        exact=exact,
        knots=case.knots,
        periodic=case.period is not None,
    )


def _layer(reference: LayerReference, nu: float) -> OperatorContact:
    material = Material(LAYER_MODULUS, nu)
    body = LayeredBody(material, LAYER_THICKNESS, reference.base)
    unit = material.plane_strain_modulus * LAYER_THICKNESS / LAYER_RADIUS
    half_width = reference.half_width * LAYER_THICKNESS
    reach = (1.0 + MARGIN) * half_width
    name = f"analytic layer, {reference.base}, nu = {nu:g}, a = {reference.half_width:g} t"
    return OperatorContact(
        *(name, LAYER_SOURCE, "layer", "layer"),
        make=partial(LayeredSurface, body=body),
        gap=roller_gap(LAYER_RADIUS),
        load=reference.load * unit * LAYER_THICKNESS,
        span=(-reach, reach),
        scale=half_width,
        exact={"peak_pressure": reference.peak_pressure * unit, "contact_length": 2 * half_width},
    )
