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
from scipy.optimize import brentq

from analytic.numerics import runs_of

# Nodes at each end of a patch whose values the end disturbs, and open nodes beyond an end likewise.
DISTURBED = 2
DISTURBED_OPEN = 1
# Touching nodes that a patch needs: four undisturbed ones hold a cubic.
LEAST_NODES = 2 * DISTURBED + 4

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


def smooth_pressure(
    hats: np.ndarray, pressure: np.ndarray, gap: np.ndarray, fewest: int = 1
) -> tuple[Patch, ...]:
    """The patches of contact of at least `fewest` touching nodes from left to right, with the curve
    of pressure on each."""
    first, after = runs_of(pressure > 0.0)
    last = after - 1
    nodal = nodal_values(hats, pressure)
    whole = np.concatenate([[0.0], pressure, [0.0]])
    bound = np.concatenate([[-1], last, first[1:], [len(pressure)]])
    patches = []
    for k in np.flatnonzero(after - first >= fewest):
        i, j = first[k], last[k]
        before, beyond = bound[k], bound[len(first) + 1 + k]
        ends = _end(hats, gap, i, -1, i - before - 1), _end(hats, gap, j, 1, beyond - j - 1)
        patches.append(_patch(hats, whole, nodal, int(i), int(j), ends))
    return tuple(patches)


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


def _end(hats: np.ndarray, gap: np.ndarray, node: int, side: int, room: int) -> float:
    """End of contact [m] beyond the touching `node` on one side, where `room` nodes are open.

    Gaps of c d^(3/2) (1 + k d) averaged over the hats agree with those of three open nodes; half
    way to the first open node where there is no such end, or where too few nodes are open.
    """
    x = hats[1:-1]
    start = x[node]
    width = abs(hats[node + 1 + side] - start)
    if room >= DISTURBED_OPEN + 3:
        open_nodes = node + side * (DISTURBED_OPEN + 1 + np.arange(3))
        local = side * (hats - start) / width

        def mismatch(end: float) -> float:
            law = [_mean_power(local, open_nodes, end, power) for power in (1.5, 2.5)]
            scale = np.abs(law[0]).max(), np.abs(law[1]).max(), np.abs(gap[open_nodes]).max()
            rows = np.stack([*law, gap[open_nodes]]) / np.array(scale)[:, None]
            return float(np.linalg.det(rows))

        ends = np.linspace(-0.5, 1.5, 17)
        values = np.array([mismatch(end) for end in ends])
        change = np.flatnonzero(values[:-1] * values[1:] < 0.0)
        if len(change):
            k = change[np.argmin(np.abs(ends[change] - 0.5))]
            return float(start + side * width * brentq(mismatch, ends[k], ends[k + 1]))
    return float(start + side * width * 0.5)


def _mean_power(local: np.ndarray, nodes: np.ndarray, end: float, power: float) -> np.ndarray:
    """Means over the hats at `nodes` of (x - end)^power for x > end, zero before."""
    over = np.maximum(local - end, 0.0) ** (power + 2.0) / ((power + 1.0) * (power + 2.0))
    near, middle, far = (np.take(over, nodes + 1 + offset) for offset in (-1, 0, 1))
    before = np.take(local, nodes + 1) - np.take(local, nodes)
    after = np.take(local, nodes + 2) - np.take(local, nodes + 1)
    total = (near - middle) / before + (far - middle) / after
    return 2.0 * total / (before + after)


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
    norm = error = 0.0
    for a, b, s, t in zip(breaks[:-1], breaks[1:], angle[:-1], angle[1:], strict=True):
        if t > s:
            theta = 0.5 * (s + t) + 0.5 * (t - s) * _AT
            at, amount = middle - half * np.cos(theta), 0.5 * (t - s) * half * np.sin(theta)
        else:
            at, amount = 0.5 * (a + b) + 0.5 * (b - a) * _AT, 0.5 * (b - a)
        norm += float(_WEIGHT @ (amount * piecewise(at) ** 2))
        error += float(_WEIGHT @ (amount * (curve(at) - piecewise(at)) ** 2))
    norm = np.sqrt(norm)
    return Patch(ends, first, last, curve, smooth, norm, np.sqrt(error) if smooth else norm)
