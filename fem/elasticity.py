"""Plane-strain elasticity of a block: quadratic displacements, one factorisation.

Displacements and loads are arrays (n, 2), x and z components, in the numbering of the mesh's
own points; dolfinx's numbering stays inside. Under MPI every process holds the whole array and
its own part of the matrix, so that what is computed from a displacement is the same on each.

The stiffness is assembled for Young's modulus 1 and the displacement divided by the modulus:
the factor depends on Poisson's ratio and the shape only, and results scale exactly.
"""

from functools import cached_property
from time import perf_counter

import numpy as np
from scipy.sparse import csr_matrix

from analytic.material import Material
from fem import compat
from fem.just_in_time import compiled, load_dolfinx
from fem.locate import Locator
from fem.mumps import FemError, SymmetricFactor
from fem.support import Support, held_components
from fem.surface import BoundaryPoints, Surface, boundary_points, surface_of
from meshes.block import BlockMesh
from meshes.quality import corner_jacobians, real_points

# dolfinx lists the edge opposite to vertex 0 first, gmsh the edge between vertices 0 and 1.
GMSH_TO_DOLFINX = [0, 1, 2, 4, 5, 3]
OPPOSITE_EDGES = [(1, 2), (0, 2), (0, 1)]

# Exact for straight triangles; on curved ones a constant stress still does exact work.
QUADRATURE = {1: 2, 2: 4}

# A body that can slide is refused a net horizontal load above this part of the whole load.
HORIZONTAL_BALANCE = 1e-6


class ElasticBody:
    """An assembled body; factored at the first solution. Make one by `elastic_body`.

    mesh, material, support   as given
    sides                     mesh points on the four sides
    surface                   the top side's points in order
    points                    (n, 2) [m] of the real body, roughness included
    curved                    whether elements have curved edges
    matrix                    PETSc stiffness for Young's modulus 1, held rows made the identity's
    assembly_seconds          what mesh transfer and assembly took
    locator                   finds the element that holds a point
    factor                    the factorisation: its seconds, bytes and number of solves
    """

    def __init__(
        self,
        mesh: BlockMesh,
        material: Material,
        support: Support,
        sides: BoundaryPoints,
        held: np.ndarray,
        owned: np.ndarray,
        space,
        matrix,
        assembly_seconds: float,
    ) -> None:
        self.mesh, self.material, self.support = mesh, material, support
        self.sides, self.held = sides, held
        self.matrix, self._owned = matrix, owned
        # The matrix lives in the communicator of the space: from dolfinx 0.9 on it does not
        # survive it.
        self._space = space
        self.assembly_seconds = assembly_seconds

    @property
    def unknowns(self) -> int:
        """Displacement components, the held ones included."""
        return 2 * len(self.mesh.points)

    @property
    def curved(self) -> bool:
        return bool(np.any(self.mesh.shift))

    @cached_property
    def points(self) -> np.ndarray:
        return real_points(self.mesh)

    @cached_property
    def surface(self) -> Surface:
        return surface_of(self.mesh)

    @cached_property
    def locator(self) -> Locator:
        return Locator(self.points, self.mesh.triangles, self.curved)

    @cached_property
    def factor(self) -> SymmetricFactor:
        return SymmetricFactor(self.matrix)

    def solve(self, load: np.ndarray) -> np.ndarray:
        """Displacement [m] for nodal forces [N/m]; both (n, 2), or (m, n, 2) for m at once.

        Forces on held components are borne by the support. Raises ValueError if the body can
        slide and the load has a horizontal resultant, FemError if the factorisation fails.
        """
        if self.support.can_slide:
            net = np.abs(load[..., 0].sum(axis=-1))
            if np.any(net > HORIZONTAL_BALANCE * np.abs(load).sum(axis=(-1, -2))):
                raise ValueError(
                    "a body on a frictionless base with free sides cannot bear a horizontal load: "
                    "bond its base or hold its sides"
                )
        free = np.where(self.held, 0.0, load)
        part = free[..., self._owned, :].reshape(*load.shape[:-2], -1).T
        return self._gathered(self.factor.solve(part).T) / self.material.youngs_modulus

    def stiffness(self) -> csr_matrix:
        """Stiffness (2n, 2n) [Pa], x and z of each mesh point in turn; on one process only.

        Rows and columns of held components are those of the identity times Young's modulus.
        """
        if self.matrix.comm.size > 1:
            raise FemError("the stiffness as one matrix is to be had on one process only")
        start, column, value = self.matrix.getValuesCSR()
        component = (2 * self._owned[:, None] + np.arange(2)).ravel()
        row = np.repeat(component, np.diff(start))
        value = value * self.material.youngs_modulus
        return csr_matrix((value, (row, component[column])), shape=(len(component),) * 2)

    def _gathered(self, part: np.ndarray) -> np.ndarray:
        """The whole displacement (..., n, 2) on every process from the parts they own."""
        part = part.reshape(*part.shape[:-1], -1, 2)
        whole = np.empty((*part.shape[:-2], *self.mesh.points.shape))
        comm = self.matrix.comm.tompi4py()
        pieces = [(self._owned, part)] if comm.size == 1 else comm.allgather((self._owned, part))
        for owned, piece in pieces:
            whole[..., owned, :] = piece
        return whole


