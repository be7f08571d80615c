"""Flash temperatures as a table, and in a sentence."""

from comparisons.common.numbers import (
    given_percent,
    percent,
    plain,
    significant,
    with_unit,
)
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.models.heat import reach_of
from comparisons.studies.heat.figures import NAME, QUANTITIES, HeatFigure
from comparisons.studies.study import Run, TextTable

RULES = {
    "equal_largest": "one fraction, largest temperatures equal (Blok)",
    "equal_mean": "one fraction, mean temperatures equal (Jaeger)",
    "conductivities": "one fraction, by conductivities alone (Seireg)",
}


def heat_table(outcome: Run) -> TextTable | None:
    """A row for each figure, then what older rules say of the first; None without [heat]."""
    if (study := outcome.data(NAME)) is None:
        return None
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


def heat_facts(outcome: Run) -> list[tuple[str, str]]:
    """What moves, what the finite elements have, and where the largest rise stands; nothing
    without [heat]."""
    study, heat = outcome.data(NAME), outcome.problem.scene.heat
    if study is None:
        return []
    body, roller = (f"{significant(abs(v), 3)} m/s" for v in heat.velocities)
    numbers = (f"{name} {significant(number, 3)}" for name, number in study.peclet.items())
    places = (each.figures["flash_position"] for each in study.contacts.values())
    reach = with_unit(reach_of(outcome.problem), "m")
    datum = f"{plain(heat.bulk_temperature)} K, at rest {reach} away"
    found = [
        ("surfaces pass the contact at", f"body {body}, roller {roller}"),
        ("Peclet number V a / 2κ", ", ".join(numbers)),
        ("bulk temperature", datum),
        ("largest rise at x =", ", ".join(dict.fromkeys(with_unit(x, "m") for x in places))),
        ("the finite elements have", ", ".join(study.contains.values())),
    ]
    first = study.figures[0]
    if first.by_pressure is not None:
        share = _difference(first, first.by_pressure)
        found.append(("of its difference, by other pressures", share))
    for feature, effect in first.effects.items():
        share = percent(effect["value"], signed=True, uncertainty=effect["uncertainty"])
        share = f"{share} ± {percent(effect['uncertainty'])}"
        found.append((f"the largest rise without {study.contains[feature]}", share))
    return [fact for fact in found if fact[1]]


def heat_lines(outcome: Run) -> list[str]:
    """The largest rise in a line, and largest stresses with heat in others."""
    said = []
    for figure in study.figures if (study := outcome.data(NAME)) else ():
        if figure.quantity != "flash_temperature" and not figure.elastic:
            continue
        cells = zip(_cells(figure), MODELS, strict=False)
        values = (f"{cell} ({LABELS[name]})" for cell, name in cells if name in figure.values)
        name = QUANTITIES[figure.quantity].label if figure.elastic else "flash temperature"
        said.append(f"{name} {', '.join(values)}")
        if figure.verdict is not None:
            difference = _difference(figure, figure.difference)
            said[-1] += f": {difference} ± {percent(figure.uncertainty)}, {figure.verdict}"
    return said
