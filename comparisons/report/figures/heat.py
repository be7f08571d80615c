"""Temperatures of both surfaces in and beside the contact, and below it."""

import numpy as np

from comparisons.common.numbers import scale_of, significant, with_unit
from comparisons.common.quantities import LABELS
from comparisons.report.figures import style
from comparisons.report.figures.fields import colour_bar, cross, fill, layout, round_bands
from comparisons.results.outcome import Outcome

HEIGHT = 1.9  # inches, of a field


def heat_pictures(outcome: Outcome) -> list[style.Picture]:
    """The surfaces' temperatures, the stress along the surface where thermal stresses are asked
    for, then the temperature below either; nothing without [heat]."""
    if outcome.heat is None:
        return []
    along = [_along(outcome)] if outcome.heat.stresses else []
    return [_surfaces(outcome), *along, *(_below(outcome, k) for k in range(2))]


def _surfaces(outcome: Outcome) -> style.Picture:
    contacts = outcome.heat.contacts
    drawn = style.figure(style.WIDE, 3.9)
    above, below = style.stacked(drawn, [(0.22, 2.2), (0.2, 0.82)], 0.8)
    unit = scale_of(next(iter(contacts.values())).x, "m")
    for name, each in contacts.items():
        x, look = each.x / unit.factor, style.LINES[name]
        above.plot(x, each.body, label=f"body, {LABELS[name]}", **look)
        thin = {**look, "linewidth": 0.5 * look["linewidth"]}
        above.plot(x, each.roller, label=f"roller, {LABELS[name]}", **thin)
        below.plot(x, each.heat / 1e6, label=f"all, {LABELS[name]}", **thin)
        below.plot(x, each.into_body / 1e6, label=f"into the body, {LABELS[name]}", **look)
    above.tick_params(labelbottom=False)
    above.set(ylabel="rise [K]")
    below.set(ylabel="heat [W/mm²]", xlabel=f"x [{unit.name}]")
    for axes in (above, below):
        axes.set_xlim(x[0], x[-1])
    above.legend(loc="upper right")
    largest = "; ".join(
        f"{LABELS[name]} {significant(each.figures['flash_temperature'])} K"
        for name, each in contacts.items()
    )
    return style.Picture(
        source=style.data_uri(drawn),
        data=style.csv_link(drawn),
        wide=True,
        alternative=f"Rise of both surfaces' temperatures over x. Largest: {largest}.",
        caption=(
            "Rise of both surfaces above the bulk temperature, equal where they touch. Below, the "
            f"heat of friction and its part that enters the body. Largest: {largest}."
        ),
    )


def _along(outcome: Outcome) -> style.Picture:
    drawn, stresses = style.figure(style.WIDE, 2.9), outcome.heat.stresses
    (axes,) = style.stacked(drawn, [(0.22, 2.2)], 0.8)
    unit = scale_of(next(iter(stresses.values())).x, "m")
    largest = []
    for name, each in stresses.items():
        look = style.LINES[name]
        thin = {**look, "linewidth": 0.5 * look["linewidth"]}
        for sx, with_heat, line in zip(each.sx, ("", "without heat, "), (look, thin), strict=True):
            axes.plot(each.x / unit.factor, sx / 1e6, label=with_heat + LABELS[name], **line)
        both, alone = (with_unit(extremum.value, "Pa") for extremum in each.along)
        largest.append(f"{LABELS[name]} {both}, without heat {alone}")
    axes.set(ylabel="σx [MPa]", xlabel=f"x [{unit.name}]", xlim=each.x[[0, -1]] / unit.factor)
    axes.legend(loc="lower right")
    what = "Stress along the body's surface by contact and heat together, and by contact alone."
    return style.Picture(
        source=style.data_uri(drawn),
        data=style.csv_link(drawn),
        wide=True,
        alternative=f"{what} Largest: {'; '.join(largest)}.",
        caption=f"{what} Tension is positive. Largest: {'; '.join(largest)}.",
    )


def _below(outcome: Outcome, body: int) -> style.Picture:
    study, half_width = outcome.heat, outcome.problem.hertz.half_width
    values, name = study.field[body], ("body", "roller")[body]
    drawn, (place,), (bar,) = layout(1, HEIGHT)
    x, z, bands = study.x / half_width, study.z / half_width, round_bands([values], signed=False)
    shown = fill(place, x, z, values, bands, "magma", signed=False)
    row, column = np.unravel_index(values.argmax(), values.shape)
    cross(place, x[column], z[row])
    words = f"{name}: largest {significant(values.max())} K at x = {significant(x[column], 3)} a"
    place.set_title(words)
    colour_bar(drawn, bar, shown, "rise [K]", bands)
    return style.Picture(
        source=style.data_uri(drawn),
        alternative=f"Rise of temperature below the surface of the {name}; {words}.",
        caption=f"Rise of temperature below the surface of the {name}, as a half-space.",
    )
