"""Plane-strain elasticity of a block: displacements of degree 1, 2 or 3, one factorisation.

Displacements and loads are arrays (n, 2), x and z components, in the numbering of `fem.body.nodes`.

The stiffness is assembled for Young's modulus 1 of the body, a coating's relative to it, and the
displacement divided by the modulus, so that results scale exactly.

Degree: quadratic, unless the material is nearly incompressible, then cubic; a mixed element is not
needed. Relative error of a pressure's work on its displacement, always too small (bonded layer,
contact four times as wide as it is thick, n square cells of two triangles across the thickness):

    nu         n    linear    quadratic   cubic     mixed (Taylor and Hood)
    0.3        4    4e-3      1.0e-5      1.9e-8    6e-6
    0.49       4    0.11      6e-4        6e-7      3e-5
    0.4999     4    0.92      6e-3        4e-6      5e-5
    0.499999   4    1.0       7e-3        5e-6      5e-5
    0.499999   16   1.0       4e-4        2e-8      6e-7

In a large block with 16 edges to a half-width the errors of the surface's slopes are 4e-2, 7e-4 and
2e-4 with nu = 0.3 and degrees 1, 2, 3; 1, 6e-3 and 5e-4 with nu = 0.499999. Cubic displacements
have 2.2 times the unknowns of quadratic ones; their factor takes 2.5 times the memory and 2.2 to
3.3 times the time."""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_matrix

from analytic.material import Law, Material
from fem import compat
from fem.body.coating import Coating, coated_triangles, relative_constants
from fem.body.nodes import Nodes, conditions_of, nodes_of, space_on
from fem.body.support import Support, held_components
from fem.body.surface import BoundaryPoints, Surface, boundary_points, surface_of
from fem.body.ties import Ties, tied_sides
from fem.body.triangle import Locator, reference_nodes, shapes
from fem.solver.compilation import compiled, load_dolfinx
from fem.solver.mumps import FemError, SymmetricFactor
from meshes.block import BlockMesh, real_points

if TYPE_CHECKING:
    import ufl
    from dolfinx.fem import FunctionSpace
    from petsc4py.PETSc import Mat

# A body that can slide is refused a net horizontal load above this part of the whole load.
HORIZONTAL_BALANCE = 1e-6


@dataclass(eq=False)
class MeshedBody:
    """A body before it is assembled. Make one by `meshed_body`.

    degree     of the displacement's polynomials
    nodes      (n, 2) [m] of the displacement, in the real body
    elements   (m, 3, 6 or 10) nodes of each triangle, in the order of `fem.body.triangle`
    unknowns   displacement components, the held ones included
    curved     whether elements have curved edges"""

    mesh: BlockMesh
    material: Material
    coating: Coating | None
    coated: np.ndarray  # (m,) whether a triangle belongs to the coating
    numbering: Nodes

    def __post_init__(self) -> None:
        self.degree, self.elements = self.numbering.degree, self.numbering.elements
        self.nodes, self.unknowns = self.numbering.real, 2 * len(self.numbering.real)
        self.curved = bool(np.any(self.mesh.shift))

    @property
    def surface_material(self) -> Material:
        """The coating's, or the body's without one."""
        return self.coating.material if self.coating else self.material

    @cached_property
    def shear_modulus(self) -> np.ndarray:
        """(m,) [Pa] of each triangle."""
        coat, body = self.surface_material, self.material
        return np.where(self.coated, coat.shear_modulus, body.shear_modulus)

    @cached_property
    def poissons_ratio(self) -> np.ndarray:
        """(m,) of each triangle."""
        coat, body = self.surface_material, self.material
        return np.where(self.coated, coat.poissons_ratio, body.poissons_ratio)

    @cached_property
    def lame(self) -> np.ndarray:
        """Lame's lambda (m,) [Pa] of each triangle."""
        nu = self.poissons_ratio
        return 2.0 * self.shear_modulus * nu / (1.0 - 2.0 * nu)

    @cached_property
    def points(self) -> np.ndarray:
        """(k, 2) [m] mesh points of the real body."""
        return real_points(self.mesh)

    @cached_property
    def sides(self) -> BoundaryPoints:
        """Mesh points on the four sides."""
        return boundary_points(self.mesh.points, self.mesh.spec)

    @cached_property
    def surface(self) -> Surface:
        """The top side's nodes in order."""
        return surface_of(self.mesh, self.numbering)

    @cached_property
    def top(self) -> Surface:
        """The top side's mesh points in order."""
        return surface_of(self.mesh, nodes_of(self.mesh, 2))

    @cached_property
    def locator(self) -> Locator:
        return Locator(self.points, self.mesh.triangles, self.curved)

    def at_points(self, displacement: np.ndarray) -> np.ndarray:
        """Displacement (..., k, 2) [m] at the mesh's points from that (..., n, 2) at the nodes."""
        if self.degree == 2:
            return displacement
        result = np.empty((*displacement.shape[:-2], *self.mesh.points.shape))
        nodal, share = displacement[..., self.elements, :], shapes(reference_nodes(2), self.degree)
        result[..., self.mesh.triangles, :] = np.einsum("...mac,qa->...mqc", nodal, share)
        return result