def elastic_body(mesh: BlockMesh, material: Material, support: Support) -> ElasticBody:
    """Assemble the stiffness of a block. A shape of its own (`mesh.shift`) gives curved elements.

    Raises FemError if an element is turned over.
    """
    load_dolfinx()
    import ufl
    from mpi4py import MPI

    start = perf_counter()
    sides = boundary_points(mesh)
    held = held_components(mesh, support, sides)
    degree = 2 if np.any(mesh.shift) else 1
    folded = (corner_jacobians(real_points(mesh), mesh.triangles) <= 0.0).any(axis=1)
    if folded.any():
        raise FemError(f"{np.count_nonzero(folded)} elements of the mesh are turned over")
    domain, number = _domain(MPI.COMM_WORLD, mesh, degree)
    space = compiled(lambda: compat.displacement_space(domain))
    point = _points_of_nodes(mesh, domain, number, space)

    nu = material.poissons_ratio
    shear, lame = 0.5 / (1.0 + nu), nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    shear, lame = (compat.constant(domain, value) for value in (shear, lame))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    strain = ufl.sym(ufl.grad(u))
    stress = 2.0 * shear * strain + lame * ufl.tr(strain) * ufl.Identity(2)
    dx = ufl.Measure("dx", domain=domain, metadata={"quadrature_degree": QUADRATURE[degree]})
    work = ufl.inner(stress, ufl.sym(ufl.grad(v))) * dx
    conditions = _conditions(space, held[point])
    matrix = compat.petsc_matrix(compiled(lambda: compat.compile_form(work)), conditions)

    owned = point[: space.dofmap.index_map.size_local]
    return ElasticBody(
        mesh, material, support, sides, held, owned, space, matrix, perf_counter() - start
    )


def _domain(comm, mesh: BlockMesh, degree: int):
    """dolfinx mesh, and the mesh point (k,) behind each of its input points.

    The first process hands the whole mesh in; dolfinx spreads it.
    """
    if degree == 2:
        cells, number = mesh.triangles[:, GMSH_TO_DOLFINX], np.arange(len(mesh.points))
    else:
        number, cells = np.unique(mesh.triangles[:, :3], return_inverse=True)
        cells = cells.reshape(-1, 3)
    points = real_points(mesh)[number]
    if comm.rank > 0:
        cells, points = cells[:0], points[:0]
    return compat.triangle_mesh(comm, cells, points, degree), number


def _points_of_nodes(mesh: BlockMesh, domain, number: np.ndarray, space) -> np.ndarray:
    """Mesh point of each node of the displacement space (owned, then ghosts).

    By topology, never by coordinates: a vertex is known from the input numbering, a midpoint
    from the two vertices of its edge.
    """
    corner = number[compat.input_points(domain)[compat.cell_points(domain)[:, :3]]]
    count = np.int64(len(mesh.points))

    def key(edge: np.ndarray) -> np.ndarray:
        return edge.min(axis=-1) * count + edge.max(axis=-1)

    known = key(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].astype(np.int64)).ravel()
    known, first = np.unique(known, return_index=True)
    middle_of = mesh.triangles[:, 3:].ravel()[first]
    middle = middle_of[np.searchsorted(known, key(corner[:, OPPOSITE_EDGES]))]

    nodes = compat.cell_nodes(space)
    index_map = space.dofmap.index_map
    point = np.full(index_map.size_local + index_map.num_ghosts, -1, dtype=np.int64)
    point[nodes[:, :3]] = corner
    point[nodes[:, 3:]] = middle
    return point


def _conditions(space, held: np.ndarray) -> list:
    """Zero displacement of the held components (nodes, 2) of the space."""
    from dolfinx import fem

    return [
        fem.dirichletbc(
            compat.real_number(0.0),
            (2 * np.flatnonzero(held[:, axis]) + axis).astype(np.int32),
            space.sub(axis),
        )
        for axis in (0, 1)
    ]
