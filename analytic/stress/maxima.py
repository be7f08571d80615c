"""Largest stresses of a field, and where they stand between the points of its grid."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from analytic.stress.field import StressField
from analytic.stress.points import stress_at
from analytic.stress.potential import Element
from analytic.stress_state import Extremum, StressState

NEAR = 0.5  # of the largest value: cells whose own are below it are not followed off the grid
STARTS = 4  # local maxima of the grid that are followed
# The search around a point of the grid: nine points, half a cell apart at first; the parabola
# through them gives the next centre. The spacing shrinks when that lies among them or nothing
# higher was met: a top far along a flat ridge is walked to first. A parabola's top errs by the
# square of the spacing, and the last one is 5e-3 of a cell.
_STENCIL = np.array([[i, j] for i in (-1, 0, 1) for j in (-1, 0, 1)])
_FIRST_STEP, _SHRINKAGE, _SPACINGS = 0.5, 0.4, 6
_FARTHEST = 1.5  # steps that a centre may move in a round
_MOST_ROUNDS = 30  # 6 where no ridge is walked along, up to 11 where one is


@dataclass(frozen=True)
class StressMaxima:
    """Largest principal shear, largest amount of the orthogonal shear, largest von Mises."""

    tau1: Extremum
    txz_abs: Extremum
    von_mises: Extremum
    # by the names of the first two, in each cell of x: value, x and z (3, k + 1)
    cells: dict[str, np.ndarray]


def stress_maxima(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    field: StressField,
    poissons_ratio: float,
    element: Element = "hat",
    *,
    beside: Callable[[np.ndarray, np.ndarray], StressState] | None = None,
    cells: Sequence[float] = (),
) -> StressMaxima:
    """The three maxima [Pa] inside the field's window, under its loads, given as to `stress_at`.

    `beside` gives further stresses [Pa] at x, z [m], which the field has already.
    `cells` (k,) [m] are where one cell of x ends and the next begins, ascending. Where the highest
    point of one is below NEAR of the highest of all, that is taken; without a point: 0, no x.

    The field's highest local maxima, up to STARTS of them, are each followed off the grid by
    `stress_at`, no further than the window, and the highest wins: the position is good to 1e-5 of a
    cell where the quantity is smooth, and the value never below the field's own largest. A field
    coarser than the asperities can miss peaks that it does not show.
    """
    quantities = (
        lambda stress: stress.tau1,
        lambda stress: np.abs(stress.txz),
        lambda stress: stress.von_mises(poissons_ratio),
    )
    rows, columns, owner = [], [], []  # an owner is a quantity in a cell
    cell, count = np.searchsorted(cells, field.x), len(cells) + 1
    largest = np.full((len(quantities), 3, count), np.nan)
    largest[:, 0] = 0.0
    edges = [0, *np.searchsorted(field.x, cells, side="right"), len(field.x)]
    for index, quantity in enumerate(quantities):
        values = quantity(field.stress)
        row, column = _local_maxima(values)
        highest = values.max()
        for k, (start, stop) in enumerate(pairwise(edges)) if count > 1 else ():
            if start == stop:
                continue
            i, j = np.unravel_index(np.argmax(values[:, start:stop]), (len(values), stop - start))
            j += start
            largest[index, :, k] = values[i, j], field.x[j], field.z[i]
            if values[i, j] >= NEAR * highest and not np.any(cell[column] == k):
                row, column = np.append(row, i), np.append(column, j)
        rows.append(row)
        columns.append(column)
        owner.append(count * index + cell[column])
    rows, columns, owner = (np.concatenate(parts) for parts in (rows, columns, owner))

    def evaluate(place: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """The quantity of each owner (k,) at its points (k, 9, 2)."""
        x, z = place[..., 0], place[..., 1]
        stress = stress_at(x_nodes, pressure, friction, x, z, element)
        stress = stress if beside is None else stress.plus(1.0, beside(x, z))
        value = np.empty(place.shape[:2])
        for index, quantity in enumerate(quantities):
            mine = owner // count == index
            value[mine] = quantity(StressState(stress.sx[mine], stress.sz[mine], stress.txz[mine]))
        return value

    ends = np.clip([field.x[0], *cells, field.x[-1]], field.x[0], field.x[-1])
    bounds = np.column_stack([ends[:-1], ends[1:]])[owner % count]
    top, place = _climb(evaluate, field, rows, columns, owner, bounds)
    for one in np.unique(owner):
        mine = np.flatnonzero(owner == one)
        best = mine[np.argmax(top[mine])]
        largest[one // count, :, one % count] = top[best], *place[best]
    best = (Extremum(*map(float, by_cell[:, np.argmax(by_cell[0])])) for by_cell in largest)
    return StressMaxima(*best, dict(zip(("tau1", "txz_abs"), largest, strict=False)))


def _local_maxima(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of the highest points that no neighbour exceeds, highest first. A point is
    passed over if its peak cannot reach the highest value: between the points it rises at most by a
    quarter of the fall to its lowest neighbour, twice what a parabola along that line would."""
    highest = values == maximum_filter(values, size=3, mode="nearest")
    fall = values - minimum_filter(values, size=3, mode="nearest")
    place = np.flatnonzero(highest & (values + 0.25 * fall >= values.max()))
    place = place[np.argsort(-values.ravel()[place], kind="stable")[:STARTS]]
    return np.unravel_index(place, values.shape)


