"""The gallery's stress fields: Johnson's line, strip and triangle loads on a half-plane."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from analytic.exact.point_and_strip import (
    line_load_stress,
    strip_load_stress,
    triangle_load_stress,
)
from analytic.stress_state import StressState

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
