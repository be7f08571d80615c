"""Quality figures on elements whose figures are known, and the bounds that refuse bad ones."""

import numpy as np
import pytest

from meshes.block import BlockMesh, BlockSpec, MeshError, add_midpoints
from meshes.quality import check_quality, corner_jacobians, measure, quality_of

SPEC = BlockSpec(1.0, 1.0, np.array([[0.0, 1.0]]), 0.1)
HIGH = np.sqrt(3.0) / 2.0


def mesh_of(vertices, triangles, shift=None):
    points, triangles = add_midpoints(np.array(vertices, dtype=float), np.array(triangles))
    return BlockMesh(points, triangles, np.zeros_like(points) if shift is None else shift, SPEC)


def figures(*args):
    mesh = mesh_of(*args)
    return measure(mesh.points, mesh.triangles)


def test_equilateral_triangles_are_perfect():
    quality = figures([[0, 0], [1, 0], [0.5, HIGH], [1.5, HIGH]], [[0, 1, 2], [1, 3, 2]])
    assert quality["least_angle_degrees"] == pytest.approx(60.0)
    assert quality["least_jacobian"] == pytest.approx(1.0)
    assert quality["size_jump"] == pytest.approx(1.0)


def test_known_triangle():
    # Sides 3, 4, 5: least angle asin(3/5).
    quality = figures([[0, 0], [4, 0], [0, 3]], [[0, 1, 2]])
    assert quality["least_angle_degrees"] == pytest.approx(np.degrees(np.arcsin(0.6)))
    assert quality["least_jacobian"] == pytest.approx(2.0 / np.sqrt(3.0) * 0.6)


def test_size_jump_is_between_neighbours_only():
    vertices = [[0, 0], [1, 0], [0, 1], [4, 4], [20, 4]]
    quality = figures(vertices, [[0, 1, 2], [1, 3, 2], [1, 4, 3]])
    areas = np.array([0.5, 3.5, 32.0])
    assert quality["size_jump"] == pytest.approx(np.sqrt((areas[1:] / areas[:-1]).max()))


def test_curved_edge_lowers_the_jacobian_at_its_ends():
    mesh = mesh_of([[0, 0], [1, 0], [0.5, HIGH]], [[0, 1, 2]])
    double_area = corner_jacobians(mesh.points, mesh.triangles)
    assert double_area == pytest.approx(np.full((1, 3), HIGH))
    bent = mesh.points.copy()
    bent[mesh.triangles[0, 3], 1] += 0.1
    # The tangent at the ends turns by 4 b over the edge, seen against half the edge.
    lower = np.array([[HIGH - 0.2, HIGH - 0.2, HIGH]])
    assert corner_jacobians(bent, mesh.triangles) == pytest.approx(lower)


def test_inverted_element_is_refused():
    mesh = mesh_of([[0, 0], [0.5, HIGH], [1, 0]], [[0, 1, 2]])
    with pytest.raises(MeshError, match=r"least_jacobian is -1, .* x = 0\.5 m, z = 0\.288"):
        check_quality(mesh)


def test_bulge_that_turns_a_corner_inside_out_is_refused():
    flat = mesh_of([[0, 0], [1, 0], [0.5, HIGH]], [[0, 1, 2]])
    shift = np.zeros((6, 2))
    mesh = BlockMesh(flat.points, flat.triangles, shift, SPEC)
    shift[flat.triangles[0, 3], 1] = 0.3
    check_quality(mesh)
    shift[flat.triangles[0, 3], 1] = 0.5
    with pytest.raises(MeshError, match="least_jacobian"):
        check_quality(mesh)


def test_thin_element_is_refused_unless_allowed():
    """Its least angle is at the sharp corner."""
    mesh = mesh_of([[0, 0], [1, 0], [0.5, 0.1]], [[0, 1, 2]])
    with pytest.raises(MeshError, match=r"least_angle_degrees is 11\.3, the bound is 15"):
        check_quality(mesh)
    check_quality(mesh, least_angle_degrees=5.0)
    angle = quality_of(mesh)["least_angle_degrees"]
    assert angle == pytest.approx(np.degrees(np.arctan(0.2)))


def test_sudden_growth_is_refused():
    mesh = mesh_of([[0, 0], [0, 1], [0.27, 0.5], [-6, 0.5]], [[0, 2, 1], [0, 1, 3]])
    with pytest.raises(MeshError, match=r"size_jump is 4\.71, the bound is 4"):
        check_quality(mesh, least_angle_degrees=1.0)
