"""Rough lines at their extremes: one node, every node, equal peaks, plateaus, spikes, steep slopes,
other units.

References: a load over one node's weight; bounded least squares and the contact conditions on a
dense matrix; the wave that a half-plane carries node by node; the same profile from behind, or in
other units.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.westergaard import westergaard_from_mean_pressure
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane, hat_aliases
from analytic.surface.synthetic import self_affine
from comparisons.studies.checks import BoundedFigure, Findings, Groups, relative_error
from comparisons.studies.robustness.loaded_contact import (
    SAME,
    LoadedContact,
    dense_matrix,
    dense_violation,
    deviation,
    least_squares_deviation,
    load_line,
    mirrored,
)

COUNT = 512  # nodes of a rough line
FEW = 48  # nodes that bounded least squares solve at once
SLOPE = 0.05  # rms
LOAD = 0.02 * SLOPE * COUNT  # [N/m] on nodes 1 m apart, modulus 1 Pa
TRACE = 1e-3 / COUNT  # [m] pitch of a trace of 1 mm
Shape = Callable[[int], np.ndarray]


def rough(count: int, rms_slope: float = SLOPE) -> np.ndarray:
    """Heights (n,) [m] of a self-affine line, 1 m from node to node."""
    profile = self_affine(hurst=0.8, samples=count, length=count - 1.0, seed=7, rms_slope=rms_slope)
    return profile.height


def pressed(
    height: np.ndarray, load: float, pitch: float = 1.0, modulus: float = 1.0
) -> LoadedContact:
    """A rigid flat on heights (n,) [m] of a half-plane."""
    return load_line(HalfPlane(len(height), pitch, modulus), height, Constraints(load=load))


def touching_figure(pressure: np.ndarray, count: int, reference: str) -> BoundedFigure:
    """Exactly `count` nodes carry pressure."""
    touching = np.count_nonzero(pressure)
    return BoundedFigure("nodes in contact", touching, count, reference, low=count)


def vanishing_findings(load: float) -> Findings:
    """Under next to no load one node alone carries it, and the gap is as it was."""
    height = rough(COUNT)
    contact = pressed(height, load)
    opened = np.abs(contact.solution.gap - (height.max() - height)).max() / np.ptp(height)
    reference = "the load over the node's weight"
    return contact.findings(
        touching_figure(contact.pressure, 1, "one"),
        relative_error("pressure", contact.pressure.max(), load, 4e-16, reference),
        BoundedFigure("gap", opened, max(1e-14, 10.0 * load), "the initial gap"),
    )


def twin_findings(load: float) -> Findings:
    half = rough(COUNT // 2)
    contact = pressed(np.concatenate([half, half[::-1]]), load)
    pressure = contact.pressure
    share = abs(pressure[: COUNT // 2].sum() / load - 0.5)
    return contact.findings(
        deviation(pressure[::-1], pressure, "pressure", SAME, "its mirror image"),
        BoundedFigure("share of a peak", share, SAME, "half of the load"),
        dense_violation(contact, 1.0),
    )


def shape_findings(shape: Shape, load: float) -> Findings:
    """Few nodes against bounded least squares, which needs no iteration of ours."""
    contact = pressed(shape(FEW), load)
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


def closed_findings() -> Findings:
    """A load that closes all gaps: equilibrium of every node, by elimination."""
    height = rough(COUNT)
    load = 1e3 * np.ptp(height)
    contact = pressed(height, load)
    ones = np.ones(COUNT)
    system = np.block([[dense_matrix(COUNT, 1.0, 1.0), -ones[:, None]], [ones, np.zeros((1, 1))]])
    expected = np.linalg.solve(system, np.append(height - height.max(), load))[:-1]
    reference = "elimination on a dense matrix"
    return contact.findings(
        touching_figure(contact.pressure, COUNT, "all"),
        deviation(contact.pressure, expected, "pressure", SAME, reference),
    )


def wave_findings(share: float) -> Findings:
    """A sinusoid under `share` of the pressure that closes it, on one periodic line.

    In full contact hats carry the wave exactly: the amplitude is that of the averaged gap over
    the wave's own symbol. In partial contact the reference is Westergaard's.
    """
    count = 1024
    closing = np.pi / count
    mean = share * closing
    wave = np.cos(2.0 * np.pi * (np.arange(count) - count // 2) / count)
    sinc4 = np.sinc(1.0 / count) ** 2
    load = Constraints(load=mean * count)
    contact = load_line(PeriodicHalfPlane(count, 1.0, 1.0), sinc4 * wave - 1.0, load)
    # in units that keep digits: the discrete wave closes at its own symbol's pressure
    amplitude = sinc4 / (float(hat_aliases(np.array([1.0 / count]))[0]) / np.pi)
    figures = []
    if mean >= amplitude:
        exact = mean + amplitude * wave
        reference = "the wave's symbol, exact"
        figures.append(deviation(contact.pressure, exact, "pressure", SAME, reference))
    peak = westergaard_from_mean_pressure(mean, float(count), 1.0, 1.0).peak_pressure
    found = contact.pressure.max()
    figures.append(relative_error("peak pressure", found, peak, 2e-4, "Westergaard, exact"))
    return contact.findings(*figures)


def mirrored_findings() -> Findings:
    contact = pressed(rough(COUNT), LOAD)
    behind, reference = mirrored(contact), "its mirror image"
    length = behind.contact_length
    return contact.findings(
        deviation(behind.pressure[::-1], contact.pressure, "pressure", SAME, reference),
        relative_error("contact length", length, contact.contact_length, 1e-7, reference),
    )


def scaled_findings(metre: float, pascal: float, same: float, slope: float = 1.0) -> Findings:
    """All lengths times `metre`, all stresses times `pascal`, all slopes times `slope`, to which
    pressures are in proportion; `same` is how well figures agree."""
    usual = pressed(rough(COUNT), LOAD)
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
        BoundedFigure("applications", spent / most, 1.0, reference, low=1.0),
    )


def cases() -> Groups:
    return {
        "one node": {
            f"load {load:g} of modulus times length": partial(vanishing_findings, load)
            for load in (1e-12, 1e-50, 1e-150)
        },
        "equal peaks": {
            "two equal highest peaks, light": partial(twin_findings, 1e-9),
            "two equal highest peaks, heavy": partial(twin_findings, 1.0),
        },
        "shapes": {
            "plateau, light": partial(shape_findings, plateau, 1e-3),
            "plateau, heavy": partial(shape_findings, plateau, 1.0),
            "spike, alone": partial(shape_findings, spike, 1e-3),
            "spike, pressed in": partial(shape_findings, spike, 20.0),
            "steps": partial(shape_findings, steps, 0.1),
            "flat": partial(shape_findings, np.zeros, 1.0),
        },
        "full contact": {
            "a load that closes all gaps": closed_findings,
            "sinusoid, 0.01 of closing": partial(wave_findings, 0.01),
            "sinusoid, just open": partial(wave_findings, 1.0 - 1e-9),
            "sinusoid, just closed": partial(wave_findings, 1.0 + 1e-4),
            "sinusoid, 1e6 times closing": partial(wave_findings, 1e6),
        },
        "slope": {
            f"rms slope {slope:g}": partial(scaled_findings, 1.0, 1.0, SAME, slope / SLOPE)
            for slope in (1e-6, 1.0)
        },
        "mirror": {"profile reversed": mirrored_findings},
        "amplitude": {
            f"amplitude {amplitude:g} m": partial(scaled_findings, TRACE, 1.0, SAME, times)
            for amplitude in (1e-12, 1e-9, 1e-6, 1e-3, 1.0)
            for times in (amplitude / TRACE / float(np.ptp(rough(COUNT))),)
        },
        "units": {
            name: partial(scaled_findings, metre, pascal, same)
            for name, metre, pascal, same in (
                ("lengths in 2^-40 m, to the last bit", 2.0**-40, 1.0, 0.0),
                ("stresses in 2^50 Pa, to the last bit", 1.0, 2.0**50, 0.0),
                ("lengths in pm", 1e-12, 1.0, SAME),
                ("lengths in light years", 1e16, 1.0, SAME),
                ("stresses in 1e15 Pa", 1.0, 1e15, SAME),
                ("stresses in 1e-15 Pa", 1.0, 1e-15, SAME),
            )
        },
    }
