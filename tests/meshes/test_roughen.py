"""The real rough boundary: exact nodes, exact area, elements that stay right side out."""

import numpy as np
import pytest

from analytic.surface.synthetic import self_affine
from meshes.block import BlockSpec, MeshError, real_points
from meshes.build import build_block
from meshes.quality import corner_jacobians, quality_of
from meshes.real_shape import carried_down, roughen

WAVELENGTH = 0.5
EDGES_PER_WAVE = 20
SPEC = BlockSpec(10.0, 20.0, np.array([[-2.0, 2.0]]), WAVELENGTH / EDGES_PER_WAVE)
FINE_SPEC = BlockSpec(2.0, 4.0, np.array([[-2.0, 2.0]]), WAVELENGTH / EDGES_PER_WAVE)


@pytest.fixture(scope="module")
def flat():
    return build_block(SPEC)


def sinusoid(rms_slope):
    k = 2.0 * np.pi / WAVELENGTH
    return lambda x: np.sqrt(2.0) * rms_slope / k * np.cos(k * x + 0.4)


def top(mesh):
    return mesh.points[:, 1] == 0.0


def test_top_nodes_lie_exactly_on_the_profile(flat):
    height = sinusoid(0.1)
    mesh = roughen(flat, height)
    x, z = real_points(mesh)[top(mesh)].T
    assert np.array_equal(z, -height(x))
    midpoints = top(mesh) & (np.arange(len(mesh.points)) > mesh.triangles[:, :3].max())
    assert midpoints.sum() == top(mesh).sum() // 2
    assert np.abs(mesh.shift[midpoints]).max() > 0.005
    assert np.array_equal(mesh.points, flat.points) and not flat.shift.any()


def test_base_stays_and_nothing_moves_more_than_the_profile(flat):
    height = sinusoid(0.2)
    mesh = roughen(flat, height)
    bottom = mesh.points[:, 1] == SPEC.depth
    assert not mesh.shift[bottom].any()
    assert np.abs(mesh.shift).max() <= np.abs(height(mesh.points[top(mesh), 0])).max() * 1.01
    deep = mesh.points[:, 1] > 3.0 * WAVELENGTH
    # A sinusoid has decayed to exp(-2 pi) there; the coarse sides add its aliases.
    assert np.abs(mesh.shift[deep & (np.abs(mesh.points[:, 0]) < 1.0)]).max() < 0.05 * 0.05


def test_area_is_that_of_the_block_plus_the_profile(flat, curved_area):
    height = sinusoid(0.1)
    mesh = roughen(flat, height)
    x = np.sort(mesh.points[top(mesh), 0])
    start, middle, end = x[:-1:2], x[1::2], x[2::2]
    simpson = ((end - start) * (height(start) + 4 * height(middle) + height(end)) / 6.0).sum()
    block = 2.0 * SPEC.half_width * SPEC.depth
    assert curved_area(mesh) == pytest.approx(block + simpson, rel=1e-12)
    assert abs(simpson) > 1e-9 * block


def test_area_converges_to_the_integral_of_the_profile(curved_area):
    slope = 0.1
    k = 2.0 * np.pi / WAVELENGTH
    amplitude = np.sqrt(2.0) * slope / k
    exact = amplitude / k * (np.sin(2.0 * k + 0.4) - np.sin(-1.9 * k + 0.4))
    errors = []
    for edges in (3, 6, 12):
        size = 0.1 * WAVELENGTH * 3 / edges
        spec = BlockSpec(1.95, 4.0, np.array([[-1.95, 1.95]]), size)
        mesh = roughen(build_block(spec), lambda x: sinusoid(slope)(x + 0.05))
        errors.append(abs(curved_area(mesh) - 2.0 * 1.95 * 4.0 - exact))
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert order == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize("rms_slope", [0.02, 0.1, 0.3])
def test_elements_stay_right_side_out(flat, rms_slope, determinants, triangle_rule):
    mesh = roughen(flat, sinusoid(rms_slope))
    assert determinants(mesh, triangle_rule[0]).min() > 0.0
    assert quality_of(mesh)["least_jacobian"] > 0.25
    assert quality_of(mesh)["least_angle_degrees"] > 20.0


