"""The meshes of a scene's bodies: what to ask for, how many displacements they will have, and
what a level on them will take."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

import numpy as np

from comparisons.common.errors import SceneError
from comparisons.models.finite_element.roller import roller_spec
from comparisons.models.level import ExpectedCost
from comparisons.models.problem import Problem
from comparisons.models.window import field_ends
from fem.nonlinear.press_plastic import TRAVEL
from fem.solver.mumps import factorisation_seconds
from meshes.block import BlockMesh, BlockSpec
from meshes.real_shape import roughen
from meshes.refined_ranges import refined_ranges
from meshes.size_law import estimate_unknowns

MARGIN_HATS = 3.0  # refined range beyond the predicted contact
FIELD_SIZE = 0.05  # largest element in the stress window on the third level, in half-widths
COARSER_GROWTH = np.sqrt(2.0)  # ratio of the growth from one level to the next
STEEPEST_GROWTH = 0.5
THICKEST_COATING = 0.9  # of the body: what is left below must hold elements
LAYER_EXTENT = 12.0  # thicknesses beyond the contact: a layer's displacements die off in one or two
# The rough boundary fades beside the extent of pressures over this length at least: pressure
# elements of the first level, four of the shortest waves; largest heights of the profile, which
# keeps the fading's own slope below 0.4. Peak pressures change by less than 3e-6 from 10 to 160.
FADE_HATS, FADE_HEIGHTS = 40.0, 5.0
# Peak of the process: without unknowns, and of each (1.9 to 3 kB from 38 000 to 170 000 unknowns).
START_BYTES, BYTES_PER_UNKNOWN = 1.7e8, 2600.0
# Seconds an unknown of gmsh, assembly, back-substitutions and stresses, on one core.
MESH_SECONDS, ASSEMBLY_SECONDS, REST_SECONDS = 5e-6, 1.6e-6, 3e-6
START_SECONDS = 0.3  # of gmsh's own process
# Of one process at the peak, and seconds an unknown: finite deformation of two rough bodies under
# friction, stresses included (2600 bytes; 15 to 17 us from 88 000 to 613 000 unknowns); one step
# of plastic flow, pressed and let go (2300 bytes; 9 to 12 us from 13 000 to 220 000).
NONLINEAR_BYTES = 3500.0
# Of a body that flows, times unknowns^0.2: 3.2 to 5.5 kB from 78 000 to 690 000 unknowns.
FLOW_BYTES, FLOW_ORDER = 360.0, 0.2
FINITE_SECONDS, FLOW_SECONDS = 1.7e-5, 1.1e-5
FINITE_FLOW = 2.0  # times as long an unknown at finite strains, on a rough surface
FEWEST_INCREMENTS = 4.0  # of plastic flow, however little it spreads


@dataclass(frozen=True)
class Refinement:
    """Fineness of a level."""

    pitch: float  # of the pressure elements [m]
    # support an unbounded body at half its width and depth, on the same mesh
    half_block: bool = False
    travel: float = TRAVEL  # of plastic flow: hats that an edge of contact may move in an increment


def block_spec(problem: Problem, refinement: Refinement, patches: np.ndarray) -> BlockSpec:
    """Mesh of the rough body for contact predicted on `patches` (k, 2) [m]."""
    scene, half_width = problem.scene, problem.hertz.half_width
    edge = refinement.pitch  # one under each pressure element
    coarser = round(np.log2(edge / problem.reference_pitch))  # levels to the third
    width, depth = problem.unbounded
    across = 0.5 * width
    if scene.body.thickness is not None:
        depth = scene.body.thickness
        # whole edges: the rounding of a predicted contact must not make another mesh
        across = edge * np.ceil((np.abs(problem.extent).max() + LAYER_EXTENT * depth) / edge)
    if problem.width is not None:
        across = 0.5 * problem.width
    margin = MARGIN_HATS * refinement.pitch
    if problem.rough_boundary or problem.period is not None:  # wherever pressure may come to act
        patches, margin = np.array([problem.extent]), 0.0
    intervals = refined_ranges(patches, edge, margin=margin, half_width=across)
    if scene.coating is not None and scene.coating.thickness > THICKEST_COATING * depth:
        raise SceneError(
            f"{scene.source}: coating.thickness: is {scene.coating.thickness:g} m on a body of "
            f"{depth:.3g} m (finite_element.block); allowed is at most "
            f"{THICKEST_COATING * depth:.3g} m"
        )
    growth = scene.finite_element.growth * COARSER_GROWTH**coarser
    window = None
    if scene.stress is not None:
        size = FIELD_SIZE * half_width * 2.0**coarser
        low, high = field_ends(problem)
        aside = max(-across, min(low, -half_width)), min(across, max(high, half_width))
        down = min(depth, max(scene.stress.depth.metres(half_width), half_width))
        window = (*aside, down, size)
    growth, coating = min(growth, STEEPEST_GROWTH), scene.coating
    interface = None if coating is None else coating.thickness
    return BlockSpec(across, depth, intervals, edge, growth, window, interface=interface)


def rough_mesh(problem: Problem, flat: BlockMesh) -> BlockMesh:
    """The body's mesh from the flat one: at finite deformation with the trace as its boundary."""
    return roughen(flat, _boundary(problem)) if problem.rough_boundary else flat


