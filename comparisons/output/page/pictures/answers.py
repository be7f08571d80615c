"""Answers from outside beside the models: pressures of all, and each one's principal shear."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, plain
from comparisons.drawing import style
from comparisons.drawing.field import (
    ColourScale,
    FieldPanel,
    draw_fields,
    height_to_scale,
    round_bands,
    signed_scale,
)
from comparisons.figures.quantity import LABELS
from comparisons.output.page.pictures.pressures import draw_pressures
from comparisons.output.page.tables.answers import compared_answers
from comparisons.studies.answers.answer import ComparedAnswer
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PANELS = ((0.3, 2.4), (0.2, 1.0))  # inches above each panel, and its height: pressures, differences
LEFT, FOOT = 0.8, 0.46
MARKED = 100  # points: fewer are marked on the curve
COLOURS = ("#CC79A7", "#56B4E9", "#E69F00", "#000000", "#F0E442")  # Okabe and Ito's others


def answer_pictures(outcome: Run) -> list[style.Picture]:
    """The pressures of all answers, then the principal shear of each that has stresses."""
    if not compared_answers(outcome):
        return []
    shears = [answer for answer in compared_answers(outcome) if answer.finest.stress is not None]
    return [_pressures(outcome), *(_shear(outcome, answer) for answer in shears)]


def _pressures(outcome: Run) -> style.Picture:
    half_width = outcome.problem.hertz.half_width
    drawn = style.figure(style.WIDE, sum(map(sum, PANELS)) + FOOT)
    panels = style.stacked(drawn, PANELS, LEFT)
    ends = np.concatenate([np.array(outcome.problem.extent), [-1.1 * half_width, 1.1 * half_width]])
    across = float(ends.min()), float(ends.max())
    draw_pressures(panels[0], outcome, across, Scale(half_width, "a"))
    for number, answer in enumerate(compared_answers(outcome)):
        _lines(panels, outcome, answer, COLOURS[number % len(COLOURS)])
    panels[0].set_ylim(0.0, 1.25 * panels[0].dataLim.y1)
    panels[0].legend(loc="upper right", ncols=4)
    panels[1].set(xlabel="x/a", ylabel="Δp/p₀")
    for panel in panels:
        panel.set_xlim(across[0] / half_width, across[1] / half_width)
        panel.tick_params(labelbottom=panel is panels[-1])
    names = ", ".join(answer.name for answer in compared_answers(outcome))
    reference = LABELS[compared_answers(outcome)[0].reference]
    return style.Picture(
        source=style.data_uri(drawn),
        data=style.csv_link(drawn),
        wide=True,
        alternative=f"Contact pressures of the models and of {names}",
        caption=f"Contact pressures of the models and of {names}; below, what these differ from "
        f"the {reference} by.",
    )


def _lines(panels: "list[Axes]", outcome: Run, answer: ComparedAnswer, colour: str) -> None:
    hertz, level = outcome.problem.hertz, outcome.runs[answer.reference].finest
    given, x = answer.finest, level.grid.x
    look = {"color": colour, "linewidth": 1.0, "label": answer.name}
    few = len(given.x) < MARKED
    p = np.where(given.touching, given.pressure, 0.0) / hertz.peak_pressure
    panels[0].plot(given.x / hertz.half_width, p, marker="." if few else None, **look)
    difference = (given.on(x) - level.solution.pressure) / hertz.peak_pressure
    panels[1].plot(x / hertz.half_width, difference, **look)


def _shear(outcome: Run, answer: ComparedAnswer) -> style.Picture:
    """An answer's field, its reference's, and the difference."""
    hertz, window = outcome.problem.hertz, outcome.window
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    stress = answer.finest.stress
    reference = outcome.runs[answer.reference].finest.stress(stress.friction)
    fields = [each.field.tau1 / hertz.peak_pressure for each in (stress, reference)]
    names = answer.name, LABELS[answer.reference]
    panels = [FieldPanel(*panel) for panel in zip(names, fields, strict=True)]
    scale = ColourScale("τ₁/p₀", round_bands(fields, signed=False))
    of_two = signed_scale("Δτ₁/p₀", round_bands([fields[0] - fields[1]], signed=True))
    difference = " − ".join(names), of_two
    drawn, _ = draw_fields(x, z, panels, scale, height_to_scale(x, z), difference)
    words = f"Principal shear stress τ₁ of {answer.name} and of the {names[1]}, friction "
    words += f"{plain(stress.friction)}, and their difference, striped where negative."
    return style.Picture(source=style.data_uri(drawn), alternative=words, caption=words)
