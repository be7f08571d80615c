"""Friction up to 1 where the bodies differ most: the sliding traction moves the surfaces.

References: the exact sliding cylinder; the contact conditions on a dense matrix."""

from analytic.contact.equilibrium import Constraints
from analytic.exact.sliding import sliding_from_load
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.campaigns.cases import CaseFigures, bounded, relative_error
from comparisons.campaigns.robustness.loaded_contact import (
    HATS_PER_HALF_WIDTH,
    Constants,
    dense_violation,
    load_cylinder,
    load_line,
)
from comparisons.campaigns.robustness.rough import COUNT, LOAD, rough

RADIUS, CYLINDER_LOAD = 10e-3, 1e6  # [m], [N/m]
HIGH = 1e-4  # of the peak and of the load's place: error by the grid
SOFT = (1e5, 0.0)  # of the largest Dundurs' constant under a rigid roller


def sliding_findings(
    body: Constants = SOFT, roller: Constants | None = None, friction: float = 1.0
) -> CaseFigures:
    """A cylinder that slides (`roller` None: rigid) against the exact one."""
    materials = Material(*body), Material(*roller) if roller else None
    modulus, beta = combined_modulus(*materials), dundurs_constants(*materials)[1]
    exact = sliding_from_load(CYLINDER_LOAD, RADIUS, modulus, friction, beta)
    count = 2 * int(2.2 * HATS_PER_HALF_WIDTH) + 1
    pitch = exact.half_width / HATS_PER_HALF_WIDTH
    operator = CoupledHalfPlane(count, pitch, modulus, friction * beta)
    contact = load_cylinder(operator, RADIUS, Constraints(load=CYLINDER_LOAD))
    (left, right), size = exact.edges, exact.half_width
    (start, stop), *_ = contact.patches
    x, pressure = contact.x, contact.pressure
    reference = "sliding cylinder, exact"
    place = abs(x @ pressure / pressure.sum() - exact.load_position) / size
    return contact.findings(
        relative_error("peak pressure", pressure.max(), exact.peak_pressure, HIGH, reference),
        bounded("trailing edge", abs(start - left) / size, 1e-2, reference),
        bounded("leading edge", abs(stop - right) / size, 1e-2, reference),
        bounded("place of the load", place, HIGH, reference),
        dense_violation(contact, modulus, friction * beta),
    )


def rough_findings(friction_dundurs: float) -> CaseFigures:
    operator = CoupledHalfPlane(COUNT, 1.0, 1.0, friction_dundurs)
    contact = load_line(operator, rough(COUNT), Constraints(load=LOAD))
    return contact.findings(dense_violation(contact, 1.0, friction_dundurs))
