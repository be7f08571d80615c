"""The half-plane's model error on the page and in the terminal: rows, effects, waterfalls.

In: a run of both models. Out: tables, lines, and a picture of waterfalls: from nothing, effect by
effect, to the error; one for each judged figure and friction coefficient, or for each there is
where nothing is judged."""

import math
from collections.abc import Sequence
from dataclasses import replace
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import UNKNOWN, listed, percent, plain, with_unit
from comparisons.drawing import curves, style
from comparisons.drawing.blocks import Block, Note, Pictures, TextTable
from comparisons.drawing.tables import figure_table
from comparisons.figures.figure import Figure, grouped
from comparisons.figures.quantity import MODELS, QUANTITIES, WHOLE, error_text, label
from comparisons.judging import contact
from comparisons.judging.effects.catalogue import EFFECTS, FLOW, LAW
from comparisons.judging.model_error.model_error import INTERACTION, JUMP
from comparisons.judging.study import LADDER, MODEL_ERROR, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn

ROUNDING = 1e-12  # of a figure's scale: what two of them leave where it is zero
SHOWN = 5e-4  # effects below this, and below a tenth of the error, are not listed
TRUST = "law of elasticity"  # statement: what is said of the strains that it bears
WORDS = {INTERACTION: "interaction", JUMP: "another asperity"}  # of parts that are no effects
ROW, TITLE, FOOT, TOP = 0.21, 0.42, 0.5, 0.06  # inches: a step, the words above and below
NAMES, BETWEEN, RIGHT = 1.95, 0.25, 0.1  # inches: names of the steps, from panel to panel
WIDTH = 2.85  # inches of a panel, about
BAR = 0.66  # of a row
NOTHING = 1e-6  # a step below it is none
TITLE_LETTERS = 15.0  # to the inch
ROOM = 0.3, 0.08  # beyond the bars, share of their range: for numbers to the right, to the left
NUMERICAL, OTHERS, ERROR = "without any effect", "smaller steps", "model error"
LOOKS = {
    True: {"facecolor": "#E69F00", "edgecolor": "#333333"},
    False: {"facecolor": "#56B4E9", "edgecolor": "#333333", **style.HATCHED},
}
NOTE = """Model error: (half-plane − whole model) / whole model, which is a finite element solution
with every effect that may matter here. A minus says that the half-plane's figure is too low. In
grey its contributions: each effect was computed by itself, as the difference that it makes in the
finite elements; *interaction* is what the effects change jointly beyond their sum. A largest value
is followed at the asperity where the whole model has it; *another asperity* is what the
half-plane's largest exceeds its own value there, and both places are named. *Not modelled* under a
quantity: effects that no model has may exceed its tolerance. The verdict is taken from these
errors."""
OF_EFFECTS = """An effect is computed where its estimate, from the scene's dimensionless groups,
exceeds a tenth of a tolerance; an effect that was not computed counts with its estimate."""


def blocks(run: Run) -> list[Block]:
    items = Pictures(("model_error",)), error_table, Note(NOTE), effects_table, Note(OF_EFFECTS)
    return [Block("model-error", items, "Model error of the half-plane")]


def lines(run: Run) -> list[tuple[str, str]]:
    """Lines on what is not modelled, and on largest values that stand at another asperity."""
    missing = not_modelled_line(run)
    said = [("not modelled", missing)] if missing else []
    if (strained := run.findings[MODEL_ERROR].said(TRUST)) is not None:
        said.append((TRUST, strained))
    for error in run.model_errors:
        if moved := _moved(error):
            name = QUANTITIES[error.quantity].short
            said.append(("another asperity", f"{name}, friction {plain(error.friction)}: {moved}"))
    return said


def error_table(run: Run, brief: bool = False) -> TextTable:
    """The half-plane's figures, the whole model's and the errors; below a name what the error is
    made of, what is not modelled of it, and where that has its largest value if not at the
    half-plane's asperity.

    brief  for a terminal: what is judged, and beside it most of what makes it up"""
    errors = [error for error in run.figures.of(study=MODEL_ERROR) if error.bounds or not brief]
    of_contact = run.figures.of(study=contact.NAME, source=MODELS[0])
    known = [of_contact.one(quantity=error.quantity, at=error.at) for error in errors]
    known += [_whole(run, error) for error in errors]

    def below(figure: Figure) -> str:
        if figure.against is None or brief:
            return ""
        said = ", ".join(contributions(run, figure)), _not_known(run, figure), _moved(figure)
        return "\n".join(filter(None, said))

    def size(error: Figure) -> tuple[str, str]:
        if leaves_flow_out(run, error):
            return UNKNOWN, UNKNOWN
        return sized_by_law(error), percent(error.numerical)

    def most(error: Figure) -> str:
        largest = "".join(contributions(run, error)[:1]).replace(" %", "")
        return "\n".join(filter(None, (largest, _not_known(run, error))))

    beside = {"mostly by, %": most} if brief else {}
    return figure_table((*known, *errors), QUANTITIES, "", below, beside, size, brief)


