"""Smooth cylinders on a half-plane: extreme stiffness, size, load, hardness and grids.

In half-widths and peak pressures every Hertz contact is the same. So each row states its distance
from the exact contact, and from the ordinary case, which is rounding."""

from functools import cache

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.hertz import HertzContact, hertz_from_load, hertz_from_peak_pressure
from analytic.material import Material, combined_modulus
from analytic.operators.half_plane import HalfPlane
from comparisons.campaigns.cases import CaseFigures, bounded, relative_error
from comparisons.campaigns.robustness.loaded_contact import (
    HATS_PER_HALF_WIDTH,
    SAME,
    Constants,
    LoadedContact,
    dense_violation,
    deviation,
    least_squares_deviation,
    load_cylinder,
    peak_and_length,
)
from comparisons.figures.figure import Figure

COUNT = 2 * int(1.5 * HATS_PER_HALF_WIDTH) + 1  # hats on 1.5 half-widths to either side
STEEL = (207e9, 0.3)
HIGHS = 5e-5, 5e-4  # error of Hertz's peak and length by the grid, three times over


def smooth_contact(
    body: Constants, roller: Constants | None, radius: float, load: float
) -> tuple[HertzContact, LoadedContact]:
    """A cylinder of a radius [m] (`roller` None: rigid) under a load [N/m], exact and computed."""
    modulus = combined_modulus(Material(*body), Material(*roller) if roller else None)
    hertz = hertz_from_load(load, radius, modulus)
    operator = HalfPlane(COUNT, hertz.half_width / HATS_PER_HALF_WIDTH, modulus)
    return hertz, load_cylinder(operator, radius, Constraints(load=load))


@cache
def ordinary_shape() -> tuple[np.ndarray, float]:
    """Pressures over the peak pressure, and the length over the half-width."""
    hertz, contact = smooth_contact(STEEL, STEEL, 8.2e-3, 1e6)
    return contact.pressure / hertz.peak_pressure, contact.contact_length / hertz.half_width


def hertz_findings(
    body: Constants = STEEL,
    roller: Constants | None = None,
    radius: float = 8.2e-3,
    load: float = 1e6,
) -> CaseFigures:
    hertz, contact = smooth_contact(body, roller, radius, load)
    peak, half_width = hertz.peak_pressure, hertz.half_width
    (shape, length), reference = ordinary_shape(), "the ordinary case"
    scaled = contact.contact_length / half_width
    return contact.findings(
        *peak_and_length(contact, (peak, half_width), HIGHS, "Hertz, exact"),
        deviation(contact.pressure / peak, shape, "shape", SAME, reference),
        relative_error("scaled length", scaled, length, 1e-7, reference),
        dense_violation(contact, hertz.combined_modulus),
    )


def sized_findings(points: int) -> CaseFigures:
    """Hertz on so many hats, a third of which touch; few of them by least squares, too."""
    half_width = points / 6.0 + 0.3
    hertz = hertz_from_peak_pressure(1.0, 0.5 * half_width, 1.0)
    load = Constraints(load=hertz.load_per_length)
    contact = load_cylinder(HalfPlane(points, 1.0, 1.0), hertz.radius, load)
    # the square-root edge leaves the L2 norm of order one in the pitch, the peak of order two
    error = contact.pressure - hertz.pressure(contact.x)
    distance = float(np.linalg.norm(error) / np.linalg.norm(hertz.pressure(contact.x)))
    reference = "Hertz, exact, order 1 in the pitch"
    figures = [bounded("pressure, L2", distance, 0.4 / half_width, reference)]
    if points <= 64:
        figures.append(least_squares_deviation(contact, 1.0))
    return contact.findings(*figures)


def hardness_findings(over_peak: float) -> CaseFigures:
    """Hardness just above or below the peak: 1 + `over_peak` of the highest pressure found."""
    pitch = 1.0 / HATS_PER_HALF_WIDTH
    operator = HalfPlane(COUNT, pitch, 1.0)
    load = hertz_from_peak_pressure(1.0, 0.5, 1.0).load_per_length
    plain = load_cylinder(operator, 0.5, Constraints(load=load))
    hardness = float(plain.pressure.max()) * (1.0 + over_peak)
    capped = load_cylinder(operator, 0.5, Constraints(load=load, hardness=hardness))
    if over_peak < -1e-3:
        exact, length = flattened_cylinder(load, 0.5, 1.0, hardness), 0.5 * capped.contact_length
        reference = "flattened cylinder, exact"
        return capped.findings(
            relative_error("contact length", length, exact.contact, HIGHS[1], reference),
            flowed_figure(capped.pressure >= hardness, pitch, exact.flowed),
        )
    # the cap takes off `over_peak` of the peak, over a share of the contact: no more may change
    high = SAME if over_peak > 0.0 else max(SAME, 3.0 * abs(over_peak))
    reference = "the uncapped contact"
    return capped.findings(deviation(capped.pressure, plain.pressure, "pressure", high, reference))


def flowed_figure(flowed: np.ndarray, pitch: float, half_width: float) -> Figure:
    """Length of the hats at the hardness (n,) against 2 `half_width` [m], in hats."""
    off = abs(np.count_nonzero(flowed) * pitch - 2.0 * half_width) / pitch
    return bounded("flowed length", off, 2.0, "flattened cylinder, exact, in hats")
