"""Answers from outside on the page; their rows and facts are the terminal's, too.

In: a run with answers. Out: tables, facts, pictures of pressures and of principal shears."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import (
    Scale,
    given_percent,
    listed,
    percent,
    plain,
    scale_of,
    significant,
    with_unit,
)
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Heading, Names, Note, Pictures, TextTable
from comparisons.drawing.curves import over, panels
from comparisons.drawing.field import (
    ColourScale,
    FieldPanel,
    draw_fields,
    height_to_scale,
    round_bands,
    signed_scale,
)
from comparisons.figures.figure import Figure, Figures, grouped
from comparisons.figures.quantity import LABELS, QUANTITIES, error_text, label
from comparisons.studies import contact
from comparisons.studies.answers.answer import NAME, ComparedAnswer
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PANELS = ((0.3, 2.4), (0.2, 1.0))  # inches above each panel, and its height: pressures, differences
MARKED = 100  # points: fewer are marked on the curve
COLOURS = ("#CC79A7", "#56B4E9", "#E69F00", "#000000", "#F0E442")  # Okabe and Ito's others
NOT_STATED = "not stated"
NOTE = """Difference: (answer − model) / model. Uncertainty: the model's, with the answer's own
where several resolutions or a scatter state it, else with the spacing of its points in a length.
Contact conditions: the answer's pressures on the models' elements, zero when exact: the work of the
pressures on the gaps that they leave, and the largest overlap, both relative. E: model less data;
u_val: root of the sum of squares of u_num, u_input and u_D."""


def compared_answers(run: Run) -> tuple[ComparedAnswer, ...]:
    """None without any."""
    compared = run.data(NAME)
    return () if compared is None else compared.answers


def blocks(run: Run) -> list[Block]:
    items: list = [Pictures(("answers",))]
    for answer in compared_answers(run):
        items += [Heading(answer.name), answer_table(run, answer), Names(answer_facts(answer))]
        items += [measured_table(answer)] if answer.validation else []
    return [Block("answers", (*items, Note(NOTE)), "Answers from outside")]


def answer_rows(run: Run, answer: ComparedAnswer) -> list[tuple[str, ...]]:
    """Quantity's name, friction, the answer's figure and the reference's with unit, difference,
    uncertainty, the answer's own, tolerance, verdict."""
    rows, known = [], run.figures.of(study=NAME, source=answer.name)
    for name in (name for name in QUANTITIES if run.shows(name)):
        differences = known.of(quantity=name, against=answer.reference)
        cells = [(each.friction, _cells(run, known, each)) for each in differences]
        for same in grouped(cells, lambda row: row[1]):
            rows.append((name, listed(friction for friction, _ in same), *same[0][1]))
    return rows


def _cells(run: Run, known: Figures, difference: Figure) -> tuple[str, ...]:
    name, bound = difference.quantity, difference.tolerance
    wanted = {"quantity": name, "at": difference.at, "against": None}
    own = known.one(**wanted)
    reference = run.figures.one(study=contact.NAME, source=difference.against, **wanted)
    values = [figure and figure.value for figure in (own, own and reference)]
    scale = scale_of(values, QUANTITIES[name].unit)
    stated = difference.uncertainty.parts.get("own")
    return (
        *("" if value is None else scale.text(value) for value in values),
        error_text(name, difference.value, difference.numerical),
        percent(difference.numerical),
        NOT_STATED if stated is None else percent(stated),
        "" if bound is None else given_percent(bound),
        difference.verdict or "",
    )


def answer_facts(answer: ComparedAnswer) -> list[tuple[str, str]]:
    """What an answer owes to no mesh: its load, the contact conditions, what explains it."""
    spacing = with_unit(answer.finest.spacing, "m", 3)
    facts = [
        ("resolution", f"{spacing} from point to point in contact"),
        ("load", f"{percent(answer.balance, signed=True, digits=3)} off the scene's"),
    ]
    for model, sizes in answer.conditions.items():
        said = (
            f"{words} {significant(sizes[name], 2)}"
            for name, words in (("complementarity", "work of the gaps"), ("penetration", "overlap"))
        )
        facts.append((f"contact conditions, {LABELS[model]}", ", ".join(said)))
    return [*facts, *(("hint", hint.text) for hint in answer.hints)]


