"""The problem drawn from the scene itself: bodies to scale, and the contact close up."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import as_written, listed, plain, scale_of, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import load_text
from comparisons.judging.study import Run
from comparisons.models.assumptions import yielding_text
from comparisons.models.problem import Problem
from comparisons.output.page.tables.problem import coating_text, elastic_text, size_text
from comparisons.scenes.scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

VIEW = 1.15  # radii to either side in the drawing to scale
LAYERS_IN_VIEW = 5.0  # of a thin body instead
CLOSE_UP = 1.15, 2.0  # half-widths to either side in the close-up, at least and at most
RISE = 6.0  # of the roller over the close-up, in reliefs of the surface
ARROW = {"arrowstyle": "-|>,head_width=0.28,head_length=0.55", "shrinkA": 0.0, "shrinkB": 0.0}
FORCE = "#B3001B"
LINE = 0.11  # of the view: height of a line of words
POINTS = 800
EDGE = {"edgecolor": style.OUTLINE["color"], "linewidth": style.OUTLINE["linewidth"]}


def problem_picture(run: Run) -> style.Picture:
    """Roller, body, load and sliding; above to scale, below with the heights stretched."""
    scene = run.problem.scene
    drawn = style.figure(style.COLUMN, 5.3)
    to_scale, close_up = style.stacked(drawn, [(0.12, 2.92), (0.54, 1.22)], 0.7, 0.14)
    _to_scale(to_scale, run.problem)
    stretch = _close_up(close_up, run.problem)
    body = "the rough body" if scene.profile is not None else "the smooth body"
    radius = "" if scene.periodic else f" of radius {as_written(scene.roller.radius, 'm')}"
    frictions = listed(scene.load.friction)
    sliding = f", sliding with friction {frictions}" if any(scene.load.friction) else ""
    return style.picture(
        drawn,
        f"A {scene.smooth_body}{radius} pressed on {body} by {load_text(run.problem)}{sliding}; "
        f"{'; '.join(_body_in_words(scene))}.",
        f"The problem. Above: to scale. Below: {scene.smooth_body} and {body} at first touch, "
        f"before loading, heights stretched {plain(float(f'{stretch:.2g}'))} times; the bar "
        f"is {'the period' if scene.periodic else 'the width'} 2a"
        f"{'' if scene.periodic else ' of the Hertz contact under the same load'}.",
        data=False,
    )


def _to_scale(axes: "Axes", problem: Problem) -> None:
    from matplotlib.patches import Circle, Rectangle

    scene, radius = problem.scene, problem.scene.roller.radius
    view = 1.5 * problem.period if scene.periodic else VIEW * radius
    if scene.body.thickness is not None:
        least = max(LAYERS_IN_VIEW * scene.body.thickness, 4.0 * problem.hertz.half_width)
        view = min(view, least)
    unit = scale_of([view], "m")
    view /= unit.factor
    half = view if scene.body.width is None else min(view, 0.5 * scene.body.width / unit.factor)
    depth = np.inf if scene.body.thickness is None else scene.body.thickness / unit.factor
    below = min(depth, 0.42 * view)
    for look in (style.ROLLER, {"fill": False, **EDGE}):
        if scene.periodic:
            axes.add_patch(Rectangle((-2.0 * view, 0.0), 4.0 * view, 0.62 * view, **look))
        else:
            axes.add_patch(Circle((0.0, radius / unit.factor), radius / unit.factor, **look))
    across = np.linspace(-half, half, 200)
    torn = depth > below  # the drawing ends before the body does
    bottom = 0.02 * view * np.sin(24.0 * across / view) if torn else 0.0
    axes.fill_between(across, bottom - below, 0.0, **style.BODY)
    axes.plot([-half, half], [0.0, 0.0], **style.OUTLINE)
    for side in (-half, half) if scene.body.width is not None and half < view else ():
        axes.plot([side, side], [-below, 0.0], **style.OUTLINE)
    if not torn:
        _base(axes, half, below, scene.body.base == "frictionless")
    _arrow(axes, (0.0, 0.62 * view), (0.0, 0.06 * view))
    lowest = _words(axes, problem, (view, half, below), roomy=torn and half == view)
    labels = {"xlabel": f"x [{unit.name}]", "ylabel": f"height [{unit.name}]"}
    axes.set(xlim=(-view, view), ylim=(lowest, 0.73 * view), aspect="equal", **labels)
    axes.grid(False)


def _words(axes: "Axes", problem: Problem, sizes: tuple[float, float, float], roomy: bool) -> float:
    """Load, roller, body and traction in words; the lowest z that is to be seen.

    sizes  half the view's width, half the body's, and its depth
    roomy  words of the body stand in it, where it is large; else under it"""
    scene, (view, half, below) = problem.scene, sizes
    note = {"va": "center", "linespacing": 1.35}
    load = f"{'p₀' if scene.periodic else 'P'} = {load_text(problem)}"
    axes.text(0.03 * view, 0.42 * view, load, color=FORCE, **note)
    material = "rigid" if scene.roller.rigid else elastic_text(scene.roller.material)
    radius = "" if scene.periodic else f"\nR = {as_written(scene.roller.radius, 'm')}"
    roller = f"{scene.smooth_body}{radius}\n{material}".replace(", ", "\n")  # inside the circle
    axes.text(-0.03 * view, 0.44 * view, roller, ha="right", **note)
    rough = "rough body" if scene.profile is not None else "body"
    said = "\n".join([f"{rough}, {elastic_text(scene.body.material)}", *_body_in_words(scene)])
    tall = LINE * view * (1 + said.count("\n"))
    words = -0.5 * below if roomy else -1.2 * below - 0.03 * view - 0.5 * tall
    axes.text(-0.97 * view, words, said, **note)
    if any(scene.load.friction):
        traction = f"q = µ p,  µ = {listed(scene.load.friction)}"
        start, end = (0.71, 0.97) if roomy else (0.08, 0.34)
        _arrow(axes, (start * half, -0.32 * below), (end * half, -0.32 * below))
        above = -0.55 * below if roomy else words + 0.5 * (tall - LINE * view)
        axes.text(0.97 * view, above, traction, color=FORCE, ha="right", **note)
    return -1.14 * below if roomy else words - 0.5 * tall - 0.01 * view


def _base(axes: "Axes", half: float, below: float, frictionless: bool) -> None:
    """The rigid base under a body of finite thickness: hatched; on rollers where it may slide."""
    thick = 0.1 * below
    gap = 0.06 * below if frictionless else 0.0
    if frictionless:
        places = np.linspace(-half, half, 25)[1:-1]
        look = {"linestyle": "", "marker": "o", "markersize": 2.2, "color": style.OUTLINE["color"]}
        axes.plot(places, np.full(len(places), -below - 0.5 * gap), **look)
    top = -below - gap
    corners = [-half, half, half, -half], [top - thick, top - thick, top, top]
    axes.fill(*corners, facecolor="none", **EDGE, **style.HATCHED)


def _close_up(axes: "Axes", problem: Problem) -> float:
    """Surfaces at first touch; returns how much more heights are stretched than lengths."""
    scene, half_width = problem.scene, problem.hertz.half_width
    profile = problem.surface.profile
    relief = 0.0 if profile is None else np.ptp(profile.height)
    reach = np.sqrt(2.0 * scene.roller.radius * RISE * relief) if relief else np.inf
    reach = np.clip(reach / half_width, *CLOSE_UP) * half_width
    if scene.periodic:
        reach = 1.5 * problem.period
    low, high = min(-reach, problem.extent[0]), max(reach, problem.extent[1])
    if profile is not None and not scene.periodic:
        low, high = max(low, profile.x[0]), min(high, profile.x[-1])
    if scene.body.width is not None:
        low, high = max(low, -0.5 * scene.body.width), min(high, 0.5 * scene.body.width)
    x = np.linspace(low, high, POINTS)
    body = np.zeros_like(x) if profile is None else profile.spline()(x)
    parabola = x**2 / (2.0 * scene.roller.radius)
    roller = parabola + np.max(body - parabola)
    along, up = scale_of([high], "m"), scale_of([np.max(roller), np.ptp(body)], "m")
    bottom, top = body.min() - 0.35 * (roller.max() - body.min()), roller.max()
    position = x / along.factor
    ends = bottom / up.factor, top / up.factor
    style.fill_bodies(axes, position, body / up.factor, roller / up.factor, *ends)
    axes.plot(position, roller / up.factor, **style.OUTLINE)
    axes.plot(position, body / up.factor, **{**style.OUTLINE, "linewidth": 0.7})
    at = 0.5 * (bottom + body.min()) / up.factor
    reach = half_width / along.factor
    axes.plot([-reach, reach], [at, at], color="black", marker="|", markersize=8, linewidth=1.2)
    clear = {"facecolor": style.BODY["facecolor"], "edgecolor": "none", "pad": 1.5}
    words = f"2a = {with_unit(2.0 * half_width, 'm')}"
    axes.text(0.0, at, words, ha="center", va="center", bbox=clear)
    axes.set(
        xlim=(position[0], position[-1]), xlabel=f"x [{along.name}]", ylabel=f"height [{up.name}]"
    )
    box = axes.get_position()
    wide, tall = axes.figure.get_size_inches() * (box.width, box.height)
    return (tall / (top - bottom)) / (wide / (high - low))


def _arrow(axes: "Axes", tail: tuple[float, float], tip: tuple[float, float]) -> None:
    axes.annotate("", tip, tail, arrowprops={**ARROW, "color": FORCE, "linewidth": 1.8})


def _body_in_words(scene: Scene) -> list[str]:
    """Size and support of the body, and what the finite elements' body has besides."""
    words = [size_text(scene.body)]
    if scene.coating is not None:
        words.append(f"coating {coating_text(scene.coating)}")
    if scene.body.yield_stress is not None:
        words.append(f"yields {yielding_text(scene.body)}")
    return words
