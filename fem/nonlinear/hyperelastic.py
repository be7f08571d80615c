"""A hyperelastic body in plane strain, at finite strains and rotations (`fem.nonlinear.laws`).

For small strains every law is the linear body of the same Young's modulus and Poisson's ratio. The
default is neo-Hookean. Under a flat on a sinusoid (slope 0.025, p0/E = 0.015) it has a peak
pressure 0.42 % above the linear one, with lambda/4 (J^2 - 1 - 2 ln J) or lambda/2 (J - 1)^2 as its
last term 0.29 and 0.22 %. The bulk modulus rises by 0.4, -0.3 and here 1.8 times the pressure
(nu = 0.3), that of steel by about five times."""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_matrix

from fem import compat
from fem.body.elasticity import ElasticBody, quadrature_degree
from fem.body.sums import nodal_sums
from fem.body.triangle import gradients, jacobians, reference_nodes, slopes
from fem.nonlinear.laws import cauchy_stress, energy
from fem.solver.compilation import compiled
from fem.solver.mumps import FemError
from fem.stress.recovery import Patches, Recovery, linear_stress, stress_nodes
from fem.stress.stress import NodalStress
from fem.stress.surface_load import SurfaceLoad, from_surface, to_surface

CORNERS = reference_nodes(1)


class HyperelasticBody:
    """The response of `body` at finite strains, by its material's law, and of its coating by that
    one's."""

    symmetric, softness = True, np.ones(1)

    def __init__(self, body: ElasticBody) -> None:
        import ufl
        from dolfinx import fem

        self.body, self.held = body, body.held
        self._unit = body.material.youngs_modulus
        space = body.space
        cell = compat.input_cells(space.mesh)
        constants = (value[cell] / self._unit for value in (body.shear_modulus, body.lame))
        mu, lame = (compat.cell_values(space.mesh, value) for value in constants)
        self._moved = fem.Function(space)
        v, w = ufl.TestFunction(space), ufl.TrialFunction(space)
        gradient = ufl.grad(self._moved)
        density = energy(body.material.law, gradient, mu, lame, self._unit)
        if body.surface_material.law != body.material.law:
            coat = energy(body.surface_material.law, gradient, mu, lame, self._unit)
            coated = compat.cell_values(space.mesh, body.coated[cell].astype(float))
            density = ufl.conditional(ufl.gt(coated, 0.5), coat, density)
        # the stress is no polynomial even on straight edges: as many points as on curved ones
        points = {"quadrature_degree": quadrature_degree(body.degree, True)}
        work = ufl.derivative(density * ufl.dx(metadata=points), self._moved, v)
        tangent = ufl.derivative(work, self._moved, w)
        self._work = compiled(lambda: compat.compile_form(work))
        self._tangent = compiled(lambda: compat.compile_form(tangent))
        self._component = (2 * body.space_nodes[:, None] + np.arange(2)).ravel()
        self._pattern: csr_matrix | None = None
        # at the corners, by r at all of them and then by s: of the displacement's shape functions
        # (k, 6), and of x and z (m, 6) each
        self._slopes = slopes(CORNERS, body.degree).transpose(1, 2, 0).reshape(-1, 6)
        corner = jacobians(body.points[body.mesh.triangles], CORNERS)
        self._jacobian = corner.transpose(2, 0, 3, 1).reshape(2, -1, 6)

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """Forces (n, 2) [N/m] and tangent (2n, 2n) [Pa]. FemError where an element is inverted."""
        force = self.force(displacement)
        self.accept(displacement)
        tangent = self._in_our_order(compat.petsc_matrix(self._tangent, []))
        return force, self._unit * tangent

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The internal forces alone. Raises FemError where they are not finite."""
        from dolfinx import fem

        self._moved.x.array[:] = displacement.ravel()[self._component]
        force = np.empty(displacement.size)
        force[self._component] = fem.assemble_vector(self._work).array.copy()
        if not np.isfinite(force).all():
            raise FemError("an element is inverted")
        return self._unit * force.reshape(-1, 2)

    def accept(self, displacement: np.ndarray) -> None:
        """Raises FemError if it inverts an element at a corner; laws in ln J find it inside, too.
        There is no history: the energy depends on the displacement alone."""
        moved = [u[self.body.elements] @ self._slopes for u in displacement.T]
        (x_r, x_s), (z_r, z_s) = (
            np.split(at + u, 2, axis=1) for at, u in zip(self._jacobian, moved, strict=True)
        )
        if np.any(x_r * z_s - x_s * z_r <= 0.0):
            raise FemError("an element is inverted")

    def _in_our_order(self, matrix: object) -> csr_matrix:
        """The matrix (2n, 2n) in the order of the body's own nodes."""
        start, column, value = matrix.getValuesCSR()
        matrix.destroy()
        if self._pattern is None:
            place = (np.repeat(self._component, np.diff(start)), self._component[column])
            size = (len(self._component),) * 2
            # the index of each value is found once, by numbers in place of values
            self._pattern = csr_matrix((np.arange(len(value), dtype=float), place), shape=size)
            self._order = self._pattern.data.astype(np.int64)
        data = (value[self._order], self._pattern.indices, self._pattern.indptr)
        return csr_matrix(data, shape=self._pattern.shape)


