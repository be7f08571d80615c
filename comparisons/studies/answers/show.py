"""Answers from outside on the page; their rows and facts are the terminal's, too.

In: a run with answers. Out: tables, facts, pictures of pressures and of principal shears."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import (
    Scale,
    percent,
    percent_as_written,
    plain,
    significant,
    with_unit,
)
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Heading, Names, Note, Pictures, TextTable
from comparisons.drawing.curves import over, panels
from comparisons.drawing.field import ColourScale, FieldPanel, draw_fields
from comparisons.drawing.tables import figure_table
from comparisons.figures.figure import deciding
from comparisons.figures.quantity import COMPARED, LABELS, label
from comparisons.judging import contact
from comparisons.judging.study import Run
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.study import CONDITIONS, HINTS, NAME, VALIDATION

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PANELS = ((0.3, 2.4), (0.2, 1.0))  # inches above each panel, and its height: pressures, differences
MARKED = 100  # points: fewer are marked on the curve
SIZES = ("u_num", "u_input", "u_D", "u_val")
COLOURS = ("#CC79A7", "#56B4E9", "#E69F00", "#000000", "#F0E442")  # Okabe and Ito's others
NOTE = """Difference: (answer − model) / model. Uncertainty: the model's, with the answer's own
where several resolutions or a scatter state it (± at its values), else with the spacing of its
points in a length.
Contact conditions: the answer's pressures on the models' elements, zero when exact: the work of the
pressures on the gaps that they leave, and the largest overlap, both relative. E: model less data;
u_val: root of the sum of squares of u_num, u_input and u_D."""


def answers_of(run: Run) -> Mapping[str, tuple[Answer, ...]]:
    """Answers by name, each on its resolutions; empty without any."""
    return run.data(NAME) or {}


def reference_of(run: Run) -> str:
    """The model that answers are compared with: the last."""
    return list(run.runs)[-1]


def blocks(run: Run) -> list[Block]:
    items: list = [Pictures(("answers",))]
    for name in answers_of(run):
        kind, sentence = answer_verdict(run, name)
        said = Note(f"*{kind.upper()}*  {sentence}"), answer_table(run, name)
        items += [Heading(name), *said, Names(answer_facts(run, name))]
        items += _validation_tables(run, name)
    return [Block("answers", (*items, Note(NOTE)), "Answers from outside")]


def verdicts(run: Run) -> list[tuple[str, str]]:
    """One on each answer."""
    return [answer_verdict(run, name) for name in answers_of(run)]


def answer_verdict(run: Run, answer: str) -> tuple[str, str]:
    """Verdict in a word on whether an answer agrees with its reference in all that is judged, and a
    sentence with the figure that decides."""
    judged = [f for f in run.figures.of(study=NAME, source=answer) if f.bounds is not None]
    figure = deciding(judged)
    kind, number = figure.verdict, sum(f.verdict == figure.verdict for f in judged)
    count = f"{number} of {len(judged)} judged figures"
    if number == len(judged):
        every = {1: "the one judged figure", 2: "both judged figures"}
        count = every.get(number, f"all {number} judged figures")
    said = {"differ": "differs from", "agree": "agrees with"}
    words = f"{said.get(kind, 'may agree with or differ from')} the {LABELS[reference_of(run)]}"
    at = f" at friction {plain(figure.friction)}" if len({f.friction for f in judged}) > 1 else ""
    end = f"{COMPARED[figure.quantity].short}{at}, {figure.sized(figure.total)}"
    first = "the farthest" if kind == "differ" else "nearest to its tolerance"
    tolerance = percent_as_written(figure.tolerance)
    return kind, f"The answer {answer} {words} in {count}; {first}: {end} (tolerance {tolerance})."


def answer_table(run: Run, answer: str, brief: bool = False) -> TextTable:
    """The answer's figures beside the reference's, which it is compared in."""
    own = run.figures.of(study=NAME, source=answer)
    compared = {(figure.quantity, figure.friction) for figure in own if figure.against}
    reference = run.figures.of(study=contact.NAME, source=reference_of(run))
    known = [figure for figure in reference if (figure.quantity, figure.friction) in compared]
    return figure_table([*own, *known], COMPARED, brief=brief)


def answer_facts(run: Run, answer: str) -> list[tuple[str, str]]:
    """Facts of an answer that owe nothing to a mesh: load, contact conditions, what explains it."""
    findings, known = run.findings[NAME], run.figures.of(study=NAME, source=answer)
    spacing = with_unit(known.one(quantity="spacing").value, "m", 3)
    balance = percent(known.one(quantity="load_balance").value, signed=True, digits=3)
    facts = [
        ("resolution", f"{spacing} from point to point in contact"),
        ("load", f"{balance} off the scene's"),
    ]
    if columns := answers_of(run)[answer][-1].columns:
        facts.insert(0, ("columns", columns))
    for row in findings.table(CONDITIONS, answer).rows():
        said = (
            f"{words} {significant(row[name], 2)}"
            for name, words in (("complementarity", "work of the gaps"), ("penetration", "overlap"))
        )
        facts.append((f"contact conditions, {LABELS[row['model']]}", ", ".join(said)))
    named = findings.table(HINTS, answer)
    return [*facts, *(("hint", text) for text in (named.columns["text"].values if named else ()))]


def _validation_tables(run: Run, answer: str) -> list[TextTable]:
    """V&V 20's comparison of measured data with each model; none of an answer without scatter."""
    measured = run.findings[NAME].table(VALIDATION, answer)
    if measured is None:
        return []
    rows = tuple(
        (
            f"{label(row['quantity'])}, {LABELS[row['model']]}",
            plain(row["friction"]),
            percent(row["E"], signed=True),
            *(percent(row[size]) for size in SIZES),
        )
        for row in measured.rows()
    )
    head = ("model less data", "friction", "E", *SIZES)
    return [TextTable("In the terms of ASME V&V 20", head, rows)]


