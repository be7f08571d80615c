"""Discs: the sector, bent on its circle, and those that are held away from the contact; of their
area, fit to solve on up to the bounds. The real rough boundary: exact nodes, exact area,
elements that stay right side out."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from analytic.surface.synthetic import self_affine
from meshes.block import EDGES, BlockSpec, MeshError, real_points
from meshes.build import build_block
from meshes.disc import (
    HELD_OPPOSITE,
    KEPT,
    disc,
    half_disc_size,
    opposite_size,
    ring,
    ring_size,
)
from meshes.quality import corner_jacobians, quality_of
from meshes.real_shape import bent, carried_down, roughen, rounded, sagitta

RADIUS = 2.0
# Points (6, 2) of the triangle and weights, of sum 1/2, exact to degree 4: Strang and Fix.
OFF = (0.445948490915965, 0.091576213509771)
AT = np.array([[c, d] for e in OFF for c, d in ((e, e), (1 - 2 * e, e), (e, 1 - 2 * e))])
WEIGHT = 0.5 * np.repeat([0.223381589678011, 0.109951743655322], 3)


def determinants(mesh, at):
    """Determinants of the quadratic map (m, q) at points (q, 2), from its shapes' derivatives."""
    r, s = at.T
    t = 1.0 - r - s
    zero = np.zeros_like(r)
    d_r = np.stack([1 - 4 * t, 4 * r - 1, zero, 4 * (t - r), 4 * s, -4 * s], axis=1)
    d_s = np.stack([1 - 4 * t, zero, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)], axis=1)
    nodes = real_points(mesh)[mesh.triangles]
    a, b = (np.einsum("qk,ekd->eqd", d, nodes) for d in (d_r, d_s))
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def curved_area(mesh):
    """Area of a mesh with quadratic edges, whose determinants have degree 2."""
    return float((determinants(mesh, AT) @ WEIGHT).sum())


def flat_block(half_width=1.2, depth=1.0, size=0.01, growth=0.2):
    return build_block(BlockSpec(half_width, depth, np.array([[-0.2, 0.2]]), size, growth))


@cache
def even_block(size):
    """Edges of one size all along the surface and in the body."""
    return build_block(BlockSpec(1.2, 1.0, np.array([[-1.2, 1.2]]), size, 0.0))


@pytest.fixture(scope="module")
def flat():
    return flat_block(size=0.02)


@pytest.fixture(scope="module")
def sector(flat):
    return bent(flat, RADIUS)


def from_centre(points):
    x, z = points[..., 0], points[..., 1]
    return np.hypot(x, RADIUS - z), np.arctan2(x, RADIUS - z)


def test_surface_lies_on_the_circle_and_keeps_x(flat, sector):
    on = flat.points[:, 1] == 0.0
    top = real_points(sector)[on]
    assert np.array_equal(top[:, 0], flat.points[on, 0])
    assert from_centre(top)[0] == pytest.approx(RADIUS, rel=4e-16)
    assert on.sum() > 50


def test_depths_become_circles_and_upright_lines_rays(flat, sector):
    distance, angle = from_centre(real_points(sector))
    x, z = flat.points.T
    assert distance == pytest.approx(RADIUS - z, rel=2e-15)
    assert np.sin(angle) == pytest.approx(x / RADIUS, abs=1e-15)


def test_sagitta_of_a_nearly_flat_circle_keeps_its_digits():
    x = np.array([1e-6, 1e-3])
    assert sagitta(x, 1e3) == pytest.approx([5e-16, 5e-10 * (1.0 + 2.5e-13)], rel=1e-15)


def test_between_its_nodes_the_surface_is_off_the_circle_by_the_cube_of_the_edge():
    errors = []
    for size in (0.15, 0.075, 0.0375):
        mesh = bent(even_block(size), RADIUS)
        ends = mesh.triangles[:, EDGES].reshape(-1, 2)
        edge = np.column_stack([ends, mesh.triangles[:, 3:].ravel()])
        edge = edge[(mesh.points[edge, 1] == 0.0).all(axis=1)]
        start, end, middle = np.moveaxis(real_points(mesh)[edge], 1, 0)
        t = np.linspace(0.0, 1.0, 21)[:, None, None]
        curve = (1 - t) * (1 - 2 * t) * start + t * (2 * t - 1) * end + 4 * t * (1 - t) * middle
        errors.append(np.abs(from_centre(curve)[0] - RADIUS).max())
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(3.0, abs=0.3)
    assert errors[-1] < 2e-6 * RADIUS


