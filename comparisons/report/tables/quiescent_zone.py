"""The quiescent zone below a rough surface, as a table and in lines."""

from comparisons.common.numbers import plain, significant
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.report.tables.text import TextTable
from comparisons.results.outcome import Outcome
from comparisons.studies.quiescent_zone import BRIDGED, QUIESCENT


def zone_entries(outcome: Outcome) -> list[tuple[str, dict]]:
    """Of result.json by model and friction: the model, and its entry. None where there is none."""
    zones = outcome.result.get("quiescent_zone") or {}
    return [(model, entry) for model in MODELS for entry in zones.get(model, ())]


def zone_table(outcome: Outcome) -> TextTable | None:
    """A row for each friction coefficient and model; None without a rough profile or fields."""
    zones = outcome.result.get("quiescent_zone")
    if zones is None:
        return None
    if "why" in zones:
        return TextTable("Not measured", ("because",), ((zones["why"],),))
    rows = [
        (
            *(plain(entry["friction"]), LABELS[model], entry["status"]),
            *(_figure(outcome, entry[name]) for name in ("start", "stop", "depth")),
            *(_figure(None, entry[name]) for name in ("level", "ratio")),
            f"{entry['bridged']} of {len(entry['asperities'])}",
        )
        for model, entry in zone_entries(outcome)
    ]
    rows.sort(key=lambda row: float(row[0]))
    head = ("friction", "model", "", "from, z/a", "to, z/a", "least shear at, z/a")
    head += ("least over Hertz zone's", "over the smaller maximum", "asperities that bridge it")
    return TextTable("Mean shear between asperities and Hertz zone", head, tuple(rows))


def zone_line(outcome: Outcome) -> str | None:
    """For the terminal: the first model's zone at every friction; None where it is not known."""
    entries = zone_entries(outcome)
    return "; ".join(_said(outcome, e) for m, e in entries if m == entries[0][0]) or None


def _said(outcome: Outcome, entry: dict) -> str:
    words = entry["status"]
    if words == QUIESCENT:
        ends = (_figure(outcome, entry[name], False) for name in ("start", "stop"))
        words = f"{' a to '.join(ends)} a deep"
    if words != BRIDGED and entry["bridged"]:
        words += f", bridged under {entry['bridged']} of {len(entry['asperities'])} asperities"
    return (
        f"friction {plain(entry['friction'])}: {words}, least shear "
        f"{_figure(None, entry['level'], False)} of the Hertz zone's"
    )


def _figure(outcome: Outcome | None, figure: dict, uncertain: bool = True) -> str:
    """A figure with its uncertainty; lengths over a where the outcome is given."""
    a = 1.0 if outcome is None else outcome.problem.hertz.half_width
    if figure["value"] is None:
        return ""
    text = significant(figure["value"] / a, 3)
    if not uncertain or figure["uncertainty"] is None:
        return text
    return f"{text} ± {significant(figure['uncertainty'] / a, 1)}"
