"""Smooth cylinders on a half-plane: stiffness, size, load and grid to their ends.

In half-widths and peak pressures every Hertz contact is the same: beside the distance from the
exact one each row states the distance from the ordinary case, which is rounding.
"""

from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactError
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.hertz import HertzContact, hertz_from_load, hertz_from_peak_pressure
from analytic.material import Material, combined_modulus
from comparisons.studies.robustness.pressing import (
    SAME,
    Pressed,
    cost_figures,
    dense_departure,
    departure,
    least_squares_departure,
    press_cylinder,
    residual_figures,
)
from comparisons.studies.robustness.row import Case, Figure, Findings

PER_HALF = 77.3  # hats on a half-width, as on the third level of a scene
STEEL = Material(207e9, 0.3)
RADIUS, LOAD = 8.2e-3, 1e6  # [m], [N/m]
# What PER_HALF hats leave of Hertz's peak and length, three times over.
PEAK, DISCRETE = 5e-5, 5e-4


@dataclass(frozen=True)
class Smooth:
    """Two materials, a radius [m] and a load [N/m]."""

    body: Material
    roller: Material | None
    radius: float = RADIUS
    load: float = LOAD


ORDINARY = Smooth(STEEL, STEEL)


def solved(smooth: Smooth) -> tuple[HertzContact, Pressed]:
    """The exact contact and the one found on PER_HALF hats a half-width."""
    modulus = combined_modulus(smooth.body, smooth.roller)
    hertz = hertz_from_load(smooth.load, smooth.radius, modulus)
    pitch = hertz.half_width / PER_HALF
    count = 2 * int(1.5 * PER_HALF) + 1
    return hertz, press_cylinder(
        count, pitch, smooth.radius, modulus, Constraints(load=smooth.load)
    )


@cache
def ordinary_shape() -> tuple[np.ndarray, float]:
    """Pressures in peak pressures and the length in half-widths of the ordinary contact."""
    hertz, pressed = solved(ORDINARY)
    return pressed.pressure / hertz.peak_pressure, pressed.contact_length / hertz.half_width


def hertz_findings(smooth: Smooth) -> Findings:
    """Against Hertz, and against the ordinary case."""
    hertz, pressed = solved(smooth)
    shape, length = ordinary_shape()
    own = pressed.contact_length / hertz.half_width
    kept, checks = residual_figures(pressed.solution)
    spent, cost = cost_figures(pressed.solution, len(pressed.x))
    peak = abs(pressed.pressure.max() / hertz.peak_pressure - 1.0)
    figures = (
        Figure("peak pressure", float(peak), PEAK, "Hertz, exact"),
        Figure("contact length", abs(0.5 * own - 1.0), DISCRETE, "Hertz, exact"),
        departure(
            pressed.pressure / hertz.peak_pressure, shape, "shape", SAME, "the ordinary case"
        ),
        Figure("scaled length", abs(own / length - 1.0), 1e-7, "the ordinary case"),
        dense_departure(pressed, hertz.combined_modulus),
    )
    return Findings((*figures, *kept, *spent), checks, cost=cost)


def sized_findings(count: int) -> Findings:
    """Hertz on `count` hats, a third of which touch; eight of them by least squares, too."""
    half_width = count / 6.0 + 0.3
    hertz = hertz_from_peak_pressure(1.0, 0.5 * half_width, 1.0)
    pressed = press_cylinder(count, 1.0, hertz.radius, 1.0, Constraints(load=hertz.load_per_length))
    kept, checks = residual_figures(pressed.solution)
    spent, cost = cost_figures(pressed.solution, count)
    # the square-root edge leaves the L2 norm of order one in the pitch, the peak of order two
    error = pressed.pressure - hertz.pressure(pressed.x)
    distance = float(np.linalg.norm(error) / np.linalg.norm(hertz.pressure(pressed.x)))
    figures = [
        Figure("pressure, L2", distance, 0.4 / half_width, "Hertz, exact, order 1 in the pitch"),
    ]
    if count <= 64:
        figures.append(least_squares_departure(pressed, 1.0))
    return Findings((*figures, *kept, *spent), checks, cost=cost)


