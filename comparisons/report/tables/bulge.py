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
        end = "beyond 20 a" if entry["end"] is None else significant(entry["end"] / a, 3)
        share = ", ".join(map(percent, entry["energy_ahead"].values()))
        energy = f"{significant(entry['energy'] / entry['work_scale'], 3)} ({share})"
        ends = (end, significant(entry["work"], 1), energy)
        rows.append((plain(entry["friction"]), *_raised(entry, a), *ends))
        for k, patch in enumerate(entry["patches"], 1):
            rows.append((f"patch {k}, {patch['kind']}", *_raised(patch, a), "", "", ""))
    head = ("friction", "bulge", "half-plane's step", "bulge over h", "h/R", "at s/a")
    head += ("half of it at s/a", "work", "energy over P h (share ahead)")
    return TextTable("Finite elements", head, tuple(rows))


def _raised(entry: dict, a: float) -> tuple[str, ...]:
    """Bulge, step, both ratios and the place, of a whole contact or of a patch."""
    stated = "" if (size := entry["uncertainty"]) is None else f" ± {with_unit(size, 'm', 1)}"
    height, step = (with_unit(entry[name], "m", 3) for name in ("height", "half_plane"))
    ratios = (entry["over_penetration"], entry["relative_penetration"], entry["at"] / a)
    return height + stated, step, *(significant(ratio, 3) for ratio in ratios)
