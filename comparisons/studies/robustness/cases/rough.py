"""Rough contacts at their ends: one node, every node, equal peaks, plateaus, spikes, steep slopes.

References: a load over one node's weight; bounded least squares and the contact conditions on a
dense matrix; the wave that a half-plane carries node by node; the same profile from behind.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.westergaard import westergaard_from_mean_pressure
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane, hat_aliases
from analytic.surface.synthetic import self_affine
from comparisons.studies.robustness.pressing import (
    SAME,
    Pressed,
    cost_figures,
    dense_departure,
    dense_matrix,
    departure,
    least_squares_departure,
    mirrored,
    press,
    residual_figures,
)
from comparisons.studies.robustness.row import Case, Figure, Findings

COUNT = 512  # nodes of a rough line
FEW = 48  # nodes that bounded least squares solve at once
Shape = Callable[[int], np.ndarray]


def rough(count: int, rms_slope: float = 0.05) -> np.ndarray:
    """Heights (n,) [m] of a self-affine line, 1 m from node to node."""
    profile = self_affine(hurst=0.8, samples=count, length=count - 1.0, seed=7, rms_slope=rms_slope)
    return profile.height


def held(pressed: Pressed, *figures: Figure) -> Findings:
    """Findings of a free line: its own figures and those of every contact."""
    count = len(pressed.x)
    kept, checks = residual_figures(pressed.solution)
    spent, cost = cost_figures(pressed.solution, count)
    condition = None
    if count <= 2 * COUNT and isinstance(pressed.operator, HalfPlane):
        touching = np.flatnonzero(pressed.pressure > 0.0)
        condition = float(np.linalg.cond(pressed.operator.block(touching)))
    return Findings((*figures, *kept, *spent), checks, condition, cost)


def vanishing_findings(load: float) -> Findings:
    """Under next to no load one node alone carries it, and the gap is as it was."""
    height = rough(COUNT)
    pressed = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height, Constraints(load=load))
    alone = pressed.pressure.max() * 1.0 / load
    opened = pressed.solution.gap - (height.max() - height)
    figures = (
        Figure("nodes in contact", np.count_nonzero(pressed.pressure), 1.0, "one", least=1.0),
        Figure("pressure", abs(alone - 1.0), 4e-16, "the load over the node's weight"),
        Figure(
            "gap", np.abs(opened).max() / np.ptp(height), max(1e-14, 10.0 * load), "the initial gap"
        ),
    )
    return held(pressed, *figures)


def twin_findings(load: float) -> Findings:
    """Two equal highest peaks: what one carries the other carries."""
    half = rough(COUNT // 2)
    height = np.concatenate([half, half[::-1]])
    pressed = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height, Constraints(load=load))
    share = pressed.pressure[: COUNT // 2].sum() / load
    figures = (
        departure(pressed.pressure[::-1], pressed.pressure, "pressure", SAME, "its mirror image"),
        Figure("share of a peak", abs(share - 0.5), SAME, "half of the load"),
        dense_departure(pressed, 1.0),
    )
    return held(pressed, *figures)


def shape_findings(shape: Shape, load: float) -> Findings:
    """Few nodes against bounded least squares, whose answer needs no iteration of ours."""
    height = shape(FEW)
    pressed = press(HalfPlane(FEW, 1.0, 1.0), 1.0, -height, Constraints(load=load))
    return held(pressed, least_squares_departure(pressed, 1.0), dense_departure(pressed, 1.0))


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


def flat(count: int) -> np.ndarray:
    return np.zeros(count)


def closed_findings() -> Findings:
    """A load that closes all gaps: equilibrium of every node, by elimination."""
    height = rough(COUNT)
    load = 1e3 * np.ptp(height)
    pressed = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height, Constraints(load=load))
    ones = np.ones(COUNT)
    system = np.block([[dense_matrix(COUNT, 1.0, 1.0), -ones[:, None]], [ones, np.zeros((1, 1))]])
    expected = np.linalg.solve(system, np.append(height - height.max(), load))[:-1]
    figures = (
        Figure("nodes in contact", np.count_nonzero(pressed.pressure), COUNT, "all", least=COUNT),
        departure(pressed.pressure, expected, "pressure", SAME, "elimination on a dense matrix"),
    )
    return held(pressed, *figures)


def wave_findings(share: float) -> Findings:
    """A sinusoid under `share` of the pressure that closes it, on one periodic line.

    In full contact hats carry the wave exactly: the amplitude is that of the averaged gap over
    the wave's own symbol. In partial contact the reference is Westergaard's.
    """
    count = 1024
    operator = PeriodicHalfPlane(count, 1.0, 1.0)
    closing = np.pi / count
    x = np.arange(count) - count // 2
    sinc4 = np.sinc(1.0 / count) ** 2
    gap = 1.0 - sinc4 * np.cos(2.0 * np.pi * x / count)
    pressed = press(operator, 1.0, gap, Constraints(load=share * closing * count))
    # in units that keep digits: the discrete wave closes at its own symbol's pressure
    symbol = float(hat_aliases(np.array([1.0 / count]))[0]) / np.pi
    amplitude = sinc4 / symbol
    figures = []
    if share * closing >= amplitude:
        exact = share * closing + amplitude * np.cos(2.0 * np.pi * x / count)
        figures.append(
            departure(pressed.pressure, exact, "pressure", SAME, "the wave's symbol, exact")
        )
    wave = westergaard_from_mean_pressure(share * closing, float(count), 1.0, 1.0)
    peak = abs(pressed.pressure.max() / wave.peak_pressure - 1.0)
    figures.append(Figure("peak pressure", peak, 2e-4, "Westergaard, exact"))
    return held(pressed, *figures)


def slope_findings(rms_slope: float) -> Findings:
    """Steep roughness: the linear theory's pressures are in proportion to the slope."""
    height = rough(COUNT, rms_slope)
    load = 0.02 * rms_slope * COUNT
    steep = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height, Constraints(load=load))
    gentle = press(HalfPlane(COUNT, 1.0, 1.0), 1.0, -height * 1e-3, Constraints(load=1e-3 * load))
    figures = (
        departure(steep.pressure, 1e3 * gentle.pressure, "pressure", SAME, "a thousandth of it"),
        dense_departure(steep, 1.0),
    )
    return held(steep, *figures)


