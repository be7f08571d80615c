"""The sources' figures, drawn again; each kind of picture has one scale for all surfaces.

The paper's: pressures over the surfaces under load (figure 1, and (a) of 6 and 8 to 10), normal
stresses on the axis (5), contours of the shear stresses, which it also shows as landscapes. Of
Seireg's book: rough spheres (4.5 and 4.6). Lengths are over a, stresses over p0."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from analytic.exact.hertz import hertz_stress
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from comparisons.campaigns.paper.book import HEAVY, LIGHT, SETS, contact, growth, real_pressure
from comparisons.campaigns.paper.claims import views_of
from comparisons.common.numbers import decimal, plain, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import load_text
from comparisons.drawing.field import colour_bar, cross, fill, round_bands
from comparisons.drawing.style import COLUMN, REFERENCE, WIDE, Picture, figure
from comparisons.figures.quantity import LABELS
from comparisons.models.problem import mean_height
from comparisons.output.page.pictures.stresses import COMPONENTS, Component
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RANGE = 1.25  # a, to either side
QUARTERS = 4  # of the trace, as figure 1 divides it
SCALE_BAR = 25e-6  # m, figure 1's scale of heights
LEFT, RIGHT, TOP, BETWEEN = 0.72, 0.22, 0.1, 0.12  # inches, of pressures over bodies
SHARE = 0.6  # of the panels' height, for the pressures
MICRO = 1e-6
SHALLOW, LOWEST = 0.1, -1.02  # of figure 5(b) [a], and of both [p0]
SIGMA = {"sx": ("σx", "#0072B2"), "sz": ("σz", "#D55E00")}
MARKERS = {"half_plane": "o", "finite_element": "x"}
ONE_PANEL = 0.13, 0.125, 0.83, 0.745  # shares of a picture: left, low, width, height
CONTOURS = {"colors": "#111111", "linewidths": 0.55, "linestyles": "dashed"}
TALL = (COLUMN - 0.75) / (2.0 * RANGE)  # inches: a half-width is as long down as along
FOOT, FIELD_FOOT, TITLE, BAR = 0.46, 0.86, 0.3, 0.1  # inches
COLOURS = dict(zip(SETS, ("#0072B2", "#D55E00", "#009E73"), strict=True))
LOADS = {"light": 0.1, "heavy": 100.0}  # T of figure 4.6


@dataclass(frozen=True)
class Scales:
    """Shared by all surfaces."""

    bands: dict[str, np.ndarray]  # of colour, by component's name [p0]
    pressure: float  # top of the pressures' axes [p0]
    relief: float  # height of the surfaces' axes [m]


def scales_of(runs: Collection[Run]) -> Scales:
    bands = {}
    for component in COMPONENTS:
        fields = [
            values_of(run, component, "half_plane", friction)
            for run in runs
            for friction in run.problem.scene.load.friction
        ]
        bands[component.name] = round_bands(fields, component.signed)
    highest = max(_highest(run, model) for run in runs for model in run.runs)
    return Scales(bands, 1.12 * highest, max(map(_relief, runs)))


def values_of(run: Run, component: Component, model: str, friction: float) -> np.ndarray:
    """A model's field on the run's window [p0]."""
    field = run.runs[model].finest.stress(friction).field
    return component.of(field) / run.problem.hertz.peak_pressure


def _highest(run: Run, model: str) -> float:
    """The highest pressure [p0]."""
    return float(run.runs[model].finest.solution.pressure.max() / run.problem.hertz.peak_pressure)


def _relief(run: Run) -> float:
    """Height [m] that both surfaces under load take, with room for the roller."""
    x, body, roller = trace_surfaces(run)
    near = np.abs(x) <= RANGE * run.problem.hertz.half_width
    return 1.45 * float(roller[near].max() - body[near].min())


def trace_surfaces(run: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x (n,) and the heights (n,) of body and roller under load [m] over the whole trace. From the
    half-plane's pressures, beyond the contact too; of a smooth body over the range of its pressure
    elements. The datum of the heights is arbitrary."""
    problem, level = run.problem, run.runs["half_plane"].finest
    profile, pitch, grid = problem.surface.profile, level.grid.pitch, level.grid
    if profile is not None:
        grid = HatGrid.within(float(profile.x[0]), float(profile.x[-1]), pitch)
    pressure = np.zeros(grid.count)
    first = level.grid.first - grid.first
    pressure[first : first + level.grid.count] = level.solution.pressure
    of_both = HalfPlane(grid.count, pitch, problem.modulus).apply(pressure) / grid.weights
    gap = grid.hat_integrals(problem.gap, problem.knots) / grid.weights + of_both
    gap -= np.median(gap[pressure > 0.0])
    displacement = problem.modulus / problem.scene.body.material.plane_strain_modulus * of_both
    body = mean_height(problem, grid) - displacement
    return grid.x, body, body + np.maximum(gap, 0.0)


