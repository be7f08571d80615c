"""Pressures over the surfaces under load: the paper's figure 1, and (a) of 6 and 8 to 10."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.paper.pictures.scales import RANGE, Scales, trace_surfaces
from comparisons.common.numbers import significant, with_unit
from comparisons.drawing.curves import load_text
from comparisons.drawing.style import (
    BODY,
    COLUMN,
    LINES,
    OUTLINE,
    REFERENCE,
    ROLLER,
    WIDE,
    Picture,
    data_uri,
    figure,
)
from comparisons.figures.quantity import LABELS
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

QUARTERS = 4  # of the trace, as figure 1 divides it
BAR = 25e-6  # m, figure 1's scale of heights
LEFT, RIGHT, FOOT, TOP, BETWEEN = 0.72, 0.22, 0.46, 0.1, 0.12  # inches
SHARE = 0.6  # of the panels' height, for the pressures
MICRO = 1e-6


def trace_picture(outcome: Run, scales: Scales) -> Picture:
    """Figure 1: pressures over the whole trace, and both bodies under load below them."""
    surface, hertz = outcome.problem.surface, outcome.problem.hertz
    drawn, (above, below) = _panels(WIDE, 4.4)
    origin = surface.position / MICRO
    _pressures(above, outcome, MICRO, origin, scales.pressure)
    x, body, roller = trace_surfaces(outcome)
    heights = [(part - body.max()) / MICRO for part in (body, roller)]
    _bodies(below, origin + x / MICRO, *heights)
    start, stop = origin + surface.profile.x[[0, -1]] / MICRO
    bar_at = start + 0.93 * (stop - start)
    low = below.get_ylim()[0] + 0.1 * BAR / MICRO
    below.plot([bar_at, bar_at], [low, low + BAR / MICRO], color="black", linewidth=2.2)
    at = bar_at - 0.008 * (stop - start), low + 0.5 * BAR / MICRO
    below.text(*at, f"{BAR / MICRO:g} µm", ha="right", va="center")
    below.set(yticks=[], xlabel="place on the trace [µm]")
    for axes in (above, below):
        axes.set(xlim=(start, stop), xticks=np.linspace(start, stop, QUARTERS + 1))
    pressure = outcome.runs["half_plane"].finest.solution.pressure
    peak = significant(pressure.max() / hertz.peak_pressure)
    return Picture(
        source=data_uri(drawn),
        wide=True,
        alternative=(
            f"Contact pressure over the trace, up to {peak} p₀, over the Hertz curve; below it "
            "roller and body under load."
        ),
        caption=(
            f"Pressure over the unrun trace, the Hertz curve and both bodies under load, "
            f"{load_text(outcome.problem)}; p₀ = {with_unit(hertz.peak_pressure, 'Pa')}, "
            f"a = {with_unit(hertz.half_width, 'm')}. Beyond the contact the surfaces are "
            "the half-plane's."
        ),
    )


def pressure_picture(outcome: Run, scales: Scales, of: str) -> Picture:
    """Panel (a): the same between -RANGE and RANGE; `of`, the surface in words."""
    hertz = outcome.problem.hertz
    drawn, (above, below) = _panels(COLUMN, 3.9)
    _pressures(above, outcome, hertz.half_width, 0.0, scales.pressure)
    x, body, roller = trace_surfaces(outcome)
    near = np.abs(x) <= 1.01 * RANGE * hertz.half_width
    body, roller = body[near] / MICRO, roller[near] / MICRO
    foot = body.min() - 0.12 * scales.relief / MICRO
    _bodies(below, x[near] / hertz.half_width, body - foot, roller - foot)
    below.set(ylim=(0.0, scales.relief / MICRO), xlabel="x/a", ylabel="height [µm]")
    for axes in (above, below):
        axes.set(xlim=(-RANGE, RANGE), xticks=np.arange(-1.0, 1.01, 0.5))
    peaks = "; ".join(
        f"{LABELS[name]} {significant(run.finest.solution.pressure.max() / hertz.peak_pressure)} p₀"
        for name, run in outcome.runs.items()
    )
    return Picture(
        source=data_uri(drawn),
        alternative=f"Pressure on the {of}, above both bodies under load. Largest: {peaks}.",
        caption=(
            f"Pressure on the {of} by both models, and roller and body under load (half-plane), "
            f"heights stretched. Largest pressure: {peaks}."
        ),
    )


def _panels(width: float, height: float) -> "tuple[Figure, tuple[Axes, Axes]]":
    """A figure with pressures above and bodies below."""
    drawn = figure(width, height)
    room = height - FOOT - TOP - BETWEEN
    wide = (width - LEFT - RIGHT) / width
    low, tall = (FOOT + (1.0 - SHARE) * room + BETWEEN) / height, SHARE * room / height
    above = drawn.add_axes((LEFT / width, low, wide, tall))
    below = drawn.add_axes((LEFT / width, FOOT / height, wide, (1.0 - SHARE) * room / height))
    above.tick_params(labelbottom=False)
    for axes in (above, below):
        axes.yaxis.set_label_coords(-0.75 * LEFT / (width * wide), 0.5)
    return drawn, (above, below)


def _pressures(axes: "Axes", outcome: Run, unit: float, origin: float, top: float) -> None:
    """Over x in `unit` [m] from `origin`, up to `top` [p0]."""
    hertz = outcome.problem.hertz
    for name, run in outcome.runs.items():
        x, pressure = run.finest.grid.x, run.finest.solution.pressure / hertz.peak_pressure
        axes.plot(origin + x / unit, pressure, label=LABELS[name], **LINES[name])
    x = np.linspace(-1.0, 1.0, 401) * hertz.half_width
    smooth = hertz.pressure(x) / hertz.peak_pressure
    axes.plot(origin + x / unit, smooth, label="Hertz, smooth", **REFERENCE)
    axes.set(ylim=(0.0, top), ylabel="p/p₀", yticks=np.arange(0.0, top, 1.0))
    axes.legend(loc="upper right", ncols=3, borderaxespad=0.1, columnspacing=1.2)


def _bodies(axes: "Axes", x: np.ndarray, body: np.ndarray, roller: np.ndarray) -> None:
    """Both bodies, filled."""
    low, high = body.min() - 0.3 * np.ptp(roller), roller.max()
    few = slice(None, None, 1 + len(x) // int(180 * axes.figure.get_figwidth()))
    axes.fill_between(x[few], low, body[few], **BODY)
    axes.fill_between(x[few], roller[few], high + np.ptp(roller), **ROLLER)
    for line in (body, roller):
        axes.plot(x[few], line[few], **{**OUTLINE, "linewidth": 0.7})
    axes.set_ylim(low, high)
    axes.text(0.5, 0.94, "roller", transform=axes.transAxes, ha="center", va="top")
    axes.text(0.01, 0.06, "body", transform=axes.transAxes, va="bottom")
    axes.grid(False)
