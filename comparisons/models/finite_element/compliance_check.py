"""The finite elements' compliance against that of analytic surfaces, before any contact.

Both get the same pressures where the mesh is refined: single pressure elements at the ends, quarter
points and middle (columns of the compliance), and packets of waves from a few elements to the whole
refined range, all in one batch of back-substitutions. Of displacements without a datum the mean
over the grid is removed. The differences name the error:

    mesh      short waves differ: elements make a body too stiff, the more the shorter the wave
    modulus   all waves differ by the same: the elastic constants
    block     short waves are right, columns differ far from their load: the block's size or support
    geometry  as `block`, but the analytic surface does not model what the finite elements have
    neither   mesh and body are right; a difference in the contact is the contact's

    h   pitch [m]      m   pressures      n   elements of the grid"""

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

import numpy as np

from analytic.grid import HatGrid
from analytic.operators.half_plane import ComplianceOperator, ModelOperator
from comparisons.common.numbers import percent, percent_as_written
from comparisons.models.nearest_operator import is_layered
from comparisons.models.problem import Problem, half_plane_of
from comparisons.scenes.scene import Scene

if TYPE_CHECKING:
    from comparisons.models.finite_element.contact import MutualCompliance


# Part of the displacement by which waves of so many pressure elements may be too stiff, with one
# edge under each element. Quadratic elements leave 5 % and 1 % there, near nu = 1/2 8 % and 2 %;
# edges of two pressure elements 18 % and 4 %, of four 78 % and 17 %, linear ones 35 % and 21 %.
SHORT_WAVES = {4.0: 0.15, 8.0: 0.05}
# Difference that all longer waves share, and what they may differ by: its own fourth, or a mesh's.
SHARED, SPREAD, MESH_SPREAD = 0.02, 0.25, 0.04
# Part of a column, far from its load. A right mesh and body leave up to 6e-4, a coating a thousand
# times as stiff 2e-3, nu = 0.4999 3e-3; blocks of 40, 20 and 12 half-widths 2e-3, 7e-3 and 2e-2.
BEYOND = 5e-3
PLACES = (0.0, 0.25, 0.5, 0.75, 1.0)  # of the refined elements, from first to last
SHORTEST = 4.0  # elements to a wave
LONGER = 4  # waves from twice the shortest to the refined range
PACKET = 2.0  # waves
NEXT = 4  # elements on either side of a column's load that feel how it is meshed


@dataclass(frozen=True)
class ComplianceColumn:
    """Under the pressure element at x [m]: the L2 norm of the difference over the column's own,
    and the part of it `beyond` the elements next to x."""

    x: float
    difference: float
    beyond: float


@dataclass(frozen=True)
class Wave:
    """Under a packet of waves of a length [m], so many pressure `elements`: the difference of the
    work of pressures on displacements over that work; negative where finite elements are stiffer"""

    length: float
    elements: float
    difference: float


@dataclass(frozen=True)
class Differences:
    """Of the finite elements from an analytic surface."""

    columns: tuple[ComplianceColumn, ...]
    waves: tuple[Wave, ...]


@dataclass(frozen=True)
class ComplianceCheck:
    """Of one level."""

    nearest: Differences  # from the analytic surface that is nearest to the scene's bodies
    datum: bool  # whether displacements count from a base; else a constant was removed
    # what the nearest surface does not model of these finite elements
    not_modelled: tuple[str, ...]
    # from half-planes of body and roller, where the body is `finite` in some respect; this
    # difference is an effect of the body and no error
    half_plane: Differences | None
    finite: tuple[str, ...]
    verdict: str  # neither | mesh | modulus | block | geometry, and why
    because: str

    def as_dict(self) -> dict:
        """For result.json."""
        effect = None
        if self.half_plane is not None:
            effect = {"of": list(self.finite), **asdict(self.half_plane)}
        return {
            "verdict": self.verdict,
            "because": self.because,
            "datum_removed": not self.datum,
            **{name: list(rows) for name, rows in asdict(self.nearest).items()},
            "not_modelled": list(self.not_modelled),
            "body_effect": effect,
        }


def judged(differences: Differences, not_modelled: tuple[str, ...]) -> tuple[str, str]:
    """Verdict and why. The body is not judged where something is `not_modelled`."""
    long = [wave.difference for wave in differences.waves if wave.elements >= 8.0]
    shared = 0.0 if not_modelled else _shared(long)
    for wave in differences.waves:
        bound = SHORT_WAVES.get(wave.elements)
        if bound is not None and wave.difference - shared < -bound:
            return "mesh", (
                f"waves of {wave.elements:g} pressure elements are too stiff by "
                f"{percent(shared - wave.difference)}, more than {percent_as_written(bound)}"
            )
    if shared:
        off = percent(shared, signed=True)
        return "modulus", f"all waves are off by the same {off}: the elastic constants"
    far = max(column.beyond for column in differences.columns)
    text = f"{percent(far)} of a column is off far from its load"
    if far > BEYOND and not_modelled:
        missing = " and ".join(not_modelled)
        return "geometry", f"{text}; the analytic surface does not model {missing}"
    if far > BEYOND:
        bound = percent_as_written(BEYOND)
        return "block", f"{text}, more than {bound}: the block's size, or how it is held"
    return "neither", "short waves and columns far from their load are right"


