"""Pressures over the profile, in the manner of Bailey and Sayles (1991), figure 1.

Above the pressures of both models over the Hertz curve, below them on the same x the deformed
surfaces; once over the whole contact, once around the highest peak or the edge, where the nodes
of the piecewise-linear pressures can be told apart.
"""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, percent, scale_of, significant, with_unit
from comparisons.common.quantities import LABELS
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.report.figures.style import (
    COLUMN,
    DIFFERENCE,
    LINES,
    REFERENCE,
    WIDE,
    Picture,
    data_uri,
    figure,
)
from comparisons.report.figures.surfaces import draw_surfaces
from comparisons.report.tables.problem import load_text
from comparisons.results.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEFT = 0.8  # inches left of the panels
FARTHEST_CAP = 2.0  # peak pressures: a hardness beyond would only flatten the curves
CLOSE_HATS = 14  # pressure elements to either side in the close-up, at least
CLOSE_REACH = 0.1  # half-widths to either side, at most
TICKS, STEPS = 7, (1, 2, 2.5, 5, 10)  # of x/a: how many at most, and how far apart, by tens
CLEAR = 0.04  # share of that axis at either end without one


def reference_level(outcome: Outcome) -> Level:
    """The finest level of the finite elements, or of the only model."""
    return list(outcome.runs.values())[-1].finest


def pressure_picture(outcome: Outcome) -> Picture:
    """The whole contact."""
    x = reference_level(outcome).grid.x
    across = (min(x[0], -1.05 * outcome.problem.hertz.half_width), max(x[-1], 0.0))
    across = (across[0], max(across[1], 1.05 * outcome.problem.hertz.half_width))
    p0 = outcome.problem.hertz.peak_pressure
    peaks = ", ".join(
        f"{LABELS[name]} {significant(run.finest.solution.pressure.max() / p0)} p₀ at x = "
        f"{with_unit(_peak_position(run.finest), 'm')}"
        for name, run in outcome.runs.items()
    )
    return Picture(
        source=data_uri(_drawn(outcome, across, WIDE, 5.2)),
        narrow=data_uri(_drawn(outcome, across, COLUMN, 5.2)),
        wide=True,
        alternative=f"Contact pressure over x above the deformed surfaces. Largest: {peaks}.",
        caption=(
            f"Contact pressure over the Hertz peak pressure p₀, and the surfaces under load. "
            f"Largest pressure: {peaks}. {_norm(outcome)}"
            "Heights are stretched and known but for a constant; in contact both surfaces coincide."
        ),
    )


def close_up_picture(outcome: Outcome) -> Picture:
    """The ground around the highest pressure; of a smooth body, the contact's edge."""
    level = reference_level(outcome)
    pitch = level.grid.pitch
    if outcome.problem.scene.profile is None:
        centre, reach, place = level.patches[-1, 1], CLOSE_HATS * pitch, "the right-hand edge"
    else:
        centre, place = _peak_position(level), "the highest peak"
        holding = (level.patches[:, 0] <= centre) & (level.patches[:, 1] >= centre)
        most = max(CLOSE_REACH * outcome.problem.hertz.half_width, CLOSE_HATS * pitch)
        reach = np.clip(0.75 * np.ptp(level.patches[holding]), CLOSE_HATS * pitch, most)
    at = f"x = {with_unit(float(centre), 'm')}"
    across = (centre - reach, centre + reach)
    return Picture(
        source=data_uri(_drawn(outcome, across, COLUMN, 5.6, nodes=True)),
        alternative=f"Pressures of the models around {place}, {at}.",
        caption=(
            f"Around {place}, {at}: the pressures are piecewise linear between the marked nodes, "
            f"{with_unit(pitch, 'm', 3)} apart."
        ),
    )


def _peak_position(level: Level) -> float:
    return float(level.grid.x[level.solution.pressure.argmax()])


def _norm(outcome: Outcome) -> str:
    row = next((c for c in outcome.comparisons if c.quantity == "pressure_l2"), None)
    if row is None or row.difference is None:
        return ""
    size = percent(row.difference, uncertainty=row.uncertainty)
    return f"The models differ by {size} (relative L2 norm). "


def _drawn(
    outcome: Outcome, across: tuple[float, float], width: float, height: float, nodes: bool = False
) -> "Figure":
    """Pressures, their difference where there are two models, and surfaces."""
    drawn = figure(width, height)
    left, right = LEFT / width, 1.0 - 0.12 / width
    comparing = len(outcome.runs) > 1
    heights = (0.50, 0.13, 0.37) if comparing else (0.58, 0.42)
    bottom, top, space = 0.46 / height, 1.0 - 0.24 / height, 0.16 / height
    room = top - bottom - space * (len(heights) - 1)
    panels, edge = [], top
    for share in heights:
        edge -= share * room
        panels.append(drawn.add_axes((left, edge, right - left, share * room)))
        edge -= space
    unit = scale_of(np.abs(across), "m")
    _pressures(panels[0], outcome, across, unit, nodes)
    if comparing:
        _difference(panels[1], outcome, across, unit)
    draw_surfaces(panels[-1], outcome, across, unit)
    for panel in panels:
        panel.yaxis.set_label_coords(-0.8 * LEFT / (width * (right - left)), 0.5)
        panel.set_xlim(across[0] / unit.factor, across[1] / unit.factor)
    for panel in panels[:-1]:
        panel.tick_params(labelbottom=False)
    panels[-1].set_xlabel(f"x [{unit.name}]")
    _second_axis(panels[0], outcome.problem.hertz.half_width / unit.factor)
    return drawn


