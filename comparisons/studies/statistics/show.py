"""Theories of rough contact beside the solved one, and the asperities' penetration.

In: a run with [statistics]. Out: tables and pictures for the page, lines for the terminal."""

import numpy as np

from comparisons.common.numbers import percent, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Note, Pictures, TextTable
from comparisons.drawing.curves import legend_above, names_above, over, panels
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
SUMMITS = ("", "bandwidth", "rms slope", "peaks per mm", "radius", "deviation")
SUMMITS += ("summits per mm²", "radius of summits", "deviation of summits")
PRESSURES = ("load", "patches", "theory, by moments", "by peaks", "Persson, ridges")
PRESSURES += ("as many ridges, Hertz", "random traces", "the trace")
WIDTHS = ("half-width over a: theory", "random traces", "the trace")
THEORIES = [f"figures.{source}.{PRESSURE}" for source in ("moments", "peaks")]
THEORIES += ["persson.ridges", "even"]
STRAIN = "plastic_strain"
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
    section = run.problem.scene.statistics
    items = (
        *(Pictures(("statistics",)), _summit_table, _load_tables, _patch_table),
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
    findings, (*_, patches) = run.findings[NAME], _patches(run.findings[NAME])
    loads = findings.table("loads")
    row = loads.rows()[0]
    theory = with_unit(row[f"figures.moments.{PRESSURE}"], "Pa", 3)
    solved = f"solved {_random(loads)[0]} under random traces"
    causes = ", ".join(map(" ".join, _causes(row).items()))
    exact = patches.columns["kinds.exact"].values
    kinds = ", ".join(f"{exact.count(kind)} {kind}" for kind in KINDS)
    return [
        ("statistics", f"mean real pressure {theory} by theory, {solved}: {causes}"),
        ("asperities", f"by h/R {kinds} ({LABELS[patches.source]})"),
    ]


def _patches(findings: Findings) -> list[Series]:
    """By model."""
    return [series for series in findings.series if series.name == "patches"]


def _causes(row: dict) -> dict[str, str]:
    """The factors of theory over solved."""
    factors = {name.removeprefix("causes."): row[name] for name in row if "causes." in name}
    return {name: f"×{significant(value, 3)}" for name, value in factors.items()}


def _random(loads: Series) -> list[str]:
    """The mean real pressure of the random traces under each load."""
    column = loads.columns[f"figures.random.{PRESSURE}"]
    shares = column.sizes / column.numbers
    return [
        f"{with_unit(value, 'Pa', 3)} ± {percent(share, digits=1)}"
        for value, share in zip(column.values, shares, strict=True)
    ]


def _summit_table(run: Run) -> TextTable:
    summits = tuple(map(_summits, run.findings[NAME].table("summits").rows()))
    return TextTable("Summits, by moments / by peaks", SUMMITS, summits)


def _summits(row: dict) -> tuple[str, ...]:
    name = row["treatment"]
    name += "" if name == "as pressed" else f" {with_unit(row['size'], 'm', 3)}"
    cells = [name, significant(row["bandwidth"], 3), significant(row["rms_slope"], 3)]
    for kind, area in (("peaks", 1e-3), ("summits", 1e-6)):
        both = (f"{kind}.moments.", f"{kind}.peaks.")
        known = [where for where in both if row.get(f"{where}density") is not None]
        cells.append(" / ".join(significant(area * row[f"{w}density"], 3) for w in known))
        for field in ("radius", "deviation"):
            cells.append(" / ".join(with_unit(row[where + field], "m", 3) for where in known))
    return tuple(cells)


def _load_tables(run: Run) -> list[TextTable]:
    """Pressures; and how far the theory is off, why, and the widths."""
    loads = run.findings[NAME].table("loads")
    pressures, factors, differences = [], [], loads.columns["difference"].sizes
    for row, random, uncertainty in zip(loads.rows(), _random(loads), differences, strict=True):
        widths = (row[f"figures.{n}.{FIGURES[2]}"] for n in ("moments", "random", "trace"))
        load, excess = with_unit(row["load"], "N/m", 3), percent(row["difference"], signed=True)
        trace = with_unit(row[f"figures.trace.{PRESSURE}"], "Pa", 3)
        before = (with_unit(row[name], "Pa", 3) for name in THEORIES)
        pressures.append((load, significant(row["patches"], 2), *before, random, trace))
        excess += f" ± {percent(uncertainty, digits=1)}"
        widths = (significant(width / row["half_width"], 3) for width in widths)
        factors.append((load, excess, *_causes(row).values(), *widths))
    head = ("load", "theory over random", *_causes(loads.rows()[0]), *WIDTHS)
    title = "Mean real pressure, load over real length"
    return [
        TextTable(title, PRESSURES, tuple(pressures)),
        TextTable("Theory over solved, and half-widths", head, tuple(factors)),
    ]


def _patch_table(run: Run) -> TextTable:
    findings = run.findings[NAME]
    models = [LABELS[patches.source] for patches in _patches(findings)]
    title = "Patches of contact by relative penetration"
    if any(STRAIN in patches.columns for patches in _patches(findings)):
        title += "; after a semicolon, how many of them flow"
    head = ("", *(f"{model}, {how}" for model in models for how in ("book", "exact")))
    return TextTable(title, head, tuple(_kinds(findings, kind) for kind in KINDS))


def _kinds(findings: Findings, kind: str) -> tuple[str, ...]:
    """How many patches by the book's coefficient and the exact one, and how many of them flow."""
    cells = [kind]
    for patches in _patches(findings):
        for how in ("book", "exact"):
            rows = [row for row in patches.rows() if row[f"kinds.{how}"] == kind]
            flowing = sum(row[STRAIN] > FLOWS for row in rows if STRAIN in row)
            cells.append(f"{len(rows)}; {flowing}" if STRAIN in patches.columns else f"{len(rows)}")
    return tuple(cells)


def statistics_pictures(run: Run) -> list[style.Picture]:
    return [_over_load(run), _asperities(run)]


def _over_load(run: Run) -> style.Picture:
    """As figure 4.5 of Seireg, with what the theory is held against."""
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
                panel.plot(load, column.numbers / scale, markersize=4.5, **look)
        random = columns[f"figures.random.{figure}"]
        look = {"color": LOOKS["random"]["color"], "linestyle": "none", "capsize": 2.0}
        panel.errorbar(load, random.numbers / scale, random.sizes / scale, **look)
        panel.set(xscale="log", yscale="log")
    axes[0].set_ylabel(f"mean real pressure [{unit.name}]")
    legend_above(axes[0], abreast)
    axes[1].set_ylabel("half-width / a")
    over(axes, "load [N/m]")
    ends = (columns[f"figures.{name}.{PRESSURE}"].values for name in ("moments", "random"))
    theory, solved = (significant(first / last, 3) for first, *_, last in ends)
    grown = f"{theory} times by the theory and {solved} times as solved"
    alternative = f"Over three decades of load the mean real pressure grows {grown}."
    [traces] = findings.table("traces").columns["traces"].values
    caption = (
        "Mean real pressure, and effective half-width over Hertz's, against load. Over three "
        f"decades the pressure grows {grown}. Bars: 95 % interval of the mean over "
        f"{traces} random traces of the same spectrum."
    )
    return style.picture(drawn, alternative, caption)


def _asperities(run: Run) -> style.Picture:
    """The profile, its patches of contact in the colour of their kind."""
    (*_, patches), wanted = _patches(run.findings[NAME]), run.problem.scene.statistics
    kinds = patches.columns["kinds.exact"].values
    counts = [f"{kinds.count(kind)} {kind}" for kind in KINDS]
    rule = f"{wanted.metal}, {'lubricated' if wanted.lubricated else 'dry'}"
    said = f"by relative penetration, {rule}: {', '.join(counts)}"
    caption = f"Patches of contact ({LABELS[patches.source]}) {said}."
    alternative = f"The profile and its patches of contact, {said}."
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
    return style.picture(drawn, alternative, caption, data=False)
