"""Normal stresses on the axis: the paper's figure 5."""

import numpy as np

from analytic.exact.hertz import hertz_stress
from comparisons.campaigns.paper.claims.readings import LevelView
from comparisons.drawing.style import COLUMN, REFERENCE, Picture, data_uri, figure
from comparisons.figures.quantity import LABELS
from comparisons.studies.study import Run

SHALLOW = 0.1  # a, of figure 5(b)
SIGMA = {"sx": ("σx", "#0072B2"), "sz": ("σz", "#D55E00")}


def axis_pictures(smooth: Run) -> list[Picture]:
    """Figures 5(a) and 5(b): normal stresses on the axis, down to 1 a and down to SHALLOW."""
    return [_axis_picture(smooth, 1.0, -1.02, 0.0), _axis_picture(smooth, SHALLOW, -1.02, -0.76)]


def _axis_picture(smooth: Run, depth: float, low: float, high: float) -> Picture:
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
            found = getattr(view.stress(0.0), part)[at, middle]
            look = {"marker": markers[name], "markersize": 4.5, "markerfacecolor": "none"}
            look |= {"linestyle": "none", "color": colour, "label": f"{symbol}, {LABELS[name]}"}
            axes.plot(found, view.z[at], **look)
        place = 0.82 * depth
        value = float(np.interp(place, fine, values))
        axes.annotate(symbol, (value, place), (7, 4), textcoords="offset points", color=colour)
    if depth <= SHALLOW:
        pitch = smooth.runs["half_plane"].finest.grid.pitch / hertz.half_width
        axes.axhline(pitch, color="#555555", linestyle="-.", linewidth=0.9)
        look = {"textcoords": "offset points", "ha": "right", "size": 8}
        axes.annotate("one pressure element", (high, pitch), (-4, 3), **look)
    axes.set(xlim=(low, high), ylim=(depth, 0.0), xlabel="stress/p₀", ylabel="z/a")
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