def _climb(
    evaluate: Callable[[np.ndarray, np.ndarray], np.ndarray],
    field: StressField,
    rows: np.ndarray,
    columns: np.ndarray,
    owner: np.ndarray,
    bounds: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Highest values (k,) that are met uphill from points of the grid, and their x, z (k, 2), each
    between its own `bounds` (k, 2) of x [m]. A climb ends early when a quarter of what its last
    nine points differ by does not lift it to the top of another one of the same owner."""
    grids, indices = (field.x, field.z), (columns, rows)
    centre = np.column_stack([g[i] for g, i in zip(grids, indices, strict=True)])
    width = np.column_stack([_cells(g, i) for g, i in zip(grids, indices, strict=True)])
    low, high = (
        np.column_stack([bounds[:, end], np.full(len(rows), field.z[end])]) for end in (0, -1)
    )
    top, best = np.full(len(centre), -np.inf), centre.copy()
    step = _FIRST_STEP * width
    # values on the stencil to the coefficients of 1, u, v, u^2, uv, v^2 by least squares
    u, v = _STENCIL.T
    fit = np.linalg.pinv(np.column_stack([np.ones(9), u, v, u**2, u * v, v**2]))
    going, left = np.arange(len(centre)), np.full(len(centre), _SPACINGS)
    for _ in range(_MOST_ROUNDS):
        at, h, floor, roof = centre[going], step[going], low[going], high[going]
        # a stencil across the window's side is moved in as a whole
        middle = np.clip(at, np.minimum(floor + h, roof), np.maximum(roof - h, floor))
        spread = middle[:, None] + _STENCIL * h[:, None]
        place = np.clip(spread, floor[:, None], roof[:, None])
        value = evaluate(place, owner[going])
        first = np.arange(len(going)), value.argmax(axis=1)
        better = value[first] > top[going]
        top[going] = np.where(better, value[first], top[going])
        best[going[better]] = place[first][better]
        _, along_u, along_v, uu, uv, vv = fit @ (value - value.mean(axis=1, keepdims=True)).T
        # the top of the parabola where it has one, else the best point so far
        bend = 4.0 * uu * vv - uv**2
        peaked = (bend > 0.0) & (uu < 0.0)
        move = np.column_stack([uv * along_v - 2 * vv * along_u, uv * along_u - 2 * uu * along_v])
        move = move / np.where(peaked, bend, 1.0)[:, None]
        vertex = middle + np.clip(move, -_FARTHEST, _FARTHEST) * h
        centre[going] = np.clip(np.where(peaked[:, None], vertex, best[going]), floor, roof)
        walks = better & (np.abs(centre[going] - middle) > h).any(axis=1)
        step[going[~walks]] *= _SHRINKAGE
        left[going[~walks]] -= 1
        leader = np.array([top[owner == mine].max() for mine in owner[going]])
        hopeful = top[going] + 0.25 * np.ptp(value, axis=1) >= leader
        going = going[hopeful & (left[going] > 0)]
        if not len(going):
            break
    return top, best


def _cells(grid: np.ndarray, indices: np.ndarray) -> np.ndarray:
    """Half the distances between the neighbours of points, or 1 on a grid of one point."""
    if len(grid) == 1:
        return np.ones(len(indices))
    after, before = np.minimum(indices + 1, len(grid) - 1), np.maximum(indices - 1, 0)
    return (grid[after] - grid[before]) / (after - before)
