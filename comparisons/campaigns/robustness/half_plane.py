"""The half-plane's contacts at their extremes: smooth, rough, sliding, coated.

Smooth cylinders: stiffness, size, load, hardness and grids. In half-widths and peak pressures every
Hertz contact is the same, so each row states its distance from the exact contact, and from the
ordinary case, which is rounding. Rough lines: one node, plateaus, spikes, against a load over one
node's weight, bounded least squares, the contact conditions on a dense matrix. Sliding, up to a
friction of 1 where the bodies differ most, against the exact sliding cylinder. Coatings, contrasts
of 1e6: where coating or base does not matter the contact is that of a half-plane (limits of layers
are held by `verify`)."""

from functools import cache

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.hertz import HertzContact, hertz_from_load, hertz_from_peak_pressure
from analytic.exact.sliding import sliding_from_load
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material, combined_modulus, dundurs_constants
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import coupled_half_planes
from analytic.surface.synthetic import self_affine
from comparisons.campaigns.cases import CaseFigures, bounded, relative_error
from comparisons.campaigns.robustness.measures import (
    SAME,
    Constants,
    LoadedContact,
    dense_violation,
    deviation,
    flowed_figure,
    least_squares_deviation,
    load_cylinder,
    load_line,
    peak_and_length,
)

HATS_PER_HALF_WIDTH = 77.3  # as on the third level of a scene; no edge falls on a node
CYLINDER_COUNT = 2 * int(1.5 * HATS_PER_HALF_WIDTH) + 1  # hats on 1.5 half-widths to either side
STEEL = (207e9, 0.3)
HIGHS = 5e-5, 5e-4  # error of Hertz's peak and length by the grid, three times over
LINE_COUNT = 512  # nodes of a rough line
FEW = 48  # nodes that bounded least squares solve at once
SLOPE = 0.05  # rms
LOAD = 0.02 * SLOPE * LINE_COUNT  # [N/m] on nodes 1 m apart, modulus 1 Pa
SLIDING_RADIUS, SLIDING_LOAD = 10e-3, 1e6  # [m], [N/m]
BY_GRID = 1e-4  # of the peak and of the load's position: error by the grid
SOFT = (1e5, 0.0)  # of the largest Dundurs' constant under a rigid roller
COATED_RADIUS = 50.0  # [m]
PITCH = 1.0 / HATS_PER_HALF_WIDTH  # [m]


def smooth_contact(
    body: Constants, roller: Constants | None, radius: float, load: float
) -> tuple[HertzContact, LoadedContact]:
    """A cylinder of a radius [m] (`roller` None: rigid) under a load [N/m], exact and computed."""
    modulus = combined_modulus(Material(*body), Material(*roller) if roller else None)
    hertz = hertz_from_load(load, radius, modulus)
    operator = HalfPlane(CYLINDER_COUNT, hertz.half_width / HATS_PER_HALF_WIDTH, modulus)
    return hertz, load_cylinder(operator, radius, Constraints(load=load))


@cache
def ordinary_shape() -> tuple[np.ndarray, float]:
    """Pressures over the peak pressure, and the length over the half-width."""
    hertz, contact = smooth_contact(STEEL, STEEL, 8.2e-3, 1e6)
    return contact.pressure / hertz.peak_pressure, contact.contact_length / hertz.half_width


def hertz_figures(
    body: Constants = STEEL,
    roller: Constants | None = None,
    radius: float = 8.2e-3,
    load: float = 1e6,
) -> CaseFigures:
    hertz, contact = smooth_contact(body, roller, radius, load)
    peak, half_width = hertz.peak_pressure, hertz.half_width
    (shape, length), reference = ordinary_shape(), "the ordinary case"
    scaled = contact.contact_length / half_width
    return contact.figures(
        *peak_and_length(contact, (peak, half_width), HIGHS),
        deviation(contact.pressure / peak, shape, "shape", SAME, reference),
        relative_error("scaled length", scaled, length, 1e-7, reference),
        dense_violation(contact, hertz.combined_modulus),
    )


def sized_figures(points: int) -> CaseFigures:
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
    return contact.figures(*figures)


def hardness_figures(over_peak: float) -> CaseFigures:
    """Hardness just above or below the peak: 1 + `over_peak` of the highest pressure found."""
    operator = HalfPlane(CYLINDER_COUNT, PITCH, 1.0)
    load = hertz_from_peak_pressure(1.0, 0.5, 1.0).load_per_length
    plain = load_cylinder(operator, 0.5, Constraints(load=load))
    hardness = float(plain.pressure.max()) * (1.0 + over_peak)
    capped = load_cylinder(operator, 0.5, Constraints(load=load, hardness=hardness))
    if over_peak < -1e-3:
        exact, length = flattened_cylinder(load, 0.5, 1.0, hardness), 0.5 * capped.contact_length
        reference = "flattened cylinder, exact"
        return capped.figures(
            relative_error("contact length", length, exact.contact, HIGHS[1], reference),
            flowed_figure(capped.pressure >= hardness, PITCH, exact.flowed),
        )
    # hardness takes `over_peak` off the peak, over a share of the contact: no more may change
    high = SAME if over_peak > 0.0 else max(SAME, 3.0 * abs(over_peak))
    reference = "the uncapped contact"
    return capped.figures(deviation(capped.pressure, plain.pressure, "pressure", high, reference))


