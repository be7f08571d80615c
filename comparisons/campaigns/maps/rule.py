"""A rule of thumb from a map: up to which value of one group an error stays within a tolerance.

    u < C v^k (or u > C v^k)    where v <= V (or v >= V)

with u one group of the map and v the other.

Each line of equal v is followed from the good end of u for as long as the error and its numerical
uncertainty together stay within the tolerance, between points by straight lines in logarithms. k is
fitted through the ends; C is then the largest, to two figures, with which no line is overstepped.
V, one of the map's v, leaves lines out where the rule then holds at more points. Both groups, both
ends and every V are tried; the rule that holds at most points is taken. A point that failed or has
no known uncertainty ends its line.
"""

import math
from dataclasses import asdict, dataclass

import numpy as np

from comparisons.campaigns.maps.content import errors

Range = tuple[float, float]
STEP = 0.05  # of exponents
FEWEST_ENDS = 3  # inside the map that an exponent is fitted through


@dataclass(frozen=True)
class Rule:
    """`group` is `side` (below or above) `coefficient` times `other_group` to the `exponent`."""

    tolerance: float
    group: str
    other_group: str
    side: str
    coefficient: float | None  # None: everywhere, or nowhere
    exponent: float
    other_range: Range  # values of `other_group` between which it holds
    points_inside: int  # points of the map that the rule includes
    points_within: int  # points of the map that meet the tolerance
    largest_error: float | None  # of a point inside, None without points
    # law, text: in words, the bound alone, and with what it keeps and where
    law: str
    text: str


def rules_of(content: dict) -> list[dict]:
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
    # of equals one with all lines: its bound is found between points
    return max(candidates, key=lambda r: (r.points_inside, r.other_range == whole[r.other_group]))


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
    count = int(np.count_nonzero(inside))
    if not count:
        coefficient, exponent, rows = None, 0.0, slice(None)
    span = other["values"][rows]
    span = (span[0], span[-1])
    largest = float(error[inside].max()) if count else None
    within = int(np.count_nonzero(worst <= tolerance))
    law = _law(axis, other, side, coefficient, exponent, span) if count else "no simple bound"
    text = f"{law} {_kept(content, tolerance)}"
    if count:
        text += (
            f" ({count} of {worst.size} points, largest {100.0 * largest:.2g} %; "
            f"{within} points are within it)"
        )
    groups = axis["group"], other["group"]
    points = count, within, largest
    return Rule(tolerance, *groups, side, coefficient, exponent, span, *points, law, text)


def _runs(count: int) -> list[slice]:
    """All lines, then ever fewer of them, which begin with the first or end with the last."""
    fewer = range(count - 1, 0, -1)
    parts = (part for n in fewer for part in (slice(0, n), slice(count - n, count)))
    return [slice(0, count), *parts]


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
    limit = float(np.min(ends - sign * shift))
    inside = np.zeros(worst.shape, dtype=bool)
    if np.isposinf(limit):
        inside[rows] = True
        return None, 0.0, rows, inside
    coefficient = _round_in(sign * limit, axis["logarithmic"], side)
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
    rounded = math.floor if side == "below" else math.ceil
    return float(f"{rounded(value / unit) * unit:.2g}")


def _law(
    axis: dict, other: dict, side: str, coefficient: float | None, exponent: float, span: Range
) -> str:
    parts = []
    if coefficient is not None:
        law = f"{axis['symbol']} {'<' if side == 'below' else '>'} {coefficient:g}"
        parts.append(law + (f" ({other['symbol']})^{exponent:g}" if exponent else ""))
    if span[1] < other["values"][-1]:
        parts.append(f"{other['symbol']} <= {span[1]:g}")
    if span[0] > other["values"][0]:
        parts.append(f"{other['symbol']} >= {span[0]:g}")
    return " and ".join(parts) or "everywhere"


def _kept(content: dict, tolerance: float) -> str:
    """What a rule keeps within its tolerance, and on which map."""
    where = " and ".join(
        f"{axis['symbol']} = {axis['values'][0]:g} to {axis['values'][-1]:g}"
        for axis in (content["x"], content["y"])
    )
    label = content["quantity"].replace("_", " ")
    return f"keeps the {label} within {100.0 * tolerance:g} % for {where}"
