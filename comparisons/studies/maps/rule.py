"""A rule of thumb from a map: up to which value of one group an error stays within a tolerance.

    u < C v^k (or u > C v^k)    where v <= V (or v >= V)

with u one group of the map and v the other.

On every line of equal v it is found how far, from the good end of u, the error and its numerical
uncertainty together stay within the tolerance, between points by straight lines in logarithms.
k is fitted through those ends; C is then the largest, to two figures, with which no line is
overstepped. V, a value of the map, leaves lines out where that is worth it. Of both groups, their
ends and all V the rule is taken that holds most points. A point that failed or is unclear ends
its line.
"""

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace

import numpy as np

STEP = 0.05  # of exponents
FEWEST_ENDS = 3  # inside the map that an exponent is fitted through


@dataclass(frozen=True)
class Rule:
    """`group` `side` (below or above) `coefficient` times `of` to the power of `exponent`.

    coefficient     None: everywhere, or nowhere
    of_span         values of `of` between which it holds
    inside          points that the rule holds
    within          points of the map that meet the tolerance
    largest         error of a point inside, None without points
    law, text       in words: the bound alone, and with what it keeps and where
    """

    tolerance: float
    group: str
    of: str
    side: str
    coefficient: float | None
    exponent: float
    of_span: tuple[float, float]
    inside: int
    within: int
    largest: float | None
    law: str
    text: str


def rules_of(content: dict) -> list[dict]:
    """A rule for every tolerance of the map's content."""
    return [asdict(rule_of(content, tolerance)) for tolerance in content["tolerances"]]


def rule_of(content: dict, tolerance: float) -> Rule:
    """The rule that holds most of the points within a tolerance."""
    x, y = content["x"], content["y"]
    error, worst = errors(content)
    candidates = [
        _rule(content, tolerance, *axes, side, values[0], values[1])
        for axes, values in (((x, y), (error, worst)), ((y, x), (error.T, worst.T)))
        for side in ("below", "above")
    ]
    whole = {axis["group"]: (axis["values"][0], axis["values"][-1]) for axis in (x, y)}
    # of equals one that leaves out no line: its bound is found between points
    return max(candidates, key=lambda rule: (rule.inside, rule.of_span == whole[rule.of]))


def errors(content: dict) -> tuple[np.ndarray, np.ndarray]:
    """(ny, nx) size of the own error, and the same with its uncertainty; infinite where unknown."""
    shape = len(content["y"]["values"]), len(content["x"]["values"])
    error, worst = np.full(shape, np.inf), np.full(shape, np.inf)
    for place, point in zip(np.ndindex(shape), content["points"], strict=True):
        own = point.get("quantities", {}).get(content["quantity"])
        if own is not None and own["uncertainty"] is not None:
            error[place] = abs(own["difference"])
            worst[place] = error[place] + own["uncertainty"]
    return error, worst


def _rule(
    content: dict,
    tolerance: float,
    axis: dict,
    other: dict,
    side: str,
    error: np.ndarray,
    worst: np.ndarray,
) -> Rule:
    """For a group along the rows of `error` and `worst`."""
    bounds = [_bound(axis, other, side, worst, tolerance, rows) for rows in _runs(len(worst))]
    coefficient, exponent, rows, inside = max(bounds, key=lambda bound: np.count_nonzero(bound[3]))
    held = int(np.count_nonzero(inside))
    values = other["values"][rows] if held else other["values"]
    rule = Rule(
        tolerance,
        axis["group"],
        other["group"],
        side,
        coefficient if held else None,
        exponent if held else 0.0,
        (values[0], values[-1]),
        held,
        int(np.count_nonzero(worst <= tolerance)),
        float(error[inside].max()) if held else None,
        "",
        "",
    )
    rule = replace(rule, law=_law(rule, axis, other))
    return replace(rule, text=_text(rule, content, worst.size))


