"""The indicated error against the exact one, element by element."""

import numpy as np
import pytest

from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from fem.body.triangle import collapsed_gauss, jacobians, shapes
from fem.stress.recovery import element_stress, energy_errors, recovered_stress

BODY = Material(3.0, 0.3)


def true_errors(body, moved, stress):
    """Energy norm (m,) of the distance to a stress at x, z."""
    at, weight = collapsed_gauss(5)
    nodes = body.points[body.mesh.triangles]
    place = np.einsum("mac,qa->mqc", nodes, shapes(at))
    exact = np.stack(np.broadcast_arrays(*stress(*np.moveaxis(place, -1, 0))), axis=-1)
    return energy_norms(body, moved, exact, at, weight)


def energy_norms(body, moved, exact, at, weight):
    """The same from stresses (m, q, 3) at the points of a rule."""
    nodes = body.points[body.mesh.triangles]
    sx, sz, txz = np.moveaxis(element_stress(body, moved, at) - exact, -1, 0)
    nu, modulus = body.material.poissons_ratio, body.material.youngs_modulus
    # Strains of plane strain, written out: e_x = (1 - nu^2)/E s_x - nu (1 + nu)/E s_z.
    strain_x = ((1 - nu**2) * sx - nu * (1 + nu) * sz) / modulus
    strain_z = ((1 - nu**2) * sz - nu * (1 + nu) * sx) / modulus
    density = sx * strain_x + sz * strain_z + 2 * (1 + nu) / modulus * txz**2
    return np.sqrt((density * np.abs(np.linalg.det(jacobians(nodes, at)))) @ weight)


def solved(structured_block, exact_forces, manufactured, cells, growth=1.0, scale=1.0):
    exact = manufactured(BODY)
    x, z = np.linspace(-1.0, 1.0, 2 * cells + 1), np.linspace(0.0, 1.0, cells + 1) ** growth
    mesh = structured_block(x, z, seed=2)
    body = elastic_body(mesh, BODY, Support())
    return body, scale * body.solve(exact_forces(mesh, exact.stress, exact.body_force)), exact


@pytest.mark.parametrize(("cells", "growth"), [(8, 1.0), (16, 1.0), (16, 1.6)])
def test_whole_error_is_indicated(structured_block, exact_forces, manufactured, cells, growth):
    body, moved, exact = solved(structured_block, exact_forces, manufactured, cells, growth)
    found, true = energy_errors(body, moved), true_errors(body, moved, exact.stress)
    assert 0.9 < np.linalg.norm(found) / np.linalg.norm(true) < 1.1


def test_each_element_error_is_indicated(structured_block, exact_forces, manufactured):
    body, moved, exact = solved(structured_block, exact_forces, manufactured, 16, 1.6)
    found, true = energy_errors(body, moved), true_errors(body, moved, exact.stress)
    assert 0.8 < np.quantile(found / true, 0.05) < np.quantile(found / true, 0.95) < 1.3
    assert np.corrcoef(np.log(found), np.log(true))[0, 1] > 0.98


def test_distance_is_that_to_the_recovered_stress(structured_block, exact_forces, manufactured):
    body, moved, _ = solved(structured_block, exact_forces, manufactured, 8)
    at, weight = collapsed_gauss(5)
    nodal = recovered_stress(body, moved)[body.mesh.triangles]
    smooth = np.einsum("mac,qa->mqc", nodal, shapes(at))
    exact = energy_norms(body, moved, smooth, at, weight)
    assert energy_errors(body, moved) == pytest.approx(exact, rel=1e-10)


def test_error_falls_with_the_order_of_stresses(structured_block, exact_forces, manufactured):
    norms = [
        np.linalg.norm(
            energy_errors(*solved(structured_block, exact_forces, manufactured, cells)[:2])
        )
        for cells in (8, 16)
    ]
    assert np.log2(norms[0] / norms[1]) == pytest.approx(2.0, abs=0.15)


def test_scales_with_the_displacement(structured_block, exact_forces, manufactured):
    body, moved, _ = solved(structured_block, exact_forces, manufactured, 8)
    assert energy_errors(body, -3.0 * moved) == pytest.approx(3.0 * energy_errors(body, moved))


def test_a_stress_that_elements_represent_has_no_error(structured_block):
    mesh = structured_block(np.linspace(-1.0, 1.0, 9), np.linspace(0.0, 1.0, 5), seed=3)
    body = elastic_body(mesh, BODY, Support())
    x, z = body.points.T
    linear = np.column_stack([0.1 * x + 0.3 * z, -0.2 * x + 0.4 * z])
    assert energy_errors(body, linear).max() < 1e-8
    bent = np.column_stack([x * z, z**2])
    assert energy_errors(body, bent).max() < 1e-8
