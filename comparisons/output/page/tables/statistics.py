"""Theories of rough contact beside the solved one, and the asperities' penetration, as tables."""

from comparisons.common.numbers import percent, significant, with_unit
from comparisons.figures.quantity import LABELS
from comparisons.studies.statistics.figures import NAME, LoadRow, SummitRow
from comparisons.studies.study import Run, TextTable

KINDS = ("elastic", "plastic", "cutting")
FLOWS = 1e-6  # equivalent plastic strain


def statistics_tables(outcome: Run) -> list[TextTable]:
    """Summits, pressures and widths by load, asperities by kind; none without [statistics]."""
    found = outcome.data(NAME)
    if found is None:
        return []
    pressures = ("load", "patches", "theory, by moments", "by peaks", "Persson, ridges")
    pressures += ("as many ridges, Hertz", "random traces", "the trace", "theory over random")
    pressures += ("as the product of", "half-width over a: theory", "random", "the trace")
    summits = ("", "bandwidth", "rms slope", "peaks a mm", "radius", "deviation")
    summits += ("summits a mm²", "radius of summits", "deviation of summits")
    kinds = ("", *(f"{LABELS[m]}, {how}" for m in found.patches for how in ("book", "exact")))
    asperities = "Asperities by relative penetration; after a semicolon, how many of them flow"
    return [
        TextTable("Summits, by moments / by peaks", summits, tuple(map(_summits, found.summits))),
        TextTable(
            "Mean real pressure, load over real length",
            pressures,
            tuple(map(_pressures, found.loads)),
        ),
        TextTable(asperities, kinds, tuple(_kinds(outcome, kind) for kind in KINDS)),
    ]


def statistics_lines(outcome: Run) -> list[tuple[str, str]]:
    """Of the scene's own load, and of its asperities."""
    found = outcome.data(NAME)
    if found is None:
        return []
    row, (model, patches) = found.loads[0], list(found.patches.items())[-1]
    theory = with_unit(row.figures["moments"].mean_real_pressure, "Pa", 3)
    solved, exact = (
        f"solved {_random(row)} under random traces",
        [p.kinds["exact"] for p in patches],
    )
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
    each, (over, uncertainty) = row.figures, row.difference
    theories = (each[name].mean_real_pressure for name in ("moments", "peaks"))
    given = *theories, row.persson["ridges"], row.even
    widths = (each[name].effective_half_width for name in ("moments", "random", "trace"))
    return (
        *(with_unit(row.load, "N/m", 3), significant(row.patches, 2)),
        *(with_unit(value, "Pa", 3) for value in given),
        *(_random(row), with_unit(each["trace"].mean_real_pressure, "Pa", 3)),
        *(f"{percent(over, signed=True)} ± {percent(uncertainty, digits=1)}", _causes(row)),
        *(significant(width / row.half_width, 3) for width in widths),
    )


def _kinds(outcome: Run, kind: str) -> tuple[str, ...]:
    """How many patches by the book's coefficient and the exact one, and how many of them flow."""
    cells = [kind]
    for states in outcome.data(NAME).patches.values():
        for how in ("book", "exact"):
            own = [state.plastic_strain for state in states if state.kinds[how] == kind]
            known = states[0].plastic_strain is not None
            flow = f"; {sum(strain > FLOWS for strain in own)}" if known else ""
            cells.append(f"{len(own)}{flow}")
    return tuple(cells)
