"""The pressure behind hat pressures: smooth inside a patch of contact, a square root at its ends.

The hat pressures p_h have the weighted means of the pressure p, up to higher order, but overshoot a
curved p by h^2 |p''| / 12 at the nodes, and towards an end e of contact no hats follow

    p(x) ~ sqrt(x - e),    g(x) ~ (x - e)^(3/2)    (Johnson 1985, section 4.2).

On each patch [b0, b1] the curve p = sqrt((x - b0) (b1 - x)) f(x) has both: b0, b1 from the gaps
outside, f a cubic spline through the nodal values that the means give.

    hats     (n + 2,) nodes [m], ascending, any spacing, with the feet of the outer two
    p, g     nodal pressures (n,) [Pa], gaps (n,) [m]: means weighted with the hats"""

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
    hats: np.ndarray, pressure: np.ndarray, gap: np.ndarray
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
    start = hats[node + 1]
    width = np.abs(hats[node + 1 + side] - start)
    end, known = np.full(len(node), 0.5), room >= DISTURBED_OPEN + 3
    place = (node + 1)[known, None] + side[known, None] * (DISTURBED_OPEN + np.arange(5))
    local = (side / width)[known, None] * (hats[place] - start[known, None])
    end[known] = _ends(local, gap[place[:, 1:-1] - 1])
    ends = start + side * width * end
    return np.column_stack([first, after - 1]), ends.reshape(2, -1).T


def nodal_values(hats: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Values (n,) [Pa] at the nodes of the parabola that has the mean of p_h over each hat. Its
    slope and curvature are those of the parabola through the node and its neighbours."""
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
    """Ends (k,) by the gaps (k, 3) of open nodes, at x (k, 5) with those beside; else 1/2."""
    step = np.diff(local)
    weighted = gap * (step[:, :-1] + step[:, 1:])

    def mismatch(end: np.ndarray) -> np.ndarray:
        """(k, m) at ends (k, m): the determinant of both powers and the gaps on the three hats."""
        over = np.maximum(local[:, None] - end[..., None], 0.0)
        once = over**3 * np.sqrt(over)  # the power 3/2 integrated twice, but for its factor
        one, two = (np.diff(np.diff(values) / step[:, None]) for values in (once, once * over))
        before, after = [2, 0, 1], [1, 2, 0]
        cross = one[..., after] * two[..., before] - one[..., before] * two[..., after]
        return (cross * weighted[:, None]).sum(axis=-1)

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
