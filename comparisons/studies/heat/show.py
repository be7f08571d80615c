"""Flash temperatures on the page and in the terminal.

In: a run with [heat]. Out: a table, facts, pictures of both surfaces and below, lines."""

import numpy as np

from comparisons.common.numbers import (
    given_percent,
    percent,
    plain,
    scale_of,
    significant,
    with_unit,
)
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Names, Note, Pictures, TextTable
from comparisons.drawing.curves import over, panels
from comparisons.drawing.field import ColourScale, FieldPanel, draw_fields, round_bands
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.models.heat import reach_of
from comparisons.studies.heat.figures import NAME, QUANTITIES, HeatFigure
from comparisons.studies.study import Run

HEIGHT = 1.9  # inches, of a field
RULES = {
    "equal_largest": "one fraction, largest temperatures equal (Blok)",
    "equal_mean": "one fraction, mean temperatures equal (Jaeger)",
    "conductivities": "one fraction, by conductivities alone (Seireg)",
}
NOTE = """Heat μ p V of the solved pressures, at the scene's largest friction coefficient. It
divides between both bodies so that their surfaces have one temperature wherever they touch; one
fraction for the whole contact is what older rules take. The pattern of pressures is taken as steady
where the contact is: exact where the contact stays on the rough body (slide-to-roll ratio −2), a
snapshot else. Difference: (half-space − finite elements) / finite elements."""
OF_STRESSES = """ Stresses are elastic and steady, zero at the bulk temperature; their difference is
over the larger one with heat and without, a depth's over a."""


def files(run: Run) -> dict[str, dict[str, np.ndarray]]:
    """temperature.csv of each model: a row for each pressure element."""
    return {
        f"{name}/temperature.csv": {
            "x [m]": contact.x,
            "heat [W/m^2]": contact.heat,
            "into the body [W/m^2]": contact.into_body,
            "rise of the body [K]": contact.body,
            "rise of the roller [K]": contact.roller,
        }
        for name, contact in run.data(NAME).contacts.items()
    }


def blocks(run: Run) -> list[Block]:
    note = Note(NOTE + OF_STRESSES * bool(run.data(NAME).stresses))
    shown = Names(heat_facts(run)), note, Pictures(("heat_below",), abreast=True)
    return [
        Block("heat", (Pictures(("heat_surfaces",)), heat_table(run), *shown), "Frictional heat")
    ]


def heat_table(run: Run) -> TextTable:
    """A row for each figure, then what older rules say of the first."""
    study = run.data(NAME)
    rows = [(QUANTITIES[figure.quantity].label, *_cells(figure)) for figure in study.figures]
    for name, rule in study.rules.items():
        value = f"{significant(rule['flash_temperature'])} K"
        share = f"{percent(rule['fraction_into_body'])} enter the body"
        rows.append((RULES[name], value, "", "", "", "", share))
    numbers = ("difference", "uncertainty", "tolerance")
    return TextTable("", ("", *map(LABELS.get, MODELS), *numbers, "verdict"), tuple(rows))


def _cells(figure: HeatFigure) -> tuple[str, ...]:
    unit = QUANTITIES[figure.quantity].unit
    values = [with_unit(figure.values.get(name), unit) for name in MODELS]
    for name, alone in figure.elastic.items():
        values[MODELS.index(name)] += f" ({with_unit(alone, unit)} without)"
    if figure.difference is None:
        return *values, "", percent(*figure.own.values()), "", "not compared"
    judged = percent(figure.uncertainty), given_percent(figure.tolerance), figure.verdict
    return *values, _difference(figure, figure.difference), *judged


def _difference(figure: HeatFigure, value: float) -> str:
    return percent(value, signed=True, uncertainty=figure.uncertainty)


def heat_facts(run: Run) -> list[tuple[str, str]]:
    """What moves, what the finite elements have, and where the largest rise stands."""
    study, heat = run.data(NAME), run.problem.scene.heat
    body, roller = (f"{significant(abs(v), 3)} m/s" for v in heat.velocities)
    numbers = (f"{name} {significant(number, 3)}" for name, number in study.peclet.items())
    places = (each.figures["flash_position"] for each in study.contacts.values())
    reach = with_unit(reach_of(run.problem), "m")
    datum = f"{plain(heat.bulk_temperature)} K, at rest {reach} away"
    facts = [
        ("surfaces pass the contact at", f"body {body}, roller {roller}"),
        ("Peclet number V a / 2κ", ", ".join(numbers)),
        ("bulk temperature", datum),
        ("largest rise at x =", ", ".join(dict.fromkeys(with_unit(x, "m") for x in places))),
        ("the finite elements have", ", ".join(study.contains.values())),
    ]
    first = study.figures[0]
    if first.by_pressure is not None:
        share = _difference(first, first.by_pressure)
        facts.append(("of its difference, by other pressures", share))
    for feature, effect in first.effects.items():
        share = percent(effect["value"], signed=True, uncertainty=effect["uncertainty"])
        share = f"{share} ± {percent(effect['uncertainty'])}"
        facts.append((f"the largest rise without {study.contains[feature]}", share))
    return [fact for fact in facts if fact[1]]


