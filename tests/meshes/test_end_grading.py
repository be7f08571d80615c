"""Vertices graded towards the ends of contact: where they lie and how long their edges are."""

import numpy as np
import pytest

from meshes.end_grading import BEYOND, OUTWARD, graded_vertices

ONE = np.array([[-1.0, 1.0]])
THREE = np.array([[-2.0, -1.2], [-1.15, 0.3], [1.0, 1.02]])
EDGES = np.array([8.0, 12.0, 5.0])


def place_of(x, vertices):
    at = np.flatnonzero(vertices == x)
    assert len(at) == 1, x
    return int(at[0])


@pytest.mark.parametrize("edges", [5, 8, 16, 40])
def test_patch_has_as_many_edges_as_asked_for_and_they_shrink_towards_its_ends(edges):
    x = graded_vertices(ONE, np.array([edges]))
    start, end = place_of(-1.0, x), place_of(1.0, x)
    assert end - start == 2 * edges
    wanted = 1.0 - np.linspace(1.0, 0.0, edges + 1) ** 2
    assert x[(start + end) // 2 : end + 1] == pytest.approx(wanted, abs=0.8 / edges**2)
    edge = np.diff(x[start : end + 1])
    assert edge[-1] * edges**2 == pytest.approx(1.0, abs=0.35)


def test_every_end_is_a_vertex_and_all_ascend():
    x = graded_vertices(THREE, EDGES)
    assert (np.diff(x) > 0.0).all()
    for end in THREE.ravel():
        place_of(end, x)
    assert x[0] == pytest.approx(-2.0 - BEYOND * 0.4)
    assert x[-1] == pytest.approx(1.02 + BEYOND * 0.01)


def test_edges_change_slowly_even_across_an_end():
    for patches, edges in ((ONE, np.array([20.0])), (THREE, EDGES)):
        edge = np.diff(graded_vertices(patches, edges))
        ratio = edge[1:] / edge[:-1]
        assert np.maximum(ratio, 1.0 / ratio).max() < 3.3


def test_in_a_gap_edges_grow_away_from_both_ends():
    x = graded_vertices(THREE, EDGES)
    gap = x[place_of(0.3, x) : place_of(1.0, x) + 1]
    edge, middle = np.diff(gap), 0.5 * (gap[:-1] + gap[1:])
    shortest = 0.725 / 12.0**2, 0.01 / 5.0**2
    wanted = np.minimum(
        shortest[0] + OUTWARD * (middle - 0.3), shortest[1] + OUTWARD * (1.0 - middle)
    )
    # The largest edge spans both slopes: its middle says little.
    assert np.quantile(edge / wanted, [0.1, 0.9]) == pytest.approx(1.0, abs=0.35)


def test_no_edge_inside_is_longer_than_the_largest():
    x = graded_vertices(THREE, EDGES, largest=0.03)
    middle = 0.5 * (x[:-1] + x[1:])
    inside = ((middle[:, None] > THREE[:, 0]) & (middle[:, None] < THREE[:, 1])).any(axis=1)
    assert 0.9 * 0.03 < np.diff(x)[inside].max() < 1.05 * 0.03
    assert len(x) > len(graded_vertices(THREE, EDGES))


def test_mirrored_patches_give_mirrored_vertices_and_units_do_not_matter():
    x = graded_vertices(THREE, EDGES)
    mirrored = graded_vertices(-THREE[::-1, ::-1], EDGES[::-1])
    # Rounding decides which cells of the integral are bisected once more.
    assert mirrored == pytest.approx(-x[::-1], abs=1e-3)
    assert graded_vertices(1e-6 * THREE, EDGES) == pytest.approx(1e-6 * x, abs=1e-9)
