"""Seconds by stage of every model, on a scale on which milliseconds and minutes are both seen."""

import numpy as np

from comparisons.common.numbers import with_unit
from comparisons.drawing import style
from comparisons.figures.quantity import LABELS
from comparisons.studies.study import Run

SHORTEST = 1e-4  # seconds: shorter stages are drawn as if they took so long


def cost_picture(outcome: Run) -> style.Picture:
    """One bar a stage and model, all levels together; on top the sums."""
    rows: list[tuple[str, str, float]] = []
    for name, run in outcome.runs.items():
        rows.append((name, f"{LABELS[name]}, in all", sum(run.seconds.values())))
        rows += [(name, stage, seconds) for stage, seconds in run.seconds.items()]
    drawn = style.figure(style.COLUMN, 0.24 * len(rows) + 0.7)
    [axes] = style.stacked(drawn, [(0.12, 0.24 * len(rows) + 0.08)], 1.62, 0.67)
    place = -np.arange(len(rows), dtype=float)
    shown = np.maximum([seconds for _, _, seconds in rows], SHORTEST)
    hatched: list = []
    first = 10.0 ** np.floor(np.log10(shown.min()) - 0.3)
    for y, width, (name, label, seconds) in zip(place, shown, rows, strict=True):
        total = label.endswith("in all")
        colour = style.LINES[name]["color"]
        look = {"facecolor": colour if total else "white", "edgecolor": colour, "linewidth": 0.9}
        [bar] = axes.barh(y, width - first, left=first, height=0.72, **look)
        hatched += [bar] * (name == "finite_element")
        beside = {"xytext": (4, 0), "textcoords": "offset points", "va": "center"}
        axes.annotate(with_unit(seconds, "s", 3), (width, y), **beside)
    style.hatch(axes, hatched, style.LINES["finite_element"]["color"])
    axes.set_xscale("log")
    last = 10.0 ** np.ceil(np.log10(shown.max()))
    axes.set_xlim(first, last)
    ticks = 10.0 ** np.arange(np.log10(first).round(), np.log10(last).round() + 1.0)
    axes.set_xticks(ticks, [with_unit(tick, "s", 1) for tick in ticks])
    axes.minorticks_off()
    style.horizontal_bars(axes, place, [label for _, label, _ in rows])
    axes.set_xlabel("time, logarithmic")
    times = {LABELS[n]: sum(run.seconds.values()) for n, run in outcome.runs.items()}
    totals = "; ".join(f"{name} {with_unit(time, 's', 3)}" for name, time in times.items())
    said = f"In all: {totals}."
    caption = f"Run time by stage, all levels together; the scale is logarithmic. {said}"
    return style.picture(drawn, f"Run time by stage. {said}", caption, data=False)