def lines(run: Run) -> list[tuple[str, str]]:
    """The largest rise in a line, and largest stresses with heat in others."""
    said = []
    for figure in run.data(NAME).figures:
        if figure.quantity != "flash_temperature" and not figure.elastic:
            continue
        cells = zip(_cells(figure), MODELS, strict=False)
        values = (f"{cell} ({LABELS[name]})" for cell, name in cells if name in figure.values)
        name = QUANTITIES[figure.quantity].label if figure.elastic else "flash temperature"
        text = f"{name} {', '.join(values)}"
        if figure.verdict is not None:
            difference = _difference(figure, figure.difference)
            text += f": {difference} ± {percent(figure.uncertainty)}, {figure.verdict}"
        said.append(("heat", text))
    return said


def surfaces_picture(run: Run) -> style.Picture | None:
    """The surfaces' temperatures over the heat, and their stresses where these are known."""
    if run.data(NAME) is None:
        return None
    contacts, stresses = run.data(NAME).contacts, run.data(NAME).stresses
    rows = [(0.22, 2.2), (0.2, 0.82), (0.2, 1.5)][: 3 if stresses else 2]
    drawn, axes = panels(style.WIDE, rows)
    above, below, *along = axes
    unit = scale_of(next(iter(contacts.values())).x, "m")
    for name, each in contacts.items():
        x, look = each.x / unit.factor, style.LINES[name]
        thin = {**look, "linewidth": 0.5 * look["linewidth"]}
        above.plot(x, each.body, label=f"body, {LABELS[name]}", **look)
        above.plot(x, each.roller, label=f"roller, {LABELS[name]}", **thin)
        below.plot(x, each.heat / 1e6, label=f"all, {LABELS[name]}", **thin)
        below.plot(x, each.into_body / 1e6, label=f"into the body, {LABELS[name]}", **look)
        for sx, line in zip(stresses[name].sx if stresses else (), (look, thin), strict=False):
            along[0].plot(stresses[name].x / unit.factor, sx / 1e6, **line)
    for each, name in zip(axes, ("rise [K]", "heat [W/mm²]", "σx [MPa]"), strict=False):
        each.set_ylabel(name)
    over(axes, f"x [{unit.name}]", x)
    above.legend(loc="upper right")
    largest = "; ".join(
        f"{LABELS[name]} {significant(each.figures['flash_temperature'])} K"
        for name, each in contacts.items()
    )
    caption = (
        "Rise of both surfaces above the bulk temperature, equal where they touch. Below, the "
        f"heat of friction and its part that enters the body. Largest: {largest}."
    )
    caption += " Last, σx of the body's surface, thin without heat." * bool(stresses)
    words = f"Rise of both surfaces' temperatures over x. Largest: {largest}."
    return style.picture(drawn, words, caption, wide=True)


def below_pictures(run: Run) -> list[style.Picture]:
    """The rise below either surface."""
    if (study := run.data(NAME)) is None:
        return []
    pictures, half_width = [], run.problem.hertz.half_width
    x, z = study.x / half_width, study.z / half_width
    for name, values in zip(("body", "roller"), study.field, strict=True):
        row, column = np.unravel_index(values.argmax(), values.shape)
        at = f"{significant(values.max())} K at x = {significant(x[column], 3)} a"
        panel = FieldPanel(f"{name}: largest {at}", values, (x[column], z[row]))
        scale = ColourScale("rise [K]", round_bands([values], signed=False), "magma")
        drawn, _ = draw_fields(x, z, [panel], scale, HEIGHT)
        words = f"Rise of temperature below the surface of the {name}"
        alternative, caption = f"{words}; {panel.title}.", f"{words}, as a half-space."
        pictures.append(style.picture(drawn, alternative, caption, data=False))
    return pictures


PICTURES = {"heat_surfaces": surfaces_picture, "heat_below": below_pictures}
