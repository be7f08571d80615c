"""Near nu = 0.5: which displacement elements are free of locking, against a mixed element.

Requirement: the compliance of a bonded layer and of a large block, nu from 0.3 to 0.499999.
References: the layer's exact compliance and the half-plane's, and apart from both the mixed
triangle of Taylor and Hood (1973, Computers and Fluids 1, 73-100; quadratic displacements, linear
pressure), which does not lock. The errors below are regressions, within a factor of 2 on both
sides: what `fem.body.elasticity` says about the choice of elements rests on them.
"""

import numpy as np
import pytest
from blocks import graded, structured_block
from scenes import hat_nodes
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.body.triangle import collapsed_gauss, jacobians, shapes, slopes
from fem.compliance.operator import FiniteElementCompliance

SUPPORT = Support("bonded", "fixed")


def mixed(body: ElasticBody, load: np.ndarray) -> np.ndarray:
    """Displacement (n, 2) by Taylor and Hood's element on the mesh of a quadratic `body`.

    integral 2 mu e(u):e(v) - p div v = load,   integral -q div u - q p / lambda = 0
    """
    triangles, points, material = body.mesh.triangles, body.points, body.material
    at, weight = collapsed_gauss(4)
    jacobian = jacobians(points[triangles], at)
    volume = np.abs(np.linalg.det(jacobian)) * weight
    slope = np.einsum("qad,mqdc->mqac", slopes(at), np.linalg.inv(jacobian))
    shear, nu = material.shear_modulus, material.poissons_ratio
    products = np.einsum("mqac,mqbd,mq->mabcd", slope, slope, volume, optimize=True)
    strain = np.einsum("mabcc,de->madbe", products, np.eye(2)) + np.einsum("mabdc->macbd", products)
    count, size = len(triangles), 2 * len(points)
    divergence = -np.einsum("qp,mqac,mq->mpac", shapes(at, 1), slope, volume, optimize=True)
    mass = np.einsum("qp,qr,mq->mpr", shapes(at, 1), shapes(at, 1), volume, optimize=True)
    vertices, corner = np.unique(triangles[:, :3], return_inverse=True)
    moved = (2 * triangles[:, :, None] + np.arange(2)).reshape(count, 12)
    unknown = np.hstack([moved, size + corner.reshape(count, 3)])
    local = np.zeros((count, 15, 15))
    local[:, :12, :12] = shear * strain.reshape(count, 12, 12)
    local[:, 12:, :12] = divergence.reshape(count, 3, 12)
    local[:, :12, 12:] = np.swapaxes(local[:, 12:, :12], 1, 2)
    local[:, 12:, 12:] = -(1 - 2 * nu) / (2 * shear * nu) * mass
    row, column = np.repeat(unknown, 15, axis=1), np.tile(unknown, 15)
    whole = size + len(vertices)
    matrix = coo_matrix((local.ravel(), (row.ravel(), column.ravel())), (whole, whole)).tocsc()
    free = np.flatnonzero(~np.append(body.held.ravel(), np.zeros(len(vertices), dtype=bool)))
    solution = np.zeros(whole)
    force = np.append(load.ravel(), np.zeros(len(vertices)))
    solution[free] = splu(matrix[free][:, free]).solve(force[free])
    return solution[:size].reshape(-1, 2)


def shifts(mesh, material: Material, hats: np.ndarray, pressure: np.ndarray) -> list[np.ndarray]:
    """Weighted displacements of the hats: by linear, quadratic, cubic and mixed elements."""
    result = []
    for degree in (1, 2, 3):
        body = elastic_body(mesh, material, SUPPORT, degree=degree)
        compliance = FiniteElementCompliance(body, hats)
        result.append(compliance.apply(pressure))
        if degree == 2:
            reference = compliance.weighted(mixed(body, compliance.load(pressure)))
    return [*result, reference]


def thin_layer(elements: int):
    """Thickness 1, hats on -4 to 4; square cells there, `elements` across the thickness."""
    outer = 5.0 + graded(12.0, 1.0 / elements, 1.3)
    middle = np.linspace(-5.0, 5.0, 10 * elements + 1)
    x = np.concatenate([-outer[:0:-1], middle, outer[1:]])
    return structured_block(x, np.linspace(0.0, 1.0, elements + 1))


# How far the work of a pressure on its displacement is too low: degrees 1, 2, 3, mixed.
@pytest.mark.parametrize(
    ("elements", "nu", "expected"),
    [
        (4, 0.3, [4.4e-3, 1.0e-5, 1.9e-8, 5.6e-6]),
        (4, 0.49, [1.1e-1, 6.1e-4, 5.6e-7, 3.3e-5]),
        (4, 0.4999, [0.92, 5.8e-3, 4.3e-6, 4.8e-5]),
        (4, 0.499999, [1.0, 6.7e-3, 4.7e-6, 4.9e-5]),
        (8, 0.499999, [1.0, 1.8e-3, 2.9e-7, 3.7e-6]),
    ],
)
def test_a_thin_bonded_layer(elements, nu, expected):
    material, count = Material(1.0, nu), 63
    hats = hat_nodes(-3.875, 0.125, count)
    pressure = (1.0 - (hats[1:-1] / 4.0) ** 2) ** 2
    exact = LayeredSurface(count, 0.125, LayeredBody(material, 1.0, "bonded")).apply(pressure)
    mesh = thin_layer(elements)
    work = [pressure @ moved for moved in shifts(mesh, material, hats, pressure)]
    missing = 1.0 - np.array(work) / (pressure @ exact)
    assert np.all(missing < 2.0 * np.array(expected)), missing
    assert np.all(missing > 0.5 * np.array(expected)), missing


# Largest error of the displacement between neighbours, of its largest: degrees 1, 2, 3, mixed.
@pytest.mark.parametrize(
    ("nu", "expected"),
    [(0.3, [4.1e-2, 6.8e-4, 2.0e-4, 5.3e-4]), (0.499999, [9.9e-1, 6.2e-3, 5.2e-4, 2.2e-4])],
)
def test_a_large_block(nu, expected):
    material, count, edge = Material(1.0, nu), 31, 1 / 16
    hats = hat_nodes(-15 / 16, edge, count)
    pressure = np.sqrt(1.0 - hats[1:-1] ** 2)
    outer = 1.25 + graded(100.0, edge, 1.4)
    x = np.concatenate([-outer[:0:-1], np.linspace(-1.25, 1.25, 41), outer[1:]])
    mesh = structured_block(x, graded(100.0, edge, 1.4))
    half_plane = HalfPlane(count, edge, material.plane_strain_modulus)
    exact = np.diff(half_plane.apply(pressure))
    off = [
        np.abs(np.diff(moved) - exact).max() / np.abs(exact).max()
        for moved in shifts(mesh, material, hats, pressure)
    ]
    assert np.all(off < 2.0 * np.array(expected)), off
    assert np.all(off > 0.5 * np.array(expected)), off
