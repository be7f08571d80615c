"""Stresses 1e-12 a below the surface, on edges of elements, 1e6 a below and beside.

References in a hundred digits at the same doubles. Each component is judged by its own relative
error, so that none hides behind a larger one.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from analytic.exact.hertz import HertzContact, hertz_stress
from analytic.stress.elements import hat_stress
from analytic.stress.field import friction_field
from comparisons.studies.checks import BoundedFigure, Findings, Groups
from comparisons.studies.robustness.many_digits import hat_parts, hertz_parts

DIGITS = 2e-13  # of each component
NOTHING = 1e-90  # what a hundred digits leave of zero
ROUNDING = 4e-15  # of the largest component
NEAR, FAR = 1e-12, 1e6
BESIDE = (0.0, 0.01, 0.3, 0.999999, 1.0, 1.0 + 2.0**-52, 1.000001, 3.0, 1e3, FAR)
AXIS = 1e-9  # what is odd in x keeps only the digits of the largest component here
HERTZ = HertzContact(1.0, 1.0, 0.5 * np.pi, 0.5, 1.0)
COUNT = 65  # hats of a line load seen from afar
Parts = tuple[float, float, float, float]


def component_error(found: np.ndarray, exact: np.ndarray) -> float:
    """Largest relative error (k, 4) of any component that is not zero."""
    zero = np.abs(exact) < NOTHING
    if np.any(found[zero] != 0.0):
        return float("inf")
    return float(np.abs(found[~zero] / exact[~zero] - 1.0).max())


def hat_at(x: np.ndarray, z: float) -> np.ndarray:
    """(k, 4) as `many_digits.hat_parts`."""
    hat = hat_stress(x, np.full_like(x, z), 1.0)
    return np.column_stack([hat.normal.sx, hat.normal.sz, hat.normal.txz, hat.traction_sx])


def hertz_at(x: np.ndarray, z: float) -> np.ndarray:
    """(k, 4) as `many_digits.hertz_parts`."""
    plain, slid = (hertz_stress(HERTZ, x, np.full_like(x, z), mu) for mu in (0.0, 1e30))
    return np.column_stack([plain.sx, plain.sz, plain.txz, (slid.sx - plain.sx) / 1e30])


def points_findings(
    found: Callable[[np.ndarray, float], np.ndarray],
    exact: Callable[[float, float], Parts],
    z: float,
) -> Findings:
    """One depth, places from the axis to 1e6 beside it."""
    x = np.array([*BESIDE, *(-place for place in BESIDE[1:]), AXIS])
    expected = np.array([exact(float(each), z) for each in x])
    given = found(x, z)
    error = component_error(given[:-1], expected[:-1])
    size = np.abs(expected).max(axis=1, keepdims=True)
    whole = float((np.abs(given - expected) / size).max())
    return Findings(
        (
            BoundedFigure("any component", error, DIGITS, "a hundred digits"),
            BoundedFigure("all, of the largest", whole, ROUNDING, "a hundred digits"),
        )
    )


def line_pressure() -> tuple[np.ndarray, np.ndarray]:
    """Nodes and pressures of a line of hats, uneven."""
    x = np.arange(COUNT) - COUNT // 2
    return x / 32.0, 1.0 + 0.5 * np.cos(1.7 * x)


def surface_findings() -> Findings:
    """On the surface sz is the pressure and txz the traction, to the last bit."""
    nodes, pressure = line_pressure()
    field = friction_field(nodes, pressure, (-1.0, 1.0), np.array([0.0, NEAR]), 4).at(0.3)
    on_nodes = np.isin(field.x, nodes)
    carried = np.interp(field.x, nodes, pressure)
    off = np.abs(field.stress.sz[0] + carried)[on_nodes].max()
    shear = np.abs(field.stress.txz[0] + 0.3 * carried)[on_nodes].max()
    below = np.abs(field.stress.sz[1] + carried).max() / carried.max()
    return Findings(
        (
            BoundedFigure("sz on the surface", float(off), 0.0, "the pressure, exactly"),
            BoundedFigure("txz on the surface", float(shear), 1e-16, "the traction, exactly"),
            BoundedFigure("sz at 1e-12", float(below), 1e-10, "the pressure"),
        )
    )


def cases() -> Groups:
    named = {}
    for label, z in {"1e-12 a": NEAR, "1e-3 a": 1e-3, "a": 1.0, "1e6 a": FAR}.items():
        named[f"one hat, at {label} below"] = partial(points_findings, hat_at, hat_parts, z)
        named[f"Hertz, at {label} below"] = partial(points_findings, hertz_at, hertz_parts, z)
    return {"stress": named | {"on the surface": surface_findings}}