def rough(count: int, rms_slope: float = SLOPE) -> np.ndarray:
    """Heights (n,) [m] of a self-affine line, 1 m from node to node."""
    profile = self_affine(hurst=0.8, samples=count, length=count - 1.0, seed=7, rms_slope=rms_slope)
    return profile.height


def pressed(height: np.ndarray, load: float) -> LoadedContact:
    """A rigid flat on heights (n,) [m] of a half-plane, modulus 1 Pa."""
    return load_line(HalfPlane(len(height), 1.0, 1.0), height, Constraints(load=load))


def vanishing_figures(load: float) -> CaseFigures:
    """Figures under next to no load: one node alone carries it, and the gap is as it was."""
    height = rough(LINE_COUNT)
    contact = pressed(height, load)
    opened = np.abs(contact.solution.gap - (height.max() - height)).max() / np.ptp(height)
    touching, reference = np.count_nonzero(contact.pressure), "the load over the node's weight"
    return contact.figures(
        bounded("nodes in contact", touching, 1, "one", low=1),
        relative_error("pressure", contact.pressure.max(), load, 4e-16, reference),
        bounded("gap", opened, max(1e-14, 10.0 * load), "the initial gap"),
    )


def shape_figures(shape: str, load: float) -> CaseFigures:
    """Few nodes against bounded least squares, which needs no iteration of ours."""
    contact = pressed(SHAPES[shape](FEW), load)
    return contact.figures(least_squares_deviation(contact, 1.0), dense_violation(contact, 1.0))


def plateau(count: int) -> np.ndarray:
    """A third of the line cut to one height."""
    height = rough(count)
    return np.minimum(height, np.quantile(height, 0.66))


def spike(count: int) -> np.ndarray:
    """One sample a thousand times as high as the roughness below it."""
    height = rough(count, 1e-3)
    height[count // 3] += 1e3 * np.ptp(height)
    return height


def steps(count: int) -> np.ndarray:
    return np.repeat(rough(count)[::6], 6)[:count]


SHAPES = {"plateau": plateau, "spike": spike, "steps": steps, "flat": np.zeros}


def sliding_figures(
    body: Constants = SOFT, roller: Constants | None = None, friction: float = 1.0
) -> CaseFigures:
    """A cylinder that slides (`roller` None: rigid) against the exact one."""
    materials = Material(*body), Material(*roller) if roller else None
    modulus, beta = combined_modulus(*materials), dundurs_constants(*materials)[1]
    exact = sliding_from_load(SLIDING_LOAD, SLIDING_RADIUS, modulus, friction, beta)
    count = 2 * int(2.2 * HATS_PER_HALF_WIDTH) + 1
    pitch = exact.half_width / HATS_PER_HALF_WIDTH
    operator = coupled_half_planes(count, pitch, modulus, friction * beta)
    contact = load_cylinder(operator, SLIDING_RADIUS, Constraints(load=SLIDING_LOAD))
    (left, right), size = exact.edges, exact.half_width
    (start, stop), *_ = contact.patches
    x, pressure = contact.x, contact.pressure
    reference = "sliding cylinder, exact"
    place = abs(x @ pressure / pressure.sum() - exact.load_position) / size
    return contact.figures(
        relative_error("peak pressure", pressure.max(), exact.peak_pressure, BY_GRID, reference),
        bounded("trailing edge", abs(start - left) / size, 1e-2, reference),
        bounded("leading edge", abs(stop - right) / size, 1e-2, reference),
        bounded("place of the load", place, BY_GRID, reference),
        dense_violation(contact, modulus, friction * beta),
    )


def sliding_line_figures(friction_dundurs: float) -> CaseFigures:
    operator = coupled_half_planes(LINE_COUNT, 1.0, 1.0, friction_dundurs)
    contact = load_line(operator, rough(LINE_COUNT), Constraints(load=LOAD))
    return contact.figures(dense_violation(contact, 1.0, friction_dundurs))


def coated_figures(
    coating: Constants, thickness: float, base: Constants, equivalent: Constants, high: float
) -> CaseFigures:
    """A coating so thin or thick (over a) that it is a half-plane of the `equivalent` material."""
    body = LayeredBody(Material(*coating), thickness, Material(*base))
    modulus = Material(*equivalent).plane_strain_modulus
    load = np.pi * modulus / (4.0 * COATED_RADIUS)  # half-width 1
    under_load = COATED_RADIUS, Constraints(load=load)
    contact = load_cylinder(LayeredSurface(CYLINDER_COUNT, PITCH, body), *under_load)
    plain = load_cylinder(HalfPlane(CYLINDER_COUNT, PITCH, modulus), *under_load).pressure
    reference = "the equivalent half-plane"
    return contact.figures(deviation(contact.pressure, plain, "pressure", high, reference))
