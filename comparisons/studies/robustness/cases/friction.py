"""Friction up to 1 where the bodies differ most: the sliding traction moves the surfaces.

References: the exact sliding cylinder; the frictionless contact and its linear change; the same
contact sliding the other way, from behind; the contact conditions on a dense matrix.
"""

from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.sliding import SlidingContact, sliding_from_load
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.studies.checks import BoundedFigure, Findings, Groups, relative_error
from comparisons.studies.robustness.cases.rough import COUNT, LOAD, rough
from comparisons.studies.robustness.loaded_contact import (
    HATS_PER_HALF_WIDTH,
    SAME,
    LoadedContact,
    dense_violation,
    deviation,
    load_cylinder,
    load_line,
    mirrored,
)

RADIUS, CYLINDER_LOAD = 10e-3, 1e6  # [m], [N/m]
HIGH = 1e-4  # of the peak and of the load's place: error by the grid
SOFT, STEEL = Material(1e5, 0.0), Material(207e9, 0.3)


def sliding(
    body: Material, roller: Material | None, friction: float
) -> tuple[LoadedContact, SlidingContact]:
    """A cylinder that slides (`roller` None: rigid), computed and exact."""
    modulus, beta = combined_modulus(body, roller), dundurs_constants(body, roller)[1]
    exact = sliding_from_load(CYLINDER_LOAD, RADIUS, modulus, friction, beta)
    count = 2 * int(2.2 * HATS_PER_HALF_WIDTH) + 1
    pitch = exact.half_width / HATS_PER_HALF_WIDTH
    operator = CoupledHalfPlane(count, pitch, modulus, friction * beta)
    return load_cylinder(operator, RADIUS, Constraints(load=CYLINDER_LOAD)), exact


def sliding_findings(body: Material, roller: Material | None, friction: float) -> Findings:
    contact, exact = sliding(body, roller, friction)
    (left, right), size = exact.edges, exact.half_width
    (start, stop), *_ = contact.patches
    x, pressure, operator = contact.x, contact.pressure, contact.operator
    reference = "sliding cylinder, exact"
    place = abs(x @ pressure / pressure.sum() - exact.load_position) / size
    return contact.findings(
        relative_error("peak pressure", pressure.max(), exact.peak_pressure, HIGH, reference),
        BoundedFigure("trailing edge", abs(start - left) / size, 1e-2, reference),
        BoundedFigure("leading edge", abs(stop - right) / size, 1e-2, reference),
        BoundedFigure("place of the load", place, HIGH, reference),
        dense_violation(contact, operator.modulus, operator.friction_dundurs),
    )


def slight_findings(friction: float) -> Findings:
    """Next to no friction moves the load by its linear part: -8 n/3 with n = beta mu / pi."""
    (still, _), (moved, _) = sliding(SOFT, None, 0.0), sliding(SOFT, None, friction)
    beta = dundurs_constants(SOFT, None)[1]
    exact = -8.0 / 3.0 * beta * friction / np.pi * still.pitch * HATS_PER_HALF_WIDTH
    change = moved.pressure - still.pressure
    place = moved.x @ change / moved.pressure.sum()
    reference = "the exact shift's linear part"
    return moved.findings(relative_error("shift of the load", place, exact, 1e-2, reference))


def rough_findings(friction_dundurs: float) -> Findings:
    """A rough line; reversed and sliding the other way, it gives the same pressures, reversed."""
    operator = CoupledHalfPlane(COUNT, 1.0, 1.0, friction_dundurs)
    contact = load_line(operator, rough(COUNT), Constraints(load=LOAD))
    behind = mirrored(contact).pressure[::-1]
    return contact.findings(
        deviation(behind, contact.pressure, "pressure", SAME, "its mirror image"),
        dense_violation(contact, 1.0, friction_dundurs),
    )


def cases() -> Groups:
    sliders = {
        "friction 1, rigid on nu = 0": (SOFT, None, 1.0),
        "friction -1, rigid on nu = 0": (SOFT, None, -1.0),
        "friction 1, roller 1e6 times as stiff": (STEEL, Material(207e15, 0.3), 1.0),
        "friction 1, roller 1e-6 times as stiff": (STEEL, Material(207e3, 0.3), 1.0),
        "friction 1, nu = 0.4999": (Material(207e9, 0.4999), None, 1.0),
    }
    named = {name: partial(sliding_findings, *given) for name, given in sliders.items()}
    named["friction 1e-06"] = partial(slight_findings, 1e-6)
    named |= {f"rough, mu beta = {n:g}": partial(rough_findings, n) for n in (0.5, 3.0)}
    return {"friction": named}
