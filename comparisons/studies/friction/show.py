"""Partial slip on the page and in the terminal.

In: a run with [partial_slip]. Out: facts, pictures of the tractions and of the loop."""

import numpy as np

from comparisons.common.numbers import listed, scale_of, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import (
    distinct,
    draw,
    joint_label,
    legend_above,
    names_above,
    over,
    panels,
)
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.judging.study import Run
from comparisons.studies.friction.half_planes import SlippedLevel, last_visit
from comparisons.studies.friction.partial_slip import NAME

NOTE = """Tractions at the end of the path of loads, at the scene's largest friction coefficient:
where the surfaces stick |q| < μp, where they slip |q| = μp. Of alike half-planes q is the
difference of two normal solutions (Ciavarella, Jaeger); all else is loaded step by step. The
displacement is the roller's, against the ends of the pressure elements: a half-plane has no other
datum. Difference: (half-plane − finite elements) / finite elements."""


def files(run: Run) -> dict[str, dict[str, np.ndarray]]:
    """partial_slip.csv of each model: a row for each pressure element, at the end of the path."""
    return {
        f"{name}/partial_slip.csv": {
            "x [m]": level.grid.x,
            "friction times pressure [Pa]": limit_of(run, level),
            "traction [Pa]": level.states[-1].traction,
            "slip in the last step [m]": level.states[-1].slip,
        }
        for name, level in run.data(NAME).items()
    }


def limit_of(run: Run, level: SlippedLevel) -> np.ndarray:
    """Friction times pressure (n,) [Pa] at the end of the path."""
    return run.problem.largest_friction * level.states[-1].normal.pressure


def slip_facts(run: Run) -> list[tuple[str, str]]:
    """The path of loads, and how many zones stick."""
    slip = run.problem.scene.partial_slip
    facts = [("tangential load over that of sliding", listed(slip.path))]
    if slip.bulk_stress:
        facts.append(("bulk stress at the largest load", with_unit(slip.bulk_stress, "Pa")))
    if last_visit(slip.path) is not None:
        facts.append(("the cycle", "since that load was reached before"))
    zones = (f"{len(level.zones[-1])} ({LABELS[name]})" for name, level in run.data(NAME).items())
    return [*facts, ("zones that stick", ", ".join(zones))]


def next_step(run: Run) -> str:
    """Clause on what would decide what is inconclusive, or on what a difference means."""
    known = run.figures.of(study=NAME, source=MODELS[0], against=MODELS[1])
    figures = [figure for figure in known if figure.verdict != "agree"]
    if not figures:
        return ""
    open_ones = [figure for figure in figures if figure.verdict == "inconclusive"]
    if not open_ones:
        return "; the finite elements have what the half-plane has not, theirs are the figures"
    worst = max(open_ones, key=lambda figure: figure.numerical).uncertainty.parts
    cause = max(worst, key=worst.get)
    scene = run.problem.scene
    steps = {
        "increments": f"partial_slip.increments = {2 * scene.partial_slip.increments}",
        "domain": f"finite_element.block = {2.0 * scene.finite_element.block:g}",
    }
    return f"; next: {steps.get(cause, f'budget = {{time = {2.0 * scene.budget.time:g}}}')}"


def tractions_picture(run: Run) -> style.Picture:
    """Tractions at the end between their limits, and the zones that stick."""
    share = f"{run.problem.scene.partial_slip.path[-1]:g}"
    caption = (
        f"Traction on the body under {share} of the load that makes it slide, between the limits "
        "that friction sets, dotted. Bars below: the zones that stick, a row for each model."
    )
    levels = run.data(NAME)
    abreast, room = names_above(style.COLUMN, 2 * len(levels))
    drawn, [panel] = panels(style.COLUMN, [(room, 2.5)])
    unit = scale_of(next(iter(levels.values())).grid.x, "m")
    places = {n: one.grid.x / unit.factor for n, one in levels.items()}
    tractions = {n: (places[n], one.states[-1].traction / 1e6) for n, one in levels.items()}
    limits = {n: (places[n], limit_of(run, one) / 1e6) for n, one in levels.items()}
    draw(panel, tractions, ", traction")
    apart = distinct(limits)
    for names, (x, limit) in apart.items():
        look = {**style.REFERENCE, "color": style.LINES[names[0]]["color"]}
        label = "± μp" if len(apart) == 1 else joint_label(names, ", ± μp")
        panel.plot(x, limit, label=label, **look)
        panel.plot(x, -limit, **look)
    for row, (name, one) in enumerate(levels.items()):
        bottom = (-1.08 - 0.05 * row) * limits[name][1].max()
        for start, stop in one.zones[-1] / unit.factor:
            look = {"color": style.LINES[name]["color"], "linewidth": 3.0}
            panel.plot([start, stop], [bottom, bottom], **look)
    panel.set_ylabel("traction [MPa]")
    over([panel], f"x [{unit.name}]", next(iter(places.values())))
    legend_above(panel, abreast)
    return style.picture(drawn, caption, caption)


def loop_picture(run: Run) -> style.Picture | None:
    """Tangential load over displacement along the path; None of a single load."""
    if len(run.problem.scene.partial_slip.path) < 2:
        return None
    caption = (
        "Tangential load over that of sliding along the path, against the roller's displacement. "
        "Between two loads the line is straight; what is lost is computed from slip."
    )
    levels, path = run.data(NAME), (0.0, *run.problem.scene.partial_slip.path)
    abreast, room = names_above(style.COLUMN, len(levels))
    drawn, [panel] = panels(style.COLUMN, [(room, 2.67)])
    unit = scale_of(next(iter(levels.values())).displacements, "m")
    moved = {n: np.append(0.0, one.displacements) / unit.factor for n, one in levels.items()}
    steps = np.arange(len(path))
    for names, (_, along) in distinct({n: (steps, m) for n, m in moved.items()}).items():
        look = {"marker": "o", "markersize": 3, **style.LINES[names[0]]}
        panel.plot(along, path, label=joint_label(names), **look)
    panel.set(xlabel=f"displacement of the roller [{unit.name}]", ylabel="Q / μP")
    legend_above(panel, abreast)
    return style.picture(drawn, caption, caption)


PICTURES = {"slip_tractions": tractions_picture, "slip_loop": loop_picture}
