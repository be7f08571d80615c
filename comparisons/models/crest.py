"""Highest pressure of a level on a finer grid of its crest.

Under a crest that is sharper than the pressure elements, pressures grow with the logarithm of their
number, as at the apex of a wedge (Johnson 1985, section 5.2)

    p = (E* tan/pi) arccosh(a/|x|),

until they resolve the curvature that the trace's spline has there. Levels differ by equal amounts
till then, and by less or to the other side soon after: no fit knows their limit. The load of the
crest, and how far what lies beside it makes it sink, are known long before. With these the crest
alone is pressed again, on elements a quarter as wide, its highest point on a quarter of these, and
so on to an eighth of the samples' distance.

What lies beside a crest follows from the level's own gap, less what the initial gap and the
pressures of the crest make of it on a half-plane: so any elastic model of it will do."""

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.contact.coupled import solve_coupled
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from comparisons.models.operators import LAYERS, half_planes
from comparisons.models.problem import Problem

REACH, FINER = 32, 4  # elements to each side of a crest's highest pressure; theirs to a coarser one
ENOUGH = 0.125  # of the least distance of samples: elements that resolve the spline between them
# Times the change: the last elements leave up to a tenth of it, and the mesh of finite elements, on
# which the crest is not pressed again, was seen to lack a quarter of it beside.
SAFETY = 1.5
# Relative change of the largest pressure below which a crest is resolved, and levels tell the rest:
# those beside a crest stay as they are, which was seen to leave 1e-4.
RESOLVED = 1e-3
MOST = 8  # crests that may come to have the highest pressure, and times that one is refined


def unresolved_crest(
    problem: Problem,
    grid: HatGrid,
    solution: ContactSolution,
    effects: frozenset[str] = LAYERS,
) -> float:
    """Bound of the error of a level's largest pressure, relative to it, by crests that its elements
    do not resolve; 0 where they do, or where the hardness holds it.

    effects  of the level's model: a coating is at the surface"""
    peak, hardness = float(solution.pressure.max()), problem.constraints().hardness
    if problem.surface.profile is None or peak >= hardness * (1.0 - RESOLVED):
        return 0.0
    least = max(float(np.diff(problem.surface.profile.x).min()), grid.pitch / FINER**MOST)
    enough, highest, pressure = ENOUGH * least, [], solution.pressure
    [tops] = np.nonzero(pressure >= np.maximum(np.roll(pressure, 1), np.roll(pressure, -1)))
    most = _most(enough, grid, solution, tops)
    tops = tops[np.argsort(-most)][: min(MOST, np.count_nonzero(most >= peak))]
    crests = [(grid, solution, int(top)) for top in tops]
    while not highest or crests[0][0].pitch > enough:
        crests = [_refined(problem, effects, *crest) for crest in crests]
        highest.append(max(pressed.pressure[top] for _, pressed, top in crests))
        crests = [crest for crest in crests if _most(enough, *crest) >= highest[-1]]
    change = float(np.abs(np.array(highest) / peak - 1.0).max())
    return SAFETY * change if change > RESOLVED else 0.0


def _most(enough: float, grid: HatGrid, solution: ContactSolution, top: np.ndarray) -> np.ndarray:
    """What pressures [Pa] of nodes may become on elements of a pitch that is `enough` [m]: each
    halving adds no more than what a node stands above its neighbours by."""
    pressure, halvings = solution.pressure, max(1.0, np.log2(grid.pitch / enough))
    above = 2.0 * pressure[top] - pressure[top - 1] - pressure[(top + 1) % grid.count]
    return pressure[top] + halvings * np.maximum(above, 0.0)


def _refined(
    problem: Problem, effects: frozenset[str], grid: HatGrid, solution: ContactSolution, top: int
) -> tuple[HatGrid, ContactSolution, int]:
    """Finer elements about a node, pressures of the same load on these, and where they are highest:
    the ends, where fine elements meet coarse ones, are no part of the crest."""
    reach = min(REACH, grid.count // 2 - 1)
    first, last = top - reach, top + reach
    if not grid.periodic:
        first, last = max(first, 0), min(last, grid.count - 1)
    nodes = np.arange(first, last + 1) % grid.count
    coarse = HatGrid(grid.pitch, grid.first + first, grid.first + last)
    start, stop = FINER * (coarse.first - 1) + 1, FINER * (coarse.last + 1) - 1
    fine = HatGrid(grid.pitch / FINER, start, stop)
    pressure = solution.pressure[nodes]
    own = coarse.hat_integrals(problem.gap, problem.knots)
    own += half_planes(problem, coarse, effects).apply(pressure)
    beside = CubicSpline(coarse.x, solution.gap[nodes] - own / coarse.weights)
    # a mean over hats exceeds the value by h^2/12 times the second derivative
    wider = (coarse.pitch**2 - fine.pitch**2) / 12.0
    gap = beside(fine.x) - wider * beside(fine.x, 2)
    gap = fine.hat_integrals(problem.gap, problem.knots) + gap * fine.weights
    constraints = problem.constraints(load=float(pressure @ coarse.weights))
    operator, start = half_planes(problem, fine, effects), np.interp(fine.x, coarse.x, pressure)
    pressed = solve_coupled(operator, gap, fine.weights, constraints, start)
    near = np.abs(fine.x - grid.x[top]) <= 0.5 * REACH * FINER * fine.pitch
    return fine, pressed, int(np.where(near, pressed.pressure, 0.0).argmax())
