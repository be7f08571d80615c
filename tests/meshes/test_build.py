"""The flat mesh: exact geometry, topology, size law with its growth, caps and integrals, quality,
repeatability, number of unknowns; lines across it that edges follow, and vertices of its own."""

from dataclasses import replace

import numpy as np
import pytest
from blocks import GRADED, SPECS, WINDOW, block, of_kinds, top_vertices

from meshes.block import BlockSpec, MeshError, unique_edges
from meshes.build import build_block
from meshes.coating import LAYERS, LONGEST, core, layer_size, stretched
from meshes.quality import corner_jacobians, quality_of
from meshes.size_law import (
    edges_per_size,
    estimate_unknowns,
    largest_size,
    local_edges,
    own_vertices,
    point_size,
    sum_of_integrals,
    surface_edge,
    uncapped_size,
    wanted_size,
)

every = of_kinds("equal edges", "own vertices", "coating")


def edges_of(mesh):
    """Edges (e, 2) by their vertices, and how many triangles have each."""
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    return edges, np.bincount(edge_of.ravel())


def corners(mesh):
    return mesh.points[mesh.triangles[:, :3]]


def signed_areas(mesh):
    """Areas (m,) of the straight triangles of a flat mesh."""
    corner = corners(mesh)
    u, v = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])


def equilateral_edges(areas):
    return np.sqrt(4.0 / np.sqrt(3.0) * areas)


@every
def test_area_is_that_of_the_block(mesh):
    areas = signed_areas(mesh)
    assert areas.min() > 0.0
    exact = 2.0 * mesh.spec.half_width * mesh.spec.depth
    assert areas.sum() == pytest.approx(exact, rel=1e-12)
    assert not mesh.shift.any()


@every
def test_every_edge_inside_has_two_triangles_and_on_the_sides_one(mesh):
    edges, uses = edges_of(mesh)
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
    edges, _ = edges_of(mesh)
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
    ends = mesh.points[edges_of(mesh)[0]]
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


def test_elements_in_the_window_are_small(built):
    mesh = built("window")
    x0, x1, z1, size = WINDOW
    (x, z), edge = corners(mesh).mean(axis=1).T, equilateral_edges(signed_areas(mesh))
    inside = edge[(x > x0) & (x < x1) & (z < z1)]
    assert np.median(inside) < size
    assert np.quantile(inside, 0.95) < 1.15 * size
    assert inside.max() < 1.5 * size
    beside = edge[(z > z1 + 2.0) & (z < z1 + 4.0) & (np.abs(x) < 1.0)]
    assert beside.min() > 5.0 * size


def test_thin_block_has_elements_through_it(built):
    for name in ("thin layer", "thinner than an edge"):
        mesh = built(name)
        assert np.ptp(corners(mesh)[..., 1], axis=1).max() <= 1.4 * largest_size(mesh.spec)


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
        *(({"interface": z}, "interface is") for z in (0.0, -1.0, 40.0, np.nan)),
        *(
            ({"surface_size": 0.5, "vertices": np.array(x)}, "vertices must be")
            for x in ([0.0], [0.0, 0.0, 1.0], [0.0, 0.5], [0.0, np.nan, 1.0], [[0.0, 1.0]])
        ),
    ],
)
def test_impossible_request_is_refused_in_words(change, words):
    spec = replace(BlockSpec(20.0, 40.0, np.array([[0.0, 1.0]]), 0.05), **change)
    with pytest.raises(MeshError, match=words):
        build_block(spec)


@of_kinds("coating")
def test_no_element_crosses_the_interface_and_its_edges_follow_all_of_it(mesh):
    t, z = mesh.spec.interface, corners(mesh)[:, :, 1]
    above = (z <= t).all(axis=1)
    assert (above | (z >= t).all(axis=1)).all()
    width = 2.0 * mesh.spec.half_width
    assert signed_areas(mesh)[above].sum() == pytest.approx(width * t, rel=1e-12)
    edges, uses = edges_of(mesh)
    along = (mesh.points[edges, 1] == t).all(axis=1)
    length = np.abs(np.diff(mesh.points[edges[along], 0])).sum()
    assert length == pytest.approx(width, rel=1e-12)
    assert (uses[along] == 2).all()


@of_kinds("coating")
def test_core_has_elements_across_and_no_more_than_it_takes(mesh):
    t, (low, high) = mesh.spec.interface, core(mesh.spec)
    centre, layer = corners(mesh).mean(axis=1), layer_size(mesh.spec)
    inside = (centre[:, 1] < t) & (centre[:, 0] > low) & (centre[:, 0] < high)
    size = equilateral_edges(signed_areas(mesh)[inside])
    assert size.max() < 1.3 * layer
    assert surface_edge(mesh.spec) <= layer * (1.0 + 1e-9)
    wanted = wanted_size(mesh.spec, *centre[inside].T)
    assert 0.8 < np.median(size / wanted) < 1.1


@of_kinds("coating")
def test_layers_beside_the_core_are_stretched_but_not_without_bound(mesh):
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


INTERVALS = np.array([[-3.0, -1.0], [-0.5, 0.0], [0.0, 0.5], [2.0, 2.25]])
PLAIN = BlockSpec(50.0, 100.0, INTERVALS, 0.25, 0.2)
WINDOWED = BlockSpec(50.0, 100.0, INTERVALS, 0.25, 0.2, (-4.0, 4.0, 2.0, 0.3))
THIN = BlockSpec(50.0, 0.6, INTERVALS, 0.25, 0.2)


