"""The flat mesh: exact geometry, topology, size law, quality, repeatability, number of unknowns."""

from dataclasses import replace

import numpy as np
import pytest
from blocks import WINDOW, of_kinds, top_vertices

from meshes.block import BlockSpec, MeshError, unique_edges
from meshes.build import build_block
from meshes.quality import corner_jacobians, quality_of
from meshes.size_law import estimate_unknowns, largest_size, surface_edge, wanted_size

every = of_kinds("equal edges", "own vertices", "coating")


def boundary_edges(mesh):
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    uses = np.bincount(edge_of.ravel(), minlength=len(edges))
    return edges, uses


@every
def test_area_is_that_of_the_block(mesh, signed_areas):
    areas = signed_areas(mesh)
    assert areas.min() > 0.0
    exact = 2.0 * mesh.spec.half_width * mesh.spec.depth
    assert areas.sum() == pytest.approx(exact, rel=1e-12)
    assert not mesh.shift.any()


@every
def test_every_edge_inside_has_two_triangles_and_on_the_sides_one(mesh):
    edges, uses = boundary_edges(mesh)
    assert set(np.unique(uses)) == {1, 2}
    outer = mesh.points[edges[uses == 1]]
    half, depth = mesh.spec.half_width, mesh.spec.depth
    on_side = [
        (outer[:, :, 1] == 0.0).all(axis=1),
        (outer[:, :, 1] == depth).all(axis=1),
        (outer[:, :, 0] == -half).all(axis=1),
        (outer[:, :, 0] == half).all(axis=1),
    ]
    assert (np.sum(on_side, axis=0) == 1).all()
    lengths = np.linalg.norm(outer[:, 1] - outer[:, 0], axis=1)
    sides = [lengths[side].sum() for side in on_side]
    assert sides == pytest.approx([2 * half, 2 * half, depth, depth], rel=1e-12)


@every
def test_simply_connected_without_stray_or_double_nodes(mesh):
    edges, _ = boundary_edges(mesh)
    vertices = np.unique(mesh.triangles[:, :3])
    assert len(vertices) - len(edges) + len(mesh.triangles) == 1  # Euler characteristic
    assert np.array_equal(np.unique(mesh.triangles), np.arange(len(mesh.points)))
    assert len(mesh.points) == len(vertices) + len(edges)
    assert len(np.unique(mesh.points, axis=0)) == len(mesh.points)


@every
def test_midpoints_halve_their_edges(mesh):
    for k, (i, j) in enumerate([(0, 1), (1, 2), (2, 0)]):
        ends = mesh.points[mesh.triangles[:, [i, j]]]
        assert np.array_equal(mesh.points[mesh.triangles[:, 3 + k]], ends.mean(axis=1))


@of_kinds("equal edges", "coating")
def test_refined_ranges_have_equal_edges_and_both_ends(mesh):
    x = top_vertices(mesh)
    h = surface_edge(mesh.spec)
    for start, end in mesh.spec.intervals:
        inside = x[(x >= start) & (x <= end)]
        assert inside[0] == start and inside[-1] == end
        assert np.diff(inside) == pytest.approx(h, rel=1e-6)


@of_kinds("equal edges", "coating")
def test_multiples_of_the_surface_size_are_nodes(mesh):
    x = top_vertices(mesh)
    size = mesh.spec.surface_size
    for start, end in mesh.spec.intervals:
        wanted = start + size * np.arange(round((end - start) / size) + 1)
        nearest = np.abs(wanted[:, None] - x[None, :]).min(axis=1)
        assert nearest.max() < 1e-6 * size


@of_kinds("equal edges")
def test_edges_follow_the_size_law(mesh):
    edges, _ = boundary_edges(mesh)
    ends = mesh.points[edges]
    middle = ends.mean(axis=1)
    ratio = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / wanted_size(mesh.spec, *middle.T)
    # A growth of 0.5 changes the size by half within one edge: its middle says little.
    slack = 0.2 * mesh.spec.growth
    assert 0.85 - slack < np.median(ratio) < 1.08
    assert np.quantile(ratio, 0.05) > 0.66 - slack
    assert np.quantile(ratio, 0.95) < 1.35
    assert ratio.max() < 1.6