def _runs(count: int) -> list[slice]:
    """All lines, then ever fewer that begin with the first or end with the last."""
    fewer = range(count - 1, 0, -1)
    return [
        slice(0, count),
        *(run for n in fewer for run in (slice(0, n), slice(count - n, count))),
    ]


def _bound(
    axis: dict, other: dict, side: str, worst: np.ndarray, tolerance: float, rows: slice
) -> tuple[float | None, float, slice, np.ndarray]:
    """Coefficient (None: no bound is needed) and exponent on some rows, and the points inside."""
    u, v = _scaled(axis), _scaled(other)[rows]
    sign = 1.0 if side == "below" else -1.0
    order = slice(None) if side == "below" else slice(None, None, -1)
    ends = np.array([_end(sign * u[order], row[order], tolerance) for row in worst[rows]])
    exponent = 0.0
    inner = np.isfinite(ends) & (ends > sign * u[order][0])
    if axis["logarithmic"] and other["logarithmic"] and np.count_nonzero(inner) >= FEWEST_ENDS:
        slope = float(np.polyfit(v[inner], sign * ends[inner], 1)[0])
        exponent = round(round(slope / STEP) * STEP, 2)
    shift = exponent * v if exponent else np.zeros_like(v)
    reach = float(np.min(ends - sign * shift))
    inside = np.zeros(worst.shape, dtype=bool)
    if np.isposinf(reach):
        inside[rows] = True
        return None, 0.0, rows, inside
    coefficient = _round_in(sign * reach, axis["logarithmic"], side)
    limit = np.log(coefficient) if axis["logarithmic"] else coefficient
    inside[rows] = sign * u[None, :] < sign * (limit + shift)[:, None]
    return coefficient, exponent, rows, inside


def _scaled(axis: dict) -> np.ndarray:
    values = np.array(axis["values"])
    return np.log(values) if axis["logarithmic"] else values


def _end(u: np.ndarray, worst: np.ndarray, tolerance: float) -> float:
    """How far along ascending u a line stays within the tolerance; inf: all of it."""
    outside = np.flatnonzero(worst > tolerance)
    if len(outside) == 0:
        return np.inf
    last = outside[0]
    if last == 0:
        return float(u[0])
    low, high = worst[last - 1], worst[last]
    if not np.isfinite(high) or low <= 0.0:
        return float(u[last - 1])
    share = math.log(tolerance / low) / math.log(high / low)
    return float(u[last - 1] + share * (u[last] - u[last - 1]))


def _round_in(limit: float, logarithmic: bool, side: str) -> float:
    """A limit, from its logarithm where the axis is so, to two figures towards the good end."""
    value = math.exp(limit) if logarithmic else limit
    if value == 0.0:
        return value
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 1)
    whole: Callable[[float], int] = math.floor if side == "below" else math.ceil
    return float(f"{whole(value / unit) * unit:.2g}")


def _law(rule: Rule, axis: dict, other: dict) -> str:
    if not rule.inside:
        return "no simple bound"
    parts = []
    if rule.coefficient is not None:
        law = f"{axis['symbol']} {'<' if rule.side == 'below' else '>'} {rule.coefficient:g}"
        parts.append(law + (f" ({other['symbol']})^{rule.exponent:g}" if rule.exponent else ""))
    first, last = rule.of_span
    if last < other["values"][-1]:
        parts.append(f"{other['symbol']} <= {last:g}")
    if first > other["values"][0]:
        parts.append(f"{other['symbol']} >= {first:g}")
    return " and ".join(parts) or "everywhere"


def _text(rule: Rule, content: dict, points: int) -> str:
    label = content["quantity"].replace("_", " ")
    where = " and ".join(
        f"{each['symbol']} = {each['values'][0]:g} to {each['values'][-1]:g}"
        for each in (content["x"], content["y"])
    )
    text = f"{rule.law} keeps the {label} within {100.0 * rule.tolerance:g} % for {where}"
    if not rule.inside:
        return text
    return (
        f"{text} ({rule.inside} of {points} points, largest {100.0 * rule.largest:.2g} %; "
        f"{rule.within} points are within it)"
    )