def test_area_is_that_of_the_sector():
    exact = np.arcsin(1.2 / RADIUS) * (RADIUS**2 - (RADIUS - 1.0) ** 2)
    areas = [curved_area(bent(even_block(size), RADIUS)) for size in (0.15, 0.075, 0.0375)]
    errors = np.abs(np.divide(areas, exact) - 1.0)
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.5)
    assert errors[-1] < 1e-6


@pytest.mark.parametrize(
    ("half_width", "depth", "growth"),
    [(1.6, 1.4, 0.1), (1.6, 1.4, 0.5), (1.6, 0.2, 0.2), (0.4, 1.4, 0.5), (1.4, 1.2, 0.2)],
)
def test_fit_to_solve_on_up_to_the_bounds(half_width, depth, growth):
    """0.8 of the radius wide to a side and 0.7 of it deep."""
    mesh = bent(flat_block(half_width, depth, 0.005, growth), RADIUS)
    assert quality_of(mesh)["least_angle_degrees"] > 12.0
    assert quality_of(mesh)["least_jacobian"] > 0.2
    assert quality_of(mesh)["size_jump"] < 2.2
    inside = determinants(mesh, np.random.default_rng(1).dirichlet([1, 1, 1], 30)[:, :2])
    corners = corner_jacobians(real_points(mesh), mesh.triangles).min(axis=1)
    # the corners tell whether an element is turned over although their map is not linear
    assert np.all(inside.min(axis=1) > 0.95 * corners) and corners.min() > 0.0


@pytest.mark.parametrize(
    ("half_width", "depth", "what"), [(1.7, 0.5, "half-width 1.7"), (0.5, 1.5, "depth 1.5")]
)
def test_more_than_that_is_refused(flat, half_width, depth, what):
    spec = replace(flat.spec, half_width=half_width, depth=depth)
    with pytest.raises(MeshError, match=f"{what} m cannot be bent to a disc of radius 2 m"):
        bent(replace(flat, spec=spec), RADIUS)


def test_what_is_not_bent_or_rounded(sector, flat):
    for mesh in (sector, roughen(flat, lambda x: 0.01 * np.cos(x))):
        with pytest.raises(MeshError, match="flat block"):
            bent(mesh, RADIUS)
    for mesh, radius in ((flat, RADIUS), (flat_block(1.0, 1.0, 0.02), 0.9)):
        with pytest.raises(MeshError, match=r"only a flat block as deep as .* can be rounded"):
            rounded(mesh, radius)


def test_rounded_about_the_contact():
    """Up to an arc about the contact, between rim and rim; rays divide the angle alike."""
    flat = flat_block(1.6, 1.6, 0.02)
    sector = rounded(flat, RADIUS)
    on = flat.points[:, 1] == 0.0
    places = real_points(sector)
    assert places[on, 0] == pytest.approx(flat.points[on, 0], abs=1e-14)
    assert from_centre(places[on])[0] == pytest.approx(RADIUS, rel=1e-14)
    outer = np.abs(np.abs(flat.points).max(axis=1) - 1.6) < 1e-12
    arc = np.hypot(1.6, sagitta(1.6, RADIUS))
    assert np.hypot(*places[outer].T) == pytest.approx(np.full(outer.sum(), arc), rel=1e-12)
    assert np.hypot(*places.T).max() < arc * (1.0 + 1e-12)
    middle = flat.points[:, 0] == 0.0
    assert np.all(places[middle, 0] == pytest.approx(0.0, abs=1e-14))
    corners = corner_jacobians(places, sector.triangles)
    assert corners.min() > 0.0
    lens = arc**2 * np.arccos(0.5 * arc / RADIUS)
    lens += RADIUS**2 * np.arccos(1.0 - 0.5 * (arc / RADIUS) ** 2)
    lens -= 0.5 * arc * np.sqrt(4.0 * RADIUS**2 - arc**2)
    assert 0.5 * corners.mean(axis=1).sum() == pytest.approx(lens, rel=2e-3)


HUBS = (0.02, 0.3, 0.9)


@pytest.fixture(scope="module")
def discs():
    """Flat mesh and disc's, by name."""
    sizes = {"half": half_disc_size(RADIUS), "opposite": opposite_size(RADIUS)}
    blocks = {name: flat_block(size, size) for name, size in sizes.items()}
    made = {name: (block, disc(block, RADIUS)) for name, block in blocks.items()}
    for hub in HUBS:
        block = flat_block(*ring_size(RADIUS, hub * RADIUS))
        made[f"hub {hub}"] = block, ring(block, RADIUS)
    return made


