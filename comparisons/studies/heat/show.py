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
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.studies.heat.half_space import reach_of
from comparisons.studies.heat.study import (
    COMPARED,
    HEATED,
    NAME,
    OTHER_PRESSURES,
    QUANTITIES,
    WITHOUT,
)
from comparisons.studies.study import Run

HEIGHT = 1.9  # inches, of a field
RULES = {
    "equal_largest": "one fraction, largest temperatures equal (Blok)",
    "equal_mean": "one fraction, mean temperatures equal (Jaeger)",
    "conductivities": "one fraction, by conductivities alone (Seireg)",
}
OF_RULES = "flash_temperature", "fraction_into_body"
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
    known = run.figures.of(study=NAME)
    shown = [name for name in COMPARED if known.one(quantity=name)]
    rows = [(QUANTITIES[name].label, *_cells(known, name)) for name in shown]
    for rule, words in RULES.items():
        rise, share = (known.one(source=rule, quantity=name).value for name in OF_RULES)
        rises, enters = f"{significant(rise)} K", f"{percent(share)} enter the body"
        rows.append((words, rises, "", "", "", "", enters))
    numbers = ("difference", "uncertainty", "tolerance")
    return TextTable("", ("", *map(LABELS.get, MODELS), *numbers, "verdict"), tuple(rows))


def _cells(known: Figures, quantity: str) -> tuple[str, ...]:
    unit, texts = QUANTITIES[quantity].unit, []
    values = [known.one(quantity=quantity, source=name, against=None) for name in MODELS]
    for name, figure in zip(MODELS, values, strict=True):
        texts.append(with_unit(figure and figure.value, unit))
        if (cold := known.one(quantity=f"{quantity}{WITHOUT}", source=name)) is not None:
            texts[-1] += f" ({with_unit(cold.value, unit)} without)"
    difference = known.one(quantity=quantity, against=MODELS[1])
    if difference is None:
        own = next(filter(None, values))
        return *texts, "", percent(own.numerical), "", "not compared"
    judged = given_percent(difference.tolerance), difference.verdict
    return *texts, _relative(difference), percent(difference.numerical), *judged


def _relative(difference: Figure, value: float | None = None) -> str:
    """A difference, or a part of it, in the digits that are certain."""
    value = difference.value if value is None else value
    return percent(value, signed=True, uncertainty=difference.numerical)


def heat_facts(run: Run) -> list[tuple[str, str]]:
    """What moves, what the finite elements have, and where the largest rise stands."""
    study, heat = run.data(NAME), run.problem.scene.heat
    body, roller = (f"{significant(abs(v), 3)} m/s" for v in heat.velocities)
    known = run.figures.of(study=NAME)
    peclet = known.of(quantity="peclet_number")
    numbers = (f"{each.source} {significant(each.value, 3)}" for each in peclet)
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
    first = known.of(quantity="flash_temperature")
    difference = first.one(against=MODELS[1])
    parts = (difference or first.one(source=list(run.runs)[-1])).parts
    for part in sorted(parts, key=lambda part: part.name != OTHER_PRESSURES):
        if part.name == OTHER_PRESSURES:
            share = _relative(difference, part.value)
            facts.append(("of its difference, by other pressures", share))
        else:
            share = percent(part.value, signed=True, uncertainty=part.uncertainty)
            share = f"{share} ± {percent(part.uncertainty)}"
            facts.append((f"the largest rise without {study.contains[part.name]}", share))
    return [fact for fact in facts if fact[1]]


def lines(run: Run) -> list[tuple[str, str]]:
    """The largest rise in a line, and largest stresses with heat in others."""
    known, said = run.figures.of(study=NAME), []
    for quantity in ("flash_temperature", *HEATED):
        of_models = known.of(quantity=quantity, against=None)
        sources = {figure.source for figure in of_models}
        cells = zip(_cells(known, quantity), MODELS, strict=False) if of_models else ()
        values = [f"{cell} ({LABELS[name]})" for cell, name in cells if name in sources]
        if not values:
            continue
        name = QUANTITIES[quantity].label if quantity in HEATED else "flash temperature"
        text = f"{name} {', '.join(values)}"
        if (difference := known.one(quantity=quantity, against=MODELS[1])) is not None:
            size = f"{_relative(difference)} ± {percent(difference.numerical)}"
            text += f": {size}, {difference.verdict}"
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
