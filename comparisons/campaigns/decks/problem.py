"""Problem that a deck of any code is written from: the project's own meshes, load and kinematics.

Millimetre, newton and megapascal. x along the surface, y up, out of the rough body; the origin is
on the mean line under the roller's centre.

A linear scene assumes a flat boundary and keeps the roughness in the gap. Its deck has the whole
initial gap on the rough body's top, under a flat roller, in heights divided by FLATTER, and moduli
that are FLATTER times as large: pressures, stresses and forces of linear elasticity stay what they
are, and whatever another code does on the deformed or rough surface is FLATTER times as small.
Otherwise both bodies have their own shapes, as the project's finite elements do."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.patches import contact_patches
from analytic.material import Material
from comparisons.common.errors import SceneError
from comparisons.models.finite_element.bodies import UNBOUNDED_SIDES
from comparisons.models.finite_element.mesh import Refinement, block_spec, rough_mesh
from comparisons.models.finite_element.roller import (
    disc_support,
    is_disc,
    levelled,
    roller_mesh,
    roller_of,
    roller_spec,
)
from comparisons.models.operators import operator_of, pressed_on
from comparisons.models.problem import Problem
from fem.body.support import Support, held_components
from fem.body.surface import boundary_points
from meshes.block import EDGES, BlockMesh, BlockSpec, real_points, structured
from meshes.build import build_block
from meshes.real_shape import roughen
from meshes.size_law import surface_edge

MM, MPA, N_PER_MM = 1e3, 1e-6, 1e-3  # of 1 m, 1 Pa, 1 N/m
FLATTER = 1e3
WIDER = 0.1  # of a predicted patch of contact: the refined ranges reach so far beyond it
FINER = 2.0  # edges of a rigid roller's curve to one of the rough body
RIGID = Material(210e9, 0.3)  # of elements whose nodes are all held
TOUCH_POINTS = 100_001
LEVEL = 1.5  # of the extent: half-width of a rigid roller


@dataclass(frozen=True)
class DeckBody:
    """A body of six-node triangles."""

    points: np.ndarray  # (n, 2) x and y [mm]
    # (m, 6) anticlockwise: corners, then midpoints of the edges (0, 1), (1, 2), (2, 0)
    triangles: np.ndarray
    coated: np.ndarray  # (m,) whether a triangle is in the coating
    materials: tuple[Material, ...]  # of the body and of its coating, moduli [Pa] as in the deck
    held: np.ndarray  # (n, 2) components of displacement that the far boundary holds
    faces: np.ndarray  # (k, 2) triangle and local edge of each face that may touch

    @property
    def surface(self) -> np.ndarray:
        """Indices (k,) among the points of the nodes that may touch, ascending along x."""
        triangle, edge = self.faces.T
        local = np.column_stack([edge, (edge + 1) % 3, edge + 3])
        nodes = np.unique(self.triangles[triangle[:, None], local])
        return nodes[np.argsort(self.points[nodes, 0])]


@dataclass(frozen=True)
class DeckProblem:
    """Bodies, load and kinematics that a deck describes."""

    problem: Problem  # the scene's
    # rough, roller: bodies; the held nodes of the roller move as one
    rough: DeckBody
    roller: DeckBody
    finite: bool  # finite deformation
    flatter: float  # what heights are divided by and moduli multiplied with
    load: float  # [N/mm]
    edge: float  # of the elements on the contact [mm]
    ranges: np.ndarray  # (k, 2) stretches of the surface with such elements [mm]
    # how deep the roller would have to stand in the undeformed body to cut off as much of its
    # surface as is predicted to touch [mm]
    overlap: float

    @property
    def bodies(self) -> dict[str, DeckBody]:
        return {"ROUGH": self.rough, "ROLLER": self.roller}

    @property
    def nodes(self) -> int:
        return len(self.rough.points) + len(self.roller.points)


def deck_problem(problem: Problem, pitch: float) -> DeckProblem:
    """The deck of a problem with elements of `pitch` [m] on the contact, in meshes like those of
    the finite elements' level. Raises SceneError for what decks do not describe."""
    scene, settings = problem.scene, problem.scene.finite_element
    if scene.periodic:
        why = "is true; allowed in a deck is a roller: it does not tie the sides of a body"
        raise SceneError(f"{scene.source}: profile.periodic: {why}")
    if scene.body.hardness is not None and not settings.plastic:
        why = "is given; allowed in a deck are elastic bodies, and such that flow (plastic = true)"
        raise SceneError(f"{scene.source}: body.hardness: {why}")
    if settings.plastic and len(scene.load.friction) > 1:  # flow remembers the one before
        why = f"has {len(scene.load.friction)} coefficients; allowed in a deck with flow is one"
        raise SceneError(f"{scene.source}: load.friction: {why}")
    grid = problem.grid(pitch)
    how = operator_of(problem, grid), problem.widest, problem.finite_element_gap
    solution = pressed_on(problem, grid, *how)
    patches = contact_patches(grid.x, solution.pressure, solution.gap)
    wider = patches + WIDER * np.diff(patches, axis=1) * [-1.0, 1.0]
    spec = block_spec(problem, Refinement(pitch), np.clip(wider, *problem.extent))
    finite = settings.deformation == "finite"
    shaped = finite or settings.roller_body == "disc"
    flatter = 1.0 if shaped else FLATTER
    gaps = np.sort(problem.finite_element_gap(np.linspace(*problem.extent, TOUCH_POINTS)))
    first, touching = float(gaps[0]), np.diff(patches, axis=1).sum() / np.ptp(problem.extent)
    flat = build_block(spec)
    sides = "free" if scene.body.width is not None else UNBOUNDED_SIDES
    support = Support(scene.body.base or "bonded", sides)
    materials = [scene.body.material]
    if scene.coating is not None:
        materials.append(scene.coating.material)
    mesh = rough_mesh(problem, flat)
    rough = _deck_body(problem, mesh, materials, support, flatter, turned=True)
    if not shaped:
        top = flat.points[:, 1] == 0.0
        reach = np.clip(flat.points[top, 0], *problem.extent)
        rough.points[top, 1] = (first - problem.finite_element_gap(reach)) * MM / flatter
    roller = _roller(problem, spec, flat, shaped, flatter)
    roller.points[:, 1] -= first * MM if shaped else 0.0
    return DeckProblem(
        problem=problem,
        rough=rough,
        roller=roller,
        finite=finite,
        flatter=flatter,
        load=problem.hertz.load_per_length * N_PER_MM,
        edge=surface_edge(spec) * MM,
        ranges=spec.intervals * MM,
        overlap=float(gaps[int(touching * (TOUCH_POINTS - 1))] - first) * MM / flatter,
    )


