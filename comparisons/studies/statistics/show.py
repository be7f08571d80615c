"""Theories of rough contact beside the solved one, and the asperities' penetration.

In: a run with [statistics]. Out: tables and pictures for the page, lines for the terminal."""

import numpy as np

from comparisons.common.numbers import scale_of, significant
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Names, Note, Pictures
from comparisons.drawing.curves import legend_above, names_above, over, panels
from comparisons.drawing.tables import series_table, stated_text
from comparisons.figures.figure import Findings, Series
from comparisons.figures.quantity import LABELS
from comparisons.judging.study import Run
from comparisons.studies.statistics.study import FIGURES, NAME, PRESSURE

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
STRAIN = "plastic_strain"
ON_THEORY = """Theory: a rough cylinder whose summits, spheres of Gaussian heights, bear each as if
alone on a half-space that gives way under their mean pressure (Greenwood and Williamson 1966,
Greenwood and Tripp 1967, in line contact). Summits by moments of the profile's spectrum (Nayak
1971) or by counting its peaks. Solved: the elastic half-plane under the scene's trace and under
random ones of its spectrum, ± the 95 % interval of their mean. Theory over solved is the product of
three factors: summits alone, the theory over Persson's of the same isotropic surface; ridges, a
profile pressed in plane strain has ridges across it and no summits (√2 by Persson); few contacts,
the rest, where a light load rests on one ridge or two, whose pressure goes with the root of the
load. Even: as many ridges as patches, each under the same share of the load, by Hertz."""
ON_PENETRATION = """Relative penetration h/R = a²/R² by the peak pressure q₀ of a patch: book,
1.78 (q₀/E)² (Seireg 1998); exact, Hertz's 2.043 (q₀/E)² of a sphere for first flow, which is by
stress, and 3.312 (q₀/E)² of a ridge for cutting, which is by the slope a/R at its edges. Elastic
below {elastic}, cutting above {cutting}. Where finite elements flow, in brackets those above a
plastic strain of {flows:g}."""


def blocks(run: Run) -> list[Block]:
    section, findings = run.problem.scene.statistics, run.findings[NAME]
    limits = {"elastic": "0.01" if section.metal == "ferrous" else "0.0001"}
    limits["cutting"] = "0.3" if section.lubricated else "0.1"
    patches = [
        (f"patches by h/R, {how}, {LABELS[one.source]}", ", ".join(_counted(one, how)))
        for one in _patches(findings)
        for how in ("book", "exact")
    ]
    items = (
        Pictures(("statistics",)),
        series_table("Summits, by moments and by peaks", findings.table("summits")),
        series_table("Theory and solved", findings.table("loads")),
        Names(patches),
        Note(ON_THEORY),
        Note(ON_PENETRATION.format(**limits, flows=FLOWS)),
    )
    return [Block("statistics", items, "Statistics of rough contact")]


def lines(run: Run) -> list[tuple[str, str]]:
    """Lines on the scene's own load, and on its asperities."""
    findings, (*_, patches) = run.findings[NAME], _patches(run.findings[NAME])
    first = {n: stated_text(c)[0] for n, c in findings.table("loads").columns.items()}
    theory, random = (first[f"figures.{source}.{PRESSURE}"] for source in ("moments", "random"))
    causes = (f"{n.removeprefix('causes.')} ×{first[n]}" for n in first if "causes." in n)
    solved = f"solved {random} under random traces"
    return [
        ("statistics", f"mean real pressure {theory} by theory, {solved}: {', '.join(causes)}"),
        ("asperities", f"by h/R {', '.join(_counted(patches))} ({LABELS[patches.source]})"),
    ]


def _patches(findings: Findings) -> list[Series]:
    """Patches by model."""
    return [series for series in findings.series if series.name == "patches"]


