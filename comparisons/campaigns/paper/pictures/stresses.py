"""Stresses below a surface: normal ones on the axis, the paper's figure 5; contours of the shear
stresses, which the paper also shows as landscapes."""

import numpy as np

from analytic.exact.hertz import hertz_stress
from comparisons.campaigns.paper.claims.readings import LevelView
from comparisons.campaigns.paper.pictures.scales import RANGE, Scales, values_of
from comparisons.common.numbers import decimal, plain, significant
from comparisons.drawing.field import colour_bar, cross, fill
from comparisons.drawing.style import COLUMN, REFERENCE, Picture, data_uri, figure
from comparisons.figures.quantity import LABELS
from comparisons.output.page.pictures.stresses import Component
from comparisons.studies.study import Run

SHALLOW, LOWEST = 0.1, -1.02  # of figure 5(b) [a], and of both [p0]
SIGMA = {"sx": ("σx", "#0072B2"), "sz": ("σz", "#D55E00")}
LINES = {"colors": "#111111", "linewidths": 0.55, "linestyles": "dashed"}
TALL = (COLUMN - 0.75) / (2.0 * RANGE)  # inches: a half-width is as long down as along
FOOT, TITLE, BAR = 0.86, 0.3, 0.1  # inches


def axis_picture(smooth: Run, depth: float, high: float) -> Picture:
    """Figure 5: normal stresses on the axis down to `depth` [a], from LOWEST to `high` [p0]."""
    hertz = smooth.problem.hertz
    drawn = figure(COLUMN, 3.7)
    axes = drawn.add_axes((0.13, 0.125, 0.83, 0.745))
    fine = np.linspace(0.0, depth, 201)
    exact = hertz_stress(hertz, 0.0, fine * hertz.half_width)
    views = {
        name: LevelView(name, smooth.problem, run.finest, smooth.window)
        for name, run in smooth.runs.items()
    }
    markers = {"half_plane": "o", "finite_element": "x"}
    for part, (symbol, colour) in SIGMA.items():
        values = getattr(exact, part) / hertz.peak_pressure
        axes.plot(values, fine, **{**REFERENCE, "color": colour, "linestyle": "-"})
        for name, view in views.items():
            at = np.flatnonzero(view.z <= depth * (1.0 + 1e-9))
            at = at[:: max(1, len(at) // 16)]
            middle = int(np.argmin(np.abs(view.x)))
            computed = getattr(view.stress(0.0), part)[at, middle]
            look = {"marker": markers[name], "markersize": 4.5, "markerfacecolor": "none"}
            look |= {"linestyle": "none", "color": colour, "label": f"{symbol}, {LABELS[name]}"}
            axes.plot(computed, view.z[at], **look)
        place = 0.82 * depth
        value = float(np.interp(place, fine, values))
        axes.annotate(symbol, (value, place), (7, 4), textcoords="offset points", color=colour)
    if depth <= SHALLOW:
        pitch = smooth.runs["half_plane"].finest.grid.pitch / hertz.half_width
        axes.axhline(pitch, color="#555555", linestyle="-.", linewidth=0.9)
        look = {"textcoords": "offset points", "ha": "right", "size": 8}
        axes.annotate("one pressure element", (high, pitch), (-4, 3), **look)
    axes.set(xlim=(LOWEST, high), ylim=(depth, 0.0), xlabel="stress/p₀", ylabel="z/a")
    place = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "borderaxespad": 0.1}
    axes.legend(ncols=2, handlelength=1.0, **place)
    near = " near the surface" if depth <= SHALLOW else ""
    return Picture(
        source=data_uri(drawn),
        alternative=(
            f"Normal stresses on the axis of the smooth contact{near}, down to {depth:g} a: the "
            "marks of both models lie on the exact curves."
        ),
        caption=(
            f"Normal stresses on the axis of the smooth contact{near}; lines are exact (the "
            "paper's equations 6a and 6b), marks computed. Compression is negative."
        ),
    )


def contour_picture(outcome: Run, component: Component, scales: Scales, of: str) -> Picture:
    """A component at every friction coefficient: half-plane in bands, finite elements in lines."""
    hertz, window = outcome.problem.hertz, outcome.window
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    near = np.abs(window.x) <= 1.01 * RANGE * hertz.half_width
    frictions = outcome.problem.scene.load.friction
    bands = scales.bands[component.name]
    total = FOOT + len(frictions) * (TALL + TITLE)
    drawn = figure(COLUMN, total)
    extremes = []
    for place, friction in enumerate(frictions, start=1):
        low = total - place * (TALL + TITLE)
        axes = drawn.add_axes((0.62 / COLUMN, low / total, 2 * RANGE * TALL / COLUMN, TALL / total))
        values = values_of(outcome, component, "half_plane", friction)
        shown = fill(axes, x, z, values, bands, component.colours, component.signed)
        lines = values_of(outcome, component, "finite_element", friction)
        axes.contour(x[near], z, lines[:, near], levels=bands, **LINES)
        axes.set(xlim=(-RANGE, RANGE), xticks=np.arange(-1.0, 1.01, 0.5))
        extreme = outcome.runs["half_plane"].finest.stress(friction).extremes[component.name]
        at = extreme.x / hertz.half_width, extreme.z / hertz.half_width
        cross(axes, *at)
        largest = significant(abs(extreme.value) / hertz.peak_pressure, 3)
        extremes.append(
            f"friction {plain(friction)}: largest {largest} p₀ at x = {decimal(at[0], 2)} a, "
            f"z = {significant(at[1], 2)} a"
        )
        axes.set_title(extremes[-1])
        axes.tick_params(labelbottom=place == len(frictions))
    axes.set_xlabel("x/a")
    bar = drawn.add_axes((1.1 / COLUMN, 0.3 / total, (COLUMN - 1.3) / COLUMN, BAR / total))
    colour_bar(drawn, bar, shown, f"{component.symbol}/p₀", bands)
    words = f"{component.words.capitalize()} {component.symbol} below the {of}"
    return Picture(
        source=data_uri(drawn),
        alternative=f"Contours. {words}. {'; '.join(extremes)}.",
        caption=(
            f"{words}: colours are the half-plane's, dashed lines the finite elements' at the "
            f"bounds of the colours; + marks the largest amount"
            f"{', stripes what is negative' if component.signed else ''}. Sliding acts on the body "
            "towards +x."
        ),
    )
