"""Smooth cylinders on a half-plane: extreme stiffness, size, load, hardness and grids.

In half-widths and peak pressures every Hertz contact is the same. So each row states its distance
from the exact contact, and from the ordinary case, which is rounding.
"""

from functools import cache, partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactError
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.hertz import HertzContact, hertz_from_load, hertz_from_peak_pressure
from analytic.material import Material, combined_modulus
from analytic.operators.half_plane import HalfPlane
from analytic.profile import Profile, surface
from comparisons.studies.checks import BoundedFigure, Findings, Groups, relative_error
from comparisons.studies.robustness.loaded_contact import (
    HATS_PER_HALF_WIDTH,
    SAME,
    LoadedContact,
    cylinder_gap,
    dense_violation,
    deviation,
    least_squares_deviation,
    load_contact,
    load_cylinder,
    peak_and_length,
)

COUNT = 2 * int(1.5 * HATS_PER_HALF_WIDTH) + 1  # hats on 1.5 half-widths to either side
STEEL = Material(207e9, 0.3)
HIGHS = 5e-5, 5e-4  # error of Hertz's peak and length by the grid, three times over


def smooth_contact(
    body: Material, roller: Material | None, radius: float = 8.2e-3, load: float = 1e6
) -> tuple[HertzContact, LoadedContact]:
    """A cylinder of a radius [m] (`roller` None: rigid) under a load [N/m], exact and computed."""
    hertz = hertz_from_load(load, radius, combined_modulus(body, roller))
    operator = HalfPlane(COUNT, hertz.half_width / HATS_PER_HALF_WIDTH, hertz.combined_modulus)
    return hertz, load_cylinder(operator, radius, Constraints(load=load))


@cache
def ordinary_shape() -> tuple[np.ndarray, float]:
    """Pressures over the peak pressure, and the length over the half-width."""
    hertz, contact = smooth_contact(STEEL, STEEL)
    return contact.pressure / hertz.peak_pressure, contact.contact_length / hertz.half_width


def hertz_findings(body: Material, roller: Material | None, **given: float) -> Findings:
    """Against Hertz, and against the ordinary case; `given` as for `smooth_contact`."""
    hertz, contact = smooth_contact(body, roller, **given)
    peak, half_width = hertz.peak_pressure, hertz.half_width
    (shape, length), reference = ordinary_shape(), "the ordinary case"
    scaled = contact.contact_length / half_width
    return contact.findings(
        *peak_and_length(contact, (peak, half_width), HIGHS, "Hertz, exact"),
        deviation(contact.pressure / peak, shape, "shape", SAME, reference),
        relative_error("scaled length", scaled, length, 1e-7, reference),
        dense_violation(contact, hertz.combined_modulus),
    )


def sized_findings(count: int) -> Findings:
    """Hertz on `count` hats, a third of which touch; few of them by least squares, too."""
    half_width = count / 6.0 + 0.3
    hertz = hertz_from_peak_pressure(1.0, 0.5 * half_width, 1.0)
    load = Constraints(load=hertz.load_per_length)
    contact = load_cylinder(HalfPlane(count, 1.0, 1.0), hertz.radius, load)
    # the square-root edge leaves the L2 norm of order one in the pitch, the peak of order two
    error = contact.pressure - hertz.pressure(contact.x)
    distance = float(np.linalg.norm(error) / np.linalg.norm(hertz.pressure(contact.x)))
    reference = "Hertz, exact, order 1 in the pitch"
    figures = [BoundedFigure("pressure, L2", distance, 0.4 / half_width, reference)]
    if count <= 64:
        figures.append(least_squares_deviation(contact, 1.0))
    return contact.findings(*figures)


def hardness_findings(over_peak: float) -> Findings:
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


def flowed_figure(flowed: np.ndarray, pitch: float, half_width: float) -> BoundedFigure:
    """Length of the hats at the hardness (n,) against 2 `half_width` [m], in hats."""
    off = abs(np.count_nonzero(flowed) * pitch - 2.0 * half_width) / pitch
    return BoundedFigure("flowed length", off, 2.0, "flattened cylinder, exact, in hats")


