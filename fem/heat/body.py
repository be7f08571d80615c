"""A block, or the sector of a disc, as a conductor of heat: its matrices.

Nomenclature
    T          temperature above the bulk's [K]
    N_a        shape functions, of degree 1, 2 or 3
    k, rho c   conductivity [W/(m K)], heat capacity [J/(m^3 K)], of each triangle its material's
    w          velocity of the material at 1 m/s of its surface in +x [-]: (1 - z/R, x/R), that of a
               disc of radius R about its centre (0, R); (1, 0) of a flat body
"""

from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_matrix

from analytic.material import ThermalMaterial
from fem import compat
from fem.body.coating import Coating, coated_triangles
from fem.body.elasticity import quadrature_degree
from fem.body.nodes import Nodes, nodes_of, space_on
from fem.body.surface import Surface, surface_of
from fem.body.triangle import Locator, shapes
from fem.solver.compilation import compiled, load_dolfinx
from meshes.block import BlockMesh, real_points

if TYPE_CHECKING:
    import ufl
    from dolfinx.fem import FunctionSpace


@dataclass(eq=False)
class ThermalBody:
    """Body made by `thermal_body`. All matrices (n, n) per length out of the plane.

    coating     its material is a ThermalMaterial
    radius      of the disc [m], infinite for a flat body
    conduction  integral grad N_a . k grad N_b [W/(m K)]
    convection  integral N_a rho c w . grad N_b [J/(m^2 K)], times the velocity of the surface
    """

    mesh: BlockMesh
    material: ThermalMaterial
    coating: Coating | None
    radius: float
    numbering: Nodes
    conduction: csr_matrix
    convection: csr_matrix

    @property
    def nodes(self) -> np.ndarray:
        """(n, 2) [m] of the temperature, in the real body."""
        return self.numbering.real

    @cached_property
    def surface(self) -> Surface:
        """The top side's nodes in order."""
        return surface_of(self.mesh, self.numbering)

    @cached_property
    def _locator(self) -> Locator:
        return Locator(real_points(self.mesh), self.mesh.triangles, bool(np.any(self.mesh.shift)))

    def at(self, places: np.ndarray, temperature: np.ndarray) -> np.ndarray:
        """Temperature (k,) [K] at points (k, 2) [m], NaN outside the body, from the nodes' (n,)."""
        element, reference = self._locator(np.asarray(places, dtype=float))
        nodal = temperature[self.numbering.elements[element]]
        value = (shapes(reference, self.numbering.degree) * nodal).sum(axis=1)
        return np.where(element < 0, np.nan, value)


def thermal_body(
    mesh: BlockMesh,
    material: ThermalMaterial,
    *,
    degree: int = 2,
    coating: Coating | None = None,
    radius: float = np.inf,
) -> ThermalBody:
    """A block with temperatures of `degree` 1, 2 or 3; of the mesh of a disc's sector with its
    `radius` [m]. Raises FemError if an element is inverted, ValueError if one crosses the coating's
    lower side."""
    load_dolfinx()
    numbering, coated = nodes_of(mesh, degree), coated_triangles(mesh, coating)
    layer = coating.material if coating else material
    curved = bool(np.any(mesh.shift))
    space, cell, node = space_on(mesh, numbering, None)

    def of_cells(surface: float, below: float):
        return compat.cell_values(space.mesh, np.where(coated[cell], surface, below))

    heat = of_cells(layer.density * layer.specific_heat, material.density * material.specific_heat)
    conductivity = of_cells(layer.conductivity, material.conductivity)
    curvature = of_cells(1.0 / radius, 1.0 / radius)
    quadrature = 2 * degree + (2 if curved else 0)

    def matrix(kind: str, points: int, *values: object) -> csr_matrix:
        make = partial(_form, kind, space, points, *values)
        name = (kind, degree, curved, points)
        form = compiled(lambda: compat.compile_bilinear(name, make, space, list(values)))
        assembled = compat.petsc_matrix(form, [])
        start, column, value = assembled.getValuesCSR()
        assembled.destroy()
        row = np.repeat(node, np.diff(start))
        return csr_matrix((value, (row, node[column])), shape=(len(node),) * 2)

    return ThermalBody(
        mesh,
        material,
        coating,
        radius,
        numbering,
        conduction=matrix("conduction", quadrature_degree(degree, curved), conductivity),
        convection=matrix("convection", quadrature, heat, curvature),
    )


def _form(
    kind: str, space: "FunctionSpace", points: int, factor: object, curvature: object = None
) -> "ufl.Form":
    """Form of one of the body's matrices; the quadrature is exact for the degree `points`."""
    import ufl

    t, s = ufl.TrialFunction(space), ufl.TestFunction(space)
    measure = ufl.dx(domain=space.mesh, metadata={"quadrature_degree": points})
    if kind == "conduction":
        return factor * ufl.inner(ufl.grad(t), ufl.grad(s)) * measure
    x, z = ufl.SpatialCoordinate(space.mesh)
    return factor * ((1.0 - curvature * z) * t.dx(0) + curvature * x * t.dx(1)) * s * measure
