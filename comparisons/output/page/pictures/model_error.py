"""The half-plane's model error as waterfalls: from nothing, effect by effect, to the error.

One for each judged figure and friction coefficient, or for each there is where nothing is judged.
Norms have no sign and do not add up: their bars all start at zero.
"""

import math
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from comparisons.drawing import style
from comparisons.figures.figure import Figure, grouped
from comparisons.figures.quantity import QUANTITIES, WHOLE, label
from comparisons.output.page.tables.model_error import SHOWN, contributions_of
from comparisons.output.page.tables.text import error_text, listed
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.study import MODEL_ERROR, Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn

ROW, TITLE, FOOT, TOP = 0.21, 0.42, 0.5, 0.06  # inches: a step, the words above and below
NAMES, BETWEEN, RIGHT = 1.95, 0.25, 0.1  # inches: names of the steps, from panel to panel
WIDTH = 2.85  # inches of a panel, about
BAR = 0.66  # of a row
NOTHING = 1e-6  # a step below it is none
TITLE_LETTERS = 15.0  # to the inch
ROOM = 0.3, 0.08  # beyond the bars, share of their range: for numbers to the right, to the left
INTERACTION, NUMERICAL, JUMP = "interaction", "without any effect", "another asperity"
OTHERS, ERROR = "smaller steps", "model error"
LOOKS = {
    True: {"facecolor": "#E69F00", "edgecolor": "#333333"},
    False: {"facecolor": "#56B4E9", "edgecolor": "#333333"},  # and hatched
    None: {"facecolor": "#cccccc", "edgecolor": "#333333"},  # without a sign
}


@dataclass(frozen=True)
class Waterfall:
    """The steps to the error of a quantity at one or more friction coefficients."""

    quantity: str
    name: str
    # relative sizes by name, with the sign of the error; of a figure they add up to it
    steps: dict[str, float]
    error: float
    uncertainty: float  # of `error`; `not_modelled` is the estimate of what else it may be
    not_modelled: float
    tolerance: float | None

    @property
    def is_norm(self) -> bool:
        return QUANTITIES[self.quantity].of_pair


def waterfalls(run: Run) -> list[Waterfall]:
    """Of what is judged, or of everything; coefficients of equal figures together."""
    found, errors = [], run.figures.of(study=MODEL_ERROR, against=WHOLE)
    names = dict.fromkeys(error.quantity for error in run.model_errors or errors)
    for quantity in (name for name in QUANTITIES if name in names):
        for same in grouped(errors.of(quantity=quantity), _drawn_of):
            some = len(same) < len(run.problem.scene.load.friction)
            frictions = listed(error.friction for error in same)
            found.append(
                Waterfall(
                    quantity=quantity,
                    name=label(quantity) + (f", μ = {frictions}" if some else ""),
                    steps=_steps(same[0]),
                    error=same[0].value,
                    uncertainty=same[0].numerical,
                    not_modelled=same[0].not_modelled,
                    tolerance=same[0].tolerance,
                )
            )
    return found


def _drawn_of(error: Figure) -> tuple:
    """What a panel shows of an error: equal ones have one."""
    return error.value, tuple(part for part in error.parts if part.name in EFFECTS)


def _steps(error: Figure) -> dict[str, float]:
    """From nothing to the error; of a norm its sizes alone."""
    steps = contributions_of(error)
    if QUANTITIES[error.quantity].of_pair:
        return steps
    return {NUMERICAL: error.value - sum(steps.values()), **steps}


def model_error_picture(outcome: Run) -> style.Picture | None:
    """Waterfalls side by side; None with one model."""
    panels = waterfalls(outcome)
    if not panels:
        return None
    judged = [panel for panel in panels if panel.tolerance]
    said = "; ".join(
        f"{panel.name}: {error_text(panel.quantity, panel.error, panel.uncertainty)}"
        + "".join(f", {name} {error_text(panel.quantity, size)}" for name, size in _large(panel))
        for panel in panels
    )
    lines = "; broken lines: the tolerance" if judged else ""
    return style.Picture(
        source=style.data_uri(_drawn(panels, max(1, int((style.WIDE - NAMES) / WIDTH)))),
        narrow=style.data_uri(_drawn(panels, 1)),
        alternative=f"The half-plane's model error, step by step. {said}.",
        caption="How the half-plane's model error comes about, in per cent of the whole model's "
        "figure: it starts with the half-plane's difference from finite elements without any of "
        "the effects, which is numerical, and each effect moves it, to the left (hatched) where "
        "the half-plane's figure becomes too low. Norms have sizes alone, which do not add up. "
        "Black: the error with its uncertainty; thin: with what is not modelled, "
        f"cut off without an end where it would hide the steps{lines}.",
        wide=True,
        data=("CSV", style.csv_uri(_table(panels))),
    )


def _table(panels: list[Waterfall]) -> list[list[object]]:
    """Every step of every panel, relative; then the error with what may be wrong with it."""
    rows: list[list[object]] = [["quantity", "step", "relative size"]]
    for panel in panels:
        ends = {
            ERROR: panel.error,
            "uncertainty": panel.uncertainty,
            "not modelled (estimate)": panel.not_modelled,
            "tolerance": panel.tolerance,
        }
        sizes = (panel.steps | ends).items()
        rows += [[panel.name, step, f"{size:.6g}"] for step, size in sizes if size is not None]
    return rows