def test_corners_hold_the_least_determinant(flat, determinants):
    mesh = roughen(flat, sinusoid(0.3))
    inside = determinants(mesh, np.random.default_rng(0).dirichlet([1, 1, 1], 20)[:, :2])
    corners = corner_jacobians(real_points(mesh), mesh.triangles)
    assert corners == pytest.approx(
        determinants(mesh, np.array([[0, 0], [1, 0], [0, 1]])), rel=1e-9
    )
    assert (inside >= corners.min(axis=1, keepdims=True) * (1 - 1e-9)).all()
    assert (inside <= corners.max(axis=1, keepdims=True) * (1 + 1e-9)).all()


@pytest.mark.parametrize(("rms_slope", "hurst"), [(0.05, 0.8), (0.3, 0.8), (0.3, 0.3)])
def test_rough_profiles_of_many_wavelengths(flat, rms_slope, hurst):
    trace = {"length": 2.02 * SPEC.half_width, "samples": 8193, "seed": 0}
    waves = {"rms_slope": rms_slope, "hurst": hurst, "shortest_wavelength": 0.25}
    mesh = roughen(flat, self_affine(**trace, **waves).spline())
    assert quality_of(mesh)["least_jacobian"] > 0.15
    assert quality_of(mesh)["least_angle_degrees"] > 15.0


def test_slope_beyond_one_is_followed_where_the_surface_is_refined(determinants, triangle_rule):
    mesh = roughen(build_block(FINE_SPEC), sinusoid(0.75))
    assert quality_of(mesh)["least_angle_degrees"] > 10.0
    assert determinants(mesh, triangle_rule[0]).min() > 0.0


def test_constant_height_stretches_the_block_evenly(flat):
    mesh = roughen(flat, lambda x: np.full_like(x, 2.0))
    expected = -2.0 * (1.0 - flat.points[:, 1] / SPEC.depth)
    assert mesh.shift[:, 1] == pytest.approx(expected, abs=1e-12)
    assert not mesh.shift[:, 0].any()


def test_shift_is_proportional_to_the_height(flat):
    one, tenth = roughen(flat, sinusoid(0.1)), roughen(flat, sinusoid(0.01))
    assert one.shift == pytest.approx(10.0 * tenth.shift, abs=1e-15)


def test_carried_down_as_the_exact_solution():
    errors = []
    for size in (0.2, 0.1, 0.05):
        spec = BlockSpec(1.0, 4.0, np.array([[-1.0, 1.0]]), size, growth=0.0)
        mesh = build_block(spec)
        n = mesh.triangles[:, :3].max() + 1
        x, z = mesh.points[:n].T
        exact = np.cos(np.pi * x) * np.sinh(np.pi / 3 * (4.0 - z)) / np.sinh(np.pi / 3 * 4.0)
        shift = carried_down(mesh.points[:n], mesh.triangles[:, :3], np.where(z == 0, exact, 0.0))
        errors.append(np.sqrt(np.mean((shift - exact) ** 2)))
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    assert order == pytest.approx(2.0, abs=0.35)
    assert errors[-1] < 1e-3


def spike(x):
    return 0.2 * np.exp(-(((x - 0.75) / 0.02) ** 2))


@pytest.mark.parametrize(
    ("height", "words"),
    [
        (sinusoid(3.0), r"inverts \d+ elements, the worst at x = .* slope is .* .steepest"),
        (spike, r"x = 0\.7"),
        (lambda x: np.full_like(x, -1.1 * SPEC.depth), "inverts"),
        (lambda x: x * np.nan, "one finite number for each x"),
        (lambda x: x[:-1], "one finite number for each x"),
    ],
)
def test_profiles_that_cannot_be_followed_are_refused(flat, height, words):
    with pytest.raises(MeshError, match=words):
        roughen(flat, height)