NAMES = ("half", "opposite", *(f"hub {hub}" for hub in HUBS))


@pytest.mark.parametrize("name", NAMES)
def test_the_rim_is_the_circle_and_keeps_x_where_it_may_be_loaded(discs, name):
    block, mesh = discs[name]
    on = block.points[:, 1] == 0.0
    x, z = real_points(mesh)[on].T
    assert np.hypot(x, z - RADIUS) == pytest.approx(RADIUS, rel=1e-14)
    kept = np.abs(block.points[on, 0]) <= KEPT * RADIUS
    assert np.array_equal(x[kept], block.points[on, 0][kept])
    first, last = mesh.spec.loaded
    assert -KEPT * RADIUS <= first < -0.6 * RADIUS and 0.6 * RADIUS < last <= KEPT * RADIUS


@pytest.mark.parametrize(
    ("name", "share"),
    [("half", 0.5), *((f"hub {hub}", 1.0 - hub**2) for hub in HUBS)],
)
def test_area_of_the_disc(discs, name, share):
    assert curved_area(discs[name][1]) == pytest.approx(share * np.pi * RADIUS**2, rel=1e-4)


def test_half_a_disc_ends_at_its_diameter_and_the_other_near_the_place_opposite(discs):
    def outer(name):
        block, mesh = discs[name]
        off = np.maximum(np.abs(block.points[:, 0]), block.points[:, 1])
        return real_points(mesh)[off > mesh.spec.half_width * (1.0 - 1e-9)].T

    x, z = outer("half")
    assert z == pytest.approx(RADIUS, rel=1e-12)
    assert np.abs(x).max() == pytest.approx(RADIUS)
    x, z = outer("opposite")
    assert np.hypot(x, z - 2.0 * RADIUS) == pytest.approx(HELD_OPPOSITE * RADIUS, rel=0.2)


@pytest.mark.parametrize("hub", HUBS)
def test_a_ring_ends_at_its_hub_and_its_sides_meet(discs, hub):
    block, mesh = discs[f"hub {hub}"]
    real, spec = real_points(mesh), mesh.spec
    base = block.points[:, 1] > spec.depth * (1.0 - 1e-9)
    x, z = real[base].T
    assert np.hypot(x, z - RADIUS) == pytest.approx(np.full(base.sum(), hub * RADIUS), rel=1e-12)
    sides = np.abs(block.points[:, 0]) > spec.half_width * (1.0 - 1e-9)
    assert np.abs(real[sides, 0]).max() < 1e-12 * RADIUS
    assert real[sides, 1].min() >= RADIUS


def test_other_blocks_are_refused(discs):
    half = discs["half"][1]
    with pytest.raises(MeshError, match="only a flat block can become a ring"):
        ring(half, RADIUS)
    with pytest.raises(MeshError, match="as deep as its half-width"):
        disc(flat_block(2.0, 1.0), RADIUS)


WAVELENGTH = 0.5
EDGES_PER_WAVE = 20
SPEC = BlockSpec(10.0, 20.0, np.array([[-2.0, 2.0]]), WAVELENGTH / EDGES_PER_WAVE)
FINE_SPEC = BlockSpec(2.0, 4.0, np.array([[-2.0, 2.0]]), WAVELENGTH / EDGES_PER_WAVE)


@pytest.fixture(scope="module")
def even():
    return build_block(SPEC)


def sinusoid(rms_slope):
    k = 2.0 * np.pi / WAVELENGTH
    return lambda x: np.sqrt(2.0) * rms_slope / k * np.cos(k * x + 0.4)


def top(mesh):
    return mesh.points[:, 1] == 0.0


def test_top_nodes_lie_exactly_on_the_profile(even):
    height = sinusoid(0.1)
    mesh = roughen(even, height)
    x, z = real_points(mesh)[top(mesh)].T
    assert np.array_equal(z, -height(x))
    midpoints = top(mesh) & (np.arange(len(mesh.points)) > mesh.triangles[:, :3].max())
    assert midpoints.sum() == top(mesh).sum() // 2
    assert np.abs(mesh.shift[midpoints]).max() > 0.005
    assert np.array_equal(mesh.points, even.points) and not even.shift.any()


