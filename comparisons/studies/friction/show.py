"""Partial slip on the page and in the terminal.

In: a run with [partial_slip]. Out: a table, facts, pictures of the tractions and of the loop, a
line."""

import numpy as np

from comparisons.common.numbers import percent, plain, scale_of, with_unit
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Names, Note, Pictures, TextTable, judged_cells
from comparisons.drawing.curves import over, panels
from comparisons.figures.quantity import LABELS, MODELS, WHOLE
from comparisons.studies.friction.half_planes import friction_of, last_visit
from comparisons.studies.friction.partial_slip import COMPARED, NAME, QUANTITIES
from comparisons.studies.study import WHY_NOT, Run

NOTE = """Tractions at the end of the path of loads, at the scene's largest friction coefficient:
where the surfaces stick |q| < μp, where they slip |q| = μp. Of alike half-planes q is the
difference of two normal solutions (Ciavarella, Jaeger); all else is loaded step by step. The
displacement is the roller's, against the ends of the pressure elements: a half-plane has no other
datum. Difference: (half-plane − finite elements) / finite elements."""


def files(run: Run) -> dict[str, dict[str, np.ndarray]]:
    """partial_slip.csv of each model: a row for each pressure element, at the end of the path."""
    return {
        f"{name}/partial_slip.csv": {
            "x [m]": curves.x,
            "friction times pressure [Pa]": curves.limit[-1],
            "traction [Pa]": curves.traction[-1],
            "slip in the last step [m]": curves.slip[-1],
        }
        for name, curves in run.data(NAME).curves.items()
    }


def blocks(run: Run) -> list[Block]:
    shown = slip_table(run), Names(slip_facts(run)), Note(NOTE)
    pictures = Pictures(("slip_tractions", "slip_loop"))
    return [Block("heat", (pictures, *shown), "Partial slip")]


def slip_table(run: Run) -> TextTable:
    """A row for each figure that both models may have."""
    known, rows = run.figures.of(study=NAME), []
    for quantity in COMPARED:
        values = [known.one(quantity=quantity, source=name, against=None) for name in MODELS]
        if not any(values):
            continue
        unit = QUANTITIES[quantity].unit
        texts = [with_unit(figure and figure.value, unit) for figure in values]
        difference = known.one(quantity=quantity, source=MODELS[0], against=MODELS[1])
        if difference is None:
            [only] = filter(None, values)
            judged = ("", percent(only.numerical), "", "not compared")
        else:
            judged = judged_cells(difference)
        rows.append((QUANTITIES[quantity].label, *texts, *judged))
    numbers = ("difference", "uncertainty", "tolerance")
    return TextTable("", ("", *map(LABELS.get, MODELS), *numbers, "verdict"), tuple(rows))


def slip_facts(run: Run) -> list[tuple[str, str]]:
    """The path of loads, what sticks, and what is not modelled."""
    scene, known = run.problem.scene, run.figures.of(study=NAME)
    slip, facts = scene.partial_slip, []
    path = ", ".join(f"{load:g}" for load in slip.path)
    facts.append(("tangential load over that of sliding", path))
    facts.append(("friction", plain(friction_of(run.problem))))
    if slip.bulk_stress:
        facts.append(("bulk stress at the largest load", with_unit(slip.bulk_stress, "Pa")))
    if last_visit(slip.path) is not None:
        facts.append(("the cycle", "since that load was reached before"))
    for figure in known.of(quantity="stick_ratio"):
        number = len(run.data(NAME).curves[figure.source].zones[-1])
        zones = f"{percent(figure.value)} of the contact, in {number} zone{'s' * (number != 1)}"
        facts.append((f"sticks ({LABELS[figure.source]})", zones))
    for figure in known.of(quantity="stick_length", against=None):
        if figure.source not in MODELS:
            difference = known.one(quantity="stick_length", source=figure.source, against=last(run))
            moved, uncertainty, _, verdict = judged_cells(difference)
            length = with_unit(figure.value, QUANTITIES["stick_length"].unit)
            said = f"{length}, {moved} ± {uncertainty} against the {LABELS[last(run)]}, {verdict}"
            facts.append((f"sticks ({figure.source}, from outside)", said))
    for figure in known.of(against=WHOLE):
        moved, uncertainty, _, verdict = judged_cells(figure)
        [part] = figure.parts
        said = f"{percent(part.value, signed=True)} ± {percent(part.uncertainty)}; with it the "
        said += f"half-plane is {moved} ± {uncertainty} off, {verdict}"
        facts.append((f"finite deformation: {QUANTITIES[figure.quantity].label}", said))
    why = run.findings[NAME].said(WHY_NOT)
    return facts + ([("not modelled", why)] if why else [])


