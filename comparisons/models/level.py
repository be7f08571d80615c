"""One model's solution on one level of refinement, as data that every model fills in."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.end_stress import EndStress
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.stress.elements import FrictionStress
from analytic.stress_state import Extremum, StressState
from comparisons.common.errors import SceneError
from comparisons.common.progress import machine_memory
from comparisons.models.operators import operator_of, pressed_on
from comparisons.models.problem import Problem, mean_height
from fem.body.coating import Coating
from meshes.block import BlockMesh

if TYPE_CHECKING:
    from fem.body.elasticity import ElasticBody, MeshedBody
    from fem.stress.stress import NodalStress


STRAIN = "equivalent_plastic_strain"  # a field of what flows


@dataclass(frozen=True)
class ExpectedCost:
    """Cost of a level by measured laws; `memory` [bytes] at the peak."""

    unknowns: int
    memory: float
    seconds: float


def refuse_too_large(problem: Problem, wanted: ExpectedCost, name: str, pitch: float) -> None:
    """Raise SceneError where a model's level takes more memory than it may, or than there is."""
    source, allowed = problem.scene.source, problem.scene.budget.memory
    need = (
        f"{name} on pressures of {pitch:.3g} m, {wanted.unknowns:.2g} unknowns, need "
        f"about {wanted.memory:.2g} bytes and {wanted.seconds:.2g} s"
    )
    if wanted.memory > allowed:
        remedy = "allowed is a larger budget, or coarser pressures (resolution.pitch)"
        raise SceneError(f"{source}: budget.memory: is {allowed:.3g} bytes, but {need}; {remedy}")
    if wanted.memory > (there := machine_memory()):
        remedy = "allowed are coarser pressures, or a smaller finite_element.block"
        machine = f"this machine has {there:.2g} bytes"
        raise SceneError(f"{source}: resolution.pitch: {need}, but {machine}; {remedy}")


def flowing_contact(problem: Problem) -> np.ndarray:
    """Patches (k, 2) [m] of the nearest analytic operator on the first level, as wide as flow may
    make them, which increments of flow follow. Where elastic ones have met they are parted in the
    middle: so far their edges travel."""
    grid = problem.grid(problem.pitches[0])
    operator, gap = operator_of(problem, grid), problem.finite_element_gap
    ways = (pressed_on(problem, grid, operator, how, gap) for how in (problem.widest, None))
    patches, first = (contact_patches(grid.x, one.pressure, one.gap) for one in ways)
    parted = 0.5 * (first[1:, 0] + first[:-1, 1])
    inside = ((parted[:, None] > patches[:, 0]) & (parted[:, None] < patches[:, 1])).any(axis=1)
    ends = [*patches[:, 0], *parted[inside]], [*patches[:, 1], *parted[inside]]
    return np.sort(ends, axis=1).T


@dataclass(frozen=True)
class StressResult:
    """Stresses under one friction coefficient."""

    friction: float
    # largest tau1, |txz| and von Mises stress by name, found off the grid [Pa], [m]
    extremes: dict[str, Extremum]
    # largest tau1 and |txz| of each of the problem's asperities: value [Pa], x and z [m] (3, k)
    maxima: dict[str, np.ndarray]
    # (m, k) on the common window, where that is asked for: on all of it of the finest level
    field: StressState | None = None

    @property
    def tau1(self) -> np.ndarray | None:
        """(m, k) [Pa] on the common window."""
        return None if self.field is None else self.field.tau1


@dataclass(frozen=True)
class MeshField:
    """A finite-element level's own mesh, with stresses and displacements, one set a friction."""

    points: np.ndarray  # (n, 2) x and z [m] of the real body; twice where two materials meet
    triangles: np.ndarray  # (m, 6) quadratic triangles in gmsh order; (m, 3) of corners alone
    stresses: dict[float, StressState]  # by friction coefficient, (n,) each
    # by friction coefficient, (n, 2) [m] in x and z, zero where the body is held; at finite
    # deformation but for a shift of all along x
    displacement: dict[float, np.ndarray]
    poissons_ratio: np.ndarray  # (n,) of the material at each point
    # further fields (n,) by name with their unit: what plastic flow leaves
    others: dict[str, np.ndarray] = field(default_factory=dict)

    @staticmethod
    def of(
        body: "ElasticBody",
        frictions: tuple[float, ...],
        nodal: "tuple[NodalStress, ...]",
        displacement: np.ndarray,
        others: dict[str, np.ndarray],
    ) -> "MeshField":
        """Field of stresses at mesh points and displacements (n, c, 2) [m], a set a friction."""
        nodes, nu = nodal[0].nodes, nodal[0].poissons_ratio
        moved = body.at_points(np.moveaxis(displacement, 1, 0))[:, nodes.point]
        states = dict(zip(frictions, (StressState(*s.values.T) for s in nodal), strict=True))
        sets = states, dict(zip(frictions, moved, strict=True))
        return MeshField(body.points[nodes.point], nodes.triangles, *sets, nu, others)

    @property
    def at_corners(self) -> "MeshField":
        """Field on triangles of three points, those of the corners."""
        kept, cells = np.unique(self.triangles[:, :3], return_inverse=True)
        stresses = {mu: StressState(*s.parts[:, kept]) for mu, s in self.stresses.items()}
        moved = {mu: values[kept] for mu, values in self.displacement.items()}
        others = {name: values[kept] for name, values in self.others.items()}
        sets = stresses, moved, self.poissons_ratio[kept], others
        return MeshField(self.points[kept], cells.reshape(-1, 3), *sets)