def test_base_stays_and_nothing_moves_more_than_the_profile(even):
    height = sinusoid(0.2)
    mesh = roughen(even, height)
    bottom = mesh.points[:, 1] == SPEC.depth
    assert not mesh.shift[bottom].any()
    assert np.abs(mesh.shift).max() <= np.abs(height(mesh.points[top(mesh), 0])).max() * 1.01
    deep = mesh.points[:, 1] > 3.0 * WAVELENGTH
    # A sinusoid has decayed to exp(-2 pi) there; the coarse sides add its aliases.
    assert np.abs(mesh.shift[deep & (np.abs(mesh.points[:, 0]) < 1.0)]).max() < 0.05 * 0.05


def test_area_is_that_of_the_block_plus_the_profile(even):
    height = sinusoid(0.1)
    mesh = roughen(even, height)
    x = np.sort(mesh.points[top(mesh), 0])
    start, middle, end = x[:-1:2], x[1::2], x[2::2]
    simpson = ((end - start) * (height(start) + 4 * height(middle) + height(end)) / 6.0).sum()
    block = 2.0 * SPEC.half_width * SPEC.depth
    assert curved_area(mesh) == pytest.approx(block + simpson, rel=1e-12)
    assert abs(simpson) > 1e-9 * block


def test_area_converges_to_the_integral_of_the_profile():
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
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.3)


@pytest.mark.parametrize("rms_slope", [0.02, 0.1, 0.3])
def test_elements_stay_right_side_out(even, rms_slope):
    mesh = roughen(even, sinusoid(rms_slope))
    assert determinants(mesh, AT).min() > 0.0
    assert quality_of(mesh)["least_jacobian"] > 0.25
    assert quality_of(mesh)["least_angle_degrees"] > 20.0


def test_corners_hold_the_least_determinant(even):
    mesh = roughen(even, sinusoid(0.3))
    inside = determinants(mesh, np.random.default_rng(0).dirichlet([1, 1, 1], 20)[:, :2])
    corners = corner_jacobians(real_points(mesh), mesh.triangles)
    at_corners = determinants(mesh, np.array([[0, 0], [1, 0], [0, 1]]))
    assert corners == pytest.approx(at_corners, rel=1e-9)
    assert (inside >= corners.min(axis=1, keepdims=True) * (1 - 1e-9)).all()
    assert (inside <= corners.max(axis=1, keepdims=True) * (1 + 1e-9)).all()


@pytest.mark.parametrize(("rms_slope", "hurst"), [(0.05, 0.8), (0.3, 0.8), (0.3, 0.3)])
def test_rough_profiles_of_many_wavelengths(even, rms_slope, hurst):
    trace = {"length": 2.02 * SPEC.half_width, "samples": 8193, "seed": 0}
    waves = {"rms_slope": rms_slope, "hurst": hurst, "shortest_wavelength": 0.25}
    mesh = roughen(even, self_affine(**trace, **waves).spline())
    assert quality_of(mesh)["least_jacobian"] > 0.15
    assert quality_of(mesh)["least_angle_degrees"] > 15.0


def test_slope_beyond_one_is_followed_where_the_surface_is_refined():
    mesh = roughen(build_block(FINE_SPEC), sinusoid(0.75))
    assert quality_of(mesh)["least_angle_degrees"] > 10.0
    assert determinants(mesh, AT).min() > 0.0


def test_constant_height_stretches_the_block_evenly(even):
    mesh = roughen(even, lambda x: np.full_like(x, 2.0))
    expected = -2.0 * (1.0 - even.points[:, 1] / SPEC.depth)
    assert mesh.shift[:, 1] == pytest.approx(expected, abs=1e-12)
    assert not mesh.shift[:, 0].any()


def test_shift_is_proportional_to_the_height(even):
    one, tenth = roughen(even, sinusoid(0.1)), roughen(even, sinusoid(0.01))
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
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2.0, abs=0.35)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize(
    ("height", "words"),
    [
        (sinusoid(3.0), r"inverts \d+ elements, the worst at x = .* slope is .* .steepest"),
        (lambda x: 0.2 * np.exp(-(((x - 0.75) / 0.02) ** 2)), r"x = 0\.7"),  # a spike
        (lambda x: np.full_like(x, -1.1 * SPEC.depth), "inverts"),
        (lambda x: x * np.nan, "one finite number for each x"),
        (lambda x: x[:-1], "one finite number for each x"),
    ],
)
def test_profiles_that_cannot_be_followed_are_refused(even, height, words):
    with pytest.raises(MeshError, match=words):
        roughen(even, height)