def last(run: Run) -> str:
    """The model that answers from outside are compared with."""
    return list(run.data(NAME).curves)[-1]


def lines(run: Run) -> list[tuple[str, str]]:
    """What sticks, in a sentence."""
    slip, known = run.problem.scene.partial_slip, run.figures.of(study=NAME)
    shares = [
        f"{percent(figure.value)} ± {percent(figure.numerical)} ({LABELS[figure.source]})"
        for figure in known.of(quantity="stick_ratio")
    ]
    text = f"under {slip.path[-1]:g} of the load that makes it slide {', '.join(shares)}"
    text += " of the contact sticks"
    figure = known.one(quantity="stick_length", source=MODELS[0], against=MODELS[1])
    if figure is not None:
        difference, uncertainty, _, verdict = judged_cells(figure)
        text += f"; length {difference} ± {uncertainty}, {verdict}"
        judged = known.of(source=MODELS[0], against=MODELS[1])
        others = [f for f in judged if f.verdict != "agree" and f != figure]
        if others:
            listed = ", ".join(f"{QUANTITIES[f.quantity].label} {f.verdict}" for f in others)
            text += f"; {listed}"
        text += next_step(run)
    if (why := run.findings[NAME].said(WHY_NOT)) is not None:
        text += f"; of the finite elements {why}"
    return [("partial slip", text)]


def next_step(run: Run) -> str:
    """What would decide what is inconclusive, or what a difference means, as a clause."""
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


def tractions_picture(run: Run) -> style.Picture | None:
    """Tractions at the end between their limits, and the zones that stick."""
    if run.data(NAME) is None:
        return None
    drawn, [panel] = panels(style.WIDE, [(0.22, 2.6)])
    curves = run.data(NAME).curves
    unit = scale_of(next(iter(curves.values())).x, "m")
    for row, (name, one) in enumerate(curves.items()):
        x, look = one.x / unit.factor, style.LINES[name]
        thin = {**look, "linewidth": 0.5 * look["linewidth"]}
        panel.plot(x, one.traction[-1] / 1e6, label=f"traction, {LABELS[name]}", **look)
        for sign in (1.0, -1.0):
            label = f"± μp, {LABELS[name]}" if sign > 0.0 else None
            panel.plot(x, sign * one.limit[-1] / 1e6, label=label, **thin)
        bottom = (-1.08 - 0.05 * row) * one.limit[-1].max() / 1e6
        for start, stop in one.zones[-1] / unit.factor:
            panel.plot([start, stop], [bottom, bottom], color=look["color"], linewidth=3.0)
    panel.set_ylabel("traction [MPa]")
    over([panel], f"x [{unit.name}]", x)
    panel.legend(loc="upper right")
    share = f"{run.problem.scene.partial_slip.path[-1]:g}"
    caption = (
        f"Traction on the body under {share} of the load that makes it slide, between the limits "
        "that friction sets, thin. Bars below: the zones that stick."
    )
    return style.picture(drawn, caption, caption, wide=True)


def loop_picture(run: Run) -> style.Picture | None:
    """Tangential load over displacement along the path."""
    if run.data(NAME) is None or len(run.problem.scene.partial_slip.path) < 2:
        return None
    drawn, [panel] = panels(style.WIDE, [(0.22, 2.4)])
    path = (0.0, *run.problem.scene.partial_slip.path)
    curves = run.data(NAME).curves
    unit = scale_of(next(iter(curves.values())).displacement, "m")
    for name, one in curves.items():
        moved = np.concatenate([[0.0], one.displacement]) / unit.factor
        panel.plot(moved, path, label=LABELS[name], marker="o", markersize=3, **style.LINES[name])
    panel.set_ylabel("Q / μP")
    panel.set_xlabel(f"displacement of the roller [{unit.name}]")
    panel.legend(loc="upper left")
    caption = (
        "Tangential load over that of sliding along the path, against the roller's displacement. "
        "Between two loads the line is straight; what is lost is computed from slip."
    )
    return style.picture(drawn, caption, caption, wide=True)


PICTURES = {"slip_tractions": tractions_picture, "slip_loop": loop_picture}
