"""Blocks with a line across them that element edges follow, and with vertices of their own."""

from dataclasses import replace

import numpy as np
import pytest
from blocks import BLOCK, GRADED, SPECS, of_kinds, top_vertices

from meshes.block import BlockSpec, MeshError, unique_edges
from meshes.build import build_block
from meshes.coating import LAYERS, LONGEST, core, layer_size, stretched
from meshes.size_law import (
    estimate_unknowns,
    largest_size,
    local_edges,
    own_vertices,
    surface_edge,
    wanted_size,
)


def corners(mesh):
    return mesh.points[mesh.triangles[:, :3]]


@of_kinds("coating")
def test_no_element_crosses_the_interface_and_its_edges_follow_all_of_it(mesh, signed_areas):
    t, z = mesh.spec.interface, corners(mesh)[:, :, 1]
    above = (z <= t).all(axis=1)
    assert (above | (z >= t).all(axis=1)).all()
    assert signed_areas(mesh)[above].sum() == pytest.approx(
        2.0 * mesh.spec.half_width * t, rel=1e-12
    )
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    along = (mesh.points[edges, 1] == t).all(axis=1)
    length = np.abs(np.diff(mesh.points[edges[along], 0])).sum()
    assert length == pytest.approx(2.0 * mesh.spec.half_width, rel=1e-12)
    assert (np.bincount(edge_of.ravel())[along] == 2).all()


@of_kinds("coating")
def test_core_has_elements_across_and_no_more_than_it_takes(mesh, signed_areas):
    t, (low, high) = mesh.spec.interface, core(mesh.spec)
    corner, layer = corners(mesh), layer_size(mesh.spec)
    centre = corner.mean(axis=1)
    inside = (centre[:, 1] < t) & (centre[:, 0] > low) & (centre[:, 0] < high)
    size = np.sqrt(4.0 / np.sqrt(3.0) * signed_areas(mesh)[inside])
    assert size.max() < 1.3 * layer
    assert surface_edge(mesh.spec) <= layer * (1.0 + 1e-9)
    wanted = wanted_size(mesh.spec, *centre[inside].T)
    assert 0.8 < np.median(size / wanted) < 1.1


@of_kinds("coating")
def test_layers_beside_the_core_are_stretched_but_not_without_bound(mesh, signed_areas):
    beside = stretched(mesh)
    t, (low, high) = mesh.spec.interface, core(mesh.spec)
    exact = t * ((low + mesh.spec.half_width) + (mesh.spec.half_width - high))
    assert signed_areas(mesh)[beside].sum() == pytest.approx(exact, rel=1e-9, abs=1e-12)
    if beside.any():
        corner = corners(mesh)[beside]
        assert np.ptp(corner[..., 1], axis=1) == pytest.approx(t / LAYERS, rel=1e-9)
        width = np.ptp(corner[..., 0], axis=1)
        assert width.max() < 55.0 * t / LAYERS
        longest = min(LONGEST * t / LAYERS, 1.1 * largest_size(mesh.spec))
        assert width.max() < 1.1 * longest
        assert width.max() > 0.6 * min(longest, 0.2 * mesh.spec.growth * mesh.spec.half_width)


def test_number_of_unknowns_in_layers_is_estimated():
    """Half of them in the layers of a wide block with little contact."""
    mesh = build_block(BlockSpec(100.0, 200.0, np.array([[0.0, 0.05]]), 0.05, interface=0.15))
    assert stretched(mesh).sum() > 0.2 * len(mesh.triangles)
    assert estimate_unknowns(mesh.spec) == pytest.approx(2 * len(mesh.points), rel=0.12)


def test_a_thin_coating_costs_less_than_its_length_in_layers(built):
    mesh = built("thin coating")
    in_equal_elements = 2.0 * LAYERS * 2.0 * 18.5 / layer_size(mesh.spec)
    assert 0.01 < stretched(mesh).sum() / in_equal_elements < 0.05


@pytest.mark.parametrize("interface", [0.0, -1.0, 40.0, np.nan])
def test_interface_outside_the_block_is_refused(interface):
    with pytest.raises(MeshError, match="interface is"):
        build_block(replace(BLOCK, interface=interface))


@of_kinds("own vertices")
def test_vertices_are_nodes_and_nothing_is_between_but_what_cuts_edges(mesh):
    vertices, x = mesh.spec.vertices, top_vertices(mesh)
    inside = x[(x >= vertices[0]) & (x <= vertices[-1])]
    assert np.isin(vertices, inside).all()
    if mesh.spec.window is None and mesh.spec.interface is None and mesh.spec.depth > 1.0:
        assert np.array_equal(inside, vertices)
    else:
        added = np.setdiff1d(inside, vertices)
        assert len(added) > 0
        cut = np.searchsorted(vertices, added)
        parts = (added - vertices[cut - 1]) / np.diff(vertices)[cut - 1]
        whole = parts * (np.bincount(cut) + 1)[cut]
        assert whole == pytest.approx(np.round(whole), abs=1e-6)


@of_kinds("own vertices")
def test_elements_at_the_surface_have_the_size_of_its_edges(mesh):
    corner = corners(mesh)
    first, last = mesh.spec.vertices[[0, -1]]
    among = (corner[..., 0] >= first).all(axis=1) & (corner[..., 0] <= last).all(axis=1)
    corner = corner[among & ((corner[..., 1] == 0.0).sum(axis=1) == 2)]
    edge = np.array([np.ptp(c[c[:, 1] == 0.0, 0]) for c in corner])
    height = corner[..., 1].max(axis=1)
    assert 0.7 < np.median(height / edge) < 1.0
    assert (height / edge).max() < 2.0
    assert (height / edge).min() > 0.3


def test_size_law_follows_the_edges_down_and_beside_them():
    edges = local_edges(GRADED)
    spec = SPECS["own vertices"]["graded"]
    assert wanted_size(spec, GRADED, np.zeros_like(GRADED)) == pytest.approx(edges, rel=1e-14)
    assert wanted_size(spec, 0.0, 2.0) == pytest.approx(edges[len(edges) // 2] + 0.4)
    beyond = np.array([GRADED[-1] + 3.0, 4.0])
    assert wanted_size(spec, *beyond) == pytest.approx(edges[-1] + 0.2 * 5.0)


def test_edges_are_cut_into_the_fewest_parts_that_fit():
    spec = SPECS["own vertices"]["graded, thin"]
    edge = np.diff(own_vertices(spec))
    assert edge.max() <= 0.075
    spacing = np.diff(GRADED)
    assert len(edge) == np.ceil(spacing / 0.075 - 1e-9).sum()


@pytest.mark.parametrize(
    "vertices", [[0.0], [0.0, 0.0, 1.0], [0.0, 0.5], [0.0, np.nan, 1.0], [[0.0, 1.0]]]
)
def test_vertices_that_do_not_fit_the_interval_are_refused(vertices):
    spec = BlockSpec(20.0, 40.0, np.array([[0.0, 1.0]]), 0.5, vertices=np.array(vertices))
    with pytest.raises(MeshError, match="vertices must be"):
        build_block(spec)
