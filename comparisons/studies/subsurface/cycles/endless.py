"""A smooth body that is rolled over from far behind to far ahead, on one level of refinement.

Nomenclature: a half-width and p0 peak pressure of the smooth contact, k = Y/sqrt(3) yield stress in
shear by von Mises, h edge of the elements."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.patches import contact_patches
from analytic.exact.shakedown import peak_carried
from analytic.grid import HatGrid
from comparisons.models.problem import Problem
from comparisons.studies.subsurface.cycles.passes import CycledLevel, Passes
from meshes.block import structured

if TYPE_CHECKING:
    from fem.nonlinear.rolling import RolledBody, RollingPass

COARSEST = 4.0  # elements on a half-width, on level 1
STEEPER = 0.3  # growth of the edges beyond what is refined, on level 1; 1/sqrt 2 of it on the next
BESIDE = 1.0  # half-widths beside the contact that are refined
LEAST_PRESSURE = 1.0 + 0.5 * np.pi  # times k: mean that a flat punch bears; contact is no wider
# Half-widths that are refined below it: P/(pi z), which the largest shear comes near to, is k at
# z = p0/(2k) a; the deepest flow is a little above.
DEEP, LEAST_DEEP = 0.35, 1.5
# Seconds of an iteration and of each of its unknowns, and iterations a pass, near the limit.
ITERATION, EACH_UNKNOWN, ITERATIONS = 1e-3, 1.5e-6, 30.0


def yield_in_shear(problem: Problem) -> float:
    """k [Pa] by von Mises."""
    return problem.scene.body.yield_stress / 3**0.5


def peak_over_shear(problem: Problem) -> float:
    """p0/k."""
    return problem.hertz.peak_pressure / yield_in_shear(problem)


def lines_of(problem: Problem, number: int) -> tuple[np.ndarray, np.ndarray]:
    """x, over the surface, and z [m] of the mesh's lines on a level from 1."""
    edges = COARSEST * 2.0 ** (number - 1)
    ratio = 1.0 + STEEPER * 0.5 ** (0.5 * (number - 1))
    edge, over = problem.hertz.half_width / edges, peak_over_shear(problem)
    wide, deep = problem.unbounded
    depth = problem.scene.body.thickness or deep
    x = _graded(_reach(problem, edges), edge, ratio, 0.5 * wide)
    z = _graded(round(max(LEAST_DEEP, DEEP * over) * edges), edge, ratio, depth)
    return np.concatenate([-x[:0:-1], x]), z


def _reach(problem: Problem, edges: float) -> int:
    """Equal edges, so many to a half-width, to each side."""
    widest = max(1.0, 0.25 * np.pi * peak_over_shear(problem) / LEAST_PRESSURE)
    return round((widest + BESIDE) * edges)


def _graded(count: int, edge: float, ratio: float, end: float) -> np.ndarray:
    """0 to an end [m] by so many equal edges [m], or fewer, and then such that grow."""
    if count * edge >= end:
        return np.linspace(0.0, end, int(np.ceil(end / edge)) + 1)
    left = end - count * edge
    more = int(np.ceil(np.log1p(left * (ratio - 1.0) / (edge * ratio)) / np.log(ratio)))
    grown = np.cumsum(ratio ** np.arange(more))
    equal = edge * np.arange(count + 1)
    return np.concatenate([equal, equal[-1] + left * grown / grown[-1]])


def expected_seconds(problem: Problem, number: int, passes: int) -> float:
    """Of a level from 1."""
    x, z = lines_of(problem, number)
    unknowns = 8.0 * len(x) * len(z)
    return passes * ITERATIONS * (ITERATION + EACH_UNKNOWN * unknowns)


