"""Stresses over depth on single verticals: the paper's figures 5 and 11."""

from typing import TYPE_CHECKING

import numpy as np

from analytic.exact.hertz import hertz_stress
from analytic.stress.points import stress_at
from comparisons.common.numbers import decimal, significant
from comparisons.common.quantities import LABELS
from comparisons.report.figures.style import COLUMN, REFERENCE, Picture, data_uri, figure
from comparisons.results.outcome import Outcome
from comparisons.studies.paper.claims.claim_list import POLISHED, SMOOTH, UNRUN
from comparisons.studies.paper.claims.readings import NEAR, SLIDING, LevelView, peak_column

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DEEPEST = 0.8  # a, of figure 11
SHALLOW = 0.1  # a, of figure 5(b)
COLOURS = {UNRUN: "#D55E00", POLISHED: "#0072B2", SMOOTH: "#222222"}
SIGMA = {"sx": ("σx", "#0072B2"), "sz": ("σz", "#D55E00")}


def axis_pictures(smooth: Outcome) -> list[Picture]:
    """Figures 5(a) and 5(b): normal stresses on the axis, down to 1 a and down to SHALLOW."""
    return [_axis_picture(smooth, 1.0, -1.02, 0.0), _axis_picture(smooth, SHALLOW, -1.02, -0.76)]


def _axis_picture(smooth: Outcome, depth: float, low: float, high: float) -> Picture:
    hertz = smooth.problem.hertz
    drawn = figure(COLUMN, 3.7)
    axes = drawn.add_axes((0.13, 0.125, 0.83, 0.745))
    fine = np.linspace(0.0, depth, 201)
    exact = hertz_stress(hertz, 0.0, fine * hertz.half_width)
    views = {name: _view(smooth, name) for name in smooth.runs}
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


def peak_section_picture(outcomes: dict[str, Outcome]) -> Picture:
    """Figure 11(a): tau1 below the peak asperities, and of the smooth contact at the same x."""
    drawn, whole, near = _section_axes()
    found = []
    for scene in (UNRUN, POLISHED):
        outcome = outcomes[scene]
        view = _view(outcome, "half_plane")
        x = float(view.x[peak_column(view)])
        words = scene.removeprefix("ground-")
        for axes in (whole, near):
            _section(axes, outcome, x, 0.0, COLOURS[scene], words)
            _smooth_section(axes, outcome, x, COLOURS[scene], f"smooth, at x = {decimal(x, 2)} a")
        near_surface = view.stress(0.0).tau1[view.z <= NEAR, peak_column(view)]
        top = significant(float(near_surface.max()), 3)
        found.append(f"{words}, x = {decimal(x, 2)} a: up to {top} p₀")
    _finish(whole, near)
    return Picture(
        source=data_uri(drawn),
        alternative=f"Principal shear over depth below the peak asperities. {'; '.join(found)}.",
        caption=(
            "Principal shear τ₁ over depth below the peak asperities of the unrun and the "
            f"polished surface, no friction; right, the first {NEAR:g} a. Lines: half-plane; "
            f"crosses: finite elements; dotted: smooth, exact. {'; '.join(found)}."
        ),
    )


def edge_section_picture(outcomes: dict[str, Outcome]) -> Picture:
    """Figure 11(b): tau1 below x = +a; smooth, smooth and sliding, unrun and sliding."""
    drawn, whole, near = _section_axes()
    curves = (
        (SMOOTH, 0.0, "#009E73", "smooth"),
        (SMOOTH, SLIDING, "#0072B2", f"smooth, friction {SLIDING:g}"),
        (UNRUN, SLIDING, "#D55E00", f"unrun, friction {SLIDING:g}"),
    )
    found = []
    for scene, friction, colour, words in curves:
        for axes in (whole, near):
            _section(axes, outcomes[scene], 1.0, friction, colour, words)
        hertz, level = outcomes[scene].problem.hertz, outcomes[scene].runs["half_plane"].finest
        a, pressure = hertz.half_width, level.solution.pressure
        stress = stress_at(level.grid.x, pressure, friction, a, [NEAR * a])
        value = significant(float(stress.tau1[0] / hertz.peak_pressure), 3)
        found.append(f"{words}: {value} p₀")
    _finish(whole, near)
    said = f"At z = {NEAR:g} a, {'; '.join(found)}."
    return Picture(
        source=data_uri(drawn),
        alternative=f"Principal shear over depth below x = +a. {said}",
        caption=(
            "Principal shear τ₁ over depth below the edge x = +a of the smooth contact; right, "
            f"the first {NEAR:g} a. Lines: half-plane; crosses: finite elements. {said}"
        ),
    )


def _view(outcome: Outcome, model: str) -> LevelView:
    return LevelView(model, outcome.problem, outcome.runs[model].finest, outcome.window)


def _section_axes() -> "tuple[Figure, Axes, Axes]":
    """A figure with axes for the whole depth, and for what lies next to the surface."""
    drawn = figure(COLUMN, 3.9)
    whole = drawn.add_axes((0.11, 0.12, 0.56, 0.78))
    return drawn, whole, drawn.add_axes((0.73, 0.12, 0.235, 0.78), sharey=whole)


def _section(
    axes: "Axes", outcome: Outcome, x: float, friction: float, colour: str, words: str
) -> None:
    """Sections of both models on the column of the window that is nearest to x [a]."""
    hertz, level = outcome.problem.hertz, outcome.runs["half_plane"].finest
    view = _view(outcome, "finite_element")
    place = int(np.argmin(np.abs(view.x - x)))
    x = float(view.x[place])
    z = np.union1d(np.geomspace(1e-4, DEEPEST, 160), np.linspace(0.0, DEEPEST, 80))
    a, p0 = hertz.half_width, hertz.peak_pressure
    stress = stress_at(level.grid.x, level.solution.pressure, friction, x * a, z * a)
    axes.plot(z, stress.tau1 / p0, color=colour, linewidth=1.4, label=words)
    column = view.stress(friction).tau1[:, place]
    is_near = axes.get_position().width < 0.5
    some = _rows(view.z, NEAR if is_near else DEEPEST, 12 if is_near else 18)
    axes.plot(view.z[some], column[some], linestyle="none", marker="x", markersize=4, color=colour)


def _smooth_section(axes: "Axes", outcome: Outcome, x: float, colour: str, words: str) -> None:
    hertz, z = outcome.problem.hertz, np.linspace(0.0, DEEPEST, 200)
    exact = hertz_stress(hertz, x * hertz.half_width, z * hertz.half_width).tau1
    axes.plot(z, exact / hertz.peak_pressure, label=words, **REFERENCE | {"color": colour})


def _rows(z: np.ndarray, depth: float, count: int) -> np.ndarray:
    """Rows nearest to `count` even depths down to `depth`."""
    wanted = np.linspace(0.0, depth, count)
    return np.unique([int(np.argmin(np.abs(z - place))) for place in wanted])


def _finish(whole: "Axes", near: "Axes") -> None:
    whole.set(xlim=(0.0, DEEPEST), xlabel="z/a", ylabel="τ₁/p₀")
    near.set(xlim=(0.0, NEAR), xlabel="z/a")
    near.locator_params(axis="x", nbins=3)
    near.tick_params(labelleft=False)
    whole.set_ylim(0.0, 1.06 * max(axes.dataLim.y1 for axes in (whole, near)))
    place = {"loc": "upper left", "bbox_to_anchor": (0.09, 1.0), "borderaxespad": 0.1}
    entries = whole.get_legend_handles_labels()
    whole.figure.legend(*entries, ncols=2, columnspacing=1.2, **place)
