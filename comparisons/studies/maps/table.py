"""What `crosscheck map` prints: the rules, what they rest on, and what failed."""

from collections import Counter
from pathlib import Path

from rich.console import Group as Lines
from rich.table import Table
from rich.text import Text

from comparisons.common.quantities import QUANTITIES
from comparisons.studies.maps.content import BELOW, TOLD, UNCLEAR
from comparisons.studies.maps.make import MAP, PICTURE
from comparisons.studies.maps.point import FAILED


def map_table(content: dict, out: Path) -> Lines:
    """For rich to print."""
    points = content["points"]
    kinds = Counter(point.get("error", point["status"]) for point in points)
    label = QUANTITIES[content["quantity"]].label
    rules = Table(title=f"Where the half-plane's own error in {label} stays small")
    for name in ("tolerance", "rule", "its points", "largest error there", "all within"):
        rules.add_column(name, justify="left" if name == "rule" else "right")
    for rule in content["rules"]:
        largest = "" if rule["largest"] is None else f"{100.0 * rule['largest']:.2g} %"
        rules.add_row(
            f"{100.0 * rule['tolerance']:g} %",
            rule["law"],
            str(rule["inside"]),
            largest,
            str(rule["within"]),
        )
    account = {
        TOLD: "told from numerical error",
        BELOW: "not told, below the first tolerance",
        UNCLEAR: "not told",
        FAILED: "failed",
    }
    found = ", ".join(f"{kinds[kind]} {words}" for kind, words in account.items() if kinds[kind])
    reasons = Counter(point["why"] for point in points if point["status"] == FAILED)
    return Lines(
        rules,
        Text(f"{len(points)} points: {found}"),
        *(Text(f"failed, {count}: {why}") for why, count in reasons.most_common()),
        Text(f"made by: {content['command']}"),
        Text(f"map: {out / MAP}, {out / PICTURE}"),
    )
