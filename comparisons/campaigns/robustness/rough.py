"""Rough lines at their extremes: one node, plateaus, spikes, steep slopes, other units.

References: a load over one node's weight; bounded least squares and the contact conditions on a
dense matrix; the same profile in other units."""

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.operators.half_plane import HalfPlane
from analytic.surface.synthetic import self_affine
from comparisons.campaigns.cases import CaseFigures, bounded, relative_error
from comparisons.campaigns.robustness.loaded_contact import (
    SAME,
    LoadedContact,
    dense_violation,
    deviation,
    least_squares_deviation,
    load_line,
)

COUNT = 512  # nodes of a rough line
FEW = 48  # nodes that bounded least squares solve at once
SLOPE = 0.05  # rms
LOAD = 0.02 * SLOPE * COUNT  # [N/m] on nodes 1 m apart, modulus 1 Pa
TRACE = 1e-3 / COUNT  # [m] pitch of a trace of 1 mm


def rough(count: int, rms_slope: float = SLOPE) -> np.ndarray:
    """Heights (n,) [m] of a self-affine line, 1 m from node to node."""
    profile = self_affine(hurst=0.8, samples=count, length=count - 1.0, seed=7, rms_slope=rms_slope)
    return profile.height


def pressed(
    height: np.ndarray, load: float, pitch: float = 1.0, modulus: float = 1.0
) -> LoadedContact:
    """A rigid flat on heights (n,) [m] of a half-plane."""
    return load_line(HalfPlane(len(height), pitch, modulus), height, Constraints(load=load))


def vanishing_findings(load: float) -> CaseFigures:
    """Under next to no load one node alone carries it, and the gap is as it was."""
    height = rough(COUNT)
    contact = pressed(height, load)
    opened = np.abs(contact.solution.gap - (height.max() - height)).max() / np.ptp(height)
    touching, reference = np.count_nonzero(contact.pressure), "the load over the node's weight"
    return contact.findings(
        bounded("nodes in contact", touching, 1, "one", low=1),
        relative_error("pressure", contact.pressure.max(), load, 4e-16, reference),
        bounded("gap", opened, max(1e-14, 10.0 * load), "the initial gap"),
    )


def shape_findings(shape: str, load: float) -> CaseFigures:
    """Few nodes against bounded least squares, which needs no iteration of ours."""
    contact = pressed(SHAPES[shape](FEW), load)
    return contact.findings(least_squares_deviation(contact, 1.0), dense_violation(contact, 1.0))


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


def scaled_findings(
    metre: float = TRACE, pascal: float = 1.0, same: float = SAME, amplitude: float | None = None
) -> CaseFigures:
    """All lengths times `metre`, all stresses times `pascal`, and heights, to which pressures are
    in proportion, up to an `amplitude` [m]; `same` is how well figures agree."""
    usual = pressed(rough(COUNT), LOAD)
    slope = 1.0 if amplitude is None else amplitude / metre / float(np.ptp(rough(COUNT)))
    height, load = rough(COUNT) * metre * slope, LOAD * metre * pascal * slope
    other, reference = pressed(height, load, metre, pascal), "the ordinary line"
    length = other.contact_length / usual.contact_length
    approach = other.solution.approach / usual.solution.approach
    spent, most = (each.solution.iterations["applications"] for each in (other, usual))
    pressure = other.pressure / (pascal * slope)
    return other.findings(
        deviation(pressure, usual.pressure, "pressure", same, reference),
        relative_error("contact length", length, metre, max(1e2 * same, 1e-15), reference),
        relative_error("approach", approach, metre * slope, same, reference),
        bounded("applications", spent / most, 1.0, reference, low=1.0),
    )
