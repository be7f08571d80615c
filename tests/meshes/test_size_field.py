"""Sizes wanted on an earlier mesh: spread, limited, and followed by the next mesh."""

from dataclasses import replace

import numpy as np
import pytest

from meshes.block import BlockSpec, unique_edges
from meshes.build import build_block
from meshes.size_field import MOST_CHANGE, SizeField, limited, size_field, triangle_sizes

PLAIN = BlockSpec(10.0, 10.0, np.array([[-1.0, 1.0]]), 0.125, 0.5)
COATED = replace(PLAIN, interface=0.2)
PLACE = np.array([3.0, 2.0])


@pytest.fixture(scope="module")
def first():
    return {"plain": build_block(PLAIN), "coated": build_block(COATED)}


def asked_around(mesh, least=0.1, growth=0.3):
    """Factors of the elements' sizes that ask for small ones around PLACE."""
    centre = mesh.points[mesh.triangles[:, :3]].mean(axis=1)
    return (least + growth * np.linalg.norm(centre - PLACE, axis=1)) / triangle_sizes(mesh)


def test_size_of_an_element_is_the_edge_of_an_equilateral_one(first):
    mesh = first["plain"]
    corner = mesh.points[mesh.triangles[:, :3]]
    edge = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2)
    ratio = triangle_sizes(mesh) / edge.mean(axis=1)
    assert ratio.max() < 1.0 + 1e-12
    assert np.median(ratio) > 0.95


def test_limited_sizes_grow_no_faster_and_are_no_smaller_than_they_must():
    rng = np.random.default_rng(0)
    x, z = (grid.ravel() for grid in np.meshgrid(np.arange(12.0), np.arange(9.0)))
    vertices = np.column_stack([x, z]) + rng.uniform(-0.2, 0.2, (len(x), 2))
    lower = (np.arange(8)[:, None] * 12 + np.arange(11)).ravel()
    triangles = np.concatenate(
        [
            np.column_stack([lower, lower + 1, lower + 13]),
            np.column_stack([lower, lower + 13, lower + 12]),
        ]
    )
    size = rng.uniform(0.1, 5.0, len(x))
    found = limited(vertices, triangles, size, 0.3)
    one, other = unique_edges(triangles)[0].T
    length = np.linalg.norm(vertices[one] - vertices[other], axis=1)
    assert (np.abs(found[one] - found[other]) <= 0.3 * length + 1e-12).all()
    assert (found <= size).all()
    held = found == size
    at_bound = np.zeros(len(x), dtype=bool)
    for a, b in ((one, other), (other, one)):
        at_bound[a[np.isclose(found[a], found[b] + 0.3 * length, rtol=1e-12)]] = True
    assert (held | at_bound).all()
    assert held.any() and not held.all()


def test_next_mesh_follows_the_sizes(first):
    mesh = first["plain"]
    field = size_field(mesh, asked_around(mesh), 0.3)
    finer = build_block(replace(PLAIN, growth=0.5), sizes=field)
    centre = finer.points[finer.triangles[:, :3]].mean(axis=1)
    near = np.linalg.norm(centre - PLACE, axis=1)
    # The first mesh cannot know more than that sizes fall by MOST_CHANGE.
    corner = field.size[field.triangles]
    asked = field.vertices[field.triangles].mean(axis=1)
    nearest = np.argmin(np.linalg.norm(asked[None] - centre[:, None], axis=2), axis=1)
    wanted = np.minimum(
        corner.mean(axis=1)[nearest],
        0.125 + 0.5 * np.hypot(np.maximum(0.0, np.abs(centre[:, 0]) - 1.0), centre[:, 1]),
    )
    ratio = triangle_sizes(finer) / wanted
    assert 0.85 < np.median(ratio[near < 4.0]) < 1.15
    assert np.quantile(ratio, 0.95) < 1.5
    assert len(finer.triangles) > 1.5 * len(mesh.triangles)
    assert finer.quality["least_angle_degrees"] > 20.0
    assert finer.quality["size_jump"] < 2.6


def test_factors_are_bounded(first):
    mesh = first["plain"]
    smallest = size_field(mesh, np.full(len(mesh.triangles), 1e-9), 10.0)
    largest = size_field(mesh, np.full(len(mesh.triangles), 1e9), 10.0)
    ratio = largest.size / smallest.size
    assert ratio == pytest.approx(MOST_CHANGE**2, rel=1e-9)


def test_sizes_larger_than_the_law_change_nothing(first):
    mesh = first["plain"]
    again = build_block(PLAIN, sizes=size_field(mesh, np.full(len(mesh.triangles), 4.0), 10.0))
    assert again.points.tobytes() == mesh.points.tobytes()


def test_coated_block_keeps_its_layers(first):
    mesh = first["coated"]
    field = size_field(mesh, np.full(len(mesh.triangles), 0.7), 0.5)
    finer = build_block(COATED, sizes=field)
    z = finer.points[finer.triangles[:, :3], 1]
    assert ((z <= 0.2).all(axis=1) | (z >= 0.2).all(axis=1)).all()
    assert 1.3 < len(finer.triangles) / len(mesh.triangles) < 2.6


def test_same_sizes_same_mesh_and_other_units_same_triangles(first):
    mesh = first["plain"]
    field = size_field(mesh, asked_around(mesh), 0.3)
    finer = build_block(PLAIN, sizes=field)
    assert build_block(PLAIN, sizes=field).points.tobytes() == finer.points.tobytes()
    factor = 3.7e-6
    spec = BlockSpec(10.0 * factor, 10.0 * factor, factor * PLAIN.intervals, 0.125 * factor, 0.5)
    scaled = SizeField(factor * field.vertices, field.triangles, factor * field.size)
    other = build_block(spec, sizes=scaled)
    assert np.array_equal(other.triangles, finer.triangles)
    assert other.points == pytest.approx(factor * finer.points, rel=1e-12, abs=1e-9 * factor)


def test_a_line_without_edges_is_refused(first):
    field = size_field(first["plain"], np.ones(len(first["plain"].triangles)), 0.5)
    with pytest.raises(ValueError, match="no edges along z = 3"):
        field.along(1, 3.14, np.array([0.0]))
