"""The gallery's layers on rigid bases: a cylinder pressed on, in the limits of thick and thin."""

from dataclasses import dataclass
from functools import cache

from analytic.exact.layer_limits import (
    LayerLimit,
    thick_layer,
    thin_compressible_layer,
    thin_incompressible_layer,
)
from analytic.layers.layered import Base, LayeredBody
from analytic.material import Material

NYLON = Material(3e9, 0.3)
ELASTOMER = Material(5e6, 0.5 - 1e-9)  # a bonded layer of nu = 1/2 but for rounding


@dataclass(frozen=True)
class LayerContact:
    """A rigid cylinder on a layer, and the limit that its contact nears.

    name, radius  of the case, and R [m] of the cylinder
    body          the layer and its rigid base
    limit         the contact in the limit; its load is the problem's
    left_out      of the load for the limit's half-width, relative to it: as `layer_limits` states
    """

    name: str
    radius: float
    body: LayeredBody
    limit: LayerLimit
    left_out: float


def thick_case(name: str, material: Material, base: Base, a_over_t: float) -> LayerContact:
    """Hertz's contact, narrower than the layer, with the first effect of the base."""
    radius, thickness = 0.05, 2e-3
    limit = thick_layer(a_over_t * thickness, radius, thickness, material, base)
    body = LayeredBody(material, thickness, base)
    return LayerContact(name, radius, body, limit, 0.23 * a_over_t**4)


def thin_case(name: str, material: Material, base: Base, a_over_t: float) -> LayerContact:
    """Winkler's bed of springs; `material` of nu = 0.3 where the base is bonded."""
    radius, thickness = 0.5, 0.1e-3
    limit = thin_compressible_layer(a_over_t * thickness, radius, thickness, material, base)
    body = LayeredBody(material, thickness, base)
    share = 0.53 if base == "frictionless" else 0.37
    return LayerContact(name, radius, body, limit, share / a_over_t)


def incompressible_case(name: str, material: Material, a_over_t: float) -> LayerContact:
    """A bonded layer of nu = 1/2, squeezed out sideways."""
    radius, thickness = 0.5, 0.1e-3
    modulus = material.youngs_modulus
    limit = thin_incompressible_layer(a_over_t * thickness, radius, thickness, modulus)
    body = LayeredBody(material, thickness, "bonded")
    return LayerContact(name, radius, body, limit, 8.0 / a_over_t)


@cache
def layer_contacts() -> tuple[LayerContact, ...]:
    """All layers of the gallery."""
    return (
        thick_case("thick layer, bonded, a = t/4", NYLON, "bonded", 0.25),
        thick_case("thick layer, bonded, a = t/20", NYLON, "bonded", 0.05),
        thick_case("thick layer, frictionless base, a = t/4", NYLON, "frictionless", 0.25),
        thick_case("thick layer, bonded, incompressible, a = t/4", ELASTOMER, "bonded", 0.25),
        thin_case("thin layer, frictionless base, a = 32 t", NYLON, "frictionless", 32.0),
        thin_case("thin layer, frictionless base, a = 128 t", NYLON, "frictionless", 128.0),
        thin_case("thin layer, bonded, a = 64 t", NYLON, "bonded", 64.0),
        incompressible_case("thin layer, bonded, incompressible, a = 64 t", ELASTOMER, 64.0),
        incompressible_case("thin layer, bonded, incompressible, a = 128 t", ELASTOMER, 128.0),
    )