def random_points(n, spec, seed=0):
    rng = np.random.default_rng(seed)
    x = rng.choice([1.0, 0.1], n) * rng.uniform(-spec.half_width, spec.half_width, n)
    return x, spec.depth * rng.random(n) ** 3


def test_distance_is_that_to_the_nearest_interval():
    x, z = random_points(400, PLAIN)
    nearest = np.clip(x[:, None], INTERVALS[:, 0], INTERVALS[:, 1])
    distance = np.hypot(nearest - x[:, None], z[:, None]).min(axis=1)
    assert uncapped_size(PLAIN, x, z) == pytest.approx(0.25 + 0.2 * distance, rel=1e-14)


@pytest.mark.parametrize("spec", [PLAIN, WINDOWED, THIN, *SPECS["own vertices"].values()])
def test_both_forms_agree(spec):
    x, z = random_points(500, spec)
    ends = INTERVALS.ravel() if spec.vertices is None else spec.vertices
    x = np.concatenate([x, ends, [-spec.half_width, spec.half_width]])
    z = np.concatenate([z, np.zeros(len(ends) + 2)])
    size = point_size(spec)
    one_by_one = [size(*point) for point in zip(x.tolist(), z.tolist(), strict=True)]
    accuracy = 1e-14 if spec.vertices is None else 1e-12
    assert wanted_size(spec, x, z) == pytest.approx(one_by_one, rel=accuracy)


@pytest.mark.parametrize("spec", [PLAIN, WINDOWED])
def test_grows_no_faster_than_asked_for(spec):
    x, z = random_points(2000, spec, seed=1)
    step = np.random.default_rng(2).normal(scale=0.5, size=(2, len(x)))
    change = np.abs(wanted_size(spec, x + step[0], z + np.abs(step[1])) - wanted_size(spec, x, z))
    assert (change <= spec.growth * np.hypot(*step) + 1e-12).all()
    assert (change > 0.9 * spec.growth * np.hypot(*step)).any()


def test_window_caps_the_size_and_nothing_is_larger_for_it():
    x, z = random_points(4000, WINDOWED, seed=3)
    windowed, plain = wanted_size(WINDOWED, x, z), wanted_size(PLAIN, x, z)
    inside = (np.abs(x) <= 4.0) & (z <= 2.0)
    assert inside.any()
    assert windowed[inside].max() <= 0.3
    assert (windowed <= plain).all()
    assert (windowed[~inside] > 0.3).any()
    assert wanted_size(WINDOWED, 7.0, 6.0) == pytest.approx(0.3 + 0.2 * 5.0)


def test_thin_block_caps_the_size_and_cuts_the_edges_into_whole_parts():
    assert largest_size(THIN) == pytest.approx(0.15)
    assert largest_size(BlockSpec(0.5, 100.0, np.array([[-0.1, 0.1]]), 0.1)) == 0.25  # narrow
    assert edges_per_size(THIN) == 2
    assert surface_edge(THIN) == 0.125
    assert wanted_size(THIN, 40.0, 0.5) == pytest.approx(0.15)
    assert edges_per_size(PLAIN) == 1


def test_an_edge_that_just_fits_is_not_cut():
    for depth in (0.7, 1.1, 3.3):
        assert edges_per_size(BlockSpec(50.0, depth, INTERVALS, depth / 4)) == 1
        assert edges_per_size(BlockSpec(50.0, depth, INTERVALS, depth / 4 * 1.01)) == 2
        assert edges_per_size(BlockSpec(50.0, depth, INTERVALS, depth / 4 * 3)) == 3


def test_integral_of_a_constant_size_is_exact():
    spec = block(3.0, 2.0, [[-1.0, 1.0]], 0.1, growth=0.0)
    box = [-3.0, 3.0, 0.0, 2.0]
    assert sum_of_integrals(spec, [box], [1.0]) == pytest.approx(12.0 / 0.01, rel=1e-12)
    assert sum_of_integrals(spec, [[-3.0, 3.0, 0.0, 0.0]], [1.0]) == pytest.approx(60.0, rel=1e-12)


def test_integrals_of_a_linear_size():
    """Along a side, and over the block."""
    spec, far = block(50.0, 1000.0, [[-50.0, 50.0]], 0.1), 0.1 + 0.2 * 100.0  # below it is capped
    side = sum_of_integrals(spec, [[50.0, 50.0, 0.0, 100.0]], [1.0])
    assert side == pytest.approx(np.log(far / 0.1) / 0.2, rel=1e-3)
    whole = sum_of_integrals(spec, [[-50.0, 50.0, 0.0, 100.0]], [1.0])
    assert whole == pytest.approx(100.0 * (1.0 / 0.1 - 1.0 / far) / 0.2, rel=2e-2)


def test_blocks_too_large_to_build_are_estimated():
    assert estimate_unknowns(block(0.2, 1.0, [[-0.1, 0.1]], 1e-6)) > 1e6
    assert estimate_unknowns(block(1000.0, 1e-2, [[-1.0, 1.0]], 0.01)) > 1e7


@pytest.mark.parametrize(
    ("depth", "size", "words"),
    [
        (-1.0, 0.1, "depth"),
        # each halving of the boxes doubles them: it would take all memory
        (1.0, 1e-12, r"elements of 1e-12 m in a body of 1 m are too many"),
    ],
)
def test_what_is_beyond_counting_is_refused(depth, size, words):
    with pytest.raises(MeshError, match=words):
        estimate_unknowns(block(1.0, depth, [[-0.5, 0.5]], size))
