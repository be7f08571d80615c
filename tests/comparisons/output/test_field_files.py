"""Fields and meshes as other programs open them: no complaint, equal values, all metadata."""

import base64
import json
from functools import partial

import meshio
import numpy as np
import pytest
import pyvista
from scenes import STEADY, changed, python

from analytic.exact.hertz import hertz_from_load, hertz_stress
from comparisons.common.provenance import versions
from comparisons.figures.quantity import MODELS
from comparisons.models.readings import stresses_at
from comparisons.output.arrays import levels_by_folder
from comparisons.output.field_files import CELL_TYPES, COMPONENTS, STRESSES, field_of, write_field
from comparisons.runs.write import write_contact, write_mesh


@pytest.fixture(scope="module")
def outcome(finish):
    """Rough steel, two friction coefficients, one with a decimal point."""
    tables = changed(STEADY, body={"poissons_ratio": 0.25}, stress={"points": [20, 10]})
    load = {"hertz_peak_pressure": 1e9, "friction": [0.0, 0.1]}
    return finish(tables | {"title": "Waves of 1 µm & <more>", "load": load})


@pytest.fixture(params=MODELS)
def field(outcome, request):
    return field_of(outcome, levels_by_folder(outcome)[request.param])


def quietly(program: str, *arguments: object) -> str:
    """Output of a program in a process that any warning ends."""
    done = python("-W", "error", "-c", program, *arguments)
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return done.stdout


def names(field) -> list[str]:
    """Names of the arrays: on the finite elements' mesh there are more."""
    named = [STRESSES]
    if field.cells.shape[1] == 3:  # triangles
        beside = "half_plane", "difference"
        named += [("displacement",), [f"{who}_{name}" for name in COMPONENTS for who in beside]]
    return [f"{name} (friction {mu})" for some in named for mu in ("0", "0.1") for name in some]


def written(field, folder):
    """The path of its file."""
    path = folder / "stress.vtu"
    write_field(path, field)
    return path


OPENED = """
import sys
import meshio, pyvista
for path in sys.argv[1:]:
    pyvista.read(path)
    meshio.read(path)
"""


def test_files_open_without_a_word_of_complaint(outcome, tmp_path, capfd):
    paths = []
    for model, levels in levels_by_folder(outcome).items():
        paths.append(tmp_path / f"{model}.vtu")
        write_field(paths[-1], field_of(outcome, levels))
    write_mesh(tmp_path / "mesh.msh", outcome, outcome.runs["finite_element"].finest.mesh)
    # meshio takes every .msh for one of Ansys first, and prints that reader's empty complaint
    assert quietly(OPENED, *paths, tmp_path / "mesh.msh").strip() == ""
    assert capfd.readouterr() == ("", "")


def test_vtu_in_meshio(field, tmp_path, monkeypatch):
    """Whose base64 the Pythons from 3.13.13 and 3.14.4 on decode: no padding but at the end."""
    monkeypatch.setattr(base64, "b64decode", partial(base64.b64decode, validate=True))
    mesh = meshio.read(written(field, tmp_path))
    assert list(mesh.point_data) == names(field)
    for name, values in field.arrays.items():
        assert np.array_equal(mesh.point_data[name], values)
    assert np.array_equal(mesh.points, field.points)
    (block,) = mesh.cells
    corners = {"triangle": 3, "quad": 4}[block.type]
    assert field.cells.shape[1] == corners and np.array_equal(block.data, field.cells)
    notes = {name: bytes(codes).decode() for name, codes in mesh.field_data.items()}
    assert notes == field.notes


def test_vtu_in_pyvista(field, tmp_path):
    from vtkmodules.vtkCommonCore import vtkDataArray

    grid = pyvista.read(written(field, tmp_path))
    assert sorted(grid.point_data) == sorted(names(field))
    for name in names(field):
        unit = "m" if name.startswith("displacement") else "1" if name.startswith("s1_") else "Pa"
        assert field.units[name] == unit
        assert np.array_equal(grid.point_data[name], field.arrays[name])
        information = grid.GetPointData().GetArray(name).GetInformation()
        assert information.Get(vtkDataArray.UNITS_LABEL()) == unit
    assert np.array_equal(grid.points, field.points)
    assert np.array_equal(grid.cells_dict[CELL_TYPES[field.cells.shape[1]]], field.cells)
    for name, text in field.notes.items():
        assert bytes(grid.field_data[name]).decode() == text


def test_notes_say_units_and_scene(outcome, field):
    assert field.notes["title"] == "Waves of 1 µm & <more>"
    posed = outcome.problem
    assert json.loads(field.notes["scene"]) == posed.surface.as_dict(posed.scene)
    assert json.loads(field.notes["units"]) == field.units
    assert list(field.units) == ["points", *names(field)] and field.units["points"] == "m"