def trace_picture(run: Run, scales: Scales) -> Picture:
    """Figure 1: pressures over the whole trace, and both bodies under load below them."""
    surface, hertz = run.problem.surface, run.problem.hertz
    drawn, (above, below) = _panels(WIDE, 4.4)
    origin = surface.position / MICRO
    _pressures(above, run, MICRO, origin, scales.pressure)
    x, body, roller = trace_surfaces(run)
    heights = [(part - body.max()) / MICRO for part in (body, roller)]
    _bodies(below, origin + x / MICRO, *heights)
    start, stop = origin + surface.profile.x[[0, -1]] / MICRO
    bar_at = start + 0.93 * (stop - start)
    low = below.get_ylim()[0] + 0.1 * SCALE_BAR / MICRO
    below.plot([bar_at, bar_at], [low, low + SCALE_BAR / MICRO], color="black", linewidth=2.2)
    at = bar_at - 0.008 * (stop - start), low + 0.5 * SCALE_BAR / MICRO
    below.text(*at, f"{SCALE_BAR / MICRO:g} µm", ha="right", va="center")
    below.set(yticks=[], xlabel="place on the trace [µm]")
    for axes in (above, below):
        axes.set(xlim=(start, stop), xticks=np.linspace(start, stop, QUARTERS + 1))
    return _picture(
        drawn,
        f"Contact pressure over the trace, up to {significant(_highest(run, 'half_plane'))} p₀, "
        "over the Hertz curve; below it roller and body under load.",
        "Pressure over the unrun trace, the Hertz curve and both bodies under load, "
        f"{load_text(run.problem)}; p₀ = {with_unit(hertz.peak_pressure, 'Pa')}, "
        f"a = {with_unit(hertz.half_width, 'm')}. Beyond the contact the surfaces are "
        "the half-plane's.",
    )


def pressure_picture(run: Run, scales: Scales, surface: str) -> Picture:
    """Panel (a): the same between -RANGE and RANGE, of a surface in words."""
    half_width = run.problem.hertz.half_width
    drawn, (above, below) = _panels(COLUMN, 3.9)
    _pressures(above, run, half_width, 0.0, scales.pressure)
    x, body, roller = trace_surfaces(run)
    near = np.abs(x) <= 1.01 * RANGE * half_width
    body, roller = body[near] / MICRO, roller[near] / MICRO
    foot = body.min() - 0.12 * scales.relief / MICRO
    _bodies(below, x[near] / half_width, body - foot, roller - foot)
    below.set(ylim=(0.0, scales.relief / MICRO), xlabel="x/a", ylabel="height [µm]")
    for axes in (above, below):
        axes.set(xlim=(-RANGE, RANGE), xticks=np.arange(-1.0, 1.01, 0.5))
    peaks = "; ".join(f"{LABELS[m]} {significant(_highest(run, m))} p₀" for m in run.runs)
    return _picture(
        drawn,
        f"Pressure on the {surface}, above both bodies under load. Largest: {peaks}.",
        f"Pressure on the {surface} by both models, and roller and body under load (half-plane), "
        f"heights stretched. Largest pressure: {peaks}.",
    )


