"""Units: the same contact from 1e-12 m to 1 m, and from soft to stiff, gives the same figures."""

from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.operators.half_plane import HalfPlane
from comparisons.studies.robustness.cases.rough import COUNT, held, rough
from comparisons.studies.robustness.pressing import SAME, departure, press
from comparisons.studies.robustness.row import Case, Figure, Findings

SLOPE = 0.05
LOAD = 0.02 * SLOPE * COUNT  # over modulus times pitch


def unit_findings(metre: float, pascal: float, same: float) -> Findings:
    """All lengths times `metre`, all stresses times `pascal`; `same` is how well figures agree."""
    height = rough(COUNT, SLOPE)
    usual = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height, Constraints(load=LOAD))
    load = LOAD * metre * pascal
    other = press(HalfPlane(COUNT, metre, pascal), metre, -height * metre, Constraints(load=load))
    length = abs(other.contact_length / usual.contact_length / metre - 1.0)
    approach = abs(other.solution.approach / usual.solution.approach / metre - 1.0)
    figures = (
        departure(other.pressure / pascal, usual.pressure, "pressure", same, "in metres"),
        Figure("contact length", length, max(1e2 * same, 1e-15), "in metres"),
        Figure("approach", approach, same, "in metres"),
        Figure(
            "applications",
            other.solution.iterations["applications"] / usual.solution.iterations["applications"],
            1.0,
            "in metres",
            least=1.0,
        ),
    )
    return held(other, *figures)


def amplitude_findings(amplitude: float) -> Findings:
    """Heights of `amplitude` [m], peak to valley, on a trace of 1 mm, under a load to match."""
    height, pitch = rough(COUNT, SLOPE), 1e-3 / COUNT
    factor = amplitude / float(np.ptp(height))
    usual = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height, Constraints(load=LOAD))
    scale = factor / pitch  # of pressures
    other = press(
        HalfPlane(COUNT, pitch, 1.0),
        pitch,
        -height * factor,
        Constraints(load=LOAD * factor),
    )
    length = abs(other.contact_length / usual.contact_length / pitch - 1.0)
    figures = (
        departure(other.pressure / scale, usual.pressure, "pressure", SAME, "amplitude 1"),
        Figure("contact length", length, 1e-7, "amplitude 1"),
    )
    return held(other, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    amplitudes = [
        Case(
            "amplitude",
            f"amplitude {amplitude:g} m",
            "half_plane",
            partial(amplitude_findings, amplitude),
        )
        for amplitude in (1e-12, 1e-9, 1e-6, 1e-3, 1.0)
    ]
    units = [
        Case("units", name, "half_plane", partial(unit_findings, metre, pascal, same))
        for name, metre, pascal, same in (
            ("lengths in 2^-40 m, to the last bit", 2.0**-40, 1.0, 0.0),
            ("stresses in 2^50 Pa, to the last bit", 1.0, 2.0**50, 0.0),
            ("lengths in pm", 1e-12, 1.0, SAME),
            ("lengths in light years", 1e16, 1.0, SAME),
            ("stresses in 1e15 Pa", 1.0, 1e15, SAME),
            ("stresses in 1e-15 Pa", 1.0, 1e-15, SAME),
        )
    ]
    return (*amplitudes, *units)