@dataclass(eq=False)
class ElasticBody(MeshedBody):
    """A body of finite elements; factored at the first solution. Make one by `elastic_body`."""

    support: Support
    held: np.ndarray  # (n, 2) components that the support holds
    space_nodes: np.ndarray  # (n,) our number of each node of `space`, of displacements
    # gives PETSc's stiffness for Young's modulus 1; held rows are those of the identity
    assemble: Callable[[], "Mat"]
    space: "FunctionSpace"
    ties: Ties | None = None  # of its sides

    @cached_property
    def factor(self) -> SymmetricFactor:
        matrix = self.assemble()
        if self.ties is not None:
            matrix = self.ties.applied(matrix, self.space_nodes)
        try:
            return SymmetricFactor(matrix)
        finally:
            matrix.destroy()  # as large as a third of the factor

    def solve(self, load: np.ndarray) -> np.ndarray:
        """Displacement [m] for nodal forces [N/m]; both (n, 2), or (m, n, 2) for m at once. The
        support bears forces on held components. Raises FemError if the body can slide and the
        load has a horizontal resultant, or if the factorisation fails."""
        if self.support.can_slide:
            net = np.abs(load[..., 0].sum(axis=-1))
            if np.any(net > HORIZONTAL_BALANCE * np.abs(load).sum(axis=(-1, -2))):
                raise FemError(
                    "a body on a frictionless base with free sides cannot bear a horizontal load: "
                    "bond its base or hold its sides"
                )
        free = np.where(self.held, 0.0, load if self.ties is None else self.ties.summed(load))
        right = np.take(free, self.space_nodes, axis=-2).reshape(*load.shape[:-2], -1).T
        solution = self.factor.solve(right).T.reshape(load.shape)
        # a take is an eighth of the time of an index
        moved = np.take(solution, self._place, axis=-2) / self.material.youngs_modulus
        return moved if self.ties is None else self.ties.followed(moved)

    def with_law(self, law: Law) -> "ElasticBody":
        """The body with another law at finite strains, on which its factor does not depend."""
        body = copy(self)
        body.material = replace(self.material, law=law)
        return body

    def stiffness(self) -> csr_matrix:
        """Stiffness (2n, 2n) [Pa], x and z of each node in turn. Rows and columns of held
        components are those of the identity times Young's modulus."""
        if self.ties is not None:
            raise FemError("the stiffness as one matrix is available without tied sides only")
        matrix = self.assemble()
        start, column, value = matrix.getValuesCSR()
        matrix.destroy()
        component = (2 * self.space_nodes[:, None] + np.arange(2)).ravel()
        row = np.repeat(component, np.diff(start))
        value = value * self.material.youngs_modulus
        return csr_matrix((value, (row, component[column])), shape=(len(component),) * 2)

    @cached_property
    def _place(self) -> np.ndarray:
        """Index (n,) of each of our nodes among those of `space`."""
        return np.argsort(self.space_nodes)


def meshed_body(
    mesh: BlockMesh, material: Material, degree: int = 2, coating: Coating | None = None
) -> MeshedBody:
    """A block with displacements of `degree`. ValueError: one crosses the coating's lower side."""
    numbering = nodes_of(mesh, degree)
    return MeshedBody(mesh, material, coating, coated_triangles(mesh, coating), numbering)


def elastic_body(
    mesh: BlockMesh,
    material: Material,
    support: Support,
    *,
    degree: int = 2,
    coating: Coating | None = None,
) -> ElasticBody:
    """A block as an elastic body, with displacements of `degree` 1, 2 or 3. Elements of a mesh with
    a `shift` have quadratic edges. Edges must follow the lower side of a `coating`. Raises FemError
    if an element is inverted, ValueError if one crosses the interface."""
    load_dolfinx()
    from dolfinx import fem

    numbering = nodes_of(mesh, degree)
    sides = boundary_points(numbering.flat, mesh.spec)
    held = held_components(numbering.flat, support, sides)
    ties = tied_sides(numbering.flat, sides) if support.sides == "tied" else None
    coated = coated_triangles(mesh, coating)
    curved = bool(np.any(mesh.shift))
    space, cell, node = space_on(mesh, numbering, (2,))
    domain = space.mesh

    # compiled once for all plain bodies and once for all coated ones
    constants = relative_constants(material, coating, coated)
    if coating is None:
        shear, lame = (fem.Constant(domain, compat.real_number(value[0])) for value in constants)
    else:
        shear, lame = (compat.cell_values(domain, value[cell]) for value in constants)
    quadrature = quadrature_degree(degree, curved)
    name = ("stiffness", degree, curved, quadrature, coating is not None)
    make = partial(_work, space, shear, lame, quadrature)
    form = compiled(lambda: compat.compile_bilinear(name, make, space, [shear, lame]))
    conditions = conditions_of(space, held[node])

    form_of_body = (mesh, material, coating, coated, numbering)
    assemble = partial(compat.petsc_matrix, form, conditions)
    return ElasticBody(*form_of_body, support, held, node, assemble, space, ties)


def _work(space: "FunctionSpace", shear: object, lame: object, quadrature: int) -> "ufl.Form":
    """Work of the stresses of one displacement on the strains of another."""
    import ufl

    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    strain = ufl.sym(ufl.grad(u))
    stress = 2.0 * shear * strain + lame * ufl.tr(strain) * ufl.Identity(2)
    points = {"quadrature_degree": quadrature}
    return ufl.inner(stress, ufl.sym(ufl.grad(v))) * ufl.dx(domain=space.mesh, metadata=points)


def quadrature_degree(degree: int, curved: bool) -> int:
    """Degree of the polynomials that the stiffness's quadrature integrates exactly. Exact on
    straight triangles; on curved ones for a constant stress, and of the same order. Two degrees
    less keep the order, but add 1 to 5 % of error where the boundary has slope 0.8."""
    return max(1, 2 * degree if curved else 2 * degree - 2)