def hardness_findings(over_peak: float) -> Findings:
    """Hardness just above or below the peak: 1 + `over_peak` of the highest pressure found."""
    hertz = hertz_from_peak_pressure(1.0, 0.5, 1.0)
    count, pitch = 2 * int(1.5 * PER_HALF) + 1, 1.0 / PER_HALF
    load = hertz.load_per_length
    plain = press_cylinder(count, pitch, 0.5, 1.0, Constraints(load=load))
    hardness = float(plain.pressure.max()) * (1.0 + over_peak)
    capped = press_cylinder(count, pitch, 0.5, 1.0, Constraints(load=load, hardness=hardness))
    kept, checks = residual_figures(capped.solution)
    spent, cost = cost_figures(capped.solution, count)
    # the cap takes off `over_peak` of the peak, over a share of the contact: no more may change
    allowed = SAME if over_peak > 0.0 else max(SAME, 3.0 * abs(over_peak))
    figures = [
        departure(capped.pressure, plain.pressure, "pressure", allowed, "the uncapped contact")
    ]
    if over_peak < -1e-3:
        flat = flattened_cylinder(load, 0.5, 1.0, hardness)
        length = abs(0.5 * capped.contact_length / flat.contact - 1.0)
        flowed = pitch * np.count_nonzero(capped.pressure >= hardness)
        figures = [
            Figure("contact length", length, DISCRETE, "flattened cylinder, exact"),
            Figure(
                "flowed length",
                abs(flowed - 2.0 * flat.flowed) / pitch,
                2.0,
                "flattened cylinder, exact, in hats",
            ),
        ]
    return Findings((*figures, *kept, *spent), checks, cost=cost)


def soft_findings(share: float) -> Findings:
    """A hardness of which the load takes `share`: rigid and plastic, all but the edges at it."""
    count = 257
    hardness, load = 1e-6, share * 1e-6 * count
    pressed = press_cylinder(
        count, 1.0, 100.0 * count, 1.0, Constraints(load=load, hardness=hardness)
    )
    kept, checks = residual_figures(pressed.solution)
    spent, cost = cost_figures(pressed.solution, count)
    full = np.count_nonzero(pressed.pressure >= hardness * (1.0 - 1e-9))
    figure = Figure(
        "hats at the hardness", abs(full - load / hardness), 3.0, "load over hardness, in hats"
    )
    return Findings((figure, *kept, *spent), checks, cost=cost)


def refused_findings() -> Findings:
    """A load beyond what the hardness carries is refused in words."""
    try:
        press_cylinder(64, 1.0, 1e3, 1.0, Constraints(load=64.0 * (1.0 + 1e-12), hardness=1.0))
        refused = 0.0
    except ContactError:
        refused = 1.0
    return Findings((Figure("refused", refused, 1.0, "must raise ContactError", least=1.0),))


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    material = {
        "ordinary: steel on steel": ORDINARY,
        "roller 1e6 times as stiff": Smooth(STEEL, Material(1e6 * 207e9, 0.3)),
        "roller 1e-6 times as stiff": Smooth(STEEL, Material(1e-6 * 207e9, 0.3)),
        "Poisson's ratio 0": Smooth(Material(207e9, 0.0), None),
        "Poisson's ratio 0.49": Smooth(Material(207e9, 0.49), None),
        "Poisson's ratio 0.4999": Smooth(Material(207e9, 0.4999), None),
        "Poisson's ratio 0.5 less rounding": Smooth(Material(207e9, np.nextafter(0.5, 0.0)), None),
    }
    size = {
        "radius 1e-9 m": Smooth(STEEL, STEEL, radius=1e-9),
        "radius 1e9 m": Smooth(STEEL, STEEL, radius=1e9),
        "load 1e-12 N/m": Smooth(STEEL, STEEL, load=1e-12),
        "load 1e12 N/m": Smooth(STEEL, STEEL, load=1e12),
    }
    hertz = [
        Case(group, name, "half_plane", partial(hertz_findings, smooth))
        for group, table in (("materials", material), ("size and load", size))
        for name, smooth in table.items()
    ]
    sized = [
        Case("points", f"{count} points", "half_plane", partial(sized_findings, count))
        for count in (8, 9, 64, 4096, 65_536, 1_000_000)
    ]
    hard = [
        Case(
            "hardness",
            f"hardness {over:+g} of the peak",
            "half_plane",
            partial(hardness_findings, over),
        )
        for over in (1e-9, 1e-3, -1e-9, -1e-6, -1e-2)
    ]
    soft = [
        Case(
            "hardness",
            f"load {share:g} of what the hardness carries",
            "half_plane",
            partial(soft_findings, share),
        )
        for share in (0.5, 1.0 - 1e-6)
    ]
    refused = Case(
        "hardness", "load above what the hardness carries", "half_plane", refused_findings
    )
    return (*hertz, *sized, *hard, *soft, refused)