def answer_table(run: Run, answer: ComparedAnswer) -> TextTable:
    """The rows of an answer for the page."""
    head = ("quantity", "friction", answer.name, LABELS[answer.reference], "difference")
    head += ("uncertainty", "its own", "tolerance", "verdict")
    rows = tuple((label(name), *cells) for name, *cells in answer_rows(run, answer))
    return TextTable("", head, rows)


def measured_table(answer: ComparedAnswer) -> TextTable:
    """V&V 20's comparison of measured data with each model."""
    sizes = ("u_num", "u_input", "u_D", "u_val")
    rows = tuple(
        (
            f"{label(name)}, {LABELS[row['model']]}",
            plain(row["friction"]),
            percent(row["E"], signed=True),
            *(percent(row[size]) for size in sizes),
        )
        for name, rows in answer.validation.items()
        for row in rows
    )
    head = ("model less data", "friction", "E", *sizes)
    return TextTable("In the terms of ASME V&V 20", head, rows)


def answer_pictures(run: Run) -> list[style.Picture]:
    """The pressures of all answers, then the principal shear of each that has stresses."""
    answers = compared_answers(run)
    shears = [_shear(run, answer) for answer in answers if answer.finest.stress is not None]
    return [_pressures(run, answers), *shears] if answers else []


def _pressures(run: Run, answers: tuple[ComparedAnswer, ...]) -> style.Picture:
    half_width = run.problem.hertz.half_width
    drawn, axes = panels(style.WIDE, PANELS)
    ends = np.concatenate([np.array(run.problem.extent), [-1.1 * half_width, 1.1 * half_width]])
    across, unit = (float(ends.min()), float(ends.max())), Scale(half_width, "a")
    contact.draw_pressures(axes[0], run, across, unit)
    for number, answer in enumerate(answers):
        _curves(axes, run, answer, COLOURS[number % len(COLOURS)])
    axes[0].set_ylim(0.0, 1.25 * axes[0].dataLim.y1)
    axes[0].legend(loc="upper right", ncols=4)
    axes[1].set_ylabel("Δp/p₀")
    over(axes, "x/a", [end / half_width for end in across])
    words = f"Contact pressures of the models and of {', '.join(each.name for each in answers)}"
    caption = f"{words}; below, what these differ from the {LABELS[answers[0].reference]} by."
    return style.picture(drawn, words, caption, wide=True)


def _curves(axes: "list[Axes]", run: Run, answer: ComparedAnswer, colour: str) -> None:
    hertz, level = run.problem.hertz, run.runs[answer.reference].finest
    finest, x = answer.finest, level.grid.x
    look = {"color": colour, "linewidth": 1.0, "label": answer.name}
    few = len(finest.x) < MARKED
    p = np.where(finest.touching, finest.pressure, 0.0) / hertz.peak_pressure
    axes[0].plot(finest.x / hertz.half_width, p, marker="." if few else None, **look)
    difference = (finest.on(x) - level.solution.pressure) / hertz.peak_pressure
    axes[1].plot(x / hertz.half_width, difference, **look)


def _shear(run: Run, answer: ComparedAnswer) -> style.Picture:
    """An answer's field, its reference's, and the difference."""
    hertz, window, stress = run.problem.hertz, run.window, answer.finest.stress
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    reference = run.runs[answer.reference].finest.stress(stress.friction)
    fields = [each.field.tau1 / hertz.peak_pressure for each in (stress, reference)]
    names = answer.name, LABELS[answer.reference]
    shown = [FieldPanel(*panel) for panel in zip(names, fields, strict=True)]
    scale = ColourScale("τ₁/p₀", round_bands(fields, signed=False))
    of_two = signed_scale("Δτ₁/p₀", round_bands([fields[0] - fields[1]], signed=True))
    difference = " − ".join(names), of_two
    drawn, _ = draw_fields(x, z, shown, scale, height_to_scale(x, z), difference)
    words = f"Principal shear stress τ₁ of {answer.name} and of the {names[1]}, friction "
    words += f"{plain(stress.friction)}, and their difference, striped where negative."
    return style.picture(drawn, words, words, data=False)
