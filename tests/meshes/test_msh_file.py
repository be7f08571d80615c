"""The .msh file: read by meshio and gmsh as written."""

import json
import warnings

import meshio
import numpy as np
import pytest
import pyvista
from scenes import python

from meshes.block import BlockSpec, real_points
from meshes.build import build_block
from meshes.msh_file import side_lines, write_msh
from meshes.real_shape import roughen

SPEC = BlockSpec(3.0, 4.0, np.array([[-1.0, 0.0], [0.5, 1.0]]), 0.1, 0.3, (-1.0, 1.0, 0.5, 0.1))

NOTES = {"title": "Waves of 1 µm & <more>"}


@pytest.fixture(scope="module")
def mesh():
    return roughen(build_block(SPEC), lambda x: 0.02 * np.cos(7.0 * x) + 0.01)


@pytest.fixture(scope="module")
def path(mesh, tmp_path_factory):
    path = tmp_path_factory.mktemp("mesh") / "mesh.msh"
    write_msh(mesh, path, NOTES)
    return path


def test_meshio_reads_the_real_body_without_a_warning(mesh, path, capsys):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        file = meshio.read(path)
    out, err = capsys.readouterr()
    assert out.strip() == err == ""  # an empty line is what trying its other .msh format prints
    assert np.array_equal(file.points[:, :2], real_points(mesh))
    assert not file.points[:, 2].any()
    assert np.array_equal(file.cells_dict["triangle6"], mesh.triangles)
    assert np.array_equal(pyvista.read(path).points, file.points)
    assert NOTES["title"] in path.read_bytes().decode("utf-8", errors="replace")
    assert {name: int(tag[1]) for name, tag in file.field_data.items()} == {
        "top": 1, "right": 1, "bottom": 1, "left": 1, "body": 2
    }  # fmt: skip


def test_named_sides_lie_where_they_should(mesh, path):
    file = meshio.read(path)
    tags = file.cell_data_dict["gmsh:physical"]["line3"]
    lines = file.cells_dict["line3"]

    def nodes(name):
        return file.points[np.unique(lines[tags == file.field_data[name][0]])]

    assert (nodes("left")[:, 0] == -3.0).all() and (nodes("right")[:, 0] == 3.0).all()
    assert (nodes("bottom")[:, 1] == 4.0).all()
    x, z = nodes("top")[:, :2].T
    assert z == pytest.approx(-0.02 * np.cos(7.0 * x) - 0.01, abs=1e-15)
    assert (x.min(), x.max()) == (-3.0, 3.0)
    assert (file.cell_data_dict["gmsh:physical"]["triangle6"] == file.field_data["body"][0]).all()


def test_sides_are_chains_from_corner_to_corner(mesh):
    sides = side_lines(mesh)
    assert sum(map(len, sides.values())) * 2 == len(np.unique(np.concatenate([*sides.values()])))
    for line in sides.values():
        ends, uses = np.unique(line[:, :2], return_counts=True)
        assert sorted(uses)[:2] == [1, 1] and set(uses) <= {1, 2}
        corners = mesh.points[ends[uses == 1]]
        assert np.isin(corners[:, 0], [-3.0, 3.0]).all() and np.isin(corners[:, 1], [0, 4]).all()
        half = mesh.points[line[:, :2]].mean(axis=1)
        assert mesh.points[line[:, 2]] == pytest.approx(half, abs=1e-15)


def test_gmsh_opens_it_without_a_warning(mesh, path):
    # In a process of its own: gmsh keeps global state and may crash what it lives in.
    code = f"""
import gmsh, json
gmsh.initialize(argv=[], readConfigFiles=False, interruptible=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.logger.start()
gmsh.open({str(path)!r})
tags, points, _ = gmsh.model.mesh.getNodes()
[kind], [elements], [nodes] = gmsh.model.mesh.getElements(2)
groups = gmsh.model.getPhysicalGroups()
print(json.dumps({{
    "log": gmsh.logger.get(),
    "names": [gmsh.model.getPhysicalName(*group) for group in groups],
    "tags": tags.tolist(),
    "points": points.tolist(),
    "kind": int(kind),
    "nodes": nodes.tolist(),
    "views": len(gmsh.view.getTags()),
    "least": min(gmsh.model.mesh.getElementQualities(elements, "minDetJac")),
}}))
"""
    done = python("-c", code)
    answer = json.loads(done.stdout.splitlines()[-1])
    assert not [line for line in answer["log"] if not line.startswith("Info")]
    assert answer["names"] == ["top", "right", "bottom", "left", "body"]
    order = np.argsort(answer["tags"])
    assert np.array_equal(np.sort(answer["tags"]), np.arange(1, len(mesh.points) + 1))
    points = np.reshape(answer["points"], (-1, 3))[order]
    assert np.array_equal(points, np.pad(real_points(mesh), ((0, 0), (0, 1))))
    assert answer["kind"] == 9  # triangles of second order
    assert np.array_equal(np.reshape(answer["nodes"], (-1, 6)) - 1, mesh.triangles)
    assert answer["least"] > 0.0 and not answer["views"]


def test_same_mesh_same_file(mesh, path, tmp_path):
    write_msh(mesh, tmp_path / "again.msh", NOTES)
    assert (tmp_path / "again.msh").read_bytes() == path.read_bytes()
