"""What a sliding contact raises ahead of itself, as a table."""

from comparisons.common.numbers import percent, plain, significant, with_unit
from comparisons.report.tables.text import TextTable
from comparisons.results.outcome import Outcome


def bulge_table(outcome: Outcome) -> TextTable | None:
    """A row for each friction coefficient above 0; None where the scene does not ask."""
    found = outcome.result.get("bulge")
    if found is None:
        return None
    if found["why"] is not None:
        return TextTable("Not measured", ("because",), ((found["why"],),))
    a, rows = outcome.problem.hertz.half_width, []
    for entry in found["by_friction"]:
        stated = "" if (size := entry["uncertainty"]) is None else f" ± {with_unit(size, 'm', 1)}"
        end = "beyond 20 a" if entry["end"] is None else significant(entry["end"] / a, 3)
        energy = ", ".join(map(percent, entry["energy_ahead"].values()))
        height, step = (with_unit(entry[name], "m", 3) for name in ("height", "half_plane"))
        ratios = (entry["over_penetration"], entry["relative_penetration"], entry["at"] / a)
        numbers = (significant(ratio, 3) for ratio in ratios)
        cells = (plain(entry["friction"]), height + stated, step, *numbers, end)
        rows.append((*cells, significant(entry["work"], 1), energy))
    head = ("friction", "bulge", "half-plane's step", "bulge over h", "h/R", "at s/a")
    head += ("half of it at s/a", "work", "energy ahead by model")
    return TextTable("Finite elements", head, tuple(rows))