def _shared(differences: list[float]) -> float:
    """The difference that all waves share, zero where they share none."""
    if len(differences) < 2:
        return 0.0
    least = min(differences, key=abs)
    spread = max(abs(np.array(differences) - least))
    equal = spread <= max(SPREAD * abs(least), MESH_SPREAD)
    return least if equal and abs(least) > SHARED else 0.0


def operator_check(
    problem: Problem,
    operator: "MutualCompliance",
    model: ModelOperator,
    grid: HatGrid,
    intervals: np.ndarray,
) -> ComplianceCheck:
    """Compare on `grid`.

    model      the surface nearest to the scene's bodies, as `nearest_operator` gives it
    intervals  (k, 2) [m] refined ranges of the rough body"""
    scene = problem.scene
    refined = _refined(grid, intervals)
    there = np.flatnonzero(refined)
    columns = np.unique(there[np.rint(np.multiply(PLACES, len(there) - 1)).astype(int)])
    span = int(there[-1] - there[0]) + 1  # elements from the first to the last refined one
    waves = _wavelengths(span)
    pressures = np.zeros((grid.count, len(columns) + len(waves)))
    pressures[columns, np.arange(len(columns))] = 1.0
    for k, length in enumerate(waves, start=len(columns)):
        pressures[:, k] = _packet(refined, span, length)
    finite = operator.apply_all(pressures)

    def against(surface: ComplianceOperator, datum: bool) -> Differences:
        exact = np.stack([surface.apply(pressure) for pressure in pressures.T], axis=1)
        return _differences(grid, finite, exact, pressures, columns, waves, datum)

    datum = scene.body.thickness is not None and scene.roller.rigid
    nearest, not_modelled, bounds = against(model, datum), _not_modelled(scene), _finite(scene)
    effect = None
    if bounds:
        size = problem.dundurs_beta * (
            scene.load.friction[0] if scene.finite_element.coupled else 0.0
        )
        effect = against(half_plane_of(problem, grid, size), datum=False)
    return ComplianceCheck(
        nearest, datum, not_modelled, effect, bounds, *judged(nearest, not_modelled)
    )


def no_check(scene: Scene) -> str | None:
    """Why the check is impossible in a scene, or None."""
    slides = scene.body.base == "frictionless" and scene.body.width is not None
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
            ComplianceColumn(
                x=float(grid.x[column]),
                difference=float(np.linalg.norm(off[:, k]) / size[k]),
                beyond=float(np.linalg.norm(off[np.abs(number - column) > NEXT, k]) / size[k]),
            )
            for k, column in enumerate(columns)
        ),
        tuple(
            Wave(length * grid.pitch, length, float(part))
            for length, part in zip(waves, work[len(columns) :], strict=True)
        ),
    )


def _refined(grid: HatGrid, intervals: np.ndarray) -> np.ndarray:
    """(n,) whether all of a hat is in a refined range."""
    slack = 1e-6 * grid.pitch
    start, stop = grid.x - grid.pitch + slack, grid.x + grid.pitch - slack
    at = np.maximum(np.searchsorted(intervals[:, 0], start) - 1, 0)
    return (start >= intervals[at, 0]) & (stop <= intervals[at, 1])


def _wavelengths(span: int) -> list[float]:
    """Elements to a wave. Longer ones than the shortest need room for a packet."""
    second = 2.0 * SHORTEST
    if span < PACKET * second:
        return [SHORTEST]
    return [SHORTEST, *map(float, np.geomspace(second, span, LONGER))]


def _packet(refined: np.ndarray, span: int, length: float) -> np.ndarray:
    """Pressures (n,) of a wave of so many elements that swells and dies off, where most of it is in
    refined ranges and, of such places, nearest to the middle."""
    half = (int(min(PACKET * length, span)) - 1) // 2
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


def _not_modelled(scene: Scene) -> tuple[str, ...]:
    """What the nearest analytic surface does not model of a scene's finite elements."""
    settings = scene.finite_element
    shared = not scene.roller.rigid and is_layered(scene)
    return tuple(
        name
        for name, there in (
            ("the rough boundary", settings.geometry == "rough" and scene.profile is not None),
            ("pressure along the roller's normal", settings.gap == "displaced"),
            ("the roller's round body", settings.roller_body == "disc"),
            ("the body's sides", scene.body.width is not None),
            ("layers below a periodic surface", scene.periodic and is_layered(scene)),
            (
                "the traction on the roller",
                shared and settings.coupled and any(scene.load.friction),
            ),
        )
        if there
    )


def _finite(scene: Scene) -> tuple[str, ...]:
    """What makes the body other than a half-plane of one material."""
    bounds = {
        "thickness": scene.body.thickness,
        "width": scene.body.width,
        "coating": scene.coating,
    }
    return tuple(name for name, bound in bounds.items() if bound is not None)
