"""Flash temperatures on the page and in the terminal.

In: a run with [heat]. Out: facts, pictures of both surfaces and below."""

from dataclasses import replace

import numpy as np

from comparisons.common.numbers import plain, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.curves import draw, legend_above, names_above, over, panels
from comparisons.drawing.field import ColourScale, FieldPanel, draw_fields
from comparisons.figures.quantity import MODELS, error_text
from comparisons.judging.study import Run
from comparisons.studies.heat.half_space import reach_of
from comparisons.studies.heat.study import NAME, OTHER_PRESSURES

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


def note(run: Run) -> str:
    return NOTE + OF_STRESSES * bool(run.data(NAME).stresses)


def heat_facts(run: Run) -> list[tuple[str, str]]:
    """Facts on what moves, and on the parts of the difference of the largest rise."""
    study, heat = run.data(NAME), run.problem.scene.heat
    body, roller = (f"{significant(abs(v), 3)} m/s" for v in heat.velocities)
    reach = with_unit(reach_of(run.problem), "m")
    facts = [
        ("surfaces pass the contact at", f"body {body}, roller {roller}"),
        ("bulk temperature", f"{plain(heat.bulk_temperature)} K, at rest {reach} away"),
    ]
    flash = run.figures.of(study=NAME, quantity="flash_temperature")
    figure = flash.one(against=MODELS[1]) or flash.one(source=list(run.runs)[-1])
    for part in sorted(figure.parts, key=lambda part: part.name != OTHER_PRESSURES):
        name = f"change of the largest rise without {study.contains.get(part.name)}"
        if part.name == OTHER_PRESSURES:
            name = "difference of both models by their pressures"
        changed = replace(figure, value=part.value).sized(part.uncertainty)
        unsure = error_text(part.value, figure.numerical)  # in what digits are certain
        facts.append((name, unsure if part.uncertainty is None else changed))
    return facts


def surfaces_picture(run: Run) -> style.Picture:
    """The surfaces' temperatures over the heat, and their stresses where these are known."""
    contacts, stresses = run.data(NAME).contacts, run.data(NAME).stresses
    caption = (
        "Rise of both surfaces above the bulk temperature, equal where they touch; wide and pale: "
        "the roller's. Below, the heat of friction, wide and pale, and its part that enters the "
        "body."
    )
    caption += " Last, σx of the body's surface; wide and pale: without heat." * bool(stresses)
    abreast, room = names_above(style.WIDE, 2 * len(contacts))
    rows = [(room, 2.2), (0.2, 0.98), (0.2, 1.5)][: 3 if stresses else 2]
    drawn, axes = panels(style.WIDE, rows)
    unit = scale_of(next(iter(contacts.values())).x, "m")

    for panel, part, name, look, scale in (
        (axes[0], ", body", "body", {}, 1.0),
        (axes[0], ", roller", "roller", style.PALE, 1.0),
        (axes[1], ", all", "heat", style.PALE, 1e6),
        (axes[1], ", into the body", "into_body", {}, 1e6),
    ):
        curves = {m: (c.x / unit.factor, getattr(c, name) / scale) for m, c in contacts.items()}
        draw(panel, curves, part, **look)
    for case, look in enumerate(({}, style.PALE) if stresses else ()):
        curves = {m: (s.x / unit.factor, s.sx[case] / 1e6) for m, s in stresses.items()}
        draw(axes[2], curves, **look)
    for panel, name in zip(axes, ("rise [K]", "heat [W/mm²]", "σx [MPa]"), strict=False):
        panel.set_ylabel(name)
    over(axes, f"x [{unit.name}]", next(iter(contacts.values())).x / unit.factor)
    legend_above(axes[0], abreast)
    return style.picture(drawn, caption, caption)


def below_pictures(run: Run) -> list[style.Picture]:
    """The rise below either surface."""
    study, pictures, half_width = run.data(NAME), [], run.problem.hertz.half_width
    x, z = study.x / half_width, study.z / half_width
    for name, values in zip(("body", "roller"), study.field, strict=True):
        row, column = np.unravel_index(values.argmax(), values.shape)
        at = f"{significant(values.max())} K at x = {significant(x[column], 3)} a"
        panel = FieldPanel(f"{name}: largest {at}", values, (x[column], z[row]))
        scale = ColourScale.over("rise [K]", [values], "magma")
        drawn = draw_fields(x, z, [panel], scale, HEIGHT)
        words = f"Rise of temperature below the surface of the {name}"
        alternative, caption = f"{words}; {panel.title}.", f"{words}, as a half-space."
        pictures.append(style.picture(drawn, alternative, caption, data=False))
    return pictures


PICTURES = {"heat_surfaces": surfaces_picture, "heat_below": below_pictures}