def rough_key(problem: Problem) -> tuple[Hashable, ...]:
    """Key of what shapes a body's rough boundary, beside its flat mesh; empty where it is flat."""
    profile = problem.surface.profile
    if not problem.rough_boundary:
        return ()
    return profile.x.tobytes(), profile.height.tobytes(), problem.extent, problem.pitches[0]


def expected_unknowns(problem: Problem, refinement: Refinement, patches: np.ndarray) -> int:
    """Displacements of a level, of all its bodies, before anything is meshed."""
    spec = block_spec(problem, refinement, patches)
    unknowns = estimate_unknowns(spec)
    if not problem.scene.roller.rigid and not problem.shares_factor:
        unknowns += estimate_unknowns(roller_spec(problem, spec))
    # of a triangle's nodes two thirds are midpoints of edges; cubic elements have 9/4 as many
    return round(unknowns * {1: 0.25, 2: 1.0, 3: 2.25}[problem.scene.finite_element.degree])


def expected(problem: Problem, refinement: Refinement, patches: np.ndarray) -> ExpectedCost:
    """Cost of a level, for contact predicted on `patches` (k, 2) [m]."""
    unknowns = expected_unknowns(problem, refinement, patches)
    factorisation = factorisation_seconds(unknowns)
    others = MESH_SECONDS + ASSEMBLY_SECONDS + REST_SECONDS
    seconds, memory = START_SECONDS + factorisation + others * unknowns, BYTES_PER_UNKNOWN
    settings = problem.scene.finite_element
    if settings.deformation == "finite":
        seconds, memory = seconds + FINITE_SECONDS * unknowns, NONLINEAR_BYTES
    if settings.plastic:
        steps = flow_increments(problem, refinement, patches)
        steps *= FINITE_FLOW if settings.deformation == "finite" else 1.0
        seconds += FLOW_SECONDS * steps * unknowns
        memory = max(NONLINEAR_BYTES, FLOW_BYTES * unknowns**FLOW_ORDER)
    return ExpectedCost(unknowns, START_BYTES + memory * unknowns, seconds)


def flow_increments(problem: Problem, refinement: Refinement, patches: np.ndarray) -> float:
    """Increments of the load in which a body flows. The edges of the `patches` (k, 2) [m] come from
    their middles, at most over Hertz's contact, and travel one hat an increment in the mean
    (`fem.nonlinear.press_plastic.edge_travel`): early those of the widest, later all of them."""
    span = 2.0 * problem.hertz.half_width
    halves = 0.5 * np.minimum(np.ptp(patches, axis=1), span)
    travel = 0.5 * (halves.max() + halves.mean())
    return max(FEWEST_INCREMENTS, float(travel / (refinement.travel * refinement.pitch)))


def _boundary(problem: Problem) -> Callable[[np.ndarray], np.ndarray]:
    """Heights [m] of the rough boundary anywhere on the block's top, the same on every level. The
    profile wherever pressure may come to act; beyond it the roughness fades, so that elements which
    grow there need not follow waves that they cannot resolve."""
    curve = problem.surface.profile.spline()
    first, last = problem.surface.profile.x[[0, -1]]
    start, stop = problem.extent
    highest = np.abs(problem.surface.profile.height).max()
    fade = max(FADE_HATS * problem.pitches[0], FADE_HEIGHTS * highest)

    def height(x: np.ndarray) -> np.ndarray:
        outside = np.maximum(0.0, np.maximum(start - x, x - stop)) / fade
        share = np.clip(1.0 - outside, 0.0, 1.0)
        smooth = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
        return smooth * curve(np.clip(x, first, last))

    return height