def _counted(patches: Series, how: str = "exact") -> list[str]:
    """Numbers of patches of each kind and, where the model flows, of those that do."""
    kinds, strain = np.array(patches.columns[f"kinds.{how}"].values), patches.columns.get(STRAIN)
    counts = [f"{np.sum(kinds == kind)} {kind}" for kind in KINDS]
    if strain is None:
        return counts
    flow = [np.sum(strain.numbers[kinds == kind] > FLOWS) for kind in KINDS]
    return [f"{count} ({some} flow)" for count, some in zip(counts, flow, strict=True)]


def statistics_pictures(run: Run) -> list[style.Picture]:
    return [_over_load(run), _asperities(run)]


def _over_load(run: Run) -> style.Picture:
    """Figure 4.5 of Seireg, with what the theory is held against."""
    findings = run.findings[NAME]
    columns = findings.table("loads").columns
    load, hertz = columns["load"].numbers, columns["half_width"].numbers
    unit = scale_of(columns[f"figures.moments.{PRESSURE}"].values, "Pa")
    abreast, room = names_above(style.COLUMN, len(LOOKS))
    drawn, axes = panels(style.COLUMN, [(room, 2.2), (0.25, 1.5)], foot=0.5)
    for panel, figure, scale in ((axes[0], PRESSURE, unit.factor), (axes[1], FIGURES[2], hertz)):
        for name, look in LOOKS.items():
            of_theory = {"ridges": "persson.ridges", "even": "even"} if panel is axes[0] else {}
            column = columns.get(of_theory.get(name, f"figures.{name}.{figure}"))
            if column is not None:
                bars = column.sizes / scale if column.uncertainty else None
                panel.errorbar(load, column.numbers / scale, bars, markersize=4.5, **look)
        panel.set(xscale="log", yscale="log")
    axes[0].set_ylabel(f"mean real pressure [{unit.name}]")
    legend_above(axes[0], abreast)
    axes[1].set_ylabel("half-width / a")
    over(axes, "load [N/m]")
    ends = (columns[f"figures.{name}.{PRESSURE}"].values for name in ("moments", "random"))
    theory, solved = (significant(first / last, 3) for first, *_, last in ends)
    [traces] = findings.table("traces").columns["traces"].values
    caption = (
        "Mean real pressure, and effective half-width over Hertz's, against load. Over three "
        f"decades the pressure grows {theory} times by the theory and {solved} times as solved. "
        f"Bars: 95 % interval of the mean over {traces} random traces of the same spectrum."
    )
    return style.picture(drawn, caption, caption)


def _asperities(run: Run) -> style.Picture:
    """The profile, its patches of contact in the colour of their kind."""
    (*_, patches), wanted = _patches(run.findings[NAME]), run.problem.scene.statistics
    counts = _counted(patches)
    rule = f"{wanted.metal}, {'lubricated' if wanted.lubricated else 'dry'}"
    caption = f"The profile and its patches of contact ({LABELS[patches.source]}) by relative "
    caption += f"penetration, {rule}: {', '.join(counts)}."
    x, spline = np.linspace(*run.problem.extent, POINTS), run.problem.surface.profile.spline()
    along, up = scale_of(x, "m"), scale_of([np.ptp(spline(x))], "m")
    abreast, room = names_above(style.WIDE, len(KINDS))
    drawn, [axes] = panels(style.WIDE, [(room, 2.34)], foot=0.51)
    axes.plot(x / along.factor, spline(x) / up.factor, **{**style.OUTLINE, "linewidth": 0.7})
    for (kind, colour), label in zip(KINDS.items(), counts, strict=True):
        ends = [(p["start"], p["stop"]) for p in patches.rows() if p["kinds.exact"] == kind]
        places = [np.append(np.linspace(*pair, ALONG), np.nan) for pair in ends]
        place = np.concatenate([*places, [np.nan]])
        look = {"color": colour, "linewidth": 3.0, "label": label}
        axes.plot(place / along.factor, spline(place) / up.factor, **look)
    axes.set_ylabel(f"height [{up.name}]")
    over([axes], f"x [{along.name}]", x / along.factor)
    legend_above(axes, abreast)
    return style.picture(drawn, caption, caption, data=False)