def _whole(run: Run, error: Figure) -> Figure:
    """The whole model's figure; unknown where flow is left out."""
    known = run.figures.one(study=LADDER, source=WHOLE, quantity=error.quantity, at=error.at)
    return replace(
        error,
        source=WHOLE,
        against=None,
        value=math.nan if leaves_flow_out(run, error) else figure_of_whole(run, error),
        uncertainty=None if known is None else known.uncertainty,
        bounds=None,
    )


def figure_of_whole(run: Run, error: Figure) -> float:
    """[SI] what a model error is against: its scale, but where that figure is zero or negative."""
    known = {"study": contact.NAME, "source": error.source, "quantity": error.quantity}
    half_plane = run.figures.one(**known, friction=error.friction).value
    whole = half_plane - error.scale * error.value
    return whole if abs(whole) > ROUNDING * error.scale else 0.0


def leaves_flow_out(run: Run, error: Figure) -> bool:
    """Whether flow that no model has may exceed the tolerance: an error of elastic bodies says
    nothing then. A hardness stands for flow."""
    stands_for_it = run.problem.scene.body.hardness is not None
    may_flow = error.bounds is not None and error.unknown.get(FLOW, 0.0) > error.tolerance
    return may_flow and not stands_for_it


def _not_known(run: Run, error: Figure) -> str:
    """Words where effects that no model has may exceed the tolerance; else nothing."""
    if leaves_flow_out(run, error):
        return f"{EFFECTS[FLOW].label} not modelled"
    others = beside_its_range(error)
    if error.bounds is None or others <= error.tolerance:
        return ""
    return f"{percent(others)} not modelled" if math.isfinite(others) else "not known"


def beside_its_range(error: Figure) -> float:
    """What no model has of the error, without what its own range by the law of elasticity shows."""
    return math.hypot(*(size for name, size in error.unknown.items() if not error.part(name)))


def sized_by_law(error: Figure) -> str:
    """The error in per cent; where the scene names no solid its range by the law of elasticity."""
    part = error.part(LAW)
    if part is None or not part.uncertainty:
        return error_text(error.value, error.numerical)
    ends = (error.value - part.uncertainty, error.value + part.uncertainty)
    low, high = (error_text(end, error.numerical).removesuffix(" %") for end in ends)
    return f"{low} to {high} %"


def flow_taken(errors: Sequence[Figure]) -> str:
    """Clause on what flow by itself takes off, or adds to, the half-plane's figures, where that is
    most of their errors; else empty."""
    changes = []
    for error in errors:
        part = error.part(FLOW)
        if part is not None and -part.value * np.sign(error.value) > 0.5 * abs(error.value):
            size = part.value / (1.0 + error.value)
            what = "takes {} off" if size < 0.0 else "adds {} to"
            changes.append(f"{what.format(percent(abs(size)))} the {label(error.quantity)}")
    parts = filter(None, (", ".join(changes[:-1]), *changes[-1:]))
    return f"flow {' and '.join(parts)}" if changes else ""


def _moved(error: Figure) -> str:
    if error.place is None:
        return ""
    before, after = (with_unit(x, "m", 4) for x in error.place)
    return f"at x = {after}, of the half-plane at {before}"


def steps_of(error: Figure) -> dict[str, float]:
    """Steps that add up to a model error: what is numerical, and its parts, with their signs: an
    effect that raises the finite elements' figure makes the half-plane's too low."""
    sizes = {}
    for part in error.parts:
        name = EFFECTS[part.name].label if part.name in EFFECTS else WORDS[part.name]
        sizes[name] = part.value if part.name == JUMP else -part.value
    return {NUMERICAL: error.value - sum(sizes.values()), **sizes}


