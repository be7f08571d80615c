"""The elastic-plastic body: its force and tangent by two independent computations, and its limit
load."""

import numpy as np
import pytest
from blocks import hooke, moved, structured_block
from flat_punch import past_the_limit
from scipy.spatial import cKDTree

from analytic.material import Material
from analytic.material.hardening import Hardening
from fem import compat
from fem.body.elasticity import Support, elastic_body
from fem.body.exact_load import forces_of
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.terms import LinearContact
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody

E, Y = 200.0, 0.5
YIELD = Y / E  # strain
METAL = ElasticPlastic(Material(E, 0.3), Hardening(Y, 12.0))


def made(shape=None):
    x, z = np.linspace(-1.0, 1.0, 7), np.linspace(0.0, 1.0, 5)
    mesh = structured_block(x, z, shape, seed=2)
    return elastic_body(mesh, METAL.elastic, Support("bonded", "free"))


@pytest.fixture(scope="module", params=["flat", "curved"])
def body(request):
    return made(None if request.param == "flat" else lambda x: 0.05 * np.cos(3.0 * x))


def with_history(body):
    plastic = PlasticBody(body, METAL)
    plastic.accept(moved(body, 2.0 * YIELD, 1))
    assert 0.2 < np.mean(plastic.state.equivalent > 0.0) < 1.0
    return plastic


def test_forces_of_a_constant_stress_are_those_of_its_tractions(body):
    plastic = PlasticBody(body, METAL)
    stress = np.array([1.0, -2.0, 0.7])
    force = plastic.force_of(np.tile(stress, (len(plastic.points), 1)))
    np.testing.assert_allclose(force, forces_of(body.mesh, lambda x, z: stress), atol=1e-13)


def test_elastic_body_until_it_yields(body):
    plastic = PlasticBody(body, METAL)
    displacement = moved(body, 0.05 * YIELD, 3)
    force, tangent = plastic.linearised(displacement)
    assert not plastic.step(displacement).yields.any()
    assert abs(tangent - body.stiffness()).max() == 0.0
    np.testing.assert_array_equal(force.ravel(), body.stiffness() @ displacement.ravel())


def test_tangent_is_the_derivative_of_the_force(body):
    plastic = with_history(body)
    displacement, way = moved(body, 3.0 * YIELD, 4), moved(body, YIELD, 5)
    _, tangent = plastic.linearised(displacement)
    h = 1e-6
    ahead, behind = (plastic.linearised(displacement + s * way)[0] for s in (h, -h))
    slope = (ahead - behind).ravel() / (2.0 * h)
    np.testing.assert_allclose(tangent @ way.ravel(), slope, atol=2e-8 * np.abs(slope).max())
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()
    assert abs(tangent - body.stiffness()).max() > 0.1 * abs(tangent).max()


def test_force_and_tangent_are_those_of_quadrature_functions():
    """dolfinx assembles both from stresses and tangents at the same points."""
    plastic = with_history(made())
    body, displacement = plastic.body, moved(plastic.body, 3.0 * YIELD, 4)
    force, tangent = plastic.linearised(displacement)
    step = plastic.step(displacement)
    stress, _ = plastic.stress(displacement, step.state)
    consistent = np.tile(hooke(METAL.elastic, *np.eye(3)), (len(stress), 1, 1))
    consistent[step.yields] -= step.softening
    node, vector, matrix = assembled_by_dolfinx(body, plastic.points, stress, consistent)
    free = ~body.held[node].ravel()
    ours = force[node].ravel()
    np.testing.assert_allclose(ours[free], vector[free], atol=1e-13)
    component = (2 * node[:, None] + np.arange(2)).ravel()[free]
    difference = tangent.toarray()[np.ix_(component, component)] - matrix[np.ix_(free, free)]
    assert np.abs(difference).max() < 1e-13 * abs(tangent).max()


def assembled_by_dolfinx(body, points, stress, tangent):
    """Our node of each of dolfinx's, its force vector and its matrix; all matched by position."""
    import basix
    import ufl
    from dolfinx import fem
    from dolfinx.fem.petsc import assemble_matrix, assemble_vector

    vertices, corner = np.unique(body.mesh.triangles[:, :3], return_inverse=True)
    domain = compat.triangle_mesh(corner.reshape(-1, 3), body.mesh.points[vertices], 1)
    space = compat.continuous_space(domain, 2, (2,))
    places, _ = basix.make_quadrature(basix.CellType.triangle, 2)
    shape = np.column_stack([1.0 - places.sum(axis=1), places])
    at = shape @ domain.geometry.x[compat.cell_points(domain)][..., :2]
    _, number = cKDTree(points).query(at.reshape(-1, 2))

    def function(values):
        kind = {"degree": 2, "scheme": "default"}
        if hasattr(basix, "ufl"):
            element = basix.ufl.quadrature_element("triangle", values.shape[1:], **kind)
            quadrature = fem.functionspace(domain, element)
        else:
            family = ufl.VectorElement if values.ndim == 2 else ufl.TensorElement
            size = {"dim": 3} if values.ndim == 2 else {"shape": (3, 3)}
            element = family("Quadrature", domain.ufl_cell(), 2, quad_scheme="default", **size)
            quadrature = fem.FunctionSpace(domain, element)
        made = fem.Function(quadrature)
        places = compat.cell_nodes(quadrature).ravel()
        made.x.array.reshape(-1, values[0].size)[places] = values[number].reshape(len(number), -1)
        return made

    def strain(w):
        return ufl.as_vector([w[0].dx(0), w[1].dx(1), w[0].dx(1) + w[1].dx(0)])

    rule = {"quadrature_degree": 2, "quadrature_scheme": "default"}
    dx = ufl.dx(domain=domain, metadata=rule)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    work = ufl.inner(ufl.dot(function(tangent), strain(u)), strain(v)) * dx
    matrix = assemble_matrix(compat.compile_form(work))
    matrix.assemble()
    vector = assemble_vector(compat.compile_form(ufl.inner(function(stress), strain(v)) * dx))
    _, node = cKDTree(body.nodes).query(space.tabulate_dof_coordinates()[:, :2])
    return node, vector.getArray().copy(), matrix.convert("dense").getDenseArray().copy()


def test_limit_load_of_a_flat_punch():
    """(2 + pi) Y / sqrt 3 (Prandtl), from above and to first order; no locking beyond it.

    Order with both bounds: 3.14, 3.058, 3.012 with 4, 8 and 16 edges against 2.969.
    """

    def contact_of(body, hats):
        return LinearContact(FiniteElementCompliance(body, hats))

    elastic = Material(1000.0, 0.3)
    assert 1.0 < past_the_limit([0.06, 0.1], elastic, PlasticBody, contact_of) < 1.001


def test_bodies_that_cannot_flow_are_refused():
    body = made()
    with pytest.raises(ValueError, match="elastic constants"):
        PlasticBody(body, ElasticPlastic(Material(E, 0.2), Hardening(Y)))
    linear = elastic_body(body.mesh, METAL.elastic, Support(), degree=1)
    with pytest.raises(ValueError, match="degree 2"):
        PlasticBody(linear, METAL)
