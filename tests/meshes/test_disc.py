"""Discs: the sector, bent on its circle, and those that are held away from the contact; of their
area, fit to solve on up to the bounds."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

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
from meshes.real_shape import bent, roughen, rounded, sagitta

RADIUS = 2.0


def block(half_width=1.2, depth=1.0, size=0.02, growth=0.2):
    return build_block(BlockSpec(half_width, depth, np.array([[-0.2, 0.2]]), size, growth))


@cache
def even_block(size):
    """Edges of one size all along the surface and in the body."""
    return build_block(BlockSpec(1.2, 1.0, np.array([[-1.2, 1.2]]), size, 0.0))


@pytest.fixture(scope="module")
def flat():
    return block()


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
    assert from_centre(top)[0] == pytest.approx(np.full(on.sum(), RADIUS), rel=4e-16)
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


def test_area_is_that_of_the_sector(curved_area):
    exact = np.arcsin(1.2 / RADIUS) * (RADIUS**2 - (RADIUS - 1.0) ** 2)
    errors = []
    for size in (0.15, 0.075, 0.0375):
        area = curved_area(bent(even_block(size), RADIUS))
        errors.append(abs(area / exact - 1.0))
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.5)
    assert errors[-1] < 1e-6


@pytest.mark.parametrize(
    ("half_width", "depth", "growth"),
    [(1.6, 1.4, 0.1), (1.6, 1.4, 0.5), (1.6, 0.2, 0.2), (0.4, 1.4, 0.5), (1.4, 1.2, 0.2)],
)
def test_fit_to_solve_on_up_to_the_bounds(half_width, depth, growth, determinants):
    """0.8 of the radius wide to a side and 0.7 of it deep."""
    mesh = bent(block(half_width, depth, 0.005, growth), RADIUS)
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
    for mesh, radius in ((flat, RADIUS), (block(1.0, 1.0), 0.9)):
        with pytest.raises(MeshError, match=r"only a flat block as deep as .* can be rounded"):
            rounded(mesh, radius)


def test_rounded_about_the_contact():
    """Up to an arc about the contact, between rim and rim; rays divide the angle alike."""
    flat = build_block(BlockSpec(1.6, 1.6, np.array([[-0.2, 0.2]]), 0.02, 0.2))
    sector = rounded(flat, RADIUS)
    on = flat.points[:, 1] == 0.0
    places = real_points(sector)
    assert places[on, 0] == pytest.approx(flat.points[on, 0], abs=1e-14)
    assert from_centre(places[on])[0] == pytest.approx(np.full(on.sum(), RADIUS), rel=1e-14)
    outer = np.abs(np.abs(flat.points).max(axis=1) - 1.6) < 1e-12
    arc = np.hypot(1.6, sagitta(1.6, RADIUS))
    assert np.hypot(*places[outer].T) == pytest.approx(np.full(outer.sum(), arc), rel=1e-12)
    assert np.hypot(*places.T).max() < arc * (1.0 + 1e-12)
    middle = flat.points[:, 0] == 0.0
    assert np.all(places[middle, 0] == pytest.approx(0.0, abs=1e-14))
    corners = corner_jacobians(places, sector.triangles)
    assert corners.min() > 0.0
    lens = arc**2 * np.arccos(0.5 * arc / RADIUS) + RADIUS**2 * np.arccos(
        1.0 - 0.5 * (arc / RADIUS) ** 2
    )
    lens -= 0.5 * arc * np.sqrt(4.0 * RADIUS**2 - arc**2)
    assert 0.5 * corners.mean(axis=1).sum() == pytest.approx(lens, rel=2e-3)


HUBS = (0.02, 0.3, 0.9)


def flat_block(half_width: float, depth: float):
    return build_block(BlockSpec(half_width, depth, np.array([[-0.2, 0.2]]), 0.01, 0.2))


@pytest.fixture(scope="module")
def discs():
    """By name, the flat mesh and the disc's."""
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
    assert np.hypot(x, z - RADIUS) == pytest.approx(np.full(on.sum(), RADIUS), rel=1e-14)
    kept = np.abs(block.points[on, 0]) <= KEPT * RADIUS
    assert np.array_equal(x[kept], block.points[on, 0][kept])
    first, last = mesh.spec.loaded
    assert -KEPT * RADIUS <= first < -0.6 * RADIUS and 0.6 * RADIUS < last <= KEPT * RADIUS


@pytest.mark.parametrize(
    ("name", "share"),
    [("half", 0.5), *((f"hub {hub}", 1.0 - hub**2) for hub in HUBS)],
)
def test_area_of_the_disc(discs, name, share, curved_area):
    assert curved_area(discs[name][1]) == pytest.approx(share * np.pi * RADIUS**2, rel=1e-4)


def test_half_a_disc_ends_at_its_diameter_and_the_other_near_the_place_opposite(discs):
    for name, distance in (("half", None), ("opposite", HELD_OPPOSITE * RADIUS)):
        block, mesh = discs[name]
        size = mesh.spec.half_width
        outer = np.maximum(np.abs(block.points[:, 0]), block.points[:, 1]) > size * (1.0 - 1e-9)
        x, z = real_points(mesh)[outer].T
        if distance is None:
            assert z == pytest.approx(np.full(outer.sum(), RADIUS), rel=1e-12)
            assert np.abs(x).max() == pytest.approx(RADIUS)
        else:
            away = np.hypot(x, z - 2.0 * RADIUS)
            assert away.min() == pytest.approx(distance, rel=0.2)
            assert away.max() == pytest.approx(distance, rel=0.2)


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
