"""What sliding raises ahead of the contact over a sweep: its height, extent and elastic energy
against the relative penetration."""

from comparisons.common.numbers import plain
from comparisons.drawing import style

# by the figure's name: its uncertainty's, what it is drawn over, and the axis' words
PANELS = {
    "height": ("uncertainty", "penetration", "bulge over h"),
    "end": ("end_uncertainty", "contact", "half of it at, over a\u2032"),
    "energy": ("energy_uncertainty", "work_scale", "energy over P h"),
}
DEPTH = "relative_penetration"
MARKERS = "os^Dv<>"
TALL, ABOVE, FOOT, LEFT = 1.5, 0.2, 0.75, 0.85  # inches


def bulge_curve(content: dict) -> str:
    """SVG of a sweep's content; the same for the same content. A line for each friction."""
    entries = [entry for point in content["points"] for entry in point.get("bulge", ())]
    entries.sort(key=lambda entry: entry[DEPTH])
    with style.drawing():
        drawn = style.figure(style.COLUMN, len(PANELS) * (TALL + ABOVE) + FOOT)
        places = style.stacked(drawn, [(ABOVE, TALL)] * len(PANELS), LEFT)
        for (name, (unsure, unit, words)), axes in zip(PANELS.items(), places, strict=True):
            for k, friction in enumerate(sorted({entry["friction"] for entry in entries})):
                rows = [e for e in entries if e["friction"] == friction and e[unsure] is not None]
                depth = [e[DEPTH] for e in rows]
                value, bar = ([e[which] / e[unit] for e in rows] for which in (name, unsure))
                look = {"marker": MARKERS[k % len(MARKERS)], "markersize": 3.0, "capsize": 2.0}
                axes.errorbar(depth, value, bar, label=f"friction {plain(friction)}", **look)
            ends = (0.9 * entries[0][DEPTH], 1.1 * entries[-1][DEPTH])
            axes.set(xscale="log", xlim=ends, ylabel=words)
            axes.tick_params(labelbottom=axes is places[-1])
        places[0].legend(loc="upper left")
        places[0].set_title(content["scene"]["title"], loc="left")
        places[-1].set_xlabel("h/R")
        return style.svg(drawn)
