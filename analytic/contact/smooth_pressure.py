"""The pressure behind hat pressures: smooth inside a patch of contact, a square root at its ends.

The hat pressures p_h have the weighted means of the pressure p, up to higher order, but overshoot a
curved p by h^2 |p''| / 12 at the nodes, and towards an end e of contact no hats follow

    p(x) ~ sqrt(x - e),    g(x) ~ (x - e)^(3/2)    (Johnson 1985, section 4.2).

On each patch [b0, b1] the curve p = sqrt((x - b0) (b1 - x)) f(x) has both: b0, b1 from the gaps
outside, f a cubic spline through the nodal values that the means give, but for the last few at
each end. The distance of both curves is a measure of the error of p_h.

    hats     (n + 2,) nodes [m], ascending, any spacing, with the feet of the outer two
    p, g     nodal pressures (n,) [Pa], gaps (n,) [m]: means weighted with the hats
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.numerics import runs_of

# Nodes at each end of a patch whose values the end disturbs, and open nodes beyond an end likewise.
DISTURBED = 2
DISTURBED_OPEN = 1
# Touching nodes that a patch needs: four undisturbed ones hold a cubic.
LEAST_NODES = 2 * DISTURBED + 4
# Where an end may lie, from the last touching node (0) to the first open one (1) and about; looked
# for on as many steps, of which each halving takes a half.
WITHIN, STEPS, HALVINGS = (-0.5, 1.5), 16, 40

Interval = tuple[float, float]
_AT, _WEIGHT = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class Patch:
    """One patch of contact.

    ends      (2,) [m]                first, last   touching nodes, places in p
    curve     pressure [Pa] at places (k,) [m]: the smooth one, or p_h itself where a patch has
              fewer than LEAST_NODES nodes
    smooth    which of the two
    norm, error   root of the integral of p_h^2, of (curve - p_h)^2 [Pa m^(1/2)]; norm for error
                  where there is no smooth curve
    """

    ends: Interval
    first: int
    last: int
    curve: Callable[[np.ndarray], np.ndarray]
    smooth: bool
    norm: float
    error: float

    @property
    def peak(self) -> tuple[float, float]:
        """Largest pressure [Pa] and its place [m]."""
        half, middle = 0.5 * (self.ends[1] - self.ends[0]), 0.5 * (self.ends[0] + self.ends[1])
        samples = 16 * (self.last - self.first + 2)
        x = middle - half * np.cos(np.linspace(0.0, np.pi, samples + 1))
        value = self.curve(x)
        best = int(np.argmax(value))
        return float(value[best]), float(x[best])


def smooth_pressure(hats: np.ndarray, pressure: np.ndarray, gap: np.ndarray) -> tuple[Patch, ...]:
    """The patches of contact from left to right, with the curve of pressure on each."""
    nodal = nodal_values(hats, pressure)
    whole = np.concatenate([[0.0], pressure, [0.0]])
    nodes, ends = contact_ends(hats, pressure, gap)
    return tuple(
        _patch(hats, whole, nodal, int(first), int(last), (float(start), float(stop)))
        for (first, last), (start, stop) in zip(nodes, ends, strict=True)
    )


def contact_ends(
    hats: np.ndarray, pressure: np.ndarray, gap: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """First and last touching node (k, 2) of each patch, places in p, and the ends of contact
    (k, 2) [m] beyond them.

    Gaps of c d^(3/2) (1 + k d) averaged over the hats agree with those of three open nodes; half
    way to the first open node where there is no such end, or where too few nodes are open.
    """
    first, after = runs_of(pressure > 0.0)
    open_before = first - np.concatenate([[0], after[:-1]])
    open_beyond = np.concatenate([first[1:], [len(pressure)]]) - after
    # all left ends, then all right ones
    node, room = np.concatenate([first, after - 1]), np.concatenate([open_before, open_beyond])
    side = np.repeat([-1, 1], len(first))
    start = hats[node + 1]
    width = np.abs(hats[node + 1 + side] - start)
    end, known = np.full(len(node), 0.5), room >= DISTURBED_OPEN + 3
    place = (node + 1)[known, None] + side[known, None] * (DISTURBED_OPEN + np.arange(5))
    local = (side / width)[known, None] * (hats[place] - start[known, None])
    end[known] = _ends(local, gap[place[:, 1:-1] - 1])
    ends = start + side * width * end
    return np.column_stack([first, after - 1]), ends.reshape(2, -1).T


def nodal_values(hats: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Values (n,) [Pa] at the nodes of the parabola that has the mean of p_h over each hat.

    Its slope and curvature are those of the parabola through the node and its neighbours.
    """
    before, after = np.diff(hats)[:-1], np.diff(hats)[1:]
    whole = np.concatenate([[0.0], pressure, [0.0]])
    width = before + after
    mean = (before * (whole[:-2] + 2.0 * pressure) + after * (whole[2:] + 2.0 * pressure)) / (
        3.0 * width
    )
    rise, fall = (pressure - whole[:-2]) / before, (whole[2:] - pressure) / after
    bend = 2.0 * (fall - rise) / width
    slope = (before * fall + after * rise) / width
    first, second = (after - before) / 3.0, (before**3 + after**3) / (6.0 * width)
    return mean - slope * first - 0.5 * bend * second


