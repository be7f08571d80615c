"""Largest stresses of a field, and where they stand between the points of its grid."""

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise, product

import numpy as np

from analytic.stress.field import StressField
from analytic.stress.points import friction_stress_at
from analytic.stress_state import StressState

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


def stress_maxima(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    fields: Mapping[float, StressField],
    poissons_ratio: float,
    *,
    beside: Callable[[np.ndarray, np.ndarray, np.ndarray], StressState] | None = None,
    cells: Sequence[float] = (),
) -> dict[float, dict[str, np.ndarray]]:
    """By friction coefficient and name, "tau1", "txz" and "von_mises", the largest principal shear,
    amount of the orthogonal shear and von Mises stress: value [Pa], x and z [m] (3, k + 1) in each
    cell of x; of von Mises once, in the first. Inside the window of the fields, whose points are
    the same, under their loads, given as to `stress_at`.

    `beside` gives further stresses [Pa] by friction coefficient (k, 1), x and z (k, n) [m], which
    the fields have already.
    `cells` (k,) [m] are where one cell of x ends and the next begins, ascending. Where the highest
    point of one is below NEAR of the highest of all, that is taken; without a point: 0, no x.

    A field's highest local maxima, up to STARTS of them, are each followed off the grid by
    `stress_at`, no further than the window, and the highest wins: the position is good to 1e-5 of a
    cell where the quantity is smooth, and the value never below the field's own largest. A field
    coarser than the asperities can miss peaks that it does not show.
    """
    quantities = {
        "tau1": lambda stress: stress.tau1,
        "txz": lambda stress: np.abs(stress.txz),
        "von_mises": lambda stress: stress.von_mises(poissons_ratio),
    }
    searches = list(product(fields, quantities))
    grid, count = next(iter(fields.values())), len(cells) + 1
    largest = np.full((len(searches), 3, count), np.nan)
    largest[:, 0] = 0.0
    rows, columns, owners, bounds = [], [], [], []  # an owner is a search in a cell
    for index, (friction, name) in enumerate(searches):
        values = quantities[name](fields[friction].stress)
        row, column = _local_maxima(values)
        inner = () if name == "von_mises" else cells
        cell, highest = np.searchsorted(inner, grid.x), values.max()
        edges = [0, *np.searchsorted(grid.x, inner, side="right"), len(grid.x)]
        for k, (start, stop) in enumerate(pairwise(edges)):
            if start == stop:
                continue
            i, j = np.unravel_index(np.argmax(values[:, start:stop]), (len(values), stop - start))
            j += start
            largest[index, :, k] = values[i, j], grid.x[j], grid.z[i]
            if values[i, j] >= NEAR * highest and not np.any(cell[column] == k):
                row, column = np.append(row, i), np.append(column, j)
        rows.append(row)
        columns.append(column)
        owners.append(count * index + cell[column])
        ends = np.clip([-np.inf, *inner, np.inf], grid.x[0], grid.x[-1])
        bounds.append(np.column_stack([ends[:-1], ends[1:]])[cell[column]])
    rows, columns, owners, bounds = map(np.concatenate, (rows, columns, owners, bounds))
    of_search = np.array([friction for friction, _ in searches])

    def evaluate(place: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """The quantity of each owner (k,) at its points (k, 9, 2)."""
        x, z = place[..., 0], place[..., 1]
        friction = of_search[owner // count, None]
        stress = friction_stress_at(x_nodes, pressure, x, z).at(friction)
        stress = stress if beside is None else stress.plus(1.0, beside(friction, x, z))
        value = np.empty(place.shape[:2])
        for index, quantity in enumerate(quantities.values()):
            mine = owner // count % len(quantities) == index
            value[mine] = quantity(StressState(*stress.parts[:, mine]))
        return value

    top, place = _climb(evaluate, grid, rows, columns, owners, bounds)
    for one in np.unique(owners):
        mine = np.flatnonzero(owners == one)
        best = mine[np.argmax(top[mine])]
        largest[one // count, :, one % count] = top[best], *place[best]
    by_friction = zip(fields, largest.reshape(len(fields), len(quantities), 3, count), strict=True)
    return {friction: dict(zip(quantities, own, strict=True)) for friction, own in by_friction}


def _local_maxima(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of the highest points that no neighbour exceeds, highest first, of values
    that are nowhere below 0. A point is passed over if its peak cannot reach the highest value:
    between the points it rises at most by a quarter of the fall to its lowest neighbour, twice what
    a parabola along that line would."""
    highest, rise = values.max(), 0.25
    row, column = np.nonzero((1.0 + rise) * values >= highest)
    around = np.pad(values, 1, mode="edge")[row + 1 + _STENCIL[:, :1], column + 1 + _STENCIL[:, 1:]]
    value = values[row, column]
    reached = value + rise * (value - around.min(axis=0)) >= highest
    place = np.flatnonzero(reached & (value == around.max(axis=0)))
    place = place[np.argsort(-value[place], kind="stable")[:STARTS]]
    return row[place], column[place]


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
    leader = np.full(owner.max() + 1, -np.inf)
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
        np.maximum.at(leader, owner, top)
        hopeful = top[going] + 0.25 * np.ptp(value, axis=1) >= leader[owner[going]]
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
