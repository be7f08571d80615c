"""map.json: all that a map shows, and nothing of when or where it was computed; and as a table."""

import json
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.grid import FAILED, SOLVED, failures
from comparisons.campaigns.maps.groups import GROUPS, Axis
from comparisons.campaigns.maps.point import TOLERANCES
from comparisons.campaigns.maps.request import MapRequest
from comparisons.campaigns.maps.rule import rules_of, values_of
from comparisons.common.errors import InputError
from comparisons.common.provenance import versions
from comparisons.figures.figure import judge
from comparisons.figures.quantity import HEAT_QUANTITIES, QUANTITIES, label

if TYPE_CHECKING:
    from rich.console import Group

MAP, PICTURE = "map.json", "map.svg"
SCHEMA = 2
# What is known of the model error of the half-plane at a point.
SIGNIFICANT, BELOW, INCONCLUSIVE = "significant", "below tolerance", "inconclusive"
SMALLEST = 1e-3  # errors below are drawn, and interpolated, as if on a straight scale


def map_content(request: MapRequest, answers: list[dict]) -> dict:
    """map.json, with the answers at its points."""
    points = [
        {"x": point.at[request.x.group], "y": point.at[request.y.group]}
        | answer
        | significance(answer, request.quantity)
        for point, answer in zip(request.points, answers, strict=True)
    ]
    content = {
        "schema": SCHEMA,
        "command": request.command,
        "scene": request.tables,
        "finite_element": request.finite_element,
        "quantity": request.quantity,
        "x": _axis(request.x),
        "y": _axis(request.y),
        "tolerances": list(TOLERANCES),
        "points": points,
        "versions": versions(),
    }
    return content | {"rules": rules_of(content)}


def read_map(path: Path) -> dict:
    return json.loads(path.read_text(encoding="utf-8"))


def showing(content: dict, quantity: str) -> dict:
    """The same map of another quantity that its points have; refined for the first one. Raises
    InputError where they do not have it."""
    solved = [point for point in content["points"] if point["status"] == SOLVED]
    names = *QUANTITIES, *HEAT_QUANTITIES
    held = [name for name in names if all(name in p["quantities"] for p in solved)]
    if quantity not in held:
        allowed = ", ".join(held)
        raise InputError(f"--quantity: {quantity} is not on this map; allowed are {allowed}")
    points = [point | significance(point, quantity) for point in content["points"]]
    content = content | {"quantity": quantity, "points": points}
    return content | {"rules": rules_of(content)}


def places(axis: dict) -> np.ndarray:
    """Where an axis's values lie: their logarithms on a logarithmic axis."""
    values = np.array(axis["values"])
    return np.log10(values) if axis["logarithmic"] else values


def differences(content: dict, quantity: str) -> np.ndarray:
    """(ny, nx) relative model errors with their signs, nan where unknown."""
    return values_of(content, quantity, "difference")


def scaled(error: np.ndarray | float) -> np.ndarray | float:
    """Nearly logarithmic for either sign; `unscaled` takes it back."""
    return np.arcsinh(np.asarray(error) / SMALLEST)


def unscaled(value: np.ndarray | float) -> np.ndarray | float:
    return SMALLEST * np.sinh(value)


def _axis(axis: Axis) -> dict:
    group = GROUPS[axis.group]
    return {
        "group": axis.group,
        "symbol": group.symbol,
        "label": group.label,
        "logarithmic": axis.logarithmic,
        "values": list(axis.values),
    }


def significance(answer: dict, quantity: str) -> dict:
    """How the model error at a solved point compares with its numerical uncertainty: significant,
    it is larger; below tolerance, both together are within the first one; else inconclusive."""
    if answer["status"] != SOLVED:
        return {}
    error = answer["quantities"].get(quantity)
    if error is None or error["uncertainty"] is None:
        return {"error": INCONCLUSIVE}
    if abs(error["difference"]) > error["uncertainty"]:
        return {"error": SIGNIFICANT}
    agrees = judge(error["difference"], error["uncertainty"], TOLERANCES[0]) == "agree"
    return {"error": BELOW if agrees else INCONCLUSIVE}


def map_table(content: dict, out: Path | None) -> "Group":
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    points = content["points"]
    kinds = Counter(point.get("error", point["status"]) for point in points)
    what = label(content["quantity"])
    rules = Table(title=f"Where the half-plane's model error in the {what} stays small")
    for name in ("tolerance", "rule", "its points", "largest error there", "all within"):
        rules.add_column(name, justify="left" if name == "rule" else "right")
    for rule in content["rules"]:
        largest = "" if rule["largest_error"] is None else f"{100.0 * rule['largest_error']:.2g} %"
        rules.add_row(
            f"{100.0 * rule['tolerance']:g} %",
            rule["law"],
            str(rule["points_inside"]),
            largest,
            str(rule["points_within"]),
        )
    account = {
        SIGNIFICANT: "with a larger error than its numerical uncertainty",
        BELOW: "below the first tolerance",
        INCONCLUSIVE: "inconclusive",
        FAILED: "failed",
    }
    counts = ", ".join(f"{kinds[kind]} {words}" for kind, words in account.items() if kinds[kind])
    return Group(
        rules,
        Text(f"{len(points)} points: {counts}"),
        *(Text(f"failed, {count}: {why}") for why, count in failures(points).most_common()),
        Text(f"made by: {content['command']}"),
        *([] if out is None else [Text(f"map: {out / MAP}, {out / PICTURE}")]),
    )
