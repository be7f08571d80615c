"""Coatings on the analytic side, contrasts of 1e6: where the coating or its base does not matter
the contact is that of a half-plane. Limits of layers are held by `verify` and the tests."""

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.campaigns.cases import CaseFigures
from comparisons.campaigns.robustness.loaded_contact import (
    HATS_PER_HALF_WIDTH,
    Constants,
    deviation,
    load_cylinder,
)

RADIUS = 50.0  # [m]
PITCH = 1.0 / HATS_PER_HALF_WIDTH  # [m]
COUNT = 2 * int(1.5 * HATS_PER_HALF_WIDTH) + 1


def coated_findings(
    coating: Constants, thickness: float, base: Constants, equivalent: Constants, high: float
) -> CaseFigures:
    """A coating so thin or thick (over a) that it is a half-plane of the `equivalent` material."""
    body = LayeredBody(Material(*coating), thickness, Material(*base))
    modulus = Material(*equivalent).plane_strain_modulus
    load = np.pi * modulus / (4.0 * RADIUS)  # half-width 1
    pressed = RADIUS, Constraints(load=load)
    contact = load_cylinder(LayeredSurface(COUNT, PITCH, body), *pressed)
    plain = load_cylinder(HalfPlane(COUNT, PITCH, modulus), *pressed).pressure
    reference = "the equivalent half-plane"
    return contact.findings(deviation(contact.pressure, plain, "pressure", high, reference))
