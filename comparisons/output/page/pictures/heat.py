"""Temperatures of both surfaces in and beside the contact, and below it."""

import numpy as np

from comparisons.common.numbers import scale_of, significant
from comparisons.drawing import style
from comparisons.drawing.field import ColourScale, FieldPanel, draw_fields, round_bands
from comparisons.figures.quantity import LABELS
from comparisons.studies.study import Run

HEIGHT = 1.9  # inches, of a field


def heat_pictures(outcome: Run) -> list[style.Picture]:
    """The surfaces' temperatures, then the field below either; nothing without [heat]."""
    if outcome.data("heat") is None:
        return []
    return [_surfaces(outcome), *(_below(outcome, k) for k in range(2))]


def _surfaces(outcome: Run) -> style.Picture:
    contacts, stresses = outcome.data("heat").contacts, outcome.data("heat").stresses
    panels = [(0.22, 2.2), (0.2, 0.82), (0.2, 1.5)][: 3 if stresses else 2]
    drawn = style.figure(style.WIDE, 0.46 + sum(map(sum, panels)))
    above, below, *along = drawn_in = style.stacked(drawn, panels, 0.8)
    unit = scale_of(next(iter(contacts.values())).x, "m")
    for name, each in contacts.items():
        x, look = each.x / unit.factor, style.LINES[name]
        above.plot(x, each.body, label=f"body, {LABELS[name]}", **look)
        thin = {**look, "linewidth": 0.5 * look["linewidth"]}
        above.plot(x, each.roller, label=f"roller, {LABELS[name]}", **thin)
        below.plot(x, each.heat / 1e6, label=f"all, {LABELS[name]}", **thin)
        below.plot(x, each.into_body / 1e6, label=f"into the body, {LABELS[name]}", **look)
        for sx, line in zip(stresses[name].sx if stresses else (), (look, thin), strict=False):
            along[0].plot(stresses[name].x / unit.factor, sx / 1e6, **line)
    names = "rise [K]", "heat [W/mm²]", "σx [MPa]"
    for axes, name in zip(drawn_in, names, strict=False):
        axes.set(ylabel=name, xlim=(x[0], x[-1]))
        axes.tick_params(labelbottom=axes is drawn_in[-1])
    drawn_in[-1].set(xlabel=f"x [{unit.name}]")
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
            + " Last, σx of the body's surface, thin without heat."
            * bool(stresses)
        ),
    )


def _below(outcome: Run, body: int) -> style.Picture:
    study, half_width = outcome.data("heat"), outcome.problem.hertz.half_width
    values, name = study.field[body], ("body", "roller")[body]
    x, z = study.x / half_width, study.z / half_width
    row, column = np.unravel_index(values.argmax(), values.shape)
    words = f"{name}: largest {significant(values.max())} K at x = {significant(x[column], 3)} a"
    panel = FieldPanel(words, values, (x[column], z[row]))
    scale = ColourScale("rise [K]", round_bands([values], signed=False), "magma")
    drawn, _ = draw_fields(x, z, [panel], scale, HEIGHT)
    return style.Picture(
        source=style.data_uri(drawn),
        alternative=f"Rise of temperature below the surface of the {name}; {words}.",
        caption=f"Rise of temperature below the surface of the {name}, as a half-space.",
    )