def soft_findings(share: float) -> Findings:
    """A hardness of which the load takes `share`: rigid and plastic, all but the edges at it."""
    count, hardness = 257, 1e-6
    load = Constraints(load=share * 1e-6 * count, hardness=hardness)
    contact = load_cylinder(HalfPlane(count, 1.0, 1.0), 100.0 * count, load)
    full = np.count_nonzero(contact.pressure >= hardness * (1.0 - 1e-9))
    off, reference = abs(full - load.load / hardness), "load over hardness, in hats"
    return contact.findings(BoundedFigure("hats at the hardness", off, 3.0, reference))


def refused_findings() -> Findings:
    load = Constraints(load=64.0 * (1.0 + 1e-12), hardness=1.0)
    try:
        load_cylinder(HalfPlane(64, 1.0, 1.0), 1e3, load)
        refused = 0.0
    except ContactError:
        refused = 1.0
    return Findings((BoundedFigure("refused", refused, 1.0, "must raise ContactError", low=1.0),))


def cubic(x: np.ndarray) -> np.ndarray:
    """Heights [m]; the spline through any number of samples is this cubic itself."""
    return -2e-3 * x**2 + 1e-3 * x**3


def sample_findings(samples: int) -> Findings:
    """A profile of so many samples against the cubic, and read from the other end."""
    even = np.linspace(-1.0, 1.0, samples)
    places = 2.0 * np.sin(0.5 * np.pi * even) if samples < 100 else 2.0 * even
    profile = Profile(places, cubic(places))
    operator, load = HalfPlane(301, 0.01, 1.0), Constraints(load=0.01)
    contact = load_cylinder(operator, 50.0, load, surface(profile), profile.x)
    exact = load_cylinder(operator, 50.0, load, cubic)
    turned = profile.mirrored()
    x, gap = cylinder_gap(operator, 50.0, surface(turned), turned.x)
    behind = load_contact(operator, x, gap[::-1], load)
    reference, length = "the cubic itself", exact.contact_length
    return contact.findings(
        deviation(contact.pressure, exact.pressure, "pressure", SAME, reference),
        deviation(behind.pressure, exact.pressure, "read backwards", SAME, reference),
        relative_error("contact length", contact.contact_length, length, 1e-7, reference),
    )


def cases() -> Groups:
    hertz = partial(hertz_findings, STEEL)
    materials = {
        "ordinary: steel on steel": partial(hertz, STEEL),
        "roller 1e6 times as stiff": partial(hertz, Material(1e6 * 207e9, 0.3)),
        "roller 1e-6 times as stiff": partial(hertz, Material(1e-6 * 207e9, 0.3)),
    }
    ratios = {"0": 0.0, "0.49": 0.49, "0.4999": 0.4999, "0.5 less rounding": np.nextafter(0.5, 0.0)}
    materials |= {
        f"Poisson's ratio {words}": partial(hertz_findings, Material(207e9, ratio), None)
        for words, ratio in ratios.items()
    }
    sizes = {
        "radius 1e-9 m": partial(hertz, STEEL, radius=1e-9),
        "radius 1e9 m": partial(hertz, STEEL, radius=1e9),
        "load 1e-12 N/m": partial(hertz, STEEL, load=1e-12),
        "load 1e12 N/m": partial(hertz, STEEL, load=1e12),
    }
    points = {
        f"{count} points": partial(sized_findings, count)
        for count in (8, 9, 64, 4096, 65_536, 1_000_000)
    }
    points |= {
        f"{samples} profile samples": partial(sample_findings, samples)
        for samples in (8, 1000, 1_000_000)
    }
    hardnesses = {
        f"hardness {over:+g} of the peak": partial(hardness_findings, over)
        for over in (1e-9, 1e-3, -1e-9, -1e-6, -1e-2)
    }
    hardnesses |= {
        f"load {share:g} of what the hardness carries": partial(soft_findings, share)
        for share in (0.5, 1.0 - 1e-6)
    }
    hardnesses["load above what the hardness carries"] = refused_findings
    groups = {"materials": materials, "size and load": sizes}
    return groups | {"points": points, "hardness": hardnesses}
