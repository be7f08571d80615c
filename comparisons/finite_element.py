"""The finite-element model of a scene on one level of refinement.

The rough body is a block: of the scene's own thickness and width where they are given, else so
large that it stands for a half-plane. An elastic roller is a flat block of its own on the same
pressures. The contact is solved on the sum of both surface compliances; the half-plane appears
only as the model of the outer iteration, whose answer is checked on the finite elements.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from analytic.contact import solve_contact
from analytic.defect import solve_with_model
from analytic.gap import HatGrid
from analytic.operators import DenseCompliance, HalfPlane, SumOfBodies
from analytic.patches import contact_patches
from analytic.plane_stress import PlaneStress
from comparisons.errors import SceneError
from comparisons.level import Level, MeshField, StressResult, Window
from comparisons.plan import Plan
from comparisons.problem import Problem
from comparisons.stages import Stages, peak_memory
from fem.compliance import FiniteElementCompliance
from fem.elasticity import ElasticBody, Support, elastic_body
from fem.maximum import maximum
from fem.stress import evaluate, nodal_stress
from fem.surface import straight_down
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.estimate import estimate_unknowns
from meshes.grading import merge, reaches_unrefined, refined_intervals
from meshes.roughen import roughen

EDGES_PER_HAT = 1  # quadratic edges under each pressure element
MARGIN_HATS = 3.0  # refined ground beyond the predicted contact
FIELD_SIZE = 0.05  # largest element in the stress window on the third level, in half-widths
COARSER_GROWTH = np.sqrt(2.0)  # ratio of the growth from one level to the next
STEEPEST_GROWTH = 0.5
LAYER_REACH = 12.0  # thicknesses beyond the contact: a layer's displacements die off in one or two
# Peak of the whole process, measured at 2.8 to 3.2 kB from 95 000 to 655 000 unknowns.
BYTES_PER_UNKNOWN = 3200.0
MOST_DENSE = 1500  # pressure elements for which the whole compliance matrix may be formed
MOST_MESHES = 5  # of one level, while contact keeps reaching unrefined ground
TAPER_HATS = 40.0  # surface edges over which real roughness fades outside the refined ground
UNBOUNDED_SIDES = "fixed"  # half of the error in tau1 that free sides or rollers leave


@dataclass(frozen=True)
class Refinement:
    """How fine a level is.

    pitch    of the pressure elements [m]
    halved   hold an unbounded body at half its width and depth, on the same mesh
    """

    pitch: float
    halved: bool = False


def block_spec(problem: Problem, refinement: Refinement, patches: np.ndarray) -> BlockSpec:
    """Mesh of the rough body for contact predicted on `patches` (k, 2) [m]."""
    scene, half_width = problem.scene, problem.hertz.half_width
    edge = refinement.pitch / EDGES_PER_HAT
    coarser = problem.coarser(refinement.pitch)
    depth = problem.block
    reach = 0.5 * depth
    if scene.thickness is not None:
        depth = scene.thickness
        # whole edges: the rounding of a predicted contact must not make another mesh
        reach = edge * np.ceil((np.abs(problem.extent).max() + LAYER_REACH * depth) / edge)
    if scene.width is not None:
        reach = 0.5 * scene.width
    intervals = refined_intervals(
        patches, edge, margin=MARGIN_HATS * refinement.pitch, half_width=reach
    )
    if scene.finite_element.geometry == "rough":
        intervals = np.array([[intervals[0, 0], intervals[-1, 1]]])
    growth = scene.finite_element.growth * COARSER_GROWTH**coarser
    window = None
    if scene.stress is not None:
        size = FIELD_SIZE * half_width * 2.0**coarser
        across = min(reach, max(scene.stress.half_range.metres(half_width), half_width))
        down = min(depth, max(scene.stress.depth.metres(half_width), half_width))
        window = (-across, across, down, size)
    return BlockSpec(reach, depth, intervals, edge, min(growth, STEEPEST_GROWTH), window)


def expected_memory(
    problem: Problem, plan: Plan, refinement: Refinement, patches: np.ndarray
) -> float:
    """Bytes that a level will take, factors, meshes and stresses together."""
    unknowns = estimate_unknowns(block_spec(problem, refinement, patches))
    own_block = problem.scene.roller is not None and not plan.shared_factor
    return BYTES_PER_UNKNOWN * unknowns * (2 if own_block else 1)


def finite_element_level(
    problem: Problem,
    plan: Plan,
    refinement: Refinement,
    window: Window | None,
    stages: Stages,
    approach: float | None = None,
) -> Level:
    """Solve one level: mesh, factorise, press, and where asked for compute the stresses.

    Ground to refine is predicted by the half-plane on the same pressure elements. If contact
    reaches ground that was not refined it is refined too and the level solved again. With
    `approach` [m], from first touch, it and not the load is prescribed.
    Raises SceneError where the level would exceed the budget of memory, MeshError or FemError
    where a mesh or a factorisation fails.
    """
    scene, grid = problem.scene, problem.grid(refinement.pitch)
    average = grid.average(problem.gap, problem.knots)
    model = HalfPlane(grid.count, grid.pitch, problem.modulus)
    with stages.stage("contact", "finite elements: predicting the contact"):
        guess = solve_contact(model, average, grid.weights, problem.constraints())
    ground, start = contact_patches(grid.x, guess.pressure, guess.gap), guess.pressure
    expected = expected_memory(problem, plan, refinement, ground)
    allowed = scene.budget.memory
    if expected > allowed:
        raise SceneError(
            f"{scene.source}: budget.memory: is {allowed:.3g} bytes, but finite elements on "
            f"pressures of {grid.pitch:.3g} m need about {expected:.2g}; allowed is a larger "
            "budget, or coarser pressures (resolution.pitch)"
        )
    constraints = problem.constraints()
    if approach is not None:
        constraints = replace(constraints, load=None, approach=approach + problem.first_touch)
    for _ in range(MOST_MESHES):
        spec = block_spec(problem, refinement, ground)
        bodies, held = _bodies(problem, plan, spec, refinement.halved, stages)
        with stages.stage("contact", "finite elements: contact"):
            direction = _roller_slope(problem)
            compliances = [
                FiniteElementCompliance(
                    body, grid.x[0], grid.pitch, grid.count, direction if body.curved else None
                )
                for body in bodies
            ]
            operator = SumOfBodies(*compliances, factors=_factors(problem, bodies))
            solution = solve_with_model(operator, model, average, grid.weights, constraints, start)
            if not solution.converged and grid.count <= MOST_DENSE:
                # far from a half-plane (a thin layer) the model leads nowhere: take C itself
                pairs = zip(compliances, operator.factors, strict=True)
                matrix = sum(factor * compliance.matrix() for compliance, factor in pairs)
                solution = solve_contact(
                    DenseCompliance(matrix), average, grid.weights, constraints, solution.pressure
                )
        touching = grid.x[solution.pressure > 0.0]
        missed = reaches_unrefined(bodies[0].mesh.spec.intervals, touching, reach=grid.pitch)
        if len(missed) == 0:
            break
        ground, start = merge(np.vstack([ground, missed])), solution.pressure
    body, compliance = bodies[0], compliances[0]
    level = Level(
        grid=grid,
        solution=solution,
        displacement=compliance.apply(solution.pressure) / grid.weights,
        patches=contact_patches(grid.x, solution.pressure, solution.gap),
        seconds=stages.seconds,
        unknowns=sum(b.unknowns for b in bodies),
        factor_memory=held,
        mesh=body.mesh,
    )
    if window is None:
        return replace(level, peak_memory=peak_memory())
    with stages.stage("stresses", "finite elements: stresses"):
        found = [
            _stresses(problem, compliance, grid, solution.pressure, friction, window)
            for friction in scene.friction
        ]
    return replace(
        level,
        peak_memory=peak_memory(),
        stresses=tuple(result for result, _ in found),
        mesh_field=MeshField(
            body.points, body.mesh.triangles, {r.friction: nodal for r, nodal in found}
        ),
    )


def _bodies(
    problem: Problem, plan: Plan, spec: BlockSpec, halved: bool, stages: Stages
) -> tuple[tuple[ElasticBody, ...], int]:
    """The rough body, and the roller's block where it needs its own; bytes of their factors."""
    scene = problem.scene
    with stages.stage("mesh", "finite elements: mesh"):
        flat = build_block(spec)
        mesh = flat
        if scene.finite_element.geometry == "rough" and scene.profile is not None:
            mesh = roughen(flat, _boundary(problem, spec))
    within = (
        0.5 * spec.half_width if halved and scene.width is None else np.inf,
        0.5 * spec.depth if halved and scene.thickness is None else np.inf,
    )
    sides = "free" if scene.width is not None else UNBOUNDED_SIDES
    wanted = [(mesh, scene.body, Support(scene.base or "bonded", sides, within))]
    if scene.roller is not None and not plan.shared_factor:
        unbounded = scene.thickness is None and scene.width is None
        block = flat
        if not unbounded:
            depth = problem.block
            with stages.stage("mesh", "finite elements: mesh of the roller"):
                block = build_block(replace(spec, half_width=0.5 * depth, depth=depth, window=None))
        beyond = 0.5 if halved else np.inf
        within = beyond * block.spec.half_width, beyond * block.spec.depth
        wanted.append((block, scene.roller, Support("bonded", UNBOUNDED_SIDES, within)))
    bodies, held = [], 0
    for block, material, support in wanted:
        with stages.stage("assembly", "finite elements: assembly"):
            body = elastic_body(block, material, support)
        with stages.stage("factorisation", "finite elements: factorisation"):
            held += body.factor.bytes
        bodies.append(body)
    return tuple(bodies), held