def answer_pictures(run: Run) -> list[style.Picture]:
    """The pressures of all answers, then the principal shear of each that has stresses."""
    answers = {name: levels[-1] for name, levels in answers_of(run).items()}
    shears = [_shear(run, n, answer) for n, answer in answers.items() if answer.stress is not None]
    return [_pressures(run, answers), *shears] if answers else []


def _pressures(run: Run, answers: Mapping[str, Answer]) -> style.Picture:
    words = f"Contact pressures of the models and, wide and pale, of {', '.join(answers)}"
    caption = f"{words}; below, what these differ from the {LABELS[reference_of(run)]} by."
    half_width = run.problem.hertz.half_width
    drawn, axes = panels(style.WIDE, PANELS)
    across = tuple(np.sort([*run.problem.extent, *contact.seen(run, 0.1)])[[0, -1]].tolist())
    unit = Scale(half_width, "a")
    contact.draw_pressures(axes[0], run, across, unit)
    for number, (name, answer) in enumerate(answers.items()):
        look = {"color": COLOURS[number % len(COLOURS)], "linewidth": 1.0, "label": name}
        _curves(axes, run, answer, look)
    axes[0].set_ylim(0.0, 1.25 * axes[0].dataLim.y1)
    look = {"loc": "upper right", "bbox_to_anchor": (1.0, 1.0), **style.BEHIND_LEGEND}
    axes[0].legend(ncols=4, **look)
    axes[1].set_ylabel("Δp/p₀")
    over(axes, "x/a", [end / half_width for end in across])
    return style.picture(drawn, words, caption)


def _curves(axes: "list[Axes]", run: Run, answer: Answer, look: dict) -> None:
    """An answer's pressures, and below what they differ from the reference by."""
    hertz, case = run.problem.hertz, run.solved.case(run.deciding_friction)
    level = case.runs[reference_of(run)].finest
    few, x = len(answer.x) < MARKED, level.grid.x
    p = np.where(answer.touching, answer.pressure, 0.0) / hertz.peak_pressure
    around = {**look, **style.PALE, "marker": "." if few else None}  # the models' lines
    axes[0].plot(answer.x / hertz.half_width, p, **around)
    difference = (answer.on(x) - level.solution.pressure) / hertz.peak_pressure
    axes[1].plot(x / hertz.half_width, difference, **look)


def _shear(run: Run, name: str, answer: Answer) -> style.Picture:
    """An answer's field, its reference's, and the difference."""
    hertz, window, stress = run.problem.hertz, run.window, answer.stress
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    reference = run.solved.case(stress.friction).runs[reference_of(run)].finest.stress
    fields = [known.field.tau1 / hertz.peak_pressure for known in (stress, reference)]
    names = name, LABELS[reference_of(run)]
    shown = [FieldPanel(*panel) for panel in zip(names, fields, strict=True)]
    apart = fields[0] - fields[1]
    difference = " − ".join(names), ColourScale.of_differences("Δτ₁/p₀", [apart])
    drawn = draw_fields(x, z, shown, ColourScale.over("τ₁/p₀", fields), difference=difference)
    said = f"the largest of {significant(np.nanmax(np.abs(apart)), 2)} p₀"
    words = f"Principal shear stress τ₁ of {name} and of the {names[1]}, friction "
    words += f"{plain(stress.friction)}, and their difference, striped where negative, {said}."
    return style.picture(drawn, words, words, data=False)