def _picture(drawn: "Figure", alternative: str, caption: str) -> Picture:
    return style.picture(drawn, alternative, caption, data=False)


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


def _pressures(axes: "Axes", run: Run, unit: float, origin: float, top: float) -> None:
    """Over x in `unit` [m] from `origin`, up to `top` [p0]."""
    hertz = run.problem.hertz
    for name, of_model in run.runs.items():
        x, pressure = of_model.finest.grid.x, of_model.finest.solution.pressure
        curve = pressure / hertz.peak_pressure
        axes.plot(origin + x / unit, curve, label=LABELS[name], **style.LINES[name])
    x = np.linspace(-1.0, 1.0, 401) * hertz.half_width
    smooth = hertz.pressure(x) / hertz.peak_pressure
    axes.plot(origin + x / unit, smooth, label="Hertz, smooth", **REFERENCE)
    axes.set(ylim=(0.0, top), ylabel="p/p₀", yticks=np.arange(0.0, top, 1.0))
    axes.legend(loc="upper right", ncols=3, borderaxespad=0.1, columnspacing=1.2)


def _bodies(axes: "Axes", x: np.ndarray, body: np.ndarray, roller: np.ndarray) -> None:
    """Both bodies, filled."""
    low, high = body.min() - 0.3 * np.ptp(roller), roller.max()
    few = slice(None, None, 1 + len(x) // int(180 * axes.figure.get_figwidth()))
    style.fill_bodies(axes, x[few], body[few], roller[few], low, high + np.ptp(roller))
    for line in (body, roller):
        axes.plot(x[few], line[few], **{**style.OUTLINE, "linewidth": 0.7})
    axes.set_ylim(low, high)
    axes.text(0.5, 0.94, "roller", transform=axes.transAxes, ha="center", va="top")
    axes.text(0.01, 0.06, "body", transform=axes.transAxes, va="bottom")


def axis_picture(smooth: Run, depth: float, high: float) -> Picture:
    """Figure 5: normal stresses on the axis down to `depth` [a], from LOWEST to `high` [p0]."""
    hertz = smooth.problem.hertz
    drawn = figure(COLUMN, 3.7)
    axes = drawn.add_axes(ONE_PANEL)
    fine = np.linspace(0.0, depth, 201)
    exact = hertz_stress(hertz, 0.0, fine * hertz.half_width)
    for part, (symbol, colour) in SIGMA.items():
        values = getattr(exact, part) / hertz.peak_pressure
        axes.plot(values, fine, **{**REFERENCE, "color": colour, "linestyle": "-"})
        for model in smooth.runs:
            view = views_of(smooth, model)[-1]
            at = np.flatnonzero(view.z <= depth * (1.0 + 1e-9))
            at = at[:: max(1, len(at) // 16)]
            middle = int(np.argmin(np.abs(view.x)))
            computed = getattr(view.stress(0.0), part)[at, middle]
            look = {"marker": MARKERS[model], "markersize": 4.5, "markerfacecolor": "none"}
            look |= {"linestyle": "none", "color": colour, "label": f"{symbol}, {LABELS[model]}"}
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
    words = f"Normal stresses on the axis of the smooth contact{near}"
    return _picture(
        drawn,
        f"{words}, down to {depth:g} a: the marks of both models lie on the exact curves.",
        f"{words}; lines are exact (the paper's equations 6a and 6b), marks computed. "
        "Compression is negative.",
    )


def contour_picture(run: Run, component: Component, scales: Scales, surface: str) -> Picture:
    """A component at every friction coefficient: half-plane in bands, finite elements in lines."""
    a, window, frictions = run.problem.hertz.half_width, run.window, run.problem.scene.load.friction
    x, z = window.x / a, window.z / a
    near = np.abs(window.x) <= 1.01 * RANGE * a
    bands = scales.bands[component.name]
    total = FIELD_FOOT + len(frictions) * (TALL + TITLE)
    drawn = figure(COLUMN, total)
    extremes = []
    for place, friction in enumerate(frictions, start=1):
        low = total - place * (TALL + TITLE)
        axes = drawn.add_axes((0.62 / COLUMN, low / total, 2 * RANGE * TALL / COLUMN, TALL / total))
        values = values_of(run, component, "half_plane", friction)
        shown = fill(axes, x, z, values, bands, component.colours, component.signed)
        lines = values_of(run, component, "finite_element", friction)
        axes.contour(x[near], z, lines[:, near], levels=bands, **CONTOURS)
        axes.set(xlim=(-RANGE, RANGE), xticks=np.arange(-1.0, 1.01, 0.5))
        extreme = views_of(run, "half_plane")[-1].extreme(component.name, friction)
        cross(axes, extreme.x, extreme.z)
        extremes.append(
            f"friction {plain(friction)}: largest {significant(extreme.value, 3)} p₀ "
            f"at x = {decimal(extreme.x, 2)} a, z = {significant(extreme.z, 2)} a"
        )
        axes.set_title(extremes[-1])
        axes.tick_params(labelbottom=place == len(frictions))
    axes.set_xlabel("x/a")
    bar = drawn.add_axes((1.1 / COLUMN, 0.3 / total, (COLUMN - 1.3) / COLUMN, BAR / total))
    colour_bar(drawn, bar, shown, f"{component.symbol}/p₀", bands)
    words = f"{component.words.capitalize()} {component.symbol} below the {surface}"
    striped = ", stripes what is negative" if component.signed else ""
    return _picture(
        drawn,
        f"Contours. {words}. {'; '.join(extremes)}.",
        f"{words}: colours are the half-plane's, dashed lines the finite elements' at the bounds "
        f"of the colours; + marks the largest amount{striped}. Sliding acts on the body towards "
        "+x.",
    )


def real_pressure_picture() -> Picture:
    """Figure 4.5: mean real pressure of rough spheres over the load."""
    drawn = figure(COLUMN, 3.7)
    axes = drawn.add_axes(ONE_PANEL)
    loads = np.geomspace(LIGHT, HEAVY, 7)
    for name, summits in SETS.items():
        values = [1e3 * real_pressure(summits, load) for load in loads]
        axes.plot(loads, values, color=COLOURS[name], label=f"set {name}")
    axes.set(xscale="log", xlabel="T of set A", ylabel="mean real pressure [E*/1000]")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="lower right", ncols=3)
    grows = f"over three decades of load it grows by {growth():.2f} at most"
    return _picture(
        drawn,
        f"Mean real pressure of rough spheres of sets A, B and C against load: {grows}.",
        f"Mean real pressure on rough spheres of 10 mm, sets A, B and C: {grows}.",
    )


def spheres_picture() -> Picture:
    """Figure 4.6: pressures of a rough and a smooth sphere."""
    drawn = figure(COLUMN, 3.7)
    for place, (words, load) in enumerate(LOADS.items()):
        axes = drawn.add_axes((0.1 + 0.47 * place, 0.125, 0.41, 0.745))
        sphere = contact(SETS["A"], load)
        a, peak = sphere.smooth
        x = np.linspace(0.0, 1.0, 201)
        axes.plot(x, np.sqrt(1.0 - x**2), label="Hertz", **REFERENCE)
        axes.plot(sphere.rho / a, sphere.pressure / peak, color=COLOURS["A"], label="rough")
        bears = sphere.rho[sphere.pressure > 1e-3 * sphere.pressure[0]].max() / a
        axes.set(xlim=(0.0, max(bears, 1.1)), ylim=(0.0, 1.05), xlabel="r/a")
        axes.set_title(f"{words}, T = {load:g}")
    drawn.axes[0].set_ylabel("p/p₀")
    drawn.axes[1].legend(loc="upper right")
    return _picture(
        drawn,
        "Pressures of a rough and a smooth sphere under a light and a heavy load.",
        "Pressures of a rough sphere, set A, and Hertz's, under a light and a heavy load.",
    )
