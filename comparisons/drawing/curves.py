"""Panels of curves under each other over one axis, and the load in words above them."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import as_written, with_unit
from comparisons.drawing import style
from comparisons.figures.quantity import LABELS
from comparisons.models.problem import Problem

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COINCIDE = 1e-2  # of the reach of all curves: what is nearer is one line
NAMES_ABREAST, NAMES_ROW = 4, 0.17  # of a legend above a panel; inches
LEFT, FOOT = 0.8, 0.46  # inches: left of the panels, below the last


def panels(
    width: float,
    rows: Sequence[tuple[float, float]],
    left: float = LEFT,
    right: float = style.RIGHT,
    foot: float = FOOT,
    abreast: int = 1,
    between: float = 0.0,
    count: int | None = None,
) -> "tuple[Figure, list[Axes]]":
    """A figure with panels, row by row, all in inches.

    rows                  space above each row and its height; foot: space below the last
    left, right, between  space beside all panels, and from one to the next of those `abreast`
    count                 how many there are, where the last row is not full"""
    drawn = style.figure(width, sum(map(sum, rows)) + foot)
    share = (width - left - right + between) / abreast
    sides = [
        style.stacked(drawn, rows, left + k * share, width - left - (k + 1) * share + between)
        for k in range(abreast)
    ]
    made = [panel for row in zip(*sides, strict=True) for panel in row]
    for panel in made[count:] if count else ():
        panel.remove()
    return drawn, made[:count]


def names_above(width: float, names: int) -> tuple[int, float]:
    """Columns of a legend above a panel in a figure `width` inches wide, and its height."""
    abreast = NAMES_ABREAST if width > 0.75 * style.WIDE else 2
    return min(abreast, names), NAMES_ROW * (1 + -(-names // abreast))


def legend_above(panel: "Axes", columns: int) -> None:
    """The curves' names above a panel, where no curve is."""
    panel.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, borderaxespad=0.1)


def joint_legend(drawn: "Figure", columns: int = 0, **look: object) -> None:
    """The names of all panels once, above them; in one row without `columns`."""
    entries: dict[str, object] = {}
    for axes in drawn.axes:
        handles, labels = axes.get_legend_handles_labels()
        entries = dict(zip(labels, handles, strict=True)) | entries
    ncols = columns or len(entries)
    drawn.legend(entries.values(), entries, loc="upper left", ncols=ncols, **look)


Curve = tuple[np.ndarray, np.ndarray]  # x ascending, y


def distinct(curves: Mapping[str, Curve], least: float = 0.0) -> dict[tuple[str, ...], Curve]:
    """Curves by the names of all that coincide with them: one line over another would be a third
    colour, and hide it. The reach of y, or `least` if that is more, decides how near that is."""
    apart: dict[tuple[str, ...], Curve] = {}
    reach = max([np.ptp(y) for _, y in curves.values()] + [least])
    for name, (x, y) in curves.items():
        for names, (place, known) in apart.items():
            if np.allclose(np.interp(place, x, y), known, rtol=0.0, atol=COINCIDE * reach):
                apart[(*names, name)] = apart.pop(names)
                break
        else:
            apart[(name,)] = x, y
    return apart


def joint_label(names: Sequence[str], beside: str = "") -> str:
    """Label of a line that stands for several."""
    return " = ".join(LABELS[name] for name in names) + beside


def draw(panel: "Axes", curves: Mapping[str, Curve], beside: str = "", **look: object) -> None:
    """Curves by model, each with its model's look and what is given beside it."""
    for names, (x, y) in distinct(curves).items():
        label = joint_label(names, beside)
        panel.plot(x, y, label=label, **{**style.LINES[names[0]], **look})


def over(axes: "Sequence[Axes]", label: str, ends: Sequence[float] | None = None) -> None:
    """One axis for all panels, with numbers and label under the last."""
    for panel in axes:
        if ends is not None:
            panel.set_xlim(ends[0], ends[-1])
        panel.tick_params(labelbottom=panel is axes[-1])
    axes[-1].set_xlabel(label)


def load_text(problem: Problem) -> str:
    """Load per length, in the digits of the scene where the scene gives it; of a periodic surface
    the mean pressure."""
    if problem.scene.periodic:
        return as_written(problem.scene.load.value, "Pa")
    write = as_written if problem.scene.load.kind == "per_length" else with_unit
    return write(problem.hertz.load_per_length, "N/m")


def hertz_text(problem: Problem) -> str:
    """The load, and peak pressure and half-width of the smooth contact under it; of a periodic
    surface the mean pressure and the period."""
    hertz = problem.hertz
    if problem.scene.periodic:
        mean, period = hertz.peak_pressure, 2.0 * hertz.half_width
        return f"mean pressure p₀ = {with_unit(mean, 'Pa')},  period 2a = {with_unit(period, 'm')}"
    return (
        f"P = {load_text(problem)},  p₀ = {with_unit(hertz.peak_pressure, 'Pa')},  "
        f"a = {with_unit(hertz.half_width, 'm')}"
    )