@every
def test_fit_to_solve_on(mesh):
    own_vertices = mesh.spec.vertices is not None
    assert quality_of(mesh)["least_angle_degrees"] > (20.0 if own_vertices else 22.0)
    assert quality_of(mesh)["least_jacobian"] > 0.4
    assert quality_of(mesh)["size_jump"] < (2.6 if own_vertices else 2.5)
    assert corner_jacobians(mesh.points, mesh.triangles).min() > 0.0


@every
def test_number_of_unknowns_is_estimated(mesh):
    assert estimate_unknowns(mesh.spec) == pytest.approx(2 * len(mesh.points), rel=0.25)


def test_elements_in_the_window_are_small(built, signed_areas):
    mesh = built("window")
    x0, x1, z1, size = WINDOW
    centre = mesh.points[mesh.triangles[:, :3]].mean(axis=1)
    inside = (centre[:, 0] > x0) & (centre[:, 0] < x1) & (centre[:, 1] < z1)
    equilateral_edge = np.sqrt(4.0 / np.sqrt(3.0) * signed_areas(mesh)[inside])
    assert np.median(equilateral_edge) < size
    assert np.quantile(equilateral_edge, 0.95) < 1.15 * size
    assert equilateral_edge.max() < 1.5 * size
    beside = (centre[:, 1] > z1 + 2.0) & (centre[:, 1] < z1 + 4.0) & (np.abs(centre[:, 0]) < 1.0)
    coarse = np.sqrt(4.0 / np.sqrt(3.0) * signed_areas(mesh)[beside])
    assert coarse.min() > 5.0 * size


def test_thin_block_has_elements_through_it(built):
    for name in ("thin layer", "thinner than an edge"):
        mesh = built(name)
        corner = mesh.points[mesh.triangles[:, :3], 1]
        assert np.ptp(corner, axis=1).max() <= 1.4 * largest_size(mesh.spec)


@pytest.mark.parametrize("name", ["asperities", "window", "graded", "as thin as an edge"])
def test_same_input_same_mesh(name, built):
    again, mesh = build_block(built(name).spec), built(name)
    assert again.points.tobytes() == mesh.points.tobytes()
    assert again.triangles.tobytes() == mesh.triangles.tobytes()


@pytest.mark.parametrize("name", ["half-plane", "graded", "as thin as an edge"])
def test_other_units_same_triangles(name, built):
    mesh = built(name)
    spec = mesh.spec
    for factor in (1e-9, 3.7, 1e6):
        scaled = replace(
            spec,
            half_width=factor * spec.half_width,
            depth=factor * spec.depth,
            intervals=factor * spec.intervals,
            surface_size=factor * spec.surface_size,
            interface=spec.interface and factor * spec.interface,
            vertices=None if spec.vertices is None else factor * spec.vertices,
        )
        other = build_block(scaled)
        assert np.array_equal(other.triangles, mesh.triangles)
        assert other.points == pytest.approx(factor * mesh.points, rel=1e-12, abs=1e-9 * factor)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"depth": 0.0}, "depth is 0.0"),
        ({"growth": 0.6}, "allowed is 0 to 0.5"),
        ({"intervals": np.empty((0, 2))}, "at least one row"),
        ({"intervals": np.array([[0.0, 1.0], [0.5, 1.5]])}, "ascending and disjoint"),
        ({"intervals": np.array([[0.0, 30.0]])}, "the block to 20"),
        ({"intervals": np.array([[0.0, 0.42]])}, "whole number"),
        ({"intervals": np.array([[0.0, 0.1], [0.11, 0.16]])}, "leave none"),
        ({"intervals": np.array([[19.0, 19.95]]), "half_width": 19.96}, "leave none"),
        ({"window": (1.0, 0.0, 1.0, 0.1)}, "x0 < x1"),
    ],
)
def test_impossible_request_is_refused_in_words(change, words):
    block = {"half_width": 20.0, "depth": 40.0, "intervals": np.array([[0.0, 1.0]])}
    spec = BlockSpec(**(block | {"surface_size": 0.05} | change))
    with pytest.raises(MeshError, match=words):
        build_block(spec)
