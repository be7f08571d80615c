"""The half-plane model of a scene on one level of refinement."""

from dataclasses import replace

import numpy as np

from analytic.contact.end_stress import EndStress
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane
from analytic.stress.elements import FrictionStress
from analytic.stress.field import FrictionField, friction_field
from analytic.stress.maxima import stress_maxima
from analytic.stress.periodic import ImageStress, PeriodicRest, held_along
from analytic.stress.points import friction_stress_at
from analytic.stress_state import StressState
from comparisons.common.progress import Stages, peak_memory
from comparisons.models.crest import unresolved_crest
from comparisons.models.level import ExpectedCost, Level, StressResult, by_friction
from comparisons.models.problem import Problem, ends_of, half_plane_of, patches_of, pressed_on
from comparisons.models.window import Window, search_window

SLOPE_STEP = 1e-3  # of a pitch, on either side
# Of a level with stresses, measured from 5 000 to 160 000 nodes on windows as wide as the contact.
SECONDS_PER_NODE, BYTES_PER_NODE = 3.5e-5, 700.0
# Of a window far wider than the contact: each point of the ring on which pressures are convolved,
# beyond the first, and each where extremes are searched; measured to 2 million.
FREE_POINTS, SECONDS_PER_POINT, BYTES_PER_POINT, BYTES_PER_SEARCHED = 1e5, 2e-5, 130.0, 90.0


def expected_of(count: int) -> ExpectedCost:
    """What a level of so many pressure elements will take."""
    return ExpectedCost(count, BYTES_PER_NODE * count, SECONDS_PER_NODE * count)


def expected_with(problem: Problem, pitch: float, window: Window | None) -> ExpectedCost:
    """The same with stresses on a window."""
    cost = expected_of(problem.grid(pitch).count)
    if window is None:
        return cost
    pressed, searched = np.ptp(problem.extent), search_window(problem, window)
    pressed *= 1.0 if problem.period is None else 3.0  # three periods of pressures
    ring = (np.ptp(window.ends) + pressed) * window.subdivisions(pitch) / pitch
    points = max(0.0, ring - FREE_POINTS)
    memory = BYTES_PER_POINT * points + BYTES_PER_SEARCHED * len(searched.x) * len(searched.z)
    seconds = max(cost.seconds, SECONDS_PER_POINT * points)
    return ExpectedCost(cost.unknowns, max(cost.memory, memory), seconds)


def half_plane_level(
    problem: Problem, pitch: float, window: Window | None, stages: Stages, fields: bool = True
) -> dict[float, Level]:
    """Solve one level at each friction coefficient: contact, and in a window the largest stresses
    and, for `fields`, all."""
    grid = problem.grid(pitch)

    def solve(problem: Problem) -> dict[float, Level]:
        frictions = problem.scene.load.friction
        return half_plane_on(problem, grid, problem.coupling, frictions, window, stages, fields)

    return by_friction(problem, "half_plane", solve)


def half_plane_on(
    problem: Problem,
    grid: HatGrid,
    friction_dundurs: float,
    frictions: tuple[float, ...],
    window: Window | None,
    stages: Stages,
    fields: bool = True,
) -> dict[float, Level]:
    """The half-plane on any pressure elements, by friction coefficient.

    friction_dundurs  mu beta by which sliding traction moves the surfaces; 0 leaves it out
    frictions         coefficients that stresses are computed for"""
    with stages.stage("contact", "half-plane: contact"):
        operator = half_plane_of(problem, grid, friction_dundurs)
        solution = pressed_on(problem, grid, operator)
        alone = PeriodicHalfPlane if grid.periodic else HalfPlane
        body = alone(grid.count, grid.pitch, problem.scene.body.material.plane_strain_modulus)
        level = Level(
            grid=grid,
            solution=solution,
            displacement=body.apply(solution.pressure) / grid.weights,
            patches=patches_of(grid, solution),
            seconds=stages.seconds,
            unknowns=grid.count,
            unresolved_crest=unresolved_crest(problem, problem.modulus, grid, solution),
            expected_seconds=expected_with(problem, grid.pitch, window).seconds,
        )
    if window is None:
        return dict.fromkeys(frictions, replace(level, peak_memory=peak_memory()))
    with stages.stage("stresses", "half-plane: stresses"):
        stresses = _stresses(problem, frictions, level, window, fields)
    memory = peak_memory()
    return {s.friction: replace(level, stress=s, peak_memory=memory) for s in stresses}


def _stresses(
    problem: Problem, frictions: tuple[float, ...], level: Level, window: Window, fields: bool
) -> tuple[StressResult, ...]:
    """Extremes off the grid and, for `fields`, all on the window, one set a friction."""
    x, pressure = level.grid.unfolded_x, level.grid.unfolded(level.solution.pressure)
    ends = beside_hats(problem, level)
    searched = field_on(level, search_window(problem, window), ends)
    shown = field_on(level, window, ends) if fields else None
    nu, results = problem.scene.body.poissons_ratio, []
    for friction in frictions:
        how = {"beside": ends.at(friction), "cells": problem.asperities}
        largest = stress_maxima(x, pressure, friction, searched.at(friction), nu, **how)
        extremes = {"tau1": largest.tau1, "txz": largest.txz_abs, "von_mises": largest.von_mises}
        maxima = {"tau1": largest.cells["tau1"], "txz": largest.cells["txz_abs"]}
        field = None if shown is None else shown.at(friction).stress
        results.append(StressResult(friction, extremes, maxima, field))
    return tuple(results)


def beside_hats(problem: Problem, level: Level) -> EndStress | PeriodicRest:
    """What the hats of a level, on three periods of a periodic surface, leave out of stresses."""
    ends, grid = ends_of(problem, level.grid, level.solution), level.grid
    if not grid.periodic:
        return ends
    pressure, nu = level.solution.pressure, problem.scene.body.poissons_ratio
    images = ImageStress(grid, pressure)
    return PeriodicRest(ends.parts, images, held_along(float(pressure.mean()), nu))


def field_on(level: Level, points: Window, ends: EndStress | PeriodicRest) -> FrictionField:
    """Stresses at a window's points, those next to the ends of contact included."""
    field = friction_field(
        level.grid.unfolded_x,
        level.grid.unfolded(level.solution.pressure),
        (points.x[0], points.x[-1]),
        points.z,
        subdivisions=points.subdivisions(level.grid.pitch),
        stride=points.stride(level.grid.pitch),
    )
    beside = ends.parts(field.x, field.z[:, None])
    return replace(field, stress=field.stress.plus(beside, ends.along))


def ends_of_contact(problem: Problem, grid: HatGrid, solution: ContactSolution) -> np.ndarray:
    """x (2k,) [m] of the ends of every patch; by the curve of a patch that has one."""
    patches = patches_of(grid, solution)
    curves = {patch.first: patch.ends for patch in ends_of(problem, grid, solution).patches}
    first = np.searchsorted(grid.x, patches[:, 0])
    return np.array([curves.get(k, p) for k, p in zip(first, patches, strict=True)]).ravel()


def left_out_at_ends(
    problem: Problem, grid: HatGrid, solution: ContactSolution, x: np.ndarray
) -> np.ndarray:
    """What hats and the curves of `ends_of` leave out of sx (2, n) [Pa] under p and under q = p at
    those x [m] that are ends of contact, a cusp; zero at others, and where the hardness holds a
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