def rolled(problem: Problem, number: int, begin: Callable[[int], None]) -> CycledLevel:
    """The passes on a level from 1; `begin` is called with each. Raises FemError."""
    from fem.nonlinear.press_plastic import averaged_pressure

    edges = COARSEST * 2.0 ** (number - 1)
    last = _reach(problem, edges) - 1
    grid = HatGrid(problem.hertz.half_width / edges, -last, last)
    body, done, rows = _body(problem, grid, number), [], []
    for count in range(1, problem.scene.cycles.passes + 1):
        begin(count)
        done.append(body.roll(problem.hertz.load_per_length))
        rows.append(_row(grid, done[-1], done[-2].plastic if count > 1 else 0.0))
    ends, z = (done[0], done[-1]), done[-1].depth
    shown = z <= max(LEAST_DEEP, DEEP * peak_over_shear(problem)) * problem.hertz.half_width
    stresses = [np.column_stack([one.sx, one.sy])[shown] for one in ends]
    return CycledLevel(
        pitch=grid.pitch,
        unknowns=body.body.body.unknowns,
        seconds=0.0,
        passes=Passes.of(rows),
        x=grid.x,
        pressure=np.array([averaged_pressure(one.pressure) for one in ends]),
        lowering=np.zeros((2, grid.count)),
        height=np.zeros(grid.count),
        z=z[shown],
        profile=np.array(stresses),
        carried=_carried(problem, done[-1]),
    )


def _body(problem: Problem, grid: HatGrid, number: int) -> "RolledBody":
    """On its mesh, under the roller."""
    from fem.body.elasticity import elastic_body
    from fem.body.support import Support
    from fem.compliance.operator import FiniteElementCompliance
    from fem.nonlinear.plasticity import ElasticPlastic
    from fem.nonlinear.press_plastic import TRAVEL
    from fem.nonlinear.rolling import RolledBody

    scene, mesh = problem.scene, structured(*lines_of(problem, number))
    body = elastic_body(mesh, scene.body.material, Support(scene.body.base or "bonded", "fixed"))
    nodes = grid.pitch * np.arange(grid.first - 1, grid.last + 2)
    compliance = roller = FiniteElementCompliance(body, nodes)
    if scene.roller.rigid:
        roller = None
    elif scene.roller.material != scene.body.material or scene.body.thickness is not None:
        above = elastic_body(mesh, scene.roller.material, Support("bonded", "fixed"))
        roller = FiniteElementCompliance(above, nodes)
    metal = ElasticPlastic(scene.body.material, scene.body.flow_stress())
    gap, guess = grid.hat_integrals(problem.finite_element_gap), problem.hertz.pressure(grid.x)
    friction = max(scene.load.friction)
    return RolledBody(compliance, metal, gap, grid.weights, guess, friction, roller, TRAVEL)


def _row(grid: HatGrid, done: "RollingPass", before: np.ndarray | float) -> dict[str, float]:
    """What is read of a pass, from plastic strains (n, 4) on."""
    from fem.nonlinear.energy import equivalent_of
    from fem.nonlinear.press_plastic import averaged_pressure

    lowest = done.sx.argmin()
    patches = contact_patches(grid.x, done.pressure, done.opening)
    return {
        "flow": done.added.max(),
        "net": equivalent_of(done.plastic - before).max(),
        **vars(done.energies),
        "residual": done.sx[lowest],
        "residual_depth": done.depth[lowest],
        "peak": averaged_pressure(done.pressure).max(),
        "length": np.ptp(patches, axis=1).sum(),
    }


def _carried(problem: Problem, done: "RollingPass") -> float:
    """p0/k that what a pass leaves carries without flow."""
    hardening, nu = problem.scene.body.flow_stress(), problem.scene.body.poissons_ratio
    back = 2.0 / 3.0 * hardening.kinematic * done.plastic * [1.0, 1.0, 0.5, 1.0]
    rest = np.column_stack([done.sx, np.zeros((len(done.sx), 2)), done.sy]) - back
    flow = hardening.stress(done.equivalent) / hardening.yield_stress
    depth = done.depth / problem.hertz.half_width
    rest, friction = rest / yield_in_shear(problem), max(problem.scene.load.friction)
    return peak_carried(depth, rest, flow, friction, nu)
