"""Contours of the shear stresses below a surface, which the paper also shows as landscapes."""

import numpy as np

from comparisons.campaigns.paper.pictures.scales import RANGE, Scales, values_of
from comparisons.common.numbers import decimal, plain, significant
from comparisons.drawing.field import colour_bar, cross, fill
from comparisons.drawing.style import COLUMN, Picture, data_uri, figure
from comparisons.output.page.pictures.fields import Component
from comparisons.studies.study import Run

LINES = {"colors": "#111111", "linewidths": 0.55, "linestyles": "dashed"}
TALL = (COLUMN - 0.75) / (2.0 * RANGE)  # inches: a half-width is as long down as along
FOOT, TITLE, BAR = 0.86, 0.3, 0.1  # inches


def contour_picture(outcome: Run, component: Component, scales: Scales, of: str) -> Picture:
    """A component at every friction coefficient: half-plane in bands, finite elements in lines."""
    hertz, window = outcome.problem.hertz, outcome.window
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    near = np.abs(window.x) <= 1.01 * RANGE * hertz.half_width
    frictions = outcome.problem.scene.load.friction
    bands = scales.bands[component.name]
    total = FOOT + len(frictions) * (TALL + TITLE)
    drawn = figure(COLUMN, total)
    found = []
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
        found.append(
            f"friction {plain(friction)}: largest {largest} p₀ at x = {decimal(at[0], 2)} a, "
            f"z = {significant(at[1], 2)} a"
        )
        axes.set_title(found[-1])
        axes.tick_params(labelbottom=place == len(frictions))
    axes.set_xlabel("x/a")
    bar = drawn.add_axes((1.1 / COLUMN, 0.3 / total, (COLUMN - 1.3) / COLUMN, BAR / total))
    colour_bar(drawn, bar, shown, f"{component.symbol}/p₀", bands)
    words = f"{component.words.capitalize()} {component.symbol} below the {of}"
    return Picture(
        source=data_uri(drawn),
        alternative=f"Contours. {words}. {'; '.join(found)}.",
        caption=(
            f"{words}: colours are the half-plane's, dashed lines the finite elements' at the "
            f"bounds of the colours; + marks the largest amount"
            f"{', stripes what is negative' if component.signed else ''}. Sliding acts on the body "
            "towards +x."
        ),
    )