def _ends(local: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Ends (k,) by the gaps (k, 3) of open nodes, at places (k, 5) with the nodes beside them; one
    half where there is none."""
    step = np.diff(local)
    weighted = gap * (step[:, :-1] + step[:, 1:])

    def mismatch(end: np.ndarray) -> np.ndarray:
        """(k, m) at ends (k, m): the determinant of both powers and the gaps on the three hats."""
        over = np.maximum(local[:, None] - end[..., None], 0.0)
        once = over**3 * np.sqrt(over)  # the power 3/2 integrated twice, but for its factor
        hats = (np.diff(np.diff(each) / step[:, None]) for each in (once, once * over))
        return (np.cross(*hats) * weighted[:, None]).sum(axis=-1)

    sampled = np.linspace(*WITHIN, STEPS + 1)
    value = mismatch(np.broadcast_to(sampled, (len(local), len(sampled))))
    change = value[:, :-1] * value[:, 1:] < 0.0
    row = np.arange(len(local))
    best = np.argmin(np.where(change, np.abs(sampled[:-1] - 0.5), np.inf), axis=1)
    low, high, before = sampled[best], sampled[best + 1], value[row, best]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        beyond = mismatch(middle[:, None])[:, 0] * before > 0.0
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    return np.where(change.any(axis=1), 0.5 * (low + high), 0.5)


def curve_between(
    ends: Interval, places: np.ndarray, values: np.ndarray
) -> Callable[[np.ndarray], np.ndarray]:
    """p [Pa] at places [m] on a patch with these ends [m], through `values` (k,) at `places` (k,)
    inside; zero beyond the ends."""
    shape = CubicSpline(places, values / np.sqrt((places - ends[0]) * (ends[1] - places)))

    def curve(at: np.ndarray) -> np.ndarray:
        inside = np.maximum((at - ends[0]) * (ends[1] - at), 0.0)
        return np.sqrt(inside) * shape(np.clip(at, places[0], places[-1]))

    return curve


def _patch(
    hats: np.ndarray, whole: np.ndarray, nodal: np.ndarray, first: int, last: int, ends: Interval
) -> Patch:
    x = hats[1:-1]
    held = slice(first + DISTURBED, last + 1 - DISTURBED)
    places = x[held]
    smooth = last - first + 1 >= LEAST_NODES and ends[0] < places[0] and places[-1] < ends[1]

    def piecewise(at: np.ndarray) -> np.ndarray:
        return np.interp(at, hats, whole)

    curve = piecewise
    if smooth:
        curve = curve_between(ends, places, nodal[held])
    low, high = hats[first], hats[last + 2]
    breaks = np.unique(np.clip([*hats[first : last + 3], *ends], low, high))
    middle, half = 0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0])
    # Along the angle theta of x = middle - half cos(theta) the square root is smooth.
    angle = np.arccos(np.clip((middle - breaks) / half, -1.0, 1.0))
    a, s, far, wide = (
        each[:, None] for each in (breaks[:-1], angle[:-1], np.diff(breaks), np.diff(angle))
    )
    share = 0.5 * (1.0 + _AT)
    inside = ((breaks[:-1] >= ends[0]) & (breaks[1:] <= ends[1]))[:, None]
    theta = s + share * wide
    at = np.where(inside, middle - half * np.cos(theta), a + share * far)
    amount = 0.5 * np.where(inside, wide * half * np.sin(theta), far) * _WEIGHT
    norm = float(np.sqrt((amount * piecewise(at) ** 2).sum()))
    error = float(np.sqrt((amount * (curve(at) - piecewise(at)) ** 2).sum())) if smooth else norm
    return Patch(ends, first, last, curve, smooth, norm, error)
