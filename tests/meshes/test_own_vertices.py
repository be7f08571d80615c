"""Given surface vertices: exact, followed by the sizes below."""

import numpy as np
import pytest
from blocks import GRADED, SPECS, of_kinds

from meshes.block import BlockSpec, MeshError
from meshes.build import build_block
from meshes.size_law import local_edges, own_vertices, point_size, wanted_size


def on_top(mesh):
    vertices = np.unique(mesh.triangles[:, :3])
    return np.sort(mesh.points[vertices][mesh.points[vertices, 1] == 0.0, 0])


@of_kinds("own vertices")
def test_vertices_are_nodes_and_nothing_is_between_but_what_cuts_edges(mesh):
    given, x = mesh.spec.vertices, on_top(mesh)
    inside = x[(x >= given[0]) & (x <= given[-1])]
    assert np.isin(given, inside).all()
    if mesh.spec.window is None and mesh.spec.interface is None and mesh.spec.depth > 1.0:
        assert np.array_equal(inside, given)
    else:
        added = np.setdiff1d(inside, given)
        assert len(added) > 0
        parts = (added - given[np.searchsorted(given, added) - 1]) / np.diff(given)[
            np.searchsorted(given, added) - 1
        ]
        count = np.bincount(np.searchsorted(given, added)) + 1
        whole = parts * count[np.searchsorted(given, added)]
        assert whole == pytest.approx(np.round(whole), abs=1e-6)


@of_kinds("own vertices")
def test_elements_at_the_surface_have_the_size_of_its_edges(mesh):
    corner = mesh.points[mesh.triangles[:, :3]]
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


@pytest.mark.parametrize("spec", SPECS["own vertices"].values(), ids=SPECS["own vertices"])
def test_both_forms_of_the_law_agree(spec):
    rng = np.random.default_rng(0)
    x = rng.choice([1.0, 0.1], 500) * rng.uniform(-spec.half_width, spec.half_width, 500)
    x = np.concatenate([x, spec.vertices])
    z = np.concatenate([spec.depth * rng.random(500) ** 3, np.zeros(len(spec.vertices))])
    size = point_size(spec)
    one_by_one = [size(*point) for point in zip(x.tolist(), z.tolist(), strict=True)]
    assert wanted_size(spec, x, z) == pytest.approx(one_by_one, rel=1e-12)


def test_edges_are_cut_into_the_fewest_parts_that_fit():
    spec = SPECS["own vertices"]["graded, thin"]
    edge = np.diff(own_vertices(spec))
    assert edge.max() <= 0.075
    given = np.diff(GRADED)
    assert len(edge) == np.ceil(given / 0.075 - 1e-9).sum()


@pytest.mark.parametrize(
    "vertices", [[0.0], [0.0, 0.0, 1.0], [0.0, 0.5], [0.0, np.nan, 1.0], [[0.0, 1.0]]]
)
def test_vertices_that_do_not_fit_the_interval_are_refused(vertices):
    spec = BlockSpec(20.0, 40.0, np.array([[0.0, 1.0]]), 0.5, vertices=np.array(vertices))
    with pytest.raises(MeshError, match="vertices must be"):
        build_block(spec)
