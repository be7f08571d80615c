"""The gallery: problems with exact solutions that every numerical model is held to.

Line contacts; Johnson's line, strip and triangle loads on a half-plane; a cylinder pressed on a
layer on a rigid base, in the limits of thick and thin.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from analytic.exact.cases import (
    ExactContact,
    capped_case,
    hertz_case,
    punch_case,
    sliding_case,
    wave_case,
)
from analytic.exact.layers import (
    LayerLimit,
    thick_layer,
    thin_compressible_layer,
    thin_incompressible_layer,
)
from analytic.exact.point_and_strip import line_load_stress, strip_load_stress, triangle_load_stress
from analytic.layers.layered import Base, LayeredBody
from analytic.material import Material
from analytic.stress_state import StressState

STEEL = Material(207e9, 0.3)
ALUMINIUM = Material(70e9, 0.33)
CERAMIC = Material(310e9, 0.26)
RUBBER = Material(5e6, 0.49)


@cache
def exact_contacts() -> tuple[ExactContact, ...]:
    """All cases of the gallery."""
    return (
        hertz_case("Hertz, steel on steel", STEEL, STEEL, 8.2e-3, 1.4e9),
        hertz_case("Hertz, steel on steel, friction 0.1", STEEL, STEEL, 8.2e-3, 4.15e9, 0.1),
        hertz_case("Hertz, steel on steel, friction 0.3", STEEL, STEEL, 8.2e-3, 1.4e9, 0.3),
        hertz_case("Hertz, light load", STEEL, STEEL, 50e-3, 1e6),
        hertz_case("Hertz, ceramic on aluminium", ALUMINIUM, CERAMIC, 20e-3, 0.5e9),
        hertz_case("Hertz, rigid on rubber", RUBBER, None, 100e-3, 0.2e6),
        punch_case("rounded punch, flat 0.3", STEEL, None, 1e-3, 0.3, 0.1),
        punch_case("rounded punch, flat 0.6", STEEL, STEEL, 1e-3, 0.6, 0.2),
        punch_case("rounded punch, flat 0.9", ALUMINIUM, STEEL, 5e-3, 0.9, 0.5),
        punch_case("rounded punch, flat 0.99", STEEL, STEEL, 5e-3, 0.99, 0.05),
        sliding_case("sliding, rigid on steel, friction 0.1", STEEL, None, 10e-3, 1e6, 0.1),
        sliding_case("sliding, rigid on steel, friction 0.5", STEEL, None, 10e-3, 1e6, 0.5),
        sliding_case("sliding, rigid on steel, friction -0.3", STEEL, None, 10e-3, 1e6, -0.3),
        sliding_case("sliding, steel on aluminium, friction 1", ALUMINIUM, STEEL, 5e-3, 1e5, 1.0),
        sliding_case("sliding, rubber on steel, friction 1", STEEL, RUBBER, 50e-3, 1e3, 1.0),
        capped_case("flattened cylinder, hardness 0.9", STEEL, STEEL, 8.2e-3, 1.4e9, 0.9),
        capped_case("flattened cylinder, hardness 0.7", STEEL, None, 8.2e-3, 1.4e9, 0.7),
        wave_case("Westergaard, 0.01 of closing", STEEL, STEEL, 100e-6, 0.1e-6, 0.01),
        wave_case("Westergaard, 0.2 of closing", STEEL, None, 1e-3, 1e-6, 0.2),
        wave_case("Westergaard, 0.9 of closing", ALUMINIUM, STEEL, 100e-6, 0.5e-6, 0.9),
        wave_case("Westergaard, full contact", STEEL, STEEL, 100e-6, 0.1e-6, 1.5),
    )


Field = Callable[[np.ndarray, np.ndarray], StressState]
Curve = Callable[[np.ndarray], np.ndarray]

SOURCE = "Johnson 1985, sections 2.2 to 2.5"


@dataclass(frozen=True)
class ExactStress:
    """A load on a half-plane and its exact stresses; a traction of `friction` times it in +x.

    name, source  of the case, and of its solution
    half_width    [m] of the load about x = 0; 0 for a line
    load          P [N/m]
    pressure      p(x) [Pa], None for a line
    stress        (x, z) [m], z >= 0, to stresses [Pa]
    """

    name: str
    source: str
    half_width: float
    load: float
    friction: float
    pressure: Curve | None
    stress: Field


def line_case(name: str, load: float, friction: float) -> ExactStress:
    """P = `load` [N/m] along a line."""
    stress = partial(line_load_stress, load, friction * load)
    return ExactStress(name, SOURCE, 0.0, load, friction, None, stress)


def strip_case(name: str, half_width: float, pressure: float, friction: float) -> ExactStress:
    """`pressure` p [Pa] on |x| < half_width [m], ends half."""

    def uniform(x: np.ndarray) -> np.ndarray:
        return pressure * (0.5 + 0.5 * np.sign(half_width - np.abs(x)))

    stress = partial(strip_load_stress, half_width, pressure, friction * pressure)
    return ExactStress(
        name, SOURCE, half_width, 2.0 * half_width * pressure, friction, uniform, stress
    )


def triangle_case(name: str, half_width: float, pressure: float, friction: float) -> ExactStress:
    """`pressure` p [Pa] at x = 0 that falls linearly to zero at half_width [m]."""

    def tent(x: np.ndarray) -> np.ndarray:
        return pressure * np.maximum(1.0 - np.abs(x) / half_width, 0.0)

    stress = partial(triangle_load_stress, half_width, pressure, friction * pressure)
    return ExactStress(name, SOURCE, half_width, half_width * pressure, friction, tent, stress)


@cache
def exact_stresses() -> tuple[ExactStress, ...]:
    """All stress fields of the gallery."""
    return (
        line_case("line load", 1e6, 0.0),
        line_case("line load, friction 0.3", 1e6, 0.3),
        strip_case("strip", 0.1e-3, 1e9, 0.0),
        strip_case("strip, friction 0.3", 0.1e-3, 1e9, 0.3),
        strip_case("wide strip, friction -1", 5e-3, 2e6, -1.0),
        triangle_case("triangle", 0.1e-3, 1e9, 0.0),
        triangle_case("triangle, friction 0.3", 0.1e-3, 1e9, 0.3),
        triangle_case("wide triangle, friction -1", 5e-3, 2e6, -1.0),
    )


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