def _second_axis(axes: "Axes", half_width: float) -> None:
    """x/a along the top."""
    from matplotlib.ticker import MaxNLocator

    top = axes.secondary_xaxis(
        "top", functions=(lambda x: x / half_width, lambda s: s * half_width)
    )
    top.tick_params(pad=1.5)
    # at the ends a number would be cut, or stand on the axis' name
    low, high = (x / half_width for x in axes.get_xlim())
    ticks = MaxNLocator(TICKS, steps=STEPS).tick_values(low, high)
    end = CLEAR * (high - low)
    top.set_ticks(ticks[(ticks >= low + end) & (ticks <= high - end)])
    axes.annotate("x/a", (0.0, 1.0), (-22, 4), "axes fraction", "offset points", ha="right")


def _pressures(
    axes: "Axes", outcome: Outcome, across: tuple[float, float], unit: Scale, nodes: bool
) -> None:
    problem = outcome.problem
    p0 = problem.hertz.peak_pressure
    smooth = np.linspace(*across, 600)
    smooth = np.union1d(
        smooth, np.clip([-problem.hertz.half_width, problem.hertz.half_width], *across)
    )
    for name, run in outcome.runs.items():
        level = run.finest
        x, pressure = _closed(level)
        near = (x >= across[0] - level.grid.pitch) & (x <= across[1] + level.grid.pitch)
        marker = {"half_plane": "o", "finite_element": "x"}[name] if nodes else None
        axes.plot(
            x[near] / unit.factor,
            pressure[near] / p0,
            label=LABELS[name],
            marker=marker,
            markersize=3.2,
            markerfacecolor="none",
            **LINES[name],
        )
    axes.plot(
        smooth / unit.factor,
        problem.hertz.pressure(smooth) / p0,
        label="Hertz, smooth",
        **REFERENCE,
    )
    peak = max(run.finest.solution.pressure.max() for run in outcome.runs.values())
    cap = np.inf if problem.scene.hardness is None else problem.scene.hardness / p0
    if cap < FARTHEST_CAP * peak / p0:
        axes.axhline(cap, color="#777777", linestyle="-.", linewidth=0.9, label="hardness")
    _legend(axes, problem)


def _legend(axes: "Axes", problem: Problem) -> None:
    """The load and the lines' names, above the curves; on a narrow picture in two rows."""
    narrow = axes.figure.get_figwidth() < 0.75 * WIDE
    axes.set_ylim(0.0, (1.34 if narrow else 1.17) * axes.dataLim.y1)
    axes.set_ylabel("p/p₀")
    load = (
        f"P = {load_text(problem)},  p₀ = {with_unit(problem.hertz.peak_pressure, 'Pa')},  "
        f"a = {with_unit(problem.hertz.half_width, 'm')}"
    )
    axes.text(0.008, 0.97, load, transform=axes.transAxes, va="top")
    axes.legend(
        loc="upper left" if narrow else "upper right",
        bbox_to_anchor=(0.0, 0.91) if narrow else (1.0, 1.02),
        ncols=4,
        borderaxespad=0.1,
        columnspacing=1.0,
        handlelength=2.0,
        handletextpad=0.5,
    )


def _closed(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """The pressure with the feet of its first and last hat."""
    x, pitch = level.grid.x, level.grid.pitch
    return (
        np.concatenate([[x[0] - pitch], x, [x[-1] + pitch]]),
        np.concatenate([[0.0], level.solution.pressure, [0.0]]),
    )


def _difference(axes: "Axes", outcome: Outcome, across: tuple[float, float], unit: Scale) -> None:
    one, other = outcome.runs["half_plane"].finest, outcome.runs["finite_element"].finest
    x, reference = _closed(other)
    difference = np.interp(x, *_closed(one)) - reference
    difference /= outcome.problem.hertz.peak_pressure
    near = (x >= across[0] - other.grid.pitch) & (x <= across[1] + other.grid.pitch)
    axes.plot(x[near] / unit.factor, difference[near], **DIFFERENCE)
    largest = np.max(np.abs(difference[near]), initial=0.0) or 1.0
    axes.set_ylim(-1.25 * largest, 1.25 * largest)
    axes.set_ylabel("Δp/p₀")
    axes.locator_params(axis="y", nbins=3)
