"""The block with a line across it that element edges follow: a coating and what lies below."""

from dataclasses import replace

import numpy as np
import pytest

from meshes.block import BlockSpec, MeshError, unique_edges
from meshes.build import build_block
from meshes.coating import LAYERS, LONGEST, core, layer_size, stretched, with_layers
from meshes.msh_file import read_msh, write_msh
from meshes.size_law import estimate_unknowns, largest_size, surface_edge, wanted_size

BLOCK = BlockSpec(20.0, 40.0, np.array([[-1.5, 1.5]]), 0.05)
PATCHES = np.array([[-1.5, -1.0], [0.3, 1.1]])

SPECS = {
    "as thick as the contact": replace(BLOCK, interface=1.0),
    "thin": replace(BLOCK, interface=0.03),
    "as thin as an edge": replace(BLOCK, intervals=PATCHES, interface=0.05),
    "thick": replace(BLOCK, interface=15.0),
    "nearly all": replace(BLOCK, interface=36.0),
    "under a window": replace(BLOCK, window=(-2.5, 1.0, 0.6, 0.04), interface=0.3),
    "steep": replace(BLOCK, growth=0.5, interface=0.2),
    "of one size": BlockSpec(1.0, 1.0, np.array([[-0.5, 0.0]]), 0.1, 0.0, interface=0.4),
    "to a side": BlockSpec(2.0, 8.0, np.array([[-1.9, 0.1]]), 0.05, interface=0.06),
}


def corners(mesh):
    return mesh.points[mesh.triangles[:, :3]]


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


def test_one_body_without_holes_stray_or_double_nodes(mesh, signed_areas):
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    vertices = np.unique(mesh.triangles[:, :3])
    assert len(vertices) - len(edges) + len(mesh.triangles) == 1
    assert len(np.unique(mesh.points, axis=0)) == len(mesh.points) == len(vertices) + len(edges)
    assert signed_areas(mesh).min() > 0.0
    exact = 2.0 * mesh.spec.half_width * mesh.spec.depth
    assert signed_areas(mesh).sum() == pytest.approx(exact, rel=1e-12)
    outer = mesh.points[edges[np.bincount(edge_of.ravel()) == 1]]
    on_side = [
        (outer[:, :, 1] == 0.0).all(axis=1),
        (outer[:, :, 1] == mesh.spec.depth).all(axis=1),
        (np.abs(outer[:, :, 0]) == mesh.spec.half_width).all(axis=1),
    ]
    assert (np.sum(on_side, axis=0) == 1).all()


def test_core_has_elements_across_and_no_more_than_it_takes(mesh, signed_areas):
    t, (low, high) = mesh.spec.interface, core(mesh.spec)
    corner, layer = corners(mesh), layer_size(mesh.spec)
    centre = corner.mean(axis=1)
    inside = (centre[:, 1] < t) & (centre[:, 0] > low) & (centre[:, 0] < high)
    size = np.sqrt(4.0 / np.sqrt(3.0) * signed_areas(mesh)[inside])
    assert size.max() < 1.3 * layer
    wanted = wanted_size(mesh.spec, *centre[inside].T)
    assert 0.8 < np.median(size / wanted) < 1.1


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


def test_multiples_of_the_surface_size_are_nodes(mesh):
    vertices = np.unique(mesh.triangles[:, :3])
    x = np.sort(mesh.points[vertices][mesh.points[vertices, 1] == 0.0, 0])
    for start, end in mesh.spec.intervals:
        inside = x[(x >= start) & (x <= end)]
        assert inside[0] == start and inside[-1] == end
        assert np.diff(inside) == pytest.approx(surface_edge(mesh.spec), rel=1e-6)
    assert surface_edge(mesh.spec) <= layer_size(mesh.spec) * (1.0 + 1e-9)


def test_fit_to_solve_on(mesh):
    assert mesh.quality["least_angle_degrees"] > 22.0
    assert mesh.quality["least_jacobian"] > 0.4
    assert mesh.quality["size_jump"] < 2.5
    assert mesh.quality["elements"] == len(mesh.triangles)


def test_number_of_unknowns_is_foretold(mesh):
    built = mesh.quality["unknowns"]
    assert estimate_unknowns(mesh.spec) == pytest.approx(built, rel=0.25)


def test_number_of_unknowns_in_layers_is_foretold():
    """Half of them in the layers of a wide block with little contact."""
    mesh = build_block(BlockSpec(100.0, 200.0, np.array([[0.0, 0.05]]), 0.05, interface=0.15))
    assert stretched(mesh).sum() > 0.2 * len(mesh.triangles)
    assert estimate_unknowns(mesh.spec) == pytest.approx(mesh.quality["unknowns"], rel=0.12)


def test_a_thin_coating_costs_less_than_its_length_in_layers(meshes):
    mesh = meshes["thin"]
    in_equal_elements = 2.0 * LAYERS * 2.0 * 18.5 / layer_size(mesh.spec)
    assert 0.01 < stretched(mesh).sum() / in_equal_elements < 0.05


def test_file_keeps_the_interface(meshes, tmp_path):
    mesh = meshes["as thick as the contact"]
    write_msh(mesh, tmp_path / "mesh.msh")
    read = read_msh(tmp_path / "mesh.msh")
    assert read.spec.interface == mesh.spec.interface
    same = {name: mesh.quality[name] for name in read.quality}
    assert read.quality == pytest.approx(same, rel=1e-9)


def test_same_input_same_mesh_and_other_units_same_triangles(meshes):
    mesh = meshes["as thin as an edge"]
    again = build_block(mesh.spec)
    assert again.points.tobytes() == mesh.points.tobytes()
    for factor in (1e-9, 3.7):
        spec = BlockSpec(
            factor * 20.0,
            factor * 40.0,
            factor * PATCHES,
            factor * 0.05,
            interface=factor * mesh.spec.interface,
        )
        scaled = build_block(spec)
        assert np.array_equal(scaled.triangles, mesh.triangles)
        assert scaled.points == pytest.approx(factor * mesh.points, rel=1e-12, abs=1e-9 * factor)


@pytest.mark.parametrize("interface", [0.0, -1.0, 40.0, np.nan])
def test_interface_outside_the_block_is_refused(interface):
    with pytest.raises(MeshError, match="interface is"):
        build_block(replace(BLOCK, interface=interface))


def test_layers_that_do_not_fit_are_refused():
    vertices = np.array([[0.0, 0.0], [0.0, 1.0], [1.0, 1.5]])
    with pytest.raises(MeshError, match="do not fit"):
        with_layers(vertices, np.empty((0, 3), dtype=int), 1.0, (np.array([0.0, 1.0]),))