def mirrored_findings() -> Findings:
    """The profile reversed presses the same, reversed."""
    pressed = press(
        HalfPlane(COUNT, 1.0, 1.0), 1.0, -rough(COUNT), Constraints(load=0.02 * 0.05 * COUNT)
    )
    behind = mirrored(pressed)
    length = abs(behind.contact_length / pressed.contact_length - 1.0)
    figures = (
        departure(behind.pressure[::-1], pressed.pressure, "pressure", SAME, "its mirror image"),
        Figure("contact length", length, 1e-7, "its mirror image"),
    )
    return held(pressed, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    table: dict[str, list[tuple[str, Callable[[], Findings]]]] = {
        "one node": [
            (f"load {load:g} of modulus times length", partial(vanishing_findings, load))
            for load in (1e-12, 1e-50, 1e-150)
        ],
        "equal peaks": [
            ("two equal highest peaks, light", partial(twin_findings, 1e-9)),
            ("two equal highest peaks, heavy", partial(twin_findings, 1.0)),
        ],
        "shapes": [
            ("plateau, light", partial(shape_findings, plateau, 1e-3)),
            ("plateau, heavy", partial(shape_findings, plateau, 1.0)),
            ("spike, alone", partial(shape_findings, spike, 1e-3)),
            ("spike, pressed in", partial(shape_findings, spike, 20.0)),
            ("steps", partial(shape_findings, steps, 0.1)),
            ("flat", partial(shape_findings, flat, 1.0)),
        ],
        "full contact": [
            ("a load that closes all gaps", closed_findings),
            ("sinusoid, 0.01 of closing", partial(wave_findings, 0.01)),
            ("sinusoid, just open", partial(wave_findings, 1.0 - 1e-9)),
            ("sinusoid, just closed", partial(wave_findings, 1.0 + 1e-4)),
            ("sinusoid, 1e6 times closing", partial(wave_findings, 1e6)),
        ],
        "slope": [
            (f"rms slope {slope:g}", partial(slope_findings, slope)) for slope in (1e-6, 1.0)
        ],
        "mirror": [("profile reversed", mirrored_findings)],
    }
    return tuple(
        Case(group, name, "half_plane", solve)
        for group, rows in table.items()
        for name, solve in rows
    )
