"""Layers and coatings on the analytic side: a/t from 1e-3 to 1e2, locking, contrasts of 1e6.

References: the exact limits of thick and thin layers (`verify` has the range in between); the
half-plane where the coating or its base does not matter.
"""

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.layers import (
    LayerLimit,
    thick_layer,
    thin_compressible_layer,
    thin_incompressible_layer,
)
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.studies.checks import Findings
from comparisons.studies.robustness.loaded_contact import (
    HATS_PER_HALF_WIDTH,
    Constants,
    LoadedContact,
    deviation,
    load_cylinder,
    peak_and_length,
)

LENGTH = 5e-4  # error by the grid
NYLON = Material(1.0 - 0.3**2, 0.3)  # plane-strain modulus 1
ELASTOMER = Material(1.0, 0.5 - 1e-9)
RADIUS = 50.0  # [m], where nothing asks for another


def on_layer(
    body: LayeredBody, half_width: float, load: float, radius: float = RADIUS
) -> LoadedContact:
    """A rigid cylinder of `radius` [m], whose contact is about `half_width` [m], on a layer."""
    count = 2 * int(1.5 * HATS_PER_HALF_WIDTH) + 1
    operator = LayeredSurface(count, half_width / HATS_PER_HALF_WIDTH, body)
    return load_cylinder(operator, radius, Constraints(load=load))


def limit_findings(
    body: LayeredBody, limit: LayerLimit, radius: float, neglected: float
) -> Findings:
    """Against a limit that neglects the share `neglected` of the load."""
    contact = on_layer(body, limit.half_width, limit.load_per_length, radius)
    exact, high = (limit.peak_pressure, limit.half_width), neglected + 2.0 * LENGTH
    reference = "the limit and what it neglects"
    return contact.findings(*peak_and_length(contact, exact, (high, high), reference))


def thick_findings(base: str, a_over_t: float) -> Findings:
    limit = thick_layer(a_over_t, RADIUS, 1.0, NYLON, base)
    return limit_findings(LayeredBody(NYLON, 1.0, base), limit, RADIUS, 0.23 * a_over_t**4)


def thin_findings(base: str, a_over_t: float, incompressible: bool = False) -> Findings:
    radius, share = 1e3 * a_over_t, 0.53 if base == "frictionless" else 0.37
    limit, material = thin_compressible_layer(a_over_t, radius, 1.0, NYLON, base), NYLON
    if incompressible:
        limit, material = thin_incompressible_layer(a_over_t, radius, 1.0, 1.0), ELASTOMER
        share = 8.0
    return limit_findings(LayeredBody(material, 1.0, base), limit, radius, share / a_over_t)


def coated_findings(
    coating: Constants, thickness: float, base: Constants, equivalent: Constants, high: float
) -> Findings:
    """A coating of a thickness over a that does not matter, or is all that matters: a half-plane of
    the `equivalent` material."""
    body = LayeredBody(Material(*coating), thickness, Material(*base))
    modulus = Material(*equivalent).plane_strain_modulus
    load = np.pi * modulus / (4.0 * RADIUS)  # half-width 1
    contact = on_layer(body, 1.0, load)
    half_plane = HalfPlane(contact.operator.count, contact.pitch, modulus)
    plain = load_cylinder(half_plane, RADIUS, Constraints(load=load)).pressure
    reference = "the equivalent half-plane"
    return contact.findings(deviation(contact.pressure, plain, "pressure", high, reference))