def contributions(run: Run, error: Figure) -> tuple[str, ...]:
    """Parts of a model error in words, the largest first; nothing where the error says nothing."""
    if leaves_flow_out(run, error):
        return ()
    parts = (step for step in _large(error) if step[0] != NUMERICAL)
    large = sorted(parts, key=lambda item: -abs(item[1]))
    return tuple(f"{name} {error_text(size)}" for name, size in large)


def not_modelled_line(run: Run) -> str:
    """The effects that may matter and that no model of the run has, by reason, each with its
    largest estimate."""
    selection = run.data(MODEL_ERROR).selection
    parts = []
    for same in grouped(selection.impossible, selection.impossible.get):
        sizes = [percent(_largest(run, selection.estimates[name])) for name in same]
        named = ", ".join(
            EFFECTS[name].label + (f" (at most {size})" if size != UNKNOWN else "")
            for name, size in zip(same, sizes, strict=True)
        )
        parts.append(f"{named}: {selection.impossible[same[0]]}")
    if (left := run.findings[MODEL_ERROR].said("left out")) is not None:
        parts.append(f"left out is {left}")
    return "; ".join(parts)


def effects_table(run: Run) -> TextTable:
    """Status of each effect that the half-plane does not model."""
    rows = []
    for row in run.findings[MODEL_ERROR].table("effects").rows():
        if row["status"] != "does not apply":
            effect = EFFECTS[row["effect"]]
            estimate = {name: row[name] for name in QUANTITIES if row[name] is not None}
            largest = percent(_largest(run, estimate)) if estimate else ""
            rows.append((effect.label, effect.words, row["status"], largest, row["because"]))
    head = ("effect", "not modelled by the half-plane", "status", "estimate, at most", "because")
    return TextTable("", head, tuple(rows), "comparison prose")


def _largest(run: Run, estimate: dict[str, float]) -> float:
    """Largest estimate of an effect on what is judged, or on anything where nothing is."""
    judged = set(run.problem.scene.tolerances) & set(estimate)
    return max(estimate[name] for name in judged or estimate)


def waterfalls(run: Run) -> dict[str, Figure]:
    """Errors by title, of what is judged, or everything; one for all friction coefficients of equal
    figures."""
    panels, errors = {}, run.figures.of(study=MODEL_ERROR, against=WHOLE)
    names = {error.quantity for error in run.model_errors or errors}
    shown = [e for name in QUANTITIES if name in names for e in errors.of(quantity=name)]

    def drawn_of(error: Figure) -> tuple:
        """Parts of an error that its panel shows: equal ones have one."""
        parts = tuple(part for part in error.parts if part.name in EFFECTS)
        return error.quantity, error.value, parts

    for error, *same in grouped(shown, drawn_of):
        frictions = tuple(figure.friction for figure in (error, *same))
        is_every = frictions == tuple(run.problem.scene.load.friction)
        at = "" if is_every else f", μ = {listed(frictions)}"
        panels[label(error.quantity) + at] = error
    return panels


def model_error_picture(run: Run) -> style.Picture | None:
    """Waterfalls side by side; None with one model."""
    panels = waterfalls(run)
    if not panels:
        return None
    said = "; ".join(
        f"{title}: {error_text(error.value, error.numerical)}"
        + "".join(f", {name} {error_text(size)}" for name, size in _large(error))
        for title, error in panels.items()
    )
    judged = any(error.tolerance for error in panels.values())
    lines = "; broken lines: the tolerance" if judged else ""
    return style.picture(
        _drawn(panels),
        f"The half-plane's model error, step by step. {said}.",
        "How the half-plane's model error comes about, in per cent of the whole model's "
        "figure: it starts with the half-plane's difference from finite elements without any of "
        "the effects, which is numerical, and each effect moves it, to the left (hatched) where "
        "the half-plane's figure becomes too low. "
        "Black: the error with its uncertainty; thin: with what is not modelled, "
        f"cut off without an end where it would hide the steps{lines}.",
        data=("CSV", style.csv_uri(_table(panels))),
    )


def _table(panels: dict[str, Figure]) -> list[list[object]]:
    """Every step of every panel, relative; then the error with what may be wrong with it."""
    rows: list[list[object]] = [["quantity", "step", "relative size"]]
    for title, error in panels.items():
        ends = {
            ERROR: error.value,
            "uncertainty": error.numerical,
            "not modelled (estimate)": error.not_modelled,
            "tolerance": error.tolerance,
        }
        sizes = (steps_of(error) | ends).items()
        rows += [[title, step, f"{size:.6g}"] for step, size in sizes if size is not None]
    return rows


