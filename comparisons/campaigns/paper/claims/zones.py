"""Numbers read off a field of shear stress: zones, what joins them, and where fields agree.

Arrays are (m, k), one row a depth from the surface down. Two points belong to one zone where a
path leads from one to the other, over sides or corners, on which the field stays at a level."""

import numpy as np
from scipy.ndimage import label

NEIGHBOURS = np.ones((3, 3))
BISECTIONS = 40  # of the range in which a level is sought: to 1e-12 of it


def agreement_depth(z: np.ndarray, difference: np.ndarray, tolerance: float) -> float:
    """Depth, in the unit of z (m,), below which |difference| (m, k) stays within a tolerance.
    Between two depths the largest difference is taken as linear. 0 where the tolerance holds at
    every depth; the last depth where it does not hold even there."""
    largest = np.max(np.abs(difference), axis=1)
    beyond = np.flatnonzero(largest > tolerance)
    if len(beyond) == 0:
        return 0.0
    last = beyond[-1]
    if last == len(z) - 1:
        return float(z[-1])
    share = (largest[last] - tolerance) / (largest[last] - largest[last + 1])
    return float(z[last] + share * (z[last + 1] - z[last]))


def zone(field: np.ndarray, level: float, seed: tuple[int, int]) -> np.ndarray:
    """Points (m, k) joined with `seed` (row, column) at a level; none if the seed is below it."""
    zones, _ = label(field >= level, structure=NEIGHBOURS)
    return (zones == zones[seed]) & (zones > 0)


def top_of_zone(z: np.ndarray, field: np.ndarray, level: float, seed: tuple[int, int]) -> float:
    """Least depth, in the unit of z (m,), of what is joined with `seed` at a level.
    Between the first row of the zone and the row above it the field is taken as linear. The last
    depth where there is no zone."""
    inside = zone(field, level, seed)
    rows = np.flatnonzero(inside.any(axis=1))
    if len(rows) == 0:
        return float(z[-1])
    row = rows[0]
    if row == 0:
        return float(z[0])
    here, above = field[row, inside[row]], field[row - 1, inside[row]]
    share = np.max((here - level) / (here - above))
    return float(z[row] - share * (z[row] - z[row - 1]))


def joining_level(field: np.ndarray, seed: tuple[int, int], target: np.ndarray) -> float:
    """Highest level at which `seed` is joined with any point of `target` (m, k)."""
    low, high = float(np.min(field)), float(field[seed])
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if np.any(zone(field, middle, seed) & target):
            low = middle
        else:
            high = middle
    return low


def share_joined(
    field: np.ndarray, weights: np.ndarray, level: float, seed: tuple[int, int], part: np.ndarray
) -> float:
    """Of the area in `part` (m, k) at or above a level, the share joined with `seed`; 0 of none.

    weights  (m, 1) or (m, k), the area that a point stands for"""
    area = np.broadcast_to(weights, field.shape)
    above = part & (field >= level)
    total = float(np.sum(area[above]))
    joined = float(np.sum(area[above & zone(field, level, seed)]))
    return joined / total if total > 0.0 else 0.0


def highest_point(field: np.ndarray, part: np.ndarray) -> tuple[int, int]:
    """Row and column of the field's largest value inside `part`, (m, 1) or (m, k)."""
    row, column = np.unravel_index(np.argmax(np.where(part, field, -np.inf)), field.shape)
    return int(row), int(column)
