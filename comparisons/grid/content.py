"""What the points of a map say: arrays of model errors, and how sure each is.

In: the content of map.json, whose points lie row by row, y outside, x inside."""

import numpy as np

from comparisons.figures.figure import is_within
from comparisons.grid.groups import GROUPS
from comparisons.grid.map_point import TOLERANCES
from comparisons.grid.points import SOLVED

# What is known of the model error of the half-plane at a point.
SIGNIFICANT, BELOW, INCONCLUSIVE = "significant", "below tolerance", "inconclusive"


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
    least = TOLERANCES[0]
    agrees = is_within(error["difference"], error["uncertainty"], -least, least)
    return {"error": BELOW if agrees else INCONCLUSIVE}


def points_within(content: dict, tolerance: float) -> int:
    """How many points have a model error that is within a tolerance with all its uncertainty."""
    largest = np.abs(of_points(content, "difference")) + of_points(content, "uncertainty")
    return int(np.count_nonzero(largest <= tolerance))


def of_points(content: dict, name: str) -> np.ndarray:
    """(ny, nx) the relative `difference` with its sign, or the `uncertainty`, of the quantity that
    is shown, nan where it is unknown."""
    shown = content["quantity"]
    entries = (point.get("quantities", {}).get(shown) or {} for point in content["points"])
    values = np.array([entry.get(name) for entry in entries], dtype=float)
    return values.reshape(len(content["y"]["values"]), len(content["x"]["values"]))


def places(axis: dict, *values: float) -> np.ndarray:
    """Where values lie on an axis, its own by default: their logarithms on a logarithmic axis."""
    values = np.array(values or axis["values"])
    return np.log10(values) if axis["logarithmic"] else values


def scaled(error: np.ndarray | float, content: dict) -> np.ndarray | float:
    """As a map is drawn: nearly logarithmic for either sign, straight up to what its groups say."""
    straight = max(GROUPS[content[axis]["group"]].straight for axis in "xy")
    return np.arcsinh(np.asarray(error) / straight)
