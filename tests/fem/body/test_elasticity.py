"""Patch tests, supports, scaling and coatings of the elastic body; near nu = 0.5, which
displacement elements are free of locking, against a mixed element. Stiffnesses at their worst:
residuals are rounding, even compression comes out exactly.

Requirement near nu = 0.5: the compliance of a bonded layer and of a large block, nu from 0.3 to
0.499999. References: the layer's exact compliance and the half-plane's, and apart from both the
mixed triangle of Taylor and Hood (1973, Computers and Fluids 1, 73-100; quadratic displacements,
linear pressure), which does not lock. The errors below are regressions, within a factor of 2 on
both sides: what `fem.body.elasticity` says about the choice of elements rests on them.

LAPACK's test ratio, ||b - A x|| / (||A|| ||x|| eps), is below 30 whatever the condition of A is
(Anderson et al. 1999, LAPACK working note 41). Even compression, u_z = depth - z, is a state that
elements of any shape represent; the condition may magnify its rounding. It needs no force inside,
and on the top the resultant of M = 2 G (1 - nu) / (1 - 2 nu).
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from blocks import graded, hooke, structured_block, widened
from scenes import hat_nodes
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.linalg import norm, splu

from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from fem.body import elasticity
from fem.body.elasticity import Coating, ElasticBody, Support, elastic_body
from fem.body.exact_load import forces_of
from fem.body.surface import hat_forces
from fem.body.triangle import collapsed_gauss, jacobians, shapes, slopes
from fem.compliance.operator import FiniteElementCompliance
from fem.solver.mumps import FemError, SymmetricFactor
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

MATERIAL = Material(3.0, 0.3)
CLAMPED = Support("bonded", "fixed")
LINE = np.linspace(-1, 1, 7)


def wavy(x):
    return 0.03 * np.cos(2.0 * x + 0.3)


def small(height=None):
    return structured_block(LINE, np.linspace(0, 1, 4), height, 7)


# Linear displacements on curved elements are no polynomials of the coordinates: no patch test.
@pytest.mark.parametrize(
    ("height", "degree"),
    [(None, 1), (None, 2), (None, 3), (wavy, 2), (wavy, 3)],
    ids=["straight-1", "straight-2", "straight-3", "curved-2", "curved-3"],
)
@pytest.mark.parametrize(
    ("support", "strain"),
    [
        (Support("bonded", "free"), (0.0, -1e-3, 2e-3)),
        (Support("frictionless", "free"), (4e-4, -1e-3, 0.0)),
        (Support("frictionless", "rollers"), (0.0, -1e-3, 0.0)),
    ],
    ids=["shear", "stretch", "confined"],
)
def test_constant_strain_is_reproduced_exactly(height, degree, support, strain):
    mesh = small(height)
    body = elastic_body(mesh, MATERIAL, support, degree=degree)
    exx, ezz, gxz = strain
    x, z = body.nodes.T
    exact = np.column_stack([exx * x + gxz * (z - 1.0), ezz * (z - 1.0)])
    sx, sz, txz = hooke(MATERIAL, exx, ezz, gxz)
    load = forces_of(mesh, lambda x, z: (sx + 0 * x, sz, txz), degree=degree)
    np.testing.assert_allclose(body.solve(load), exact, atol=1e-11 * np.abs(exact).max())


@pytest.mark.parametrize("ratio", [1e-6, 0.1, 1e6])
def test_a_coating_under_uniform_traction_is_reproduced_exactly(degree, ratio):
    """Uniform pressure and shear: each layer strains by its own compliance; sx jumps."""
    mesh = structured_block(LINE, np.array([0.0, 0.1, 0.25, 0.5, 1.0]))
    coat = Material(ratio * MATERIAL.youngs_modulus, 0.2)
    body = elastic_body(mesh, MATERIAL, Support(), degree=degree, coating=Coating(coat, 0.25))
    assert np.count_nonzero(body.coated) == len(body.coated) // 2
    z = body.nodes[:, 1]
    below, above = np.minimum(1.0 - z, 0.75), np.maximum(0.25 - z, 0.0)
    exact = np.zeros(body.nodes.shape)
    for material, height in ((MATERIAL, below), (coat, above)):
        # bonded below, so exx = 0; moved along by shear, down by pressure
        mass, shear = hooke(material, 0.0, 1.0, 1.0)[1:]
        exact += np.outer(height, [-0.4 / shear, 1.0 / mass])

    def stress(x, z):
        nu = np.where(z < 0.25, coat.poissons_ratio, MATERIAL.poissons_ratio)
        return -nu / (1.0 - nu), -1.0, 0.4

    load = forces_of(mesh, stress, degree=degree)
    np.testing.assert_allclose(body.solve(load), exact, atol=1e-11 * np.abs(exact).max())


def test_coatings_that_the_mesh_does_not_follow_are_refused():
    with pytest.raises(ValueError, match=r"\d+ elements of the mesh cross the coating"):
        elastic_body(small(), MATERIAL, Support(), coating=Coating(MATERIAL, 0.25))
    with pytest.raises(ValueError, match="thickness must be positive"):
        Coating(MATERIAL, 0.0)


def test_a_coating_of_the_body_s_material_is_none(degree):
    mesh, coating = structured_block(LINE, LINE[3:], wavy), Coating(MATERIAL, LINE[4])
    plain = elastic_body(mesh, MATERIAL, Support(), degree=degree)
    coated = elastic_body(mesh, MATERIAL, Support(), degree=degree, coating=coating)
    np.testing.assert_array_equal(coated.solve(pressed(coated)), plain.solve(pressed(plain)))


@pytest.mark.parametrize("height", [None, wavy], ids=["straight", "curved"])
def test_displacements_at_the_mesh_s_points(degree, height):
    """Polynomials of the displacement's degree on straight elements; on curved ones what lies in
    all degrees: constants, and at vertices anything."""
    body = elastic_body(small(height), MATERIAL, Support(), degree=degree)
    assert body.unknowns == 2 * len(body.nodes)

    def moved(place):
        x, z = np.moveaxis(place, -1, 0)
        power = degree if height is None else 0
        return np.stack([1.0 + (x - 0.3 * z) ** power, (0.5 * x * z + z) ** (power // 2)], axis=-1)

    both = np.stack([moved(body.nodes), 2.0 * moved(body.nodes)])
    at_points = body.at_points(both)
    np.testing.assert_allclose(at_points[1], 2.0 * at_points[0], rtol=1e-15)
    np.testing.assert_allclose(at_points[0], moved(body.points), atol=1e-14)
    vertices = body.mesh.triangles[:, :3]
    np.testing.assert_array_equal(body.at_points(body.nodes)[vertices], body.points[vertices])
    if degree > 1:
        np.testing.assert_allclose(body.at_points(body.nodes), body.points, atol=1e-15)


def pressed(body: ElasticBody) -> np.ndarray:
    """A load that pushes down on a few surface nodes, unevenly."""
    load = np.zeros(body.nodes.shape)
    load[body.surface.point[2:7], 1] = [1.0, 2.0, 0.5, 3.0, 1.0]
    return load


def test_points_keep_their_own_numbers(degree):
    """The pressed points move most, and nothing depends on how points are numbered."""
    mesh = small()
    body = elastic_body(mesh, MATERIAL, Support(), degree=degree)
    moved = body.solve(pressed(body))
    assert np.argmax(moved[:, 1]) in body.surface.point[2:7]
    order = np.random.default_rng(2).permutation(len(mesh.points))
    rank = np.argsort(order)
    shuffled = replace(
        mesh, points=mesh.points[order], triangles=rank[mesh.triangles], shift=mesh.shift[order]
    )
    again = elastic_body(shuffled, MATERIAL, Support(), degree=degree)
    at_points = again.at_points(again.solve(pressed(again)))
    np.testing.assert_allclose(at_points, body.at_points(moved)[order], atol=1e-13)


def test_displacement_scales_with_load_and_inversely_with_the_moduli(degree):
    mesh = structured_block(LINE, LINE[3:])

    def body(size):
        coating = Coating(Material(7.0 * size, 0.2), LINE[4])
        return elastic_body(mesh, Material(size, 0.3), Support(), degree=degree, coating=coating)

    soft, hard = body(1e-3), body(2e12)
    moved = soft.solve(pressed(soft))
    np.testing.assert_allclose(hard.solve(5.0 * pressed(hard)) * 2e15, 5.0 * moved, rtol=1e-12)


@pytest.mark.parametrize("size", [1e-9, 1e6])
def test_displacement_does_not_depend_on_the_unit_of_length(degree, size):
    def body(size):
        mesh = structured_block(size * LINE, size * LINE[3:], lambda x: size * wavy(x / size))
        coating = Coating(Material(2.0, 0.1), size * LINE[4])
        return elastic_body(mesh, MATERIAL, Support(), degree=degree, coating=coating)

    one, other = (made.solve(pressed(made)) for made in (body(1.0), body(size)))
    np.testing.assert_allclose(other, one, rtol=1e-9, atol=1e-12)


def test_supports_hold_what_they_say(degree):
    for base in ("bonded", "frictionless"):
        for sides in ("free", "rollers", "fixed"):
            body = elastic_body(small(), MATERIAL, Support(base, sides), degree=degree)
            moved = body.at_points(body.solve(pressed(body)))
            assert np.all(moved[body.sides.bottom, 1] == 0.0)
            assert (base == "frictionless") == (np.abs(moved[body.sides.bottom, 0]).max() > 0.0)
            flank = np.union1d(body.sides.left, body.sides.right)
            flank = np.setdiff1d(flank, body.sides.bottom)
            assert (sides == "free") == (np.abs(moved[flank, 0]).min() > 0.0)
            assert (sides != "fixed") == (np.abs(moved[flank, 1]).min() > 0.0)


def test_a_body_held_within_is_the_smaller_body():
    """The middle of a block, held at half its extent, is a block of half its size."""
    line = np.linspace(-2.0, 2.0, 17)
    large = structured_block(line, np.linspace(0.0, 2.0, 9))
    inner = structured_block(line[4:13], np.linspace(0.0, 1.0, 5))
    held = elastic_body(large, MATERIAL, Support("bonded", "fixed", within=(0.99, 0.99)))
    alone = elastic_body(inner, MATERIAL, CLAMPED)
    places = {tuple(p): i for i, p in enumerate(np.round(large.points, 9))}
    same = np.array([places[tuple(p)] for p in np.round(inner.points, 9)])
    load = np.random.default_rng(3).normal(size=inner.points.shape)
    wider = np.zeros(large.points.shape)
    wider[same] = load
    moved = held.solve(wider)
    np.testing.assert_allclose(moved[same], alone.solve(load), atol=1e-12)
    assert not np.any(np.delete(moved, same, axis=0))


def test_a_body_that_can_slide_refuses_a_net_horizontal_load():
    body = elastic_body(small(), MATERIAL, Support("frictionless", "free"))
    load = pressed(body)
    load[body.surface.point[4], 0] = 0.1
    with pytest.raises(FemError, match="cannot bear a horizontal load"):
        body.solve(load)
    load[body.surface.point[6], 0] = -0.1
    assert np.abs(body.solve(load)).max() > 0.0
    load[body.surface.point[6], 0] = 0.0
    held = elastic_body(small(), MATERIAL, Support("frictionless", "rollers"))
    assert np.abs(held.solve(load)).max() > 0.0


@pytest.mark.parametrize("held", [("glued",), ("bonded", "loose"), ("bonded", "free", (0.0, 1.0))])
def test_supports_without_sense_are_refused(held):
    with pytest.raises(ValueError):
        Support(*held)


def test_roughness_that_inverts_elements_is_refused():
    line = np.linspace(-1, 1, 9)
    mesh = structured_block(line, np.linspace(0, 0.1, 3), lambda x: -0.2 * np.cos(9 * x))
    with pytest.raises(FemError, match=r"\d+ elements of the mesh are inverted"):
        elastic_body(mesh, MATERIAL, Support())


BODY = Material(0.91, 0.3)
PITCH = 0.05
BLOCK = BlockSpec(50.0, 100.0, np.array([[-1.5, 1.5]]), PITCH)
HATS = PITCH * np.arange(-26, 27)


def surface(spec, modulus=None):
    """Weighted displacement under a smooth pressure; the coating's modulus over the body's."""
    coat = None if modulus is None else Material(modulus * 0.91, 0.3)
    coating = None if coat is None else Coating(coat, spec.interface)
    body = elastic_body(build_block(spec), BODY, CLAMPED, coating=coating)
    pressure = np.maximum(0.0, 1.0 - HATS[1:-1] ** 2) ** 2
    return FiniteElementCompliance(body, HATS).apply(pressure)


@pytest.fixture(scope="module")
def plain():
    """Surface of the body without a line."""
    return surface(BLOCK)


@pytest.mark.parametrize("thickness", [1.0, 0.1])
def test_a_line_in_a_body_of_one_material_changes_nothing(plain, thickness):
    lined = surface(replace(BLOCK, interface=thickness))
    assert lined == pytest.approx(plain, abs=4e-4 * np.ptp(plain))


@pytest.mark.parametrize("modulus", [0.1, 10.0])
def test_three_elements_across_a_coating_are_enough(plain, modulus):
    spec = replace(BLOCK, interface=0.15)
    plate = surface(spec, modulus)
    finer = surface(replace(spec, window=(-2.0, 2.0, 0.4, 0.02)), modulus)
    assert plate == pytest.approx(finer, abs=1e-4 * np.ptp(finer))
    assert np.ptp(plate) != pytest.approx(np.ptp(plain), rel=0.1)


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
        body = elastic_body(mesh, material, CLAMPED, degree=degree)
        compliance = FiniteElementCompliance(body, hats)
        result.append(compliance.apply(pressure))
        if degree == 2:
            reference = compliance.weighted(mixed(body, compliance.load(pressure)))
    return [*result, reference]


def assert_near(errors, expected):
    """Within a factor of 2."""
    assert np.all(np.abs(np.log2(np.divide(errors, expected))) < 1.0), errors


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
    middle = np.linspace(-5.0, 5.0, 10 * elements + 1)  # square cells under the hats
    x = widened(middle, graded(12.0, 1.0 / elements, 1.3))
    mesh = structured_block(x, np.linspace(0.0, 1.0, elements + 1))
    work = [pressure @ moved for moved in shifts(mesh, material, hats, pressure)]
    missing = 1.0 - np.array(work) / (pressure @ exact)
    assert_near(missing, expected)


# Largest error of the displacement between neighbours, of its largest: degrees 1, 2, 3, mixed.
@pytest.mark.parametrize(
    ("nu", "expected"),
    [(0.3, [4.1e-2, 6.8e-4, 2.0e-4, 5.3e-4]), (0.499999, [9.9e-1, 6.2e-3, 5.2e-4, 2.2e-4])],
)
def test_a_large_block(nu, expected):
    material, count, edge = Material(1.0, nu), 31, 1 / 16
    hats = hat_nodes(-15 / 16, edge, count)
    pressure = np.sqrt(1.0 - hats[1:-1] ** 2)
    outer = graded(100.0, edge, 1.4)
    mesh = structured_block(widened(np.linspace(-1.25, 1.25, 41), outer), outer)
    half_plane = HalfPlane(count, edge, material.plane_strain_modulus)
    exact = np.diff(half_plane.apply(pressure))
    off = [
        np.abs(np.diff(moved) - exact).max() / np.abs(exact).max()
        for moved in shifts(mesh, material, hats, pressure)
    ]
    assert_near(off, expected)


EPS = np.finfo(float).eps
THRESHOLD = 30.0  # LAPACK's own for its test ratios
GIVEN_BACK = 1e-8  # error of even compression
STEEL = Material(207e9, 0.3)
INTERFACE = 0.2  # [m] lower side of a coating
# Half-width, depth, refined on |x| <=, edge there, growth [m].
BLOCKS = {
    "plain": (40.0, 40.0, 1.5, 0.1, 0.3),
    "grading of 1e7": (1.0, 1.0, 1e-6, 1e-7, 0.5),
    "thin": (10.0, 0.1, 1.5, 0.1, 0.3),
    "coated": (40.0, 40.0, 1.5, 0.1, 0.3),
    "rough": (8.0, 8.0, 3.0, 0.05, 0.3),
}


def wave(x: np.ndarray) -> np.ndarray:
    """A sinusoid of rms slope 1 on the refined range."""
    return np.exp(-((x / 2.0) ** 8)) * np.sqrt(2.0) / np.pi * np.cos(np.pi * x)


@lru_cache
def mesh_named(name: str) -> BlockMesh:
    half_width, depth, reach, edge, growth = BLOCKS[name]
    interface = INTERFACE if name == "coated" else None
    refined = np.array([[-reach, reach]])
    mesh = build_block(BlockSpec(half_width, depth, refined, edge, growth, interface=interface))
    return roughen(mesh, wave) if name == "rough" else mesh


def residual_ratio(body: ElasticBody) -> float:
    """The larger one of random forces and of the forces of a hat."""
    matrix, x = csr_matrix(body.stiffness()), body.surface.x
    hats = np.linspace(0.25 * x[0], 0.25 * x[-1], 7)
    one_hat = np.zeros(body.nodes.shape)
    one_hat[body.surface.point] = hat_forces(body.surface, hats)[:, 2].toarray().reshape(-1, 2)
    ratios = []
    for load in (np.random.default_rng(5).standard_normal(body.nodes.shape), one_hat):
        load[body.held] = 0.0
        moved = body.solve(load).ravel()
        residual = np.abs(load.ravel() - matrix @ moved).sum()
        ratios.append(residual / (norm(matrix, 1) * np.abs(moved).sum() * EPS))
    return max(ratios)


def compression_errors(body: ElasticBody) -> tuple[float, float, float]:
    """Errors of the displacement, relative; forces inside as a test ratio; resultant, relative."""
    material, matrix = body.material, csr_matrix(body.stiffness())
    moved = np.zeros(body.nodes.shape)
    moved[:, 1] = body.mesh.spec.depth - body.nodes[:, 1]
    moved[body.held] = 0.0
    force = (matrix @ moved.ravel()).reshape(-1, 2)
    top, inside = body.surface.point, ~body.held
    inside[top] = False
    ratio = np.abs(force[inside]).max() / (norm(matrix, 1) * np.abs(moved).max() * EPS)
    nu, width = material.poissons_ratio, 2.0 * body.mesh.spec.half_width
    resultant = width * 2.0 * material.shear_modulus * (1.0 - nu) / (1.0 - 2.0 * nu)
    load = np.zeros_like(force)
    load[top] = force[top]
    error = np.abs(body.solve(load) - moved).max() / np.abs(moved).max()
    return error, ratio, abs(force[top, 1].sum() / resultant - 1.0)


def clamped(
    mesh: str, material: Material = STEEL, degree: int = 2, ratio: float | None = None
) -> ElasticBody:
    """A body held on its base and sides; `ratio`, how many times as stiff as steel a coating is."""
    coating = ratio and Coating(Material(ratio * 207e9, 0.2), INTERFACE)
    return elastic_body(mesh_named(mesh), material, CLAMPED, degree=degree, coating=coating)


def confined(mesh: str, nu: float = 0.3, degree: int = 2) -> ElasticBody:
    """A body on a frictionless base between rollers."""
    support = Support("frictionless", "rollers")
    return elastic_body(mesh_named(mesh), Material(207e9, nu), support, degree=degree)


@pytest.mark.parametrize(
    "body",
    [
        ("plain",),
        ("plain", Material(1.0, 0.0)),
        ("plain", Material(1.0, 0.4999)),
        ("plain", Material(1.0, 0.5 - 1e-9), 3),
        ("grading of 1e7",),
        ("thin",),
        ("rough",),
        ("plain", Material(1e-12, 0.3)),
        ("coated", STEEL, 2, 1e6),
        ("coated", STEEL, 2, 1e-6),
    ],
    ids=str,
)
def test_residuals_are_rounding_and_the_stiffness_is_symmetric(body):
    made = clamped(*body)
    matrix = csr_matrix(made.stiffness())
    assert abs(matrix - matrix.T).max() <= 1e-14 * abs(matrix).max()
    assert residual_ratio(made) < THRESHOLD


@pytest.mark.parametrize(
    "body",
    [
        ("plain",),
        ("plain", 0.4999),
        ("plain", 0.4999, 3),
        ("plain", 0.3, 1),
        ("grading of 1e7",),
        ("rough",),
    ],
    ids=str,
)
def test_even_compression_is_given_back(body):
    error, ratio, resultant = compression_errors(confined(*body))
    assert error < GIVEN_BACK and ratio < THRESHOLD and resultant < GIVEN_BACK


def test_a_factor_in_32_bits_is_seen(monkeypatch):
    original = SymmetricFactor.solve

    def rounded(self, load: np.ndarray) -> np.ndarray:
        return original(self, load).astype(np.float32).astype(float)

    monkeypatch.setattr(SymmetricFactor, "solve", rounded)
    assert residual_ratio(clamped("plain")) > 1e3 * THRESHOLD


def test_a_wrong_stiffness_is_seen(monkeypatch):
    """Equations that are solved exactly are no proof that they are the right ones."""
    original = elasticity.relative_constants

    def stiffer(*constants: object) -> tuple[np.ndarray, np.ndarray]:
        shear, lame = original(*constants)
        return shear, 1.01 * lame

    monkeypatch.setattr(elasticity, "relative_constants", stiffer)
    assert compression_errors(confined("plain"))[2] > 1e3 * GIVEN_BACK
    assert residual_ratio(clamped("plain")) < THRESHOLD
