"""Where a slab is no half-space for the heat of friction: thickness against Peclet number.

`python -m tests.heat_map FOLDER` solves Hertz's contact of a steel roller that slides on a steel
slab at every point of the map, by the half-space and by finite elements under the same pressures on
three levels, and writes heat-map.svg and the table of `comparisons/docs/figures.md` there.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from comparisons.assessment.convergence import grid_convergence
from comparisons.assessment.verdict import judge
from comparisons.common.progress import Stages, no_progress
from comparisons.models.finite_element.heat import finite_element_heat
from comparisons.models.half_plane import half_plane_level
from comparisons.models.heat import half_space_heat, peclet_numbers
from comparisons.models.problem import Problem, problem_of
from comparisons.report.figures import style
from comparisons.scenes.resolve import load_scene

THICKNESSES = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0)  # half-widths
PECLETS = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
BASES = ("held", "insulated")
TOLERANCE = 0.05
COLOURS = {"agree": "#56B4E9", "inconclusive": "#F0E442", "differ": "#E69F00"}
FLASH = "flash_temperature"


def smooth() -> Problem:
    """The library's scene without its waves."""
    scene = load_scene("frictional-heat")
    return problem_of(replace(scene, profile=None, profile_info=None))


def at_speed(problem: Problem, peclet: float, thickness: float | None, base: str) -> Problem:
    """The same contact at the speed of a Peclet number, on a slab [half-widths]."""
    heat = problem.scene.heat
    speed = heat.speed * peclet / peclet_numbers(problem)["body"]
    own = thickness and thickness * problem.hertz.half_width
    heat = replace(heat, speed=speed, base=base)
    return replace(problem, scene=replace(problem.scene, heat=heat, thickness=own))


def flash(problem: Problem, levels: tuple, solve) -> tuple[float, float]:
    """The largest rise [K] on the finest level, and its relative uncertainty."""
    found = grid_convergence([solve(problem, each).figures[FLASH] for each in levels], 1.0)
    return found.value, found.uncertainty / found.value


def points() -> dict[tuple[str, float, float], tuple[float, float, str]]:
    """By base, thickness and Peclet number: error of the half-space, uncertainty, verdict."""
    problem, found = smooth(), {}
    stages = Stages(no_progress)
    levels = tuple(half_plane_level(problem, p, None, stages, False) for p in problem.pitches)
    for peclet in PECLETS:
        half_space, own = flash(at_speed(problem, peclet, None, "held"), levels, half_space_heat)
        for base in BASES:
            for thickness in THICKNESSES:
                given = at_speed(problem, peclet, thickness, base)
                slab, other = flash(given, levels, finite_element_heat)
                error, uncertainty = half_space / slab - 1.0, own + other
                verdict = judge(error, uncertainty, TOLERANCE)
                found[base, thickness, peclet] = error, uncertainty, verdict
                print(base, thickness, peclet, f"{error:+.2%} +- {uncertainty:.2%}", verdict)
    return found


def picture(found: dict) -> str:
    """SVG: a panel for each base, errors in per cent."""
    with style.drawing():
        drawn = style.figure(6.4, 5.7)
        panels = style.stacked(drawn, [(0.3, 2.1)] * len(BASES), 0.7)
        for axes, base in zip(panels, BASES, strict=True):
            for row, thickness in enumerate(THICKNESSES):
                for column, peclet in enumerate(PECLETS):
                    error, _, verdict = found[base, thickness, peclet]
                    x, y = column + np.array([-0.5, 0.5, 0.5, -0.5]), row + np.array([-0.5] * 2)
                    corners = np.concatenate([y, y + 1.0])
                    axes.fill(x, corners, facecolor=COLOURS[verdict], edgecolor="white")
                    axes.text(column, row, f"{100 * error:+.1f}", ha="center", va="center")
            axes.set(xlim=(-0.5, len(PECLETS) - 0.5), ylim=(-0.5, len(THICKNESSES) - 0.5))
            axes.set_yticks(range(len(THICKNESSES)), [f"{t:g}" for t in THICKNESSES])
            axes.set_xticks(range(len(PECLETS)), [f"{p:g}" for p in PECLETS])
            axes.set(ylabel="thickness / a", title=f"base {base}: error of the half-plane, %")
            axes.grid(False)
        panels[0].tick_params(labelbottom=False)
        panels[-1].set_xlabel("Peclet number V a / 2κ")
        look = {"marker": "s", "linestyle": "none"}
        keys = [axes.plot([], [], color=c, label=n, **look)[0] for n, c in COLOURS.items()]
        drawn.legend(handles=keys, loc="lower left", ncols=3, borderaxespad=0.5)
        return style.svg(drawn)


def table(found: dict, base: str) -> str:
    """Markdown: errors in per cent, bold where the half-space differs."""
    lines = ["| thickness / a \\ Peclet | " + " | ".join(f"{p:g}" for p in PECLETS) + " |"]
    lines.append("| --- " * (len(PECLETS) + 1) + "|")
    marks = {"agree": "{}", "differ": "**{}**", "inconclusive": "{}?"}
    for thickness in THICKNESSES:
        row = [found[base, thickness, peclet] for peclet in PECLETS]
        cells = [marks[v].format(f"{100 * e:+.1f}".replace("-", "−")) for e, _, v in row]
        lines.append(f"| {thickness:g} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    made = points()
    (folder / "heat-map.svg").write_text(picture(made), encoding="utf-8")
    text = "\n\n".join(f"Base {base}:\n\n{table(made, base)}" for base in BASES)
    (folder / "heat-map.md").write_text(text, encoding="utf-8")