@dataclass(frozen=True)
class RecoverableField:
    """Parts of a `MeshField` of linear bodies under vertical pressures. Of all levels of a model
    the last one's field alone is written: stresses are recovered when they are asked for."""

    mesh: BlockMesh
    material: Material
    coating: Coating | None
    degree: int
    # (n, c, 2) [m] at the nodes of the displacement, one for each friction
    displacement: np.ndarray
    # as in `fem.compliance.operator`
    hats: np.ndarray
    pressure: np.ndarray
    frictions: tuple[float, ...]
    ends: EndStress  # what the hats leave out

    @cached_property
    def recovered(self) -> MeshField:
        from fem.body.elasticity import meshed_body

        body = meshed_body(self.mesh, self.material, self.degree, self.coating)
        return MeshField.of(body, self.frictions, self.on(body), self.displacement, {})

    def on(self, body: "MeshedBody") -> "tuple[NodalStress, ...]":
        """Stresses of a body of this mesh, one set a friction."""
        from fem.stress.stress import nodal_stresses
        from fem.stress.surface_load import SurfaceLoad

        load = SurfaceLoad(body, self.hats, self.pressure, np.array(self.frictions))

        def beside(x: np.ndarray, z: np.ndarray) -> list[StressState]:
            left_out = FrictionStress.of(self.ends.parts(x, z))
            return [left_out.at(friction) for friction in self.frictions]

        return nodal_stresses(self.displacement, load, beside)


@dataclass(frozen=True)
class Level:
    """One model at one friction coefficient, on pressure elements of one pitch. Levels of several
    coefficients that share a contact share its arrays."""

    grid: HatGrid
    solution: ContactSolution
    # (n,) [m] of the rough body's surface, mean of each hat; into the body, from the model's datum
    displacement: np.ndarray
    patches: np.ndarray  # (k, 2) [m] contact patches
    seconds: dict[str, float]  # by stage, of all coefficients that are solved together
    unknowns: int  # of the linear systems behind the compliance
    # bound of the largest pressure's error by crests that the grid does not resolve, relative to it
    unresolved_crest: float = 0.0
    peak_memory: int = 0  # largest memory of the process when the level was done [bytes]
    # by the laws that a level is refused or planned by; memory [bytes], 0 without finite elements
    expected_seconds: float = 0.0
    expected_memory: float = 0.0
    stress: StressResult | None = None  # None without [stress]
    mesh: BlockMesh | None = None  # finite elements only: the BlockMesh solved on
    mesh_field: MeshField | RecoverableField | None = None  # finite elements only, with stresses
    # (n,) [m] where what now stands at the grid's nodes stood without load; None: there
    material: np.ndarray | None = None

    @property
    def converged(self) -> bool:
        return self.solution.converged

    def shares_contact(self, other: "Level") -> bool:
        """True if another level, under another friction coefficient, has the same contact."""
        return self.solution.pressure is other.solution.pressure

    @property
    def field_on_mesh(self) -> MeshField | None:
        """`mesh_field`, with its stresses."""
        field = self.mesh_field
        return field.recovered if isinstance(field, RecoverableField) else field

    @property
    def contact_length(self) -> float:
        """Sum of the patches [m]."""
        return float(np.ptp(self.patches, axis=1).sum())

    @property
    def extent(self) -> float:
        """Distance from the first to the last contact [m]."""
        return float(self.patches[-1, 1] - self.patches[0, 0])

    @property
    def plastic_strain(self) -> float | None:
        """The largest equivalent one under the load; None where nothing shows it."""
        others = self.mesh_field.others if isinstance(self.mesh_field, MeshField) else {}
        return float(others[STRAIN].max()) if STRAIN in others else None


@dataclass(frozen=True)
class Solution:
    """One model at one friction coefficient on its levels, coarse to fine, or instead what a
    study finds on them."""

    name: str
    levels: tuple[Level, ...]
    # the coarsest level again, by the part of an uncertainty that it shows: "domain", on a block of
    # half the size; "increments", where a body flows by longer ones, the longest first
    repeated: Mapping[str, tuple[Level, ...]] = field(default_factory=dict)

    @property
    def finest(self) -> Level:
        return self.levels[-1]

    def beside(self, other: Level) -> Level:
        """The level on the pressure elements of another model's, or on the nearest."""
        return min(self.levels, key=lambda level: abs(level.grid.pitch - other.grid.pitch))

    @property
    def seconds(self) -> dict[str, float]:
        """Seconds by stage, all levels together."""
        total: dict[str, float] = {}
        for level in chain(self.levels, *self.repeated.values()):
            for stage, seconds in level.seconds.items():
                total[stage] = total.get(stage, 0.0) + seconds
        return total


def deformed_height(problem: Problem, level: Level) -> np.ndarray:
    """Heights (n,) [m] of the rough body's surface under load, averaged over each hat. Zero
    displacement at the mean of the grid's two ends: a datum that both models have."""
    ends = level.displacement[[0, -1]].mean()
    return mean_height(problem, level.grid) - (level.displacement - ends)