def _roller(
    problem: Problem, spec: BlockSpec, flat: BlockMesh, shaped: bool, flatter: float
) -> DeckBody:
    """The body above, its lowest point at the origin: flat, or of its own shape."""
    scene = problem.scene
    reach = float(np.abs(problem.extent).max())
    support, material = Support("bonded", UNBOUNDED_SIDES), scene.roller.material or RIGID
    if scene.roller.rigid:
        wide = LEVEL * reach
        cells = int(np.ceil(2.0 * wide / spec.surface_size * FINER)) if shaped else 1
        mesh = structured(np.linspace(-wide, wide, cells + 1), np.array([0.0, 0.5 * wide]))
        if shaped:
            rise = roller_of(problem)(mesh.points[:, 0])[0]
            mesh = replace(mesh, shift=np.column_stack([np.zeros_like(rise), rise]))
        support = Support("bonded", UNBOUNDED_SIDES, within=(1e-9 * wide, 1e-9 * wide))
    else:
        wanted = roller_spec(problem, spec)
        if wanted is not spec:  # nodes face nodes, also where a coating asks for shorter edges
            flat = build_block(replace(wanted, surface_size=surface_edge(spec)))
        mesh = flat
        if is_disc(problem):
            mesh, support = roller_mesh(problem, flat), disc_support(problem)
        elif shaped:
            mesh = roughen(mesh, levelled(roller_of(problem), reach))
    return _deck_body(problem, mesh, [material], support, flatter)


def _deck_body(
    problem: Problem,
    mesh: BlockMesh,
    materials: list[Material],  # moduli as the scene's
    support: Support,
    flatter: float,
    turned: bool = False,
) -> DeckBody:
    """A body on a mesh; `turned` the one below, whose y = -z turns the triangles over."""
    points, triangles = real_points(mesh) * MM, mesh.triangles
    coated = np.zeros(len(triangles), dtype=bool)
    if len(materials) > 1:
        depth = mesh.points[triangles[:, :3], 1].mean(axis=1)
        coated = depth < problem.scene.coating.thickness
    if turned:
        points, triangles = points * [1.0, -1.0], triangles[:, [0, 2, 1, 5, 4, 3]]
    sides, beside = boundary_points(mesh.points, mesh.spec), mesh.spec.surface_size
    start, stop = problem.extent
    top = np.zeros(len(points), dtype=bool)
    top[sides.top] = True
    top &= (mesh.points[:, 0] > start - beside) & (mesh.points[:, 0] < stop + beside)
    return DeckBody(
        points,
        triangles,
        coated,
        tuple(replace(m, youngs_modulus=flatter * m.youngs_modulus) for m in materials),
        held_components(mesh.points, support, sides),
        np.argwhere(top[triangles[:, EDGES]].all(axis=2)),
    )
