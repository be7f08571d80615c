"""Discs that are held away from the contact: on their circles, of their area, fit to solve on."""

import numpy as np
import pytest

from meshes.block import BlockSpec, MeshError, real_points
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

RADIUS = 2.0
HUBS = (0.02, 0.3, 0.9)


def flat(half_width: float, depth: float):
    return build_block(BlockSpec(half_width, depth, np.array([[-0.2, 0.2]]), 0.01, 0.2))


@pytest.fixture(scope="module")
def discs():
    """By name, the flat mesh and the disc's."""
    sizes = {"half": half_disc_size(RADIUS), "opposite": opposite_size(RADIUS)}
    blocks = {name: flat(size, size) for name, size in sizes.items()}
    made = {name: (block, disc(block, RADIUS)) for name, block in blocks.items()}
    for hub in HUBS:
        block = flat(*ring_size(RADIUS, hub * RADIUS))
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
        disc(flat(2.0, 1.0), RADIUS)
