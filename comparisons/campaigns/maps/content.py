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


def uncertainties(content: dict, quantity: str) -> np.ndarray:
    """(ny, nx) of the relative model errors, nan where unknown."""
    return _values(content, quantity, "uncertainty")


def errors(content: dict) -> tuple[np.ndarray, np.ndarray]:
    """(ny, nx) size of the model error, and with its uncertainty added; infinite where unknown."""
    quantity = content["quantity"]
    unsure = _values(content, quantity, "uncertainty")
    error = np.where(np.isfinite(unsure), np.abs(differences(content, quantity)), np.inf)
    return error, np.where(np.isfinite(unsure), error + unsure, np.inf)


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
    """As a map is drawn and interpolated: nearly logarithmic for either sign, straight up to what
    its groups say; `unscaled` takes it back."""
    return np.arcsinh(np.asarray(error) / _straight(content))


def unscaled(value: np.ndarray | float, content: dict) -> np.ndarray | float:
    return _straight(content) * np.sinh(value)


def _straight(content: dict) -> float:
    return max(GROUPS[content[axis]["group"]].straight for axis in "xy")
