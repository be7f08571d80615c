"""The content of map.json: all that a map shows, and nothing of when or where it was computed."""

from comparisons.common.cache import Cache
from comparisons.common.provenance import versions
from comparisons.studies.maps.axes import Axis
from comparisons.studies.maps.groups import GROUPS
from comparisons.studies.maps.point import SOLVED, TOLERANCES
from comparisons.studies.maps.request import MapRequest
from comparisons.studies.maps.rule import rules_of

SCHEMA = 1
MISSING = "missing"
# What is known of the half-plane's own error at a point.
TOLD, BELOW, UNCLEAR = "told", "below", "unclear"


def map_content(request: MapRequest, store: Cache) -> dict:
    """Every point in the order of the axes, x inside; those that the store lacks as missing."""
    points = []
    for asked in request.points:
        kept = store.load(asked.key)
        found = {"status": MISSING} if kept is None else kept["found"]
        points.append({"x": asked.x, "y": asked.y, **found, **known(found, request.quantity)})
    content = {
        "schema": SCHEMA,
        "command": request.command,
        "scene": described(request),
        "finite_element": request.removed,
        "quantity": request.quantity,
        "x": _axis(request.x),
        "y": _axis(request.y),
        "tolerances": list(TOLERANCES),
        "points": points,
        "versions": versions(),
    }
    return content | {"rules": rules_of(content)}


def described(request: MapRequest) -> dict:
    """The scene as the map tells it: without [budget], which says what a run may cost."""
    return {name: fields for name, fields in request.tables.items() if name != "budget"}


def _axis(axis: Axis) -> dict:
    group = GROUPS[axis.group]
    return {
        "group": axis.group,
        "symbol": group.symbol,
        "label": group.label,
        "logarithmic": axis.logarithmic,
        "values": list(axis.values),
    }


def known(found: dict, quantity: str) -> dict:
    """Whether the own error of a solved point can be told from the numerical one.

    told: it is larger than its uncertainty; below: it is not, but that is less than the first
    tolerance; unclear: it is not.
    """
    if found["status"] != SOLVED:
        return {}
    own = found["quantities"].get(quantity)
    if own is None or own["uncertainty"] is None:
        return {"error": UNCLEAR}
    size, doubt = abs(own["difference"]), own["uncertainty"]
    return {"error": TOLD if size > doubt else BELOW if doubt <= TOLERANCES[0] else UNCLEAR}
