"""Theories of rough contact beside the solved one, and the asperities' penetration.

In: a run with [statistics]. Out: tables and pictures for the page, lines for the terminal."""

import numpy as np

from comparisons.common.numbers import percent, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Note, Pictures, TextTable
from comparisons.drawing.curves import over, panels
from comparisons.figures.quantity import LABELS
from comparisons.studies.statistics.figures import NAME, LoadRow, SummitRow
from comparisons.studies.study import Run

KINDS = {"elastic": "#0072B2", "plastic": "#E69F00", "cutting": "#D55E00"}
FLOWS = 1e-6  # equivalent plastic strain
LOOKS = {
    "moments": {"color": "#0072B2", "label": "Greenwood and Tripp, moments"},
    "peaks": {"color": "#56B4E9", "linestyle": (0, (5, 1.5)), "label": "the same, counted peaks"},
    "ridges": style.LINES["whole"] | {"label": "Persson, ridges"},
    "even": style.REFERENCE | {"label": "as many ridges, Hertz"},
    "random": {"color": "#D55E00", "marker": "o", "linestyle": "none", "label": "random traces"},
    "trace": {"color": "#222222", "marker": "x", "linestyle": "none", "label": "the scene's"},
}
POINTS, ALONG = 4000, 20  # of the profile, of each patch
SUMMITS = ("", "bandwidth", "rms slope", "peaks a mm", "radius", "deviation")
SUMMITS += ("summits a mm²", "radius of summits", "deviation of summits")
PRESSURES = ("load", "patches", "theory, by moments", "by peaks", "Persson, ridges")
PRESSURES += ("as many ridges, Hertz", "random traces", "the trace", "theory over random")
PRESSURES += ("as the product of", "half-width over a: theory", "random", "the trace")
ON_THEORY = """Theory: a rough cylinder whose summits, spheres of Gaussian heights, bear each as if
alone on a half-space that gives way under their mean pressure (Greenwood and Williamson 1966,
Greenwood and Tripp 1967, in line contact). Summits by moments of the profile's spectrum (Nayak
1971) or by counting its peaks. Solved: the elastic half-plane under the scene's trace and under
random ones of its spectrum, ± the 95 % interval of their mean. Theory over solved is the product of
three factors: summits alone, the theory over Persson's of the same isotropic surface; ridges, a
profile pressed in plane strain has ridges across it and no summits (√2 by Persson); few contacts,
the rest, where a light load rests on one ridge or two, whose pressure goes with the root of the
load."""
ON_PENETRATION = """Relative penetration h/R = a²/R² by the peak pressure q₀ of a patch: book,
1.78 (q₀/E)² (Seireg 1998); exact, Hertz's 2.043 (q₀/E)² of a sphere for first flow, which is by
stress, and 3.312 (q₀/E)² of a ridge for cutting, which is by the slope a/R at its edges. Elastic
below {elastic}, cutting above {cutting}. Where finite elements flow, the second number of a cell
counts the patches above a plastic strain."""


def blocks(run: Run) -> list[Block]:
    section, found = run.problem.scene.statistics, run.data(NAME)
    kinds = ("", *(f"{LABELS[m]}, {how}" for m in found.patches for how in ("book", "exact")))
    asperities = "Asperities by relative penetration; after a semicolon, how many of them flow"
    pressures = tuple(map(_pressures, found.loads))
    items = (
        Pictures(("statistics",)),
        TextTable("Summits, by moments / by peaks", SUMMITS, tuple(map(_summits, found.summits))),
        TextTable("Mean real pressure, load over real length", PRESSURES, pressures),
        TextTable(asperities, kinds, tuple(_kinds(run, kind) for kind in KINDS)),
        Note(ON_THEORY),
        Note(
            ON_PENETRATION.format(
                elastic="0.01" if section.metal == "ferrous" else "0.0001",
                cutting="0.3" if section.lubricated else "0.1",
            )
        ),
    )
    return [Block("statistics", items, "Statistics of rough contact")]


def lines(run: Run) -> list[tuple[str, str]]:
    """Of the scene's own load, and of its asperities."""
    found = run.data(NAME)
    row, (model, patches) = found.loads[0], list(found.patches.items())[-1]
    theory = with_unit(row.figures["moments"].mean_real_pressure, "Pa", 3)
    solved = f"solved {_random(row)} under random traces"
    exact = [patch.kinds["exact"] for patch in patches]
    kinds = ", ".join(f"{exact.count(kind)} {kind}" for kind in KINDS)
    return [
        ("statistics", f"mean real pressure {theory} by theory, {solved}: {_causes(row)}"),
        ("asperities", f"by h/R {kinds} ({LABELS[model]})"),
    ]


def _causes(row: LoadRow) -> str:
    return ", ".join(f"{name} ×{significant(value, 3)}" for name, value in row.causes.items())


def _random(row: LoadRow) -> str:
    size = percent(row.scatter.mean_real_pressure, digits=1)
    return f"{with_unit(row.figures['random'].mean_real_pressure, 'Pa', 3)} ± {size}"


def _summits(row: SummitRow) -> tuple[str, ...]:
    name = row.treatment
    name += "" if name == "as pressed" else f" {with_unit(row.size, 'm', 3)}"
    cells = [name, significant(row.bandwidth, 3), significant(row.rms_slope, 3)]
    for pair, area in ((row.peaks, 1e-3), (row.summits, 1e-6)):
        known = [each for each in pair if each is not None]
        cells.append(" / ".join(significant(area * each.density, 3) for each in known))
        for field in ("radius", "deviation"):
            cells.append(" / ".join(with_unit(getattr(each, field), "m", 3) for each in known))
    return tuple(cells)