def _factors(problem: Problem, bodies: tuple[ElasticBody, ...]) -> tuple[float, ...]:
    """Weights of the bodies' compliances in the sum: one factorisation may serve both."""
    scene = problem.scene
    if len(bodies) == 1 and scene.roller is not None:
        return (1.0 + scene.body.youngs_modulus / scene.roller.youngs_modulus,)
    return (1.0,) * len(bodies)


def _roller_slope(problem: Problem) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """Force per length of x under unit pressure on a rough boundary: along the roller's normal."""
    radius = problem.scene.roller_radius

    def direction(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return x / radius, np.ones_like(x)

    return direction


def _boundary(problem: Problem, spec: BlockSpec) -> Callable[[np.ndarray], np.ndarray]:
    """Heights [m] of the real boundary anywhere on the block's top.

    The profile on the refined ground; beyond it the roughness fades, so that elements which grow
    there need not follow waves that they cannot resolve.
    """
    curve = problem.scene.profile.spline()
    first, last = problem.scene.profile.x[[0, -1]]
    start, stop = spec.intervals[0, 0], spec.intervals[-1, 1]
    fade = TAPER_HATS * spec.surface_size

    def height(x: np.ndarray) -> np.ndarray:
        outside = np.maximum(0.0, np.maximum(start - x, x - stop)) / fade
        share = np.clip(1.0 - outside, 0.0, 1.0)
        smooth = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
        return smooth * curve(np.clip(x, first, last))

    return height


def _stresses(
    problem: Problem,
    compliance: FiniteElementCompliance,
    grid: HatGrid,
    pressure: np.ndarray,
    friction: float,
    window: Window,
) -> tuple[StressResult, PlaneStress]:
    """Stresses under one friction coefficient: on the window, and at the mesh's points."""
    body, nu = compliance.body, problem.scene.body.poissons_ratio
    nodes = np.concatenate([[grid.x[0] - grid.pitch], grid.x, [grid.x[-1] + grid.pitch]])
    hats = np.concatenate([[0.0], pressure, [0.0]])
    nodal = nodal_stress(
        body,
        compliance.displacement(pressure, friction),
        lambda x: np.interp(x, nodes, hats),
        friction,
        _roller_slope(problem) if body.curved else straight_down,
    )
    bounds = (-window.reach, window.reach, window.z[-1])
    quantities = {
        "tau1": lambda stress: stress.tau1,
        "txz": lambda stress: np.abs(stress.txz),
        "von_mises": lambda stress: stress.von_mises(nu),
    }
    extremes = {
        name: maximum(body, nodal, quantity, bounds) for name, quantity in quantities.items()
    }
    x, z = np.meshgrid(window.x, window.z)
    return StressResult(friction, extremes, evaluate(body, nodal, x, z)), nodal
