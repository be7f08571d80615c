"""Profiles of 8 and of a million samples: the curve through them, and the contact on it.

The reference is a cubic, which the spline through any number of its samples is; and the same
profile read from the other end.
"""

from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane
from analytic.profile import Profile, surface
from comparisons.studies.robustness.cases.rough import held
from comparisons.studies.robustness.pressing import SAME, Pressed, departure
from comparisons.studies.robustness.row import Case, Figure, Findings

GRID = HatGrid(0.01, -150, 150)
RADIUS, LOAD = 50.0, 0.01
BEND, TWIST = -2e-3, 1e-3  # of the height, over x^2 and x^3


def height(x: np.ndarray) -> np.ndarray:
    return BEND * x**2 + TWIST * x**3


def profile_of(samples: int) -> Profile:
    """The cubic at uneven places from -2 to 2 m."""
    even = np.linspace(-1.0, 1.0, samples)
    x = 2.0 * np.sin(0.5 * np.pi * even) if samples < 100 else 2.0 * even
    return Profile(x, height(x))


def pressed_on(profile: Profile | None, mirrored: bool = False) -> Pressed:
    """A cylinder on the profile's spline; on the cubic itself without one."""
    curve = height if profile is None else surface(profile)
    weighted_gap = GRID.hat_integrals(
        roller_gap(RADIUS, curve), None if profile is None else profile.x
    )
    if mirrored:
        weighted_gap = weighted_gap[::-1]
    operator = HalfPlane(GRID.count, GRID.pitch, 1.0)
    constraints = Constraints(load=LOAD)
    solution = solve_contact(operator, weighted_gap, GRID.weights, constraints)
    return Pressed(GRID.x, weighted_gap, operator, constraints, solution)


def sample_findings(samples: int) -> Findings:
    """Against the cubic that was sampled, and read from the other end."""
    profile = profile_of(samples)
    pressed, exact = pressed_on(profile), pressed_on(None)
    behind = pressed_on(profile.mirrored(), mirrored=True)
    length = abs(pressed.contact_length / exact.contact_length - 1.0)
    figures = (
        departure(pressed.pressure, exact.pressure, "pressure", SAME, "the cubic itself"),
        departure(behind.pressure, exact.pressure, "read backwards", SAME, "the cubic itself"),
        Figure("contact length", length, 1e-7, "the cubic itself"),
    )
    return held(pressed, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    return tuple(
        Case(
            "points", f"{samples} profile samples", "half_plane", partial(sample_findings, samples)
        )
        for samples in (8, 1000, 1_000_000)
    )