def _pressures(row: LoadRow) -> tuple[str, ...]:
    each, (over_random, uncertainty) = row.figures, row.difference
    theories = (each[name].mean_real_pressure for name in ("moments", "peaks"))
    widths = (each[name].effective_half_width for name in ("moments", "random", "trace"))
    return (
        *(with_unit(row.load, "N/m", 3), significant(row.patches, 2)),
        *(with_unit(value, "Pa", 3) for value in (*theories, row.persson["ridges"], row.even)),
        *(_random(row), with_unit(each["trace"].mean_real_pressure, "Pa", 3)),
        f"{percent(over_random, signed=True)} ± {percent(uncertainty, digits=1)}",
        _causes(row),
        *(significant(width / row.half_width, 3) for width in widths),
    )


def _kinds(run: Run, kind: str) -> tuple[str, ...]:
    """How many patches by the book's coefficient and the exact one, and how many of them flow."""
    cells = [kind]
    for states in run.data(NAME).patches.values():
        for how in ("book", "exact"):
            own = [state.plastic_strain for state in states if state.kinds[how] == kind]
            known = states[0].plastic_strain is not None
            flow = f"; {sum(strain > FLOWS for strain in own)}" if known else ""
            cells.append(f"{len(own)}{flow}")
    return tuple(cells)


def statistics_pictures(run: Run) -> list[style.Picture]:
    """None without [statistics]."""
    return [] if run.data(NAME) is None else [_over_load(run), _asperities(run)]


def _over_load(run: Run) -> style.Picture:
    """As figure 4.5 of Seireg, with what the theory is held against."""
    rows = run.data(NAME).loads
    load, names = np.array([row.load for row in rows]), rows[0].figures
    pressure = {n: np.array([r.figures[n].mean_real_pressure for r in rows]) for n in names}
    unit = scale_of(pressure["moments"], "Pa")
    others = {"ridges": [row.persson["ridges"] for row in rows], "even": [r.even for r in rows]}
    shown = pressure | {name: np.array(values) for name, values in others.items()}
    hertz = np.array([row.half_width for row in rows])
    widths = {n: np.array([r.figures[n].effective_half_width for r in rows]) / hertz for n in names}
    drawn, axes = panels(style.COLUMN, [(0.3, 2.6), (0.25, 1.75)], foot=0.7)
    for each, values, field, factor in (
        (axes[0], shown, "mean_real_pressure", unit.factor),
        (axes[1], widths, "effective_half_width", 1.0),
    ):
        for name, look in LOOKS.items():
            if name in values:
                each.plot(load, values[name] / factor, markersize=4.5, **look)
        bars = values["random"] * [getattr(row.scatter, field) for row in rows] / factor
        at = {"color": LOOKS["random"]["color"], "linestyle": "none", "capsize": 2.0}
        each.errorbar(load, values["random"] / factor, bars, **at)
        each.set(xscale="log", yscale="log")
    axes[0].set_ylabel(f"mean real pressure [{unit.name}]")
    axes[0].legend(loc="lower right", fontsize=7.5)
    axes[1].set_ylabel("half-width / a")
    over(axes, "load [N/m]")
    grown = [significant(pressure[n][0] / pressure[n][-1], 3) for n in ("moments", "random")]
    said = f"times {grown[0]} by the theory and times {grown[1]} solved"
    alternative = f"Over three decades of load the mean real pressure grows {said}."
    caption = (
        "Mean real pressure, and effective half-width over Hertz's, against load. Over three "
        f"decades the pressure grows {said}. Bars: 95 % interval of the mean over "
        f"{run.data(NAME).traces} random traces of the same spectrum."
    )
    return style.picture(drawn, alternative, caption)


def _asperities(run: Run) -> style.Picture:
    """The profile, its patches of contact in the colour of their kind."""
    (name, patches), problem = list(run.data(NAME).patches.items())[-1], run.problem
    x, spline = np.linspace(*problem.extent, POINTS), problem.surface.profile.spline()
    along, up = scale_of(x, "m"), scale_of([np.ptp(spline(x))], "m")
    drawn, [axes] = panels(style.WIDE, [(0.35, 2.34)], foot=0.51)
    axes.plot(x / along.factor, spline(x) / up.factor, **{**style.OUTLINE, "linewidth": 0.7})
    counts = []
    for kind, colour in KINDS.items():
        own = [patch for patch in patches if patch.kinds["exact"] == kind]
        counts.append(f"{len(own)} {kind}")
        places = [np.append(np.linspace(p.start, p.stop, ALONG), np.nan) for p in own]
        place = np.concatenate([*places, [np.nan]])
        look = {"color": colour, "linewidth": 3.0, "label": counts[-1]}
        axes.plot(place / along.factor, spline(place) / up.factor, **look)
    axes.set_ylabel(f"height [{up.name}]")
    over([axes], f"x [{along.name}]", x / along.factor)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=3)
    wanted = problem.scene.statistics
    rule = f"{wanted.metal}, {'lubricated' if wanted.lubricated else 'dry'}"
    said = f"by relative penetration, {rule}: {', '.join(counts)}"
    alternative = f"The profile and its patches of contact, {said}."
    return style.picture(
        drawn, alternative, f"Patches of contact ({LABELS[name]}) {said}.", data=False, wide=True
    )