class CauchyRecovery(Recovery):
    """Cauchy's stresses [Pa] at the deformed `stress_nodes` of a body, recovered where they are
    asked for.

    The recovered linear stress of the same displacement, plus its difference from Cauchy's stress,
    of second order and averaged over the elements around a point. `load` is that of the linear
    theory. `pressure` (t,) [Pa] on the deformed surface at the points of `body.top`, and the load's
    friction times it, are the stresses across the surface.

    estimate  sx, sz, txz (k, 3) [Pa] at all nodes: means of the elements around them
    across    stress across the plane (k,) [Pa] at the nodes, of these means"""

    def __init__(
        self, body: ElasticBody, displacement: np.ndarray, load: SurfaceLoad, pressure: np.ndarray
    ) -> None:
        gradient = gradients(
            body.points[body.mesh.triangles], displacement[body.elements], reference_nodes(2)
        )
        constants = body.shear_modulus[:, None], body.lame[:, None]
        cauchy = cauchy_stress(gradient, *constants, body.material.law)
        if body.surface_material.law != body.material.law:
            coat = cauchy_stress(gradient, *constants, body.surface_material.law)
            cauchy = np.where(body.coated[:, None, None], coat, cauchy)
        means = _averaged(body, np.concatenate([cauchy, linear_stress(gradient, *constants)], 2))
        self.estimate, self.across = means[:, :3], means[:, 3]
        self._second_order = means[:, :3] - means[:, 4:]
        top = body.top.point
        along = along_surface(body.top.x, body.points[top] + body.at_points(displacement)[top])
        self._tangent = along / np.linalg.norm(along, axis=1)[:, None]
        self._pressure, self._friction = pressure, load.friction
        nodes = stress_nodes(body)
        node = nodes.at_surface(top)
        self._place = np.full(len(nodes.point), -1)  # of the nodes on the surface, along it
        self._place[node] = np.arange(len(top))
        surface_stress = Recovery(body, displacement).at(node) + self._second_order[node]
        known = self._on_surface(np.arange(len(top)), surface_stress) - self._second_order[node]
        forces = load.pressure, load.friction, load.direction
        matched = _MatchedLoad(body, load.hats, *forces, known=known)
        super().__init__(body, displacement, matched)

    @property
    def nodal(self) -> NodalStress:
        """Stresses at the nodes, and what interpolates them."""
        nu = self.nodes.of_triangles(self.body.poissons_ratio)
        return NodalStress(self.nodes, nu, self.at, lambda: self.estimate, self.load.kinks)

    def _recover(self, patches: Patches) -> None:
        super()._recover(patches)
        node = np.concatenate([patches.vertex, patches.middle])
        self._stress[node] += self._second_order[node]
        top = node[self._place[node] >= 0]
        self._stress[top] = self._on_surface(self._place[top], self._stress[top])

    def _on_surface(self, place: np.ndarray, stress: np.ndarray) -> np.ndarray:
        """Stresses (q, 3) at points of the surface, with the tractions there."""
        t, pressure = self._tangent[place], self._pressure[place]
        s_tt, _, _ = to_surface(t, stress)
        return from_surface(t, s_tt, -pressure, self._friction * pressure)


@dataclass(frozen=True)
class _MatchedLoad(SurfaceLoad):
    """A load whose tractions on the undeformed surface are those of the linear stress of a finite
    displacement: `known` (t, 3) sx, sz, txz at the top's points."""

    known: np.ndarray = field(kw_only=True)

    def across(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """s_nn and s_nt (k,) [Pa] at x (k,) [m]."""
        stress = np.column_stack([np.interp(x, self.body.top.x, s) for s in self.known.T])
        _, s_nn, s_nt = to_surface(self.tangent(x), stress)
        return s_nn, s_nt


def _averaged(body: ElasticBody, value: np.ndarray) -> np.ndarray:
    """Means (k, c) at the `stress_nodes` of values (m, 6, c) of the elements around them."""
    nodes = stress_nodes(body)
    node, count = nodes.triangles, len(nodes.point)
    return nodal_sums(node, value, count) / np.bincount(node.ravel(), minlength=count)[:, None]


def along_surface(x: np.ndarray, value: np.ndarray) -> np.ndarray:
    """d value / dx (t, c) of `value` (t, c) at points x (t,) of quadratic edges, a vertex first. At
    midpoints the chord's slope, more accurate than the quadratic's slope at its ends; at vertices
    the line through the slopes at the two nearest midpoints."""
    vertex, middle = x[::2], 0.5 * (x[:-2:2] + x[2::2])
    chord = np.diff(value[::2], axis=0) / np.diff(vertex)[:, None]
    after = np.clip(np.arange(len(vertex)), 1, len(middle) - 1)
    share = ((vertex - middle[after - 1]) / (middle[after] - middle[after - 1]))[:, None]
    slope = np.empty_like(value)
    slope[1::2] = chord
    slope[::2] = (1.0 - share) * chord[after - 1] + share * chord[after]
    return slope
