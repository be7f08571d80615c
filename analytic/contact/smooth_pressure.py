"""The pressure behind hat pressures: smooth inside a patch of contact, a square root at its ends.

The hat pressures p_h have the weighted means of the pressure p, up to higher order, but overshoot a
curved p by h^2 |p''| / 12 at the nodes, and towards an end e of contact no hats follow

    p(x) ~ sqrt(x - e),    g(x) ~ (x - e)^(3/2)    (Johnson 1985, section 4.2).

On each patch [b0, b1] the curve p = sqrt((x - b0) (b1 - x)) f(x) has both: b0, b1 from the gaps
outside, f a cubic spline through the nodal values that the means give.

    x, p, g  nodes [m], pressures [Pa] and gaps [m] (n,) of equal hats: means weighted with them"""

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.linalg import solve_banded

from analytic.numerics import runs_of

DISTURBED_OPEN = 1  # open nodes beyond an end whose gaps the end disturbs
# Where an end may lie, from the last touching node (0) to the first open one (1) and about; looked
# for on as many steps, of which each halving takes a half.
WITHIN, STEPS, HALVINGS = (-0.5, 1.5), 16, 40


def contact_ends(
    x: np.ndarray, pressure: np.ndarray, gap: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """First and last touching node (k, 2) of each patch, indices in p, and the ends of contact
    (k, 2) [m] beyond them.
    Gaps of c d^(3/2) (1 + k d) averaged over the hats agree with those of three open nodes; half
    way to the first open node where there is no such end, or where too few nodes are open."""
    first, after = runs_of(pressure > 0.0)
    open_before = first - np.concatenate([[0], after[:-1]])
    open_beyond = np.concatenate([first[1:], [len(pressure)]]) - after
    # all left ends, then all right ones
    node, room = np.concatenate([first, after - 1]), np.concatenate([open_before, open_beyond])
    side = np.repeat([-1, 1], len(first))
    end, known = np.full(len(node), 0.5), room >= DISTURBED_OPEN + 3
    beyond = DISTURBED_OPEN + 1 + np.arange(3)
    end[known] = _ends(gap[node[known, None] + side[known, None] * beyond])
    ends = x[node] + side * (x[1] - x[0]) * end
    return np.column_stack([first, after - 1]), ends.reshape(2, -1).T


def nodal_values(pressure: np.ndarray) -> np.ndarray:
    """Values (n,) [Pa] at the nodes of the parabola that has the mean of p_h over each hat. Its
    curvature is that of the parabola through the node and its neighbours."""
    return pressure + np.diff(np.pad(pressure, 1), 2) / 12.0


def _ends(gap: np.ndarray) -> np.ndarray:
    """Ends (k,) [pitches] by the gaps (k, 3) of open nodes; else 1/2."""
    nodes = DISTURBED_OPEN + np.arange(5.0)  # with those beside
    before, after = [2, 0, 1], [1, 2, 0]

    def minors(end: np.ndarray) -> np.ndarray:
        """(…, 3) at ends (…): of both powers on the three hats, which times the gaps vanish."""
        over = np.maximum(nodes - end[..., None], 0.0)
        once = over**3 * np.sqrt(over)  # the power 3/2 integrated twice, but for its factor
        one, two = np.diff(once, 2), np.diff(once * over, 2)
        return one[..., after] * two[..., before] - one[..., before] * two[..., after]

    sampled = np.linspace(*WITHIN, STEPS + 1)
    value = gap @ minors(sampled).T
    change = value[:, :-1] * value[:, 1:] < 0.0
    row = np.arange(len(gap))
    best = np.argmin(np.where(change, np.abs(sampled[:-1] - 0.5), np.inf), axis=1)
    low, high, start = sampled[best], sampled[best + 1], value[row, best]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        beyond = (minors(middle) * gap).sum(axis=1) * start > 0.0
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    return np.where(change.any(axis=1), 0.5 * (low + high), 0.5)


def curves_between(
    ends: np.ndarray, places: np.ndarray, values: np.ndarray, of: np.ndarray
) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """p (m,) [Pa] at x (m,) [m] on the patches of those numbers (m,); 0 beyond their ends.

    ends    (k, 2) [m] of the patches
    places  (n,) [m] of `values` (n,) [Pa] of the patches `of` (n,), ascending, four or more each a
            pitch apart"""
    left, right = ends.T
    shape = values / np.sqrt((places - left[of]) * (right[of] - places))
    # slopes of a spline on each patch, a pitch as the unit: "not a knot" next to its ends
    first, last = np.searchsorted(of, np.arange(len(ends))), np.cumsum(np.bincount(of)) - 1
    rise, sums, bands = np.diff(shape), np.zeros(len(of)), np.tile([[1.0], [4.0], [1.0]], len(of))
    sums[1:-1] = 3.0 * (rise[:-1] + rise[1:])
    sums[first] = 0.5 * (5.0 * rise[first] + rise[first + 1])
    sums[last] = 0.5 * (5.0 * rise[last - 1] + rise[last - 2])
    bands[:, first], bands[:, last] = [[0.0], [1.0], [1.0]], [[1.0], [1.0], [0.0]]
    bands[0, first + 1] = bands[2, last - 1] = 2.0
    slope = solve_banded((1, 1), bands, sums) / (places[1] - places[0])
    spline, low, high = CubicHermiteSpline(places, shape, slope), places[first], places[last]

    def curve(at: np.ndarray, patch: np.ndarray) -> np.ndarray:
        inside = np.maximum((at - left[patch]) * (right[patch] - at), 0.0)
        return np.sqrt(inside) * spline(np.clip(at, low[patch], high[patch]))

    return curve