def _large(panel: Waterfall) -> list[tuple[str, float]]:
    """The steps that are worth a row."""
    least = max(SHOWN, 0.1 * abs(panel.error))
    return [(name, size) for name, size in panel.steps.items() if abs(size) >= least]


def _drawn(panels: list[Waterfall], columns: int) -> "Drawn":
    """All panels with the same rows, so many side by side."""
    columns = min(columns, len(panels))
    worth = {name for panel in panels for name, _ in _large(panel)}
    names = [NUMERICAL, *(effect.label for effect in EFFECTS.values()), INTERACTION, JUMP]
    rows = [name for name in names if name in worth]
    every = [step for panel in panels for step in panel.steps.items()]
    if any(abs(size) > NOTHING for name, size in every if name not in worth):
        rows.append(OTHERS)
    rows.append(ERROR)
    width = style.WIDE if columns > 1 else style.COLUMN
    across = (width - NAMES - RIGHT - BETWEEN * (columns - 1)) / columns
    stacks = -(-len(panels) // columns)
    tall = [(TITLE + (FOOT if k else TOP), ROW * len(rows)) for k in range(stacks)]
    drawn = style.figure(width, sum(map(sum, tall)) + FOOT)
    for column in range(columns):
        left = NAMES + column * (across + BETWEEN)
        places = style.stacked(drawn, tall, left, width - left - across)
        for axes, panel in zip(places, panels[column::columns], strict=False):
            _draw(axes, panel, rows, across)
            if column:
                axes.tick_params(labelleft=False)
        for axes in places[len(panels[column::columns]) :]:
            axes.remove()
    return drawn


def _draw(axes: "Axes", panel: Waterfall, rows: list[str], across: float) -> None:
    shown = {name: panel.steps.get(name, 0.0) for name in rows[:-1]}
    left_out = [size for name, size in panel.steps.items() if name not in shown]
    if OTHERS in shown:
        shown[OTHERS] = max(left_out, default=0.0) if panel.is_norm else sum(left_out)
    place, start, ends = -np.arange(len(rows), dtype=float), 0.0, [0.0]
    hatched: list = []
    for y, size in zip(place, shown.values(), strict=False):
        begin = 0.0 if panel.is_norm else start
        start = begin + 100.0 * size
        if abs(size) > NOTHING:
            sign = None if panel.is_norm else size > 0.0
            look = {"height": BAR, "linewidth": 0.5, **LOOKS[sign]}
            [bar] = axes.barh(y, start - begin, left=begin, **look)
            hatched += [bar] * (sign is False)
            text = error_text(panel.quantity, size, panel.uncertainty)
            _beside(axes, max(begin, start), y, text)
        if not panel.is_norm:
            # past a step that does not apply
            top = y - 0.5 * BAR if abs(size) > NOTHING else y + 0.5 * BAR
            axes.plot([start, start], [top, y - 1.0 + 0.5 * BAR], color="#555555", linewidth=0.6)
        ends += [begin, start]
    style.hatch(axes, hatched, LOOKS[False]["edgecolor"])
    value, y = 100.0 * panel.error, place[-1]
    axes.barh(y, value, height=BAR, facecolor="#bbbbbb", edgecolor="#000000", linewidth=0.8)
    certain = 100.0 * panel.uncertainty if math.isfinite(panel.uncertainty) else 0.0
    at = 100.0 * (panel.tolerance or 0.0)
    most = max(*map(abs, ends), abs(value) + certain, at)
    estimate = min(100.0 * panel.not_modelled, most)  # more would hide the steps
    bars = (certain, 1.4, 3.0), (certain + estimate, 0.6, 2.0 * (estimate < most))
    for reach, thick, caps in bars:
        look = {"elinewidth": thick, "capsize": caps, "color": "#000000", "fmt": "none"}
        low = min(reach, value) if panel.is_norm else reach
        axes.errorbar(value, y, xerr=[[low], [reach]], **look)
        ends += [value - low, value + reach]
    text = error_text(panel.quantity, panel.error, panel.uncertainty)
    _beside(axes, max(ends[-1], value, 0.0), y, text)
    for side in ((1.0,) if panel.is_norm else (-1.0, 1.0)) if panel.tolerance else ():
        axes.axvline(side * at, color="#000000", linestyle=(0, (3, 2)), linewidth=0.9)
        ends.append(side * at)
    axes.axvline(0.0, color="#555555", linewidth=0.7)
    low, high = min(ends), max(ends)
    axes.set_xlim(low - ROOM[1] * (high - low) * (low < 0.0), high + ROOM[0] * (high - low))
    style.horizontal_bars(axes, place, rows)
    axes.locator_params(axis="x", nbins=6)
    axes.set_title("\n".join(wrap(panel.name, int(TITLE_LETTERS * across))))
    axes.set_xlabel("per cent")


def _beside(axes: "Axes", x: float, y: float, text: str) -> None:
    """Words to the right of a bar's end."""
    behind = {"facecolor": "#ffffff", "edgecolor": "none", "pad": 0.5}
    beside = {"textcoords": "offset points", "va": "center", "fontsize": 7.5, "bbox": behind}
    axes.annotate(text, (x, y), (3, 0), **beside)
