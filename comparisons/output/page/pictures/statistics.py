"""Mean real pressure and effective half-width over the load, and asperities by kind."""

import numpy as np

from comparisons.common.numbers import scale_of, significant
from comparisons.drawing import style
from comparisons.figures.quantity import LABELS
from comparisons.studies.study import Run

LOOKS = {
    "moments": {"color": "#0072B2", "label": "Greenwood and Tripp, moments"},
    "peaks": {"color": "#56B4E9", "linestyle": (0, (5, 1.5)), "label": "the same, counted peaks"},
    "ridges": style.LINES["whole"] | {"label": "Persson, ridges"},
    "even": style.REFERENCE | {"label": "as many ridges, Hertz"},
    "random": {"color": "#D55E00", "marker": "o", "linestyle": "none", "label": "random traces"},
    "trace": {"color": "#222222", "marker": "x", "linestyle": "none", "label": "the scene's"},
}
KINDS = {"elastic": "#0072B2", "plastic": "#E69F00", "cutting": "#D55E00"}
POINTS, ALONG = 4000, 20  # of the profile, of each patch


def statistics_pictures(outcome: Run) -> list[style.Picture]:
    """None without [statistics]."""
    if outcome.data("statistics") is None:
        return []
    return [_over_load(outcome), _asperities(outcome)]


def _over_load(outcome: Run) -> style.Picture:
    """As figure 4.5 of Seireg, with what the theory is held against."""
    rows = outcome.data("statistics").loads
    load, names = np.array([row.load for row in rows]), rows[0].figures
    pressure = {n: np.array([r.figures[n].mean_real_pressure for r in rows]) for n in names}
    unit = scale_of(pressure["moments"], "Pa")
    others = {"ridges": [row.persson["ridges"] for row in rows], "even": [r.even for r in rows]}
    shown = pressure | {name: np.array(values) for name, values in others.items()}
    hertz = np.array([row.half_width for row in rows])
    widths = {n: np.array([r.figures[n].effective_half_width for r in rows]) / hertz for n in names}
    drawn = style.figure(style.COLUMN, 5.6)
    panels = style.stacked(drawn, [(0.3, 2.6), (0.25, 1.75)], 0.8, 0.12)
    for axes, values, field, factor in (
        (panels[0], shown, "mean_real_pressure", unit.factor),
        (panels[1], widths, "effective_half_width", 1.0),
    ):
        for name, look in LOOKS.items():
            if name in values:
                axes.plot(load, values[name] / factor, markersize=4.5, **look)
        bars = values["random"] * [getattr(row.scatter, field) for row in rows] / factor
        at = {"color": LOOKS["random"]["color"], "linestyle": "none", "capsize": 2.0}
        axes.errorbar(load, values["random"] / factor, bars, **at)
        axes.set(xscale="log", yscale="log")
    panels[0].set_ylabel(f"mean real pressure [{unit.name}]")
    panels[0].tick_params(labelbottom=False)
    panels[0].legend(loc="lower right", fontsize=7.5)
    panels[1].set(xlabel="load [N/m]", ylabel="half-width / a")
    grown = [significant(pressure[n][0] / pressure[n][-1], 3) for n in ("moments", "random")]
    said = f"times {grown[0]} by the theory and times {grown[1]} solved"
    return style.Picture(
        source=style.data_uri(drawn),
        data=style.csv_link(drawn),
        alternative=f"Over three decades of load the mean real pressure grows {said}.",
        caption=(
            "Mean real pressure, and effective half-width over Hertz's, against load. Over three "
            f"decades the pressure grows {said}. Bars: 95 % interval of the mean over "
            f"{outcome.data('statistics').traces} random traces of the same spectrum."
        ),
    )


def _asperities(outcome: Run) -> style.Picture:
    """The profile, its patches of contact in the colour of their kind."""
    (name, patches), problem = list(outcome.data("statistics").patches.items())[-1], outcome.problem
    x, spline = np.linspace(*problem.extent, POINTS), problem.surface.profile.spline()
    along, up = scale_of(x, "m"), scale_of([np.ptp(spline(x))], "m")
    drawn = style.figure(style.WIDE, 3.2)
    [axes] = style.stacked(drawn, [(0.35, 2.34)], 0.8, 0.12)
    axes.plot(x / along.factor, spline(x) / up.factor, **{**style.OUTLINE, "linewidth": 0.7})
    counts = []
    for kind, colour in KINDS.items():
        own = [patch for patch in patches if patch.kinds["exact"] == kind]
        counts.append(f"{len(own)} {kind}")
        places = [np.append(np.linspace(p.start, p.stop, ALONG), np.nan) for p in own]
        place = np.concatenate([*places, [np.nan]])
        look = {"color": colour, "linewidth": 3.0, "label": counts[-1]}
        axes.plot(place / along.factor, spline(place) / up.factor, **look)
    axes.set(xlabel=f"x [{along.name}]", ylabel=f"height [{up.name}]")
    axes.set_xlim(x[0] / along.factor, x[-1] / along.factor)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=3)
    wanted = problem.scene.statistics
    rule = f"{wanted.metal}, {'lubricated' if wanted.lubricated else 'dry'}"
    said = f"by relative penetration, {rule}: {', '.join(counts)}"
    return style.Picture(
        source=style.data_uri(drawn),
        wide=True,
        alternative=f"The profile and its patches of contact, {said}.",
        caption=f"Patches of contact ({LABELS[name]}) {said}.",
    )
