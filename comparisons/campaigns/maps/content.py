"""What the points of a map say: arrays of model errors, and how sure each is.

In: the content of map.json, whose points lie row by row, y outside, x inside."""

import numpy as np

from comparisons.campaigns.grid import SOLVED
from comparisons.campaigns.maps.groups import GROUPS
from comparisons.campaigns.maps.point import TOLERANCES
from comparisons.figures.figure import judge

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
    agrees = judge(error["difference"], error["uncertainty"], TOLERANCES[0]) == "agree"
    return {"error": BELOW if agrees else INCONCLUSIVE}


def differences(content: dict, quantity: str) -> np.ndarray:
    """(ny, nx) relative model errors with their signs, nan where unknown."""
    return _values(content, quantity, "difference")


def points_within(content: dict, tolerance: float) -> int:
    """How many points have a model error that is within a tolerance with all its uncertainty."""
    quantity = content["quantity"]
    largest = np.abs(differences(content, quantity)) + _values(content, quantity, "uncertainty")
    return int(np.count_nonzero(largest <= tolerance))


def _values(content: dict, quantity: str, name: str) -> np.ndarray:
    """(ny, nx) what is called so of a quantity's errors, nan where it is unknown."""
    entries = (point.get("quantities", {}).get(quantity) or {} for point in content["points"])
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