def _large(error: Figure) -> list[tuple[str, float]]:
    """The steps to an error that are worth a row."""
    least = max(SHOWN, 0.1 * abs(error.value))
    return [(name, size) for name, size in steps_of(error).items() if abs(size) >= least]


def _drawn(panels: dict[str, Figure]) -> "Drawn":
    """All panels with the same rows, as many side by side as there is room for."""
    abreast = min(int((style.WIDE - NAMES) / WIDTH), len(panels))
    worth = {name for error in panels.values() for name, _ in _large(error)}
    names = [NUMERICAL, *(effect.label for effect in EFFECTS.values()), *WORDS.values()]
    rows = [name for name in names if name in worth]
    every = [step for error in panels.values() for step in steps_of(error).items()]
    if any(abs(size) > NOTHING for name, size in every if name not in worth):
        rows.append(OTHERS)
    rows.append(ERROR)
    width = style.WIDE if abreast > 1 else style.COLUMN
    across = (width - NAMES - RIGHT - BETWEEN * (abreast - 1)) / abreast
    stacks = -(-len(panels) // abreast)
    tall = [(TITLE + (FOOT if k else TOP), ROW * len(rows)) for k in range(stacks)]
    room = NAMES, RIGHT, FOOT, abreast, BETWEEN, len(panels)
    drawn, places = curves.panels(width, tall, *room)
    for number, (axes, (title, error)) in enumerate(zip(places, panels.items(), strict=True)):
        _draw(axes, error, rows)
        axes.set_title("\n".join(wrap(title, int(TITLE_LETTERS * across))))
        if number % abreast:
            axes.tick_params(labelleft=False)
    return drawn


def _draw(axes: "Axes", error: Figure, rows: list[str]) -> None:
    steps = steps_of(error)
    shown = {name: steps.get(name, 0.0) for name in rows[:-1]}
    left_out = [size for name, size in steps.items() if name not in shown]
    if OTHERS in shown:
        shown[OTHERS] = sum(left_out)
    place, start, ends = -np.arange(len(rows), dtype=float), 0.0, [0.0]
    for y, size in zip(place, shown.values(), strict=False):
        begin, start = start, start + 100.0 * size
        if abs(size) > NOTHING:
            look = {"height": BAR, "linewidth": 0.5, **LOOKS[size > 0.0]}
            axes.barh(y, start - begin, left=begin, **look)
            style.beside_bar(axes, max(begin, start), y, error_text(size, error.numerical))
        # past a step that does not apply
        top = y - 0.5 * BAR if abs(size) > NOTHING else y + 0.5 * BAR
        axes.plot([start, start], [top, y - 1.0 + 0.5 * BAR], color="#555555", linewidth=0.6)
        ends += [begin, start]
    value, y = 100.0 * error.value, place[-1]
    axes.barh(y, value, height=BAR, facecolor="#bbbbbb", edgecolor="#000000", linewidth=0.8)
    certain = 100.0 * error.numerical if math.isfinite(error.numerical) else 0.0
    at = 100.0 * (error.tolerance or 0.0)
    most = max(*map(abs, ends), abs(value) + certain, at)
    estimate = min(100.0 * error.not_modelled, most)  # more would hide the steps
    bars = (certain, 1.4, 3.0), (certain + estimate, 0.6, 2.0 * (estimate < most))
    for reach, thick, caps in bars:
        style.whisker(axes, value, y, (reach, reach), thick, caps)
        ends += [value - reach, value + reach]
    text = error_text(error.value, error.numerical)
    style.beside_bar(axes, max(ends[-1], value, 0.0), y, text)
    for side in (-1.0, 1.0) if error.tolerance else ():
        axes.axvline(side * at, color="#000000", linestyle=(0, (3, 2)), linewidth=0.9)
        ends.append(side * at)
    axes.axvline(0.0, color="#555555", linewidth=0.7)
    low, high = min(ends), max(ends)
    axes.set_xlim(low - ROOM[1] * (high - low) * (low < 0.0), high + ROOM[0] * (high - low))
    axes.set_ylim(place[-1] - 0.6, 0.6)
    axes.set_yticks(place, rows)
    axes.tick_params(axis="y", length=0.0)
    axes.grid(False, axis="y")
    axes.locator_params(axis="x", nbins=6)
    axes.set_xlabel("model error [%]")