def test_principal_directions_diagonalise_the_stress(field):
    for friction in ("0", "0.1"):
        sx, sz, txz, tau1, along = (
            field.arrays[f"{name} (friction {friction})"]
            for name in ("sx", "sz", "txz", "tau1", "s1_direction")
        )
        there = np.isfinite(tau1)
        x, z, y = along[there].T.astype(float)
        assert np.hypot(x, z) == pytest.approx(1.0, abs=1e-6) and not y.any()
        normal = (sx[there] * x + txz[there] * z) * x + (txz[there] * x + sz[there] * z) * z
        middle, size = 0.5 * (sx + sz)[there], np.abs(tau1[there]).max()
        assert normal == pytest.approx(middle + tau1[there], abs=float(1e-5 * size))


def test_one_file_holds_both_models_and_their_difference(outcome):
    """At the finite elements' nodes, against Hertz's closed form between the nodes of pressure."""
    problem, field = outcome.problem, field_of(outcome, levels_by_folder(outcome)["finite_element"])
    x, z, _ = field.points.T
    radius = problem.scene.roller.radius
    hertz = hertz_from_load(problem.hertz.load_per_length, radius, problem.modulus)
    for friction in (0.0, 0.1):
        exact = hertz_stress(hertz, x, z, friction)
        values = exact.sx, exact.sz, exact.sy(0.25), exact.txz, exact.tau1, exact.von_mises(0.25)
        for name, value in zip(COMPONENTS, values, strict=True):
            named = f"{name} (friction {friction:g})"
            half_plane = field.arrays[f"half_plane_{named}"]
            difference = field.arrays[f"difference_{named}"]
            assert np.abs(half_plane - value).max() < 2e-3 * hertz.peak_pressure
            assert half_plane - field.arrays[named] == pytest.approx(difference, rel=1e-5)


@pytest.mark.parametrize(
    ("model", "name", "finest", "coarsest"),
    [("half_plane", "sz", 1e-8, 6e-8), ("finite_element", "displacement", 4e-6, 7.7e-6)],
)
def test_numbers_are_as_fine_as_said(outcome, model, name, finest, coarsest):
    """Single precision, and 17 bits on a mesh: no coarser, and no larger in a file."""
    level = outcome.runs[model].finest
    field, mesh = field_of(outcome, levels_by_folder(outcome)[model]), level.field_on_mesh
    mesh = mesh and mesh.at_corners
    assert {a.dtype for a in (field.points, *field.arrays.values())} == {np.dtype(np.float32)}
    exact = level.stress.field.sz.ravel() if mesh is None else mesh.displacement[0.0]
    written = field.arrays[f"{name} (friction 0)"]
    written = written if mesh is None else written[:, :2]
    there = exact != 0.0
    assert finest < np.abs(written[there] / exact[there] - 1.0).max() < coarsest


def test_the_half_plane_has_no_stress_above_the_mean_line(outcome):
    level = outcome.runs["half_plane"].finest
    z = np.array([-1e-9, 0.0, 1e-6])
    stresses = stresses_at(outcome.problem, level, (0.1,), np.zeros(3), z)
    assert np.isnan(stresses[0.1].tau1).tolist() == [True, False, False]
    assert stresses[0.1].sz[1] == pytest.approx(-level.solution.pressure.max(), rel=1e-3)


def test_displacements_are_those_of_the_mesh_in_its_plane(outcome):
    field = field_of(outcome, levels_by_folder(outcome)["finite_element"])
    for friction in ("0", "0.1"):
        moved = field.arrays[f"displacement (friction {friction})"]
        assert moved == pytest.approx(1e-3 * field.points[:, [1, 0, 2]], rel=1e-5)


def test_the_mesh_is_saved_with_its_scene(outcome, tmp_path):
    """Of what other programs read of it: tests/meshes/test_msh_file.py."""
    mesh, path = outcome.runs["finite_element"].finest.mesh, tmp_path / "mesh.msh"
    write_mesh(path, outcome, mesh)
    real = np.column_stack([mesh.points + mesh.shift, np.zeros(len(mesh.points))])
    assert np.array_equal(meshio.read(path, file_format="gmsh").points, real)
    said = path.read_bytes().decode("utf-8", errors="replace")
    assert outcome.problem.scene.title in said


def test_contact_curves_have_units_in_their_header(outcome, tmp_path):
    level = outcome.runs["half_plane"].finest
    write_contact(tmp_path / "contact.csv", outcome, level)
    text, posed = (tmp_path / "contact.csv").read_text(encoding="utf-8"), outcome.problem
    made, scene, header, *rows = text.splitlines()
    assert made.startswith(f"# crosscheck {versions()['crosscheck']}")
    assert made.endswith(": Waves of 1 µm & <more>")
    assert json.loads(scene.removeprefix("# scene: ")) == posed.surface.as_dict(posed.scene)
    assert header == "x [m],pressure [Pa],gap [m],deformed height [m]"
    read = np.array([row.split(",") for row in rows], dtype=float)
    assert read[:, 0] == pytest.approx(level.grid.x, rel=1e-11)
    assert read[:, 1] == pytest.approx(level.solution.pressure, rel=1e-11)
