"""Readings of a contact that is solved on hats: its patches, their ends, and the stresses below.

Hats leave something out of the stresses next to the ends of contact, and on a periodic surface the
periods but three: `beside_hats`."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from analytic.contact.end_stress import EndStress, end_stress
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.stress.elements import FrictionStress
from analytic.stress.field import FrictionField, friction_field
from analytic.stress.maxima import stress_maxima
from analytic.stress.periodic import ImageStress, held_along
from analytic.stress.points import friction_stress_at
from analytic.stress_state import Extremum, StressState
from comparisons.models.level import Level
from comparisons.models.operators import patches_of
from comparisons.models.problem import Problem
from comparisons.models.window import Window, search_window

SLOPE_STEP = 1e-3  # of a pitch, on either side


def ends_of(problem: Problem, grid: HatGrid, solution: ContactSolution) -> EndStress:
    """Stresses that the hats of a solution leave out next to the ends of contact, in both models
    alike, for both have hats. None where the hardness holds a pressure."""
    pressure, x = grid.unfolded(solution.pressure), grid.unfolded_x
    if np.any(pressure >= problem.constraints().hardness):
        return EndStress(x, pressure, ())
    return end_stress(x, pressure, grid.unfolded(solution.gap))


def ends_of_contact(problem: Problem, grid: HatGrid, solution: ContactSolution) -> np.ndarray:
    """x (2k,) [m] of the ends of every patch; by the curve of a patch that has one."""
    patches = patches_of(grid, solution)
    curves = {patch.first: patch.ends for patch in ends_of(problem, grid, solution).patches}
    first = np.searchsorted(grid.x, patches[:, 0])
    return np.array([curves.get(k, p) for k, p in zip(first, patches, strict=True)]).ravel()


def left_out_at_ends(
    problem: Problem, grid: HatGrid, solution: ContactSolution, x: np.ndarray
) -> np.ndarray:
    """Part of sx (2, n) [Pa] under p and under q = p that hats and the curves of `ends_of` lack
    at those x [m] that are ends of contact, a cusp; zero at others, and where the hardness holds a
    pressure. No pressure is left there, and both bodies touch up to there, 2 / (pi E*) int p(s) /
    (x - s) ds = g0'(x); sx under q is -2 / pi times that integral. Hertz's contact has 2 p0."""
    left, pressure = np.zeros((2, len(x))), solution.pressure
    if np.any(pressure >= problem.constraints().hardness):
        return left
    edges = np.isin(x, ends_of_contact(problem, grid, solution))
    at, step = x[edges], SLOPE_STEP * grid.pitch
    slope = (problem.gap(at + step) - problem.gap(at - step)) / (2.0 * step)
    top = at, np.zeros_like(at)
    by_hats = friction_stress_at(grid.x, pressure, *top).parts
    by_hats = by_hats + ends_of(problem, grid, solution).parts(*top)
    left[:, edges] = np.array([np.zeros_like(at), -problem.modulus * slope]) - by_hats[[0, 3]]
    return left


def beside_hats(problem: Problem, level: Level) -> EndStress:
    """Stresses that the hats of a level, on three periods of a periodic surface, leave out."""
    ends, grid = ends_of(problem, level.grid, level.solution), level.grid
    if not grid.periodic:
        return ends
    pressure, nu = level.solution.pressure, problem.scene.body.poissons_ratio
    along = held_along(float(pressure.mean()), nu)
    return replace(ends, images=ImageStress(grid, pressure), along=along)


def hats_field(grid: HatGrid, pressure: np.ndarray, points: Window) -> FrictionField:
    """Stresses at a window's points under hats of pressure (n,) [Pa]."""
    return friction_field(
        grid.unfolded_x,
        grid.unfolded(pressure),
        (points.x[0], points.x[-1]),
        points.z,
        subdivisions=points.subdivisions(grid.pitch),
        stride=points.stride(grid.pitch),
    )


def largest_tau1(
    problem: Problem,
    grid: HatGrid,
    pressure: np.ndarray,
    friction: float,
    beside: Callable[[np.ndarray, np.ndarray], StressState],
) -> Extremum:
    """The largest tau1 [Pa] in the window below hats of pressure (n,) [Pa] and their sliding
    traction, with the stresses `beside` them at x and z [m]."""
    field = hats_field(grid, pressure, search_window(problem)).at(friction)
    stress = field.stress.plus(1.0, beside(*np.meshgrid(field.x, field.z)))
    fields, nu = {friction: replace(field, stress=stress)}, problem.scene.body.poissons_ratio
    further = {"beside": lambda _, x, z: beside(x, z)}
    maxima = stress_maxima(grid.x, pressure, fields, nu, **further)[friction]
    return Extremum.highest(maxima["tau1"])


def field_on(level: Level, points: Window, ends: EndStress) -> FrictionField:
    """Stresses at a window's points, those next to the ends of contact included."""
    field = hats_field(level.grid, level.solution.pressure, points)
    beside = ends.parts(field.x, field.z[:, None])
    return replace(field, stress=field.stress.plus(beside, ends.along))


def stresses_at(
    problem: Problem, level: Level, frictions: tuple[float, ...], x: np.ndarray, z: np.ndarray
) -> dict[float, StressState]:
    """A solved level's stresses by friction coefficient at x, z (n,) [m]; NaN where z < 0."""
    below, parts, grid = z >= 0.0, np.full((4, len(x)), np.nan), level.grid
    at = x[below], z[below]
    ends = beside_hats(problem, level)
    stress = friction_stress_at(grid.unfolded_x, grid.unfolded(level.solution.pressure), *at)
    parts[:, below] = stress.plus(ends.parts(*at)).parts
    return {friction: FrictionStress.of(parts, ends.along).at(friction) for friction in frictions}
