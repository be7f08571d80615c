"""The .msh file: read by meshio and gmsh as written, and back again."""

import json
import subprocess
import sys
import warnings

import meshio
import numpy as np
import pytest

from meshes.block import BlockSpec, MeshError, real_points
from meshes.build import build_block
from meshes.msh_file import read_msh, side_lines, write_msh
from meshes.real_shape import roughen

SPEC = BlockSpec(3.0, 4.0, np.array([[-1.0, 0.0], [0.5, 1.0]]), 0.1, 0.3, (-1.0, 1.0, 0.5, 0.1))


@pytest.fixture(scope="module")
def mesh():
    return roughen(build_block(SPEC), lambda x: 0.02 * np.cos(7.0 * x) + 0.01)


@pytest.fixture(scope="module")
def path(mesh, tmp_path_factory):
    path = tmp_path_factory.mktemp("mesh") / "mesh.msh"
    write_msh(mesh, path)
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
groups = gmsh.model.getPhysicalGroups()
print(json.dumps({{
    "log": gmsh.logger.get(),
    "names": sorted(gmsh.model.getPhysicalName(*group) for group in groups),
    "triangles": len(gmsh.model.mesh.getElementsByType(9)[0]),
    "least": min(gmsh.model.mesh.getElementQualities(
        gmsh.model.mesh.getElementsByType(9)[0], "minDetJac")),
}}))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    answer = json.loads(done.stdout.splitlines()[-1])
    assert not [line for line in answer["log"] if not line.startswith("Info")]
    assert answer["names"] == ["body", "bottom", "left", "right", "top"]
    assert answer["triangles"] == len(mesh.triangles)
    assert answer["least"] > 0.0


def test_round_trip(mesh, path):
    again = read_msh(path)
    assert np.array_equal(again.triangles, mesh.triangles)
    assert np.array_equal(again.shift, mesh.shift)
    assert again.points == pytest.approx(mesh.points, abs=1e-15)
    assert np.array_equal(again.points[:, 1] == 0.0, mesh.points[:, 1] == 0.0)
    assert np.array_equal(real_points(again)[:, 0], real_points(mesh)[:, 0])
    assert again.spec.window == SPEC.window
    assert np.array_equal(again.spec.intervals, SPEC.intervals)
    assert (again.spec.half_width, again.spec.depth) == (3.0, 4.0)
    assert (again.spec.surface_size, again.spec.growth) == (0.1, 0.3)
    shared = {key: value for key, value in mesh.quality.items() if key != "seconds"}
    assert again.quality == pytest.approx(shared, rel=1e-9)


def test_files_with_a_shift_in_z_alone_are_still_read(mesh, path, tmp_path):
    content = meshio.read(path)
    content.point_data["shift"] = content.point_data["shift"][:, 1]
    meshio.write(tmp_path / "former.msh", content, file_format="gmsh22", binary=True)
    with (tmp_path / "former.msh").open("ab") as file:
        file.write(b"\n$BlockSpec" + path.read_bytes().split(b"$BlockSpec")[1])
    again = read_msh(tmp_path / "former.msh")
    assert np.array_equal(again.shift, mesh.shift)
    assert again.points == pytest.approx(mesh.points, abs=1e-15)


@pytest.mark.parametrize("name", ["as thick as the contact", "uneven"])
def test_interface_and_vertices_come_back(name, built, tmp_path):
    spec, quality = built(name).spec, built(name).quality
    write_msh(built(name), tmp_path / "mesh.msh")
    again = read_msh(tmp_path / "mesh.msh")
    assert again.spec.interface == spec.interface
    assert np.array_equal(again.spec.vertices, spec.vertices)
    assert again.quality == pytest.approx({key: quality[key] for key in again.quality}, rel=1e-9)


def test_spec_of_numpy_numbers_and_without_a_window_comes_back(tmp_path):
    spec = BlockSpec(np.float64(1.0), np.float32(2.0), np.array([[0, 1]]), 0.25)
    mesh = build_block(spec)
    write_msh(mesh, tmp_path / "plain.msh")
    assert b"NodeData" not in (tmp_path / "plain.msh").read_bytes()  # of no shift
    again = read_msh(tmp_path / "plain.msh")
    assert np.array_equal(again.points, mesh.points) and not again.shift.any()
    assert again.spec.window is None
    assert again.spec.depth == 2.0


def test_same_mesh_same_file(mesh, path, tmp_path):
    write_msh(mesh, tmp_path / "again.msh")
    assert (tmp_path / "again.msh").read_bytes() == path.read_bytes()


def test_foreign_or_broken_file_is_refused(path, tmp_path):
    (tmp_path / "other.msh").write_bytes(b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
    with pytest.raises(MeshError, match="no block mesh"):
        read_msh(tmp_path / "other.msh")
    (tmp_path / "cut.msh").write_bytes(path.read_bytes()[:5000])
    with pytest.raises(MeshError, match="no block mesh"):
        read_msh(tmp_path / "cut.msh")
