"""The finite elements' compliance against analytic surfaces, before any contact.

Pressures lie where the mesh is refined for contact: single elements at its ends, its quarter points
and its middle, and packets of waves from a few pressure elements to all of the refined ground. One
batch of back-substitutions serves all. Of displacements that count from nowhere the mean over the
grid is removed.

    h   pitch [m]      m   pressures tried      n   elements of the grid
"""

from typing import TYPE_CHECKING

import numpy as np

from analytic.grid import HatGrid
from analytic.operators.half_plane import ComplianceOperator, ModelOperator
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.models.finite_element.compliance_check import (
    Column,
    Differences,
    OperatorCheck,
    Wave,
    judged,
)
from comparisons.models.nearest_operator import is_layered
from comparisons.models.problem import Problem
from comparisons.scenes.scene import ResolvedScene

if TYPE_CHECKING:
    from comparisons.models.finite_element.contact import MutualCompliance

PLACES = (0.0, 0.25, 0.5, 0.75, 1.0)  # of the refined elements, from first to last
SHORTEST = 4.0  # elements to a wave
LONGER = 4  # waves from twice the shortest to the refined ground
PACKET = 2.0  # waves
NEXT = 4  # elements on either side of a column's load that feel how it is meshed


def operator_check(
    problem: Problem,
    operator: "MutualCompliance",
    model: ModelOperator,
    grid: HatGrid,
    intervals: np.ndarray,
) -> OperatorCheck:
    """Compare on `grid`.

    model      the surface nearest to the scene's bodies, as `nearest_operator` gives it
    intervals  (k, 2) [m] refined ground of the rough body
    """
    scene = problem.scene
    refined = _refined(grid, intervals)
    columns, waves = _places(refined), _wavelengths(refined)
    pressures = np.zeros((grid.count, len(columns) + len(waves)))
    pressures[columns, np.arange(len(columns))] = 1.0
    for k, length in enumerate(waves, start=len(columns)):
        pressures[:, k] = _packet(refined, length)
    finite = operator.apply_all(pressures)

    def against(surface: ComplianceOperator, datum: bool) -> Differences:
        exact = np.stack([surface.apply(pressure) for pressure in pressures.T], axis=1)
        return _differences(grid, finite, exact, pressures, columns, waves, datum)

    datum = scene.thickness is not None and scene.roller is None
    nearest, lacks, bounds = against(model, datum), _lacks(scene), _finite(scene)
    effect = None
    if bounds:
        size = problem.dundurs_beta * (scene.friction[0] if scene.finite_element.coupled else 0.0)
        half_plane = CoupledHalfPlane(grid.count, grid.pitch, problem.modulus, size)
        effect = against(half_plane, datum=False)
    return OperatorCheck(nearest, datum, lacks, effect, bounds, *judged(nearest, lacks))


def no_check(scene: ResolvedScene) -> str | None:
    """Why a scene's finite elements bear no single pressure, or None if they do."""
    slides = scene.base == "frictionless" and scene.width is not None
    if slides and scene.finite_element.gap == "displaced":
        return "the body slides on its base: it bears no pressure that leans to one side"
    return None


def _differences(
    grid: HatGrid,
    finite: np.ndarray,
    exact: np.ndarray,
    pressures: np.ndarray,
    columns: np.ndarray,
    waves: list[float],
    datum: bool,
) -> Differences:
    """Of displacements (n, m) `finite` from `exact` under `pressures` (n, m)."""
    off = finite - exact
    if not datum:
        off, exact = off - off.mean(axis=0), exact - exact.mean(axis=0)
    size = np.linalg.norm(exact, axis=0)
    work = (pressures * off).sum(axis=0) / (pressures * exact).sum(axis=0)
    number = np.arange(grid.count)
    return Differences(
        tuple(
            Column(
                x=float(grid.x[column]),
                difference=float(np.linalg.norm(off[:, k]) / size[k]),
                beyond=float(np.linalg.norm(off[np.abs(number - column) > NEXT, k]) / size[k]),
            )
            for k, column in enumerate(columns)
        ),
        tuple(
            Wave(length * grid.pitch, length, float(work[k]))
            for k, length in enumerate(waves, start=len(columns))
        ),
    )


def _refined(grid: HatGrid, intervals: np.ndarray) -> np.ndarray:
    """(n,) whether all of a hat is on refined ground."""
    slack = 1e-6 * grid.pitch
    start, stop = grid.x - grid.pitch + slack, grid.x + grid.pitch - slack
    at = np.maximum(np.searchsorted(intervals[:, 0], start) - 1, 0)
    return (start >= intervals[at, 0]) & (stop <= intervals[at, 1])


def _places(refined: np.ndarray) -> np.ndarray:
    """Elements whose columns are compared, each once."""
    there = np.flatnonzero(refined)
    return np.unique(there[np.rint(np.multiply(PLACES, len(there) - 1)).astype(int)])


def _span(refined: np.ndarray) -> int:
    """Elements from the first to the last refined one."""
    there = np.flatnonzero(refined)
    return int(there[-1] - there[0]) + 1


def _wavelengths(refined: np.ndarray) -> list[float]:
    """Elements to a wave. Longer ones than the shortest need ground for a packet."""
    span, second = _span(refined), 2.0 * SHORTEST
    if span < PACKET * second:
        return [SHORTEST]
    return [SHORTEST, *map(float, np.geomspace(second, span, LONGER))]


def _packet(refined: np.ndarray, length: float) -> np.ndarray:
    """Pressures (n,) of a wave of so many elements that swells and dies off, where most of it is on
    refined ground and, of such places, nearest to the middle."""
    half = (int(min(PACKET * length, _span(refined))) - 1) // 2
    offset = np.arange(-half, half + 1)
    window = np.cos(0.5 * np.pi * offset / (half + 1)) ** 2
    before = np.concatenate([[0], np.cumsum(refined)])
    centre = np.arange(half, len(refined) - half)
    covered = before[centre + half + 1] - before[centre - half]
    best = centre[covered == covered.max()]
    middle = best[np.argmin(np.abs(best - 0.5 * (len(refined) - 1)))]
    pressure = np.zeros(len(refined))
    pressure[middle + offset] = window * np.cos(2.0 * np.pi * offset / length)
    return pressure


def _lacks(scene: ResolvedScene) -> tuple[str, ...]:
    """What finite elements of a scene have and the nearest analytic surface has not."""
    settings = scene.finite_element
    shared = scene.roller is not None and is_layered(scene)
    return tuple(
        name
        for name, there in (
            ("the rough boundary", settings.geometry == "rough" and scene.profile is not None),
            ("pressure along the roller's normal", settings.gap == "displaced"),
            ("the roller's round body", settings.roller_body == "disc"),
            ("the body's sides", scene.width is not None),
            ("the traction on the roller", shared and settings.coupled and any(scene.friction)),
        )
        if there
    )


def _finite(scene: ResolvedScene) -> tuple[str, ...]:
    """What makes the body other than a half-plane of one material."""
    bounds = {"thickness": scene.thickness, "width": scene.width, "coating": scene.coating}
    return tuple(name for name, bound in bounds.items() if bound is not None)
