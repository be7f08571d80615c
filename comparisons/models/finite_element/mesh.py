"""The meshes of a scene's bodies: what to ask for, and how many displacements they will have."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass

import numpy as np

from comparisons.common.errors import SceneError
from comparisons.models.finite_element.roller import roller_spec
from comparisons.models.problem import Problem
from comparisons.models.window import field_ends
from fem.nonlinear.press_plastic import TRAVEL
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


@dataclass(frozen=True)
class Refinement:
    """How fine a level is."""

    pitch: float  # of the pressure elements [m]
    # support an unbounded body at half its width and depth, on the same mesh
    half_block: bool = False
    travel: float = TRAVEL  # of plastic flow: hats that an edge of contact may move in an increment


def block_spec(problem: Problem, refinement: Refinement, patches: np.ndarray) -> BlockSpec:
    """Mesh of the rough body for contact predicted on `patches` (k, 2) [m]."""
    scene, half_width = problem.scene, problem.hertz.half_width
    edge = refinement.pitch  # one under each pressure element
    coarser = problem.coarser(refinement.pitch)
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
    """What shapes the rough boundary of a body, beside its flat mesh; nothing where it is flat."""
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
