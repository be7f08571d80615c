"""Largest stresses of a field, and where they stand between the points of its grid."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter
from scipy.optimize import minimize

from analytic.plane_stress import Extremum, PlaneStress
from analytic.stress import Element, stress_at
from analytic.stress_field import StressField

Quantity = Callable[[PlaneStress], np.ndarray]

_DIFFERENCE = 1e-4  # of a cell: rounding and curvature spoil the slope by less than 1e-8
_SLOPE_TOLERANCE = 1e-8  # of the largest value on the grid, a cell
_VALUE_TOLERANCE = 1e-11
_ITERATIONS = 50


@dataclass(frozen=True)
class StressMaxima:
    """Largest principal shear, largest amount of the orthogonal shear, largest von Mises."""

    tau1: Extremum
    txz_abs: Extremum
    von_mises: Extremum


def stress_maxima(
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    field: StressField,
    poissons_ratio: float,
    element: Element = "hat",
) -> StressMaxima:
    """The three maxima of the field of these pressures inside its window."""

    def largest(quantity: Quantity) -> Extremum:
        return field_maximum(quantity, x_nodes, pressure, friction, field, element)

    return StressMaxima(
        tau1=largest(lambda stress: stress.tau1),
        txz_abs=largest(lambda stress: np.abs(stress.txz)),
        von_mises=largest(lambda stress: stress.von_mises(poissons_ratio)),
    )


def field_maximum(
    quantity: Quantity,
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    friction: float,
    field: StressField,
    element: Element = "hat",
    starts: int = 8,
) -> Extremum:
    """Largest `quantity` [Pa] of the stresses of these pressures inside the field's window.

    The field's highest local maxima, up to `starts` of them, are each followed off the grid by
    `stress_at`, no further than the window, and the highest wins: the place is good to 1e-5 of a
    cell where the quantity is smooth, and the value never below the field's own largest. A field
    coarser than the asperities can miss peaks that it does not show.
    """
    values = quantity(field.stress)
    rows, columns, reach = _local_maxima(values, starts)
    best = Extremum(
        float(values[rows[0], columns[0]]), float(field.x[columns[0]]), float(field.z[rows[0]])
    )
    scale = best.value if best.value > 0.0 else 1.0

    def relative(x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return quantity(stress_at(x_nodes, pressure, friction, x, z, element)) / scale

    for row, column, highest in zip(rows, columns, reach, strict=True):
        if highest < best.value:
            continue
        peak, x, z = _climb(relative, (field.x, field.z), (column, row))
        if peak * scale > best.value:
            best = Extremum(peak * scale, x, z)
    return best


def _local_maxima(values: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows and columns of the highest points that no neighbour exceeds, highest first, and the
    values that their peaks can reach.

    Between the points a peak rises at most by a quarter of the fall to its lowest neighbour: a
    parabola along that line would rise by an eighth.
    """
    highest = values == maximum_filter(values, size=3, mode="nearest")
    fall = values - minimum_filter(values, size=3, mode="nearest")
    reach = values + 0.25 * fall
    place = np.flatnonzero(highest & (reach >= values.max()))
    place = place[np.argsort(-values.ravel()[place], kind="stable")[:count]]
    return *np.unravel_index(place, values.shape), reach.ravel()[place]


def _climb(
    function: Callable[[np.ndarray, np.ndarray], np.ndarray],
    grids: tuple[np.ndarray, np.ndarray],
    indices: tuple[int, int],
) -> tuple[float, float, float]:
    """The peak of `function` (x, z) uphill from a point of the grid, its x and its z.

    A quasi-Newton search (L-BFGS-B) in widths of the point's cells, bounded by the grid, with
    central differences whose five points are one call; at the grid's sides they are one-sided.
    """
    origin = np.array([grid[index] for grid, index in zip(grids, indices, strict=True)])
    low, high = (np.array([grid[end] for grid in grids]) for end in (0, -1))
    width = np.array([_cell(grid, index) for grid, index in zip(grids, indices, strict=True)])
    cross = _DIFFERENCE * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])

    def value_and_slope(place: np.ndarray) -> tuple[float, np.ndarray]:
        points = np.clip(origin + (place + cross) * width, low, high)
        values = -function(points[:, 0], points[:, 1])
        steps = (points[[1, 3], [0, 1]] - points[[2, 4], [0, 1]]) / width
        rise = values[[1, 3]] - values[[2, 4]]
        return float(values[0]), rise / np.where(steps > 0.0, steps, 1.0)

    found = minimize(
        value_and_slope,
        np.zeros(2),
        jac=True,
        method="L-BFGS-B",
        bounds=list(zip((low - origin) / width, (high - origin) / width, strict=True)),
        options={"ftol": _VALUE_TOLERANCE, "gtol": _SLOPE_TOLERANCE, "maxiter": _ITERATIONS},
    )
    place = np.clip(origin + found.x * width, low, high)
    return -float(found.fun), float(place[0]), float(place[1])


def _cell(grid: np.ndarray, index: int) -> float:
    """Distance between the neighbours of a point, or 1 on a grid of one point."""
    if len(grid) == 1:
        return 1.0
    return float(grid[min(index + 1, len(grid) - 1)] - grid[max(index - 1, 0)])
