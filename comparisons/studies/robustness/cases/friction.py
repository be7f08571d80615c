"""Friction to 1 where the bodies differ most: the sliding traction moves the surfaces.

References: the exact sliding cylinder; the frictionless contact and its linear change; the same
contact that slides the other way, from behind; the conditions on a dense matrix.
"""

from functools import partial

import numpy as np

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.exact.sliding import sliding_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.studies.robustness.cases.rough import COUNT, held, rough
from comparisons.studies.robustness.pressing import (
    SAME,
    Pressed,
    dense_departure,
    departure,
    mirrored,
    press,
)
from comparisons.studies.robustness.row import Case, Figure, Findings

PER_HALF = 77.3
RADIUS, LOAD = 10e-3, 1e6  # [m], [N/m]
DISCRETE = 1e-4  # of the peak and of the load's place, with PER_HALF hats
SOFT, STEEL = Material(1e5, 0.0), Material(207e9, 0.3)


def sliding(
    body: Material, roller: Material | None, friction: float, load: float = LOAD
) -> Pressed:
    """A cylinder that slides, on PER_HALF hats a half-width."""
    modulus, beta = combined_modulus(body, roller), dundurs_constants(body, roller)[1]
    exact = sliding_from_load(load, RADIUS, modulus, friction, beta)
    pitch = exact.half_width / PER_HALF
    grid = HatGrid(pitch, -int(2.2 * PER_HALF), int(2.2 * PER_HALF))
    operator = CoupledHalfPlane(grid.count, pitch, modulus, friction * beta)
    weighted_gap, constraints = grid.hat_integrals(roller_gap(RADIUS)), Constraints(load=load)
    solution = solve_coupled(operator, weighted_gap, grid.weights, constraints)
    return Pressed(grid.x, weighted_gap, operator, constraints, solution)


def sliding_findings(
    body: Material, roller: Material | None, friction: float, load: float = LOAD
) -> Findings:
    """Against the exact sliding cylinder."""
    pressed = sliding(body, roller, friction, load)
    modulus, beta = combined_modulus(body, roller), dundurs_constants(body, roller)[1]
    exact = sliding_from_load(load, RADIUS, modulus, friction, beta)
    (left, right), size = exact.edges, exact.half_width
    (start, stop), *_ = pressed.patches
    peak = abs(pressed.pressure.max() / exact.peak_pressure - 1.0)
    place = pressed.x @ pressed.pressure / pressed.pressure.sum()
    figures = (
        Figure("peak pressure", peak, DISCRETE, "sliding cylinder, exact"),
        Figure("trailing edge", abs(start - left) / size, 1e-2, "sliding cylinder, exact"),
        Figure("leading edge", abs(stop - right) / size, 1e-2, "sliding cylinder, exact"),
        Figure(
            "place of the load",
            abs(place - exact.load_position) / size,
            DISCRETE,
            "sliding cylinder, exact",
        ),
        dense_departure(pressed, modulus, friction * beta),
    )
    return held(pressed, *figures)


def slight_findings(friction: float) -> Findings:
    """Next to no friction moves the load by its linear part: -8 n/3 with n = beta mu / pi."""
    still, moved = sliding(SOFT, None, 0.0), sliding(SOFT, None, friction)
    beta = dundurs_constants(SOFT, None)[1]
    exact = -8.0 / 3.0 * beta * friction / np.pi * still.pitch * PER_HALF
    change = moved.pressure - still.pressure
    place = moved.x @ change / moved.pressure.sum()
    figure = Figure(
        "shift of the load", abs(place / exact - 1.0), 1e-2, "the exact shift's linear part"
    )
    return held(moved, figure)


def rough_findings(friction_dundurs: float) -> Findings:
    """A rough line; reversed, sliding the other way, it presses the same, reversed."""
    operator = CoupledHalfPlane(COUNT, 1.0, 1.0, friction_dundurs)
    pressed = press(operator, 1.0, -rough(COUNT), Constraints(load=0.02 * 0.05 * COUNT))
    behind = mirrored(pressed)
    figures = (
        departure(behind.pressure[::-1], pressed.pressure, "pressure", SAME, "its mirror image"),
        dense_departure(pressed, 1.0, friction_dundurs),
    )
    return held(pressed, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    slid = {
        "friction 1, rigid on nu = 0": (SOFT, None, 1.0),
        "friction -1, rigid on nu = 0": (SOFT, None, -1.0),
        "friction 1, roller 1e6 times as stiff": (STEEL, Material(207e15, 0.3), 1.0),
        "friction 1, roller 1e-6 times as stiff": (STEEL, Material(207e3, 0.3), 1.0),
        "friction 1, nu = 0.4999": (Material(207e9, 0.4999), None, 1.0),
    }
    exact = [(name, partial(sliding_findings, *given)) for name, given in slid.items()]
    slight = [(f"friction {mu:g}", partial(slight_findings, mu)) for mu in (1e-6,)]
    line = [
        (f"rough, mu beta = {coupling:g}", partial(rough_findings, coupling))
        for coupling in (0.5, 3.0)
    ]
    return tuple(
        Case("friction", name, "half_plane", solve) for name, solve in (*exact, *slight, *line)
    )
