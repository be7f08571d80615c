"""Files of other codes: what is in them is found, and what is wrong with them is said in a line."""

import shutil
import subprocess
import sys
import tomllib
from importlib.util import find_spec
from pathlib import Path

import meshio
import numpy as np
import pytest
import pyvista
from scenes import QUICK, problem, resolved

from analytic.exact.hertz import hertz_stress
from comparisons.campaigns.decks.write import make_deck
from comparisons.common.errors import InputError
from comparisons.scenes.scene import Scene
from comparisons.scenes.studies.answers import answers_named
from comparisons.studies.answers.meshes import _write_faces
from comparisons.studies.answers.read import read_answers
from meshes.block import structured


@pytest.fixture(scope="module")
def mesh(hertz):
    """A structured mesh of quadratic triangles, finer towards the contact."""
    fine = np.linspace(-1.5, 1.5, 31)
    far = 1.5 + 0.1 * np.cumsum(1.5 ** np.arange(1, 11))
    x = np.concatenate([-far[::-1], fine, far])
    z = np.concatenate([[0.0], np.cumsum(0.05 * 1.25 ** np.arange(22))])
    return structured(hertz.half_width * x, hertz.half_width * z)


@pytest.fixture(autouse=True)
def in_this_process(monkeypatch):
    """Whole files are read without another process, whose start takes far longer; a test that asks
    for one undoes it."""

    def here(command, **others):
        _, _, _, path, out, *step = command
        _write_faces(Path(path), Path(out), int(step[0]) if step else None)

    monkeypatch.setattr("comparisons.studies.answers.meshes.said_by", here)


def upright(mesh):
    """Points of the answer in a file, y out of the body."""
    return mesh.points @ [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]


def exact(mesh, hertz, friction=0.0):
    return hertz_stress(hertz, *mesh.points.T, friction)


def read(section, **changes):
    posed = problem(QUICK | changes | {"answers": {"other": section}})
    return read_answers(posed)["other"][-1]


def grid_of(points, triangles):
    """Quadratic triangles."""
    cells = np.column_stack([np.full(len(triangles), 6), triangles]).ravel()
    return pyvista.UnstructuredGrid(cells, np.full(len(triangles), 22), points)


def vtu(path, points, triangles, stress, name="S"):
    """A file with a tensor of six components, x y z xy yz xz."""
    grid = grid_of(points, triangles)
    grid[name] = stress
    grid.save(path)
    return {"file": str(path)}


def tensor(stress, vertical="y", sign=1.0):
    zero = np.zeros_like(stress.sx)
    if vertical == "y":
        return np.column_stack([stress.sx, stress.sz, zero, -sign * stress.txz, zero, zero])
    return np.column_stack([stress.sx, zero, stress.sz, zero, zero, -sign * stress.txz])


@pytest.fixture(scope="module")
def stress(mesh, hertz):
    """Hertz' exact one without friction, y up."""
    return tensor(exact(mesh, hertz))


def holds(answer, hertz, near=0.02):
    peak = answer.on(np.zeros(1))[0]
    assert peak == pytest.approx(hertz.peak_pressure, rel=near)
    assert answer.load == pytest.approx(hertz.load_per_length, rel=max(near, 0.01))
    assert answer.stress.extremes["tau1"].value == pytest.approx(hertz.tau1_max, rel=near)
    assert answer.stress.extremes["tau1"].z == pytest.approx(hertz.tau1_max_depth, rel=0.1)


@pytest.mark.parametrize("up", ["y", "-y", "z", "-z"])
def test_any_axis_may_point_out_of_the_body(mesh, hertz, tmp_path, up):
    sign = -1.0 if up.startswith("-") else 1.0
    (x, z), zero = mesh.points.T, np.zeros(len(mesh.points))
    columns = [x, -sign * z, zero] if up[-1] == "y" else [x, zero, -sign * z]
    stress = tensor(exact(mesh, hertz), up[-1], sign)
    section = vtu(tmp_path / "a.vtu", np.column_stack(columns), mesh.triangles, stress)
    for variant in (section, section | {"up": up}):
        answer = read(variant)
        holds(answer, hertz, near=2e-3)
        shown = answer.stress.field
        right = shown.txz[:, shown.txz.shape[1] * 3 // 4]
        known = exact(mesh, hertz).txz[(x > 0.0) & (z > 0.1 * hertz.half_width)]
        assert np.sign(np.nansum(right)) == np.sign(known.sum())


def test_friction_keeps_its_direction(mesh, hertz, tmp_path):
    """The shear on the top is minus the traction's: sliding that pulls towards +x."""
    stress = tensor(exact(mesh, hertz, 0.2))
    section = vtu(tmp_path / "a.vtu", upright(mesh), mesh.triangles, stress)
    answer = read(section, load=QUICK["load"] | {"friction": 0.2})
    middle = answer.stress.field.txz.shape[1] // 2
    expected = hertz_stress(hertz, np.zeros(1), np.full(1, 1e-9), 0.2).txz
    assert answer.stress.field.txz[0, middle] == pytest.approx(expected[0], rel=0.02)


def test_the_roller_in_the_same_file_is_left_out(mesh, stress, hertz, tmp_path):
    body = upright(mesh)
    points = np.vstack([body * [0.2, -0.2, 1.0], body])
    triangles = np.vstack([mesh.triangles, mesh.triangles + len(body)])
    section = vtu(tmp_path / "a.vtu", points, triangles, np.vstack([7.0 * stress, stress]))
    holds(read(section), hertz, near=2e-3)


@pytest.mark.parametrize("output", ["OUTPUT=2D", "OUTPUT=3D"])
def test_a_result_of_calculix(hertz, tmp_path, output):
    """Of a deck in two steps, half of the load and all of it: the last, unless another is asked
    for. Results are in the plane, or on the layer of wedges that CalculiX solves."""
    if shutil.which("ccx") is None:
        pytest.skip("no CalculiX: apt-get install calculix-ccx")
    pytest.importorskip("pyvista_frd", reason="no pyvista-frd-reader: pip install")
    few = {"finite_element": {"growth": 0.5, "block": 20.0}, "resolution": {"pitch": "80 um"}}
    make_deck(resolved(QUICK | few), "calculix", 1).write(tmp_path)
    job, load = tmp_path / "job.inp", f"{1e-3 * hertz.load_per_length:g}"
    head, star, step = job.read_text().replace("OUTPUT=2D", output).partition("*STEP")
    assert load in step
    half = step.replace(load, f"{0.5e-3 * hertz.load_per_length:g}")
    job.write_text(head + star + half + star + step)
    subprocess.run(["ccx", "job"], cwd=tmp_path, check=True, capture_output=True, timeout=120)
    section = tomllib.loads((tmp_path / "answer.toml").read_text())
    section["file"] = str(tmp_path / section["file"])
    holds(read(section), hertz, near=0.05)
    half = read(section | {"step": 0})
    assert half.load == pytest.approx(0.5 * hertz.load_per_length, rel=0.03)


def test_a_truncated_result_of_calculix(tmp_path):
    pytest.importorskip("pyvista_frd", reason="no pyvista-frd-reader: pip install")
    path = tmp_path / "cut.frd"
    path.write_text("    1C\n")
    with pytest.raises(InputError, match=r"cut\.frd: ends before its last line"):
        read({"file": str(path)})


def text(rows):
    return "x,p\n" + "\n".join(rows) + "\n"


UNKNOWN_NODE = """<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="S" NumberOfComponents="3" format="ascii">
1 2 3 4 5 6 7 8 9</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 -1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 987654321</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>"""
ROWS = [f"{x:g},{(1 - x**2) * 1e9:g}" for x in np.linspace(-1.0, 1.0, 11)]


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("a.csv", text([*ROWS[:4], "0.1,nan", *ROWS[4:]]), "line 6: holds no number"),
        ("a.csv", text([",".join(r.split(",")[::-1]) for r in ROWS]), "are they swapped"),
        ("a.csv", text([*ROWS, ROWS[-1]]), "x = 1 m twice"),
        ("a.csv", text(ROWS[:3]), "has 3 points"),
        ("a.csv", text([*ROWS[:-1], "1,1e308"]), r"beyond 1e\+30 in SI units"),
        ("a.csv", text([f"{k}e-300,{p}" for k, p in enumerate((1, 2, 4, 2, 1))]), "x = .* twice"),
        ("a.vtu", UNKNOWN_NODE, "on nodes that it has not|crashes on it"),
        ("a.csv", text([f"{x},0" for x in range(9)]), "no pressure but 0"),
        ("a.csv", "nothing here\n", "no row of numbers"),
        ("a.csv", text(ROWS).replace("x,p", "x [N],p"), r'column "x \[N\]" is "N", a force; allo'),
        (
            "a.csv",
            text(ROWS).replace("x,p", "x,p (mm)"),
            'is "mm", a length; allowed is a pressure',
        ),
        ("a.vtu", "<VTKFile", "at line 1.*; allowed is a whole result file|holds no mesh"),
        ("a.med", "not HDF", "cannot be read|not installed"),
        ("a.what", "?", "does not support"),
    ],
)
def test_what_cannot_be_read_is_said_in_one_line(
    tmp_path, capsys, monkeypatch, name, content, said
):
    monkeypatch.undo()
    path = tmp_path / name
    path.write_text(content)
    before = path.read_bytes()
    with pytest.raises(InputError, match=said) as raised:
        read({"file": str(path)})
    assert str(raised.value).startswith("answers.other.file: ") and "\n" not in str(raised.value)
    assert path.read_bytes() == before
    assert capsys.readouterr().err == ""


def test_a_body_that_is_not_in_a_plane(hertz, tmp_path):
    block = pyvista.ImageData(dimensions=(6, 6, 6), spacing=(1e-4,) * 3).cast_to_unstructured_grid()
    block["S"] = np.zeros((block.n_points, 6))
    block.save(tmp_path / "a.vtu")
    with pytest.raises(InputError, match="nodes stand in 6 planes"):
        read({"file": str(tmp_path / "a.vtu"), "up": "y"})


def test_missing_stresses_steps_and_frictions(mesh, stress, hertz, tmp_path):
    points = upright(mesh)
    section = vtu(tmp_path / "a.vtu", points, mesh.triangles, stress, "U")
    with pytest.raises(InputError, match="holds no stresses in its plane, of U"):
        read(section)
    with pytest.raises(InputError, match=r"allowed is friction = one of 0, 0\.1"):
        read(section, load=QUICK["load"] | {"friction": [0.0, 0.1]})
    moved = vtu(tmp_path / "b.vtu", points - [0, 1e-3, 0], mesh.triangles, stress)
    with pytest.raises(InputError, match=r"its surface lies 0\.001 m off the scene's"):
        read(moved)
    holds(read(moved | {"z_origin": -1e-3}), hertz, near=2e-3)


def test_components_in_an_exodus_file(mesh, hertz, tmp_path):
    """Components are in MOOSE's order, of which VTK takes the first two for a vector."""
    from vtkmodules.vtkIOExodus import vtkExodusIIWriter

    grid, stress = grid_of(upright(mesh), mesh.triangles), exact(mesh, hertz)
    named = {"stress_xx": stress.sx, "stress_xy": -stress.txz, "stress_yy": stress.sz}
    for name, values in named.items():
        grid[name] = values
    writer = vtkExodusIIWriter()
    writer.SetFileName(str(tmp_path / "a.e"))
    writer.SetInputData(grid)
    writer.Write()
    holds(read({"file": str(tmp_path / "a.e")}), hertz, near=2e-3)


def test_steps_of_xdmf(mesh, stress, hertz, tmp_path):
    with meshio.xdmf.TimeSeriesWriter(tmp_path / "a.xdmf", data_format="XML") as writer:
        writer.write_points_cells(upright(mesh), [("triangle6", mesh.triangles)])
        for time in (0.5, 1.0):
            writer.write_data(time, point_data={"S": time * stress})
    holds(read({"file": str(tmp_path / "a.xdmf")}), hertz, near=2e-3)
    half = read({"file": str(tmp_path / "a.xdmf"), "step": 0})
    assert half.load == pytest.approx(0.5 * hertz.load_per_length, rel=0.01)
    with pytest.raises(InputError, match="has 2 steps; allowed is a step from 0 to 1"):
        read({"file": str(tmp_path / "a.xdmf"), "step": 2})


def test_med_is_read_beside_another_hdf5(mesh, stress, hertz, tmp_path, monkeypatch):
    """Written in another process, too: dolfinx has loaded its own HDF5 into this one."""
    monkeypatch.undo()
    if find_spec("h5py") is None:
        pytest.skip("no h5py: pip install h5py")
    vtu(tmp_path / "a.vtu", upright(mesh), mesh.triangles, stress, "SIEF_NOEU")
    convert = "import pyvista; pyvista.save_meshio('a.med', pyvista.read('a.vtu'))"
    subprocess.run([sys.executable, "-c", convert], cwd=tmp_path, check=True)
    holds(read({"file": str(tmp_path / "a.med")}), hertz, near=2e-3)


def test_answers_on_the_command_line(tmp_path, complaint):
    (tmp_path / "a.csv").write_text(text(ROWS))
    (tmp_path / "a.toml").write_text('file = "a.csv"\nunits = {length = "mm"}\n')
    tables = answers_named([f"one={tmp_path / 'a.csv'}", f"two={tmp_path / 'a.toml'}"], None)
    answers = Scene.read("smooth").changed("answers", tables).answers
    one, two = answers["one"], answers["two"]
    assert one.file == two.file == (str(tmp_path / "a.csv"),)
    assert (one.unit("length"), two.unit("length")) == (1.0, 1e-3)
    both = answers_named([f"one={tmp_path / name}" for name in ("a.csv", "b.csv")], tables)
    assert len(both["one"]["file"]) == 2 and both["two"] == tables["two"]
    asked = "run", "smooth", "--answer", f"a={tmp_path}/no.csv", "--out", tmp_path / "out"
    assert "no.csv: there is no such file" in complaint(*asked)


@pytest.mark.parametrize(
    ("head", "units"),
    [
        ("x,p", {"length": "mm", "stress": "MPa"}),
        ("x [mm],p [MPa]", None),
        ("x_mm,p_N/mm2", None),
        ("# x / mm,p / MPa", None),
        ("Position (mm),p_MPa", None),
        ("x [um],p_max", {"length": "mm", "stress": "MPa"}),  # what is said beside the file counts
        ("x,p [MPa]", {"length": "mm"}),
    ],
)
def test_units_are_those_beside_the_file_or_of_its_columns(tmp_path, hertz, head, units):
    x = 1.2 * hertz.half_width * np.linspace(-1.0, 1.0, 101)
    rows = np.column_stack([1e3 * x, 1e-6 * hertz.pressure(x)])
    np.savetxt(tmp_path / "a.csv", rows, delimiter=",", header=head, comments="")
    answer = read({"file": str(tmp_path / "a.csv")} | ({"units": units} if units else {}))
    assert answer.x == pytest.approx(x) and answer.pressure == pytest.approx(hertz.pressure(x))
    assert answer.load == pytest.approx(hertz.load_per_length, rel=1e-3)


def test_units_on_the_command_line(tmp_path):
    (tmp_path / "a.csv").write_text(text(ROWS))
    for units in ("mm,MPa", " MPa, mm"):
        tables = answers_named([f"one={tmp_path / 'a.csv'}"], None, units)
        assert tables["one"]["units"] == {"length": "mm", "stress": "MPa"}
    assert answers_named(["one=a.csv"], None, "mm")["one"]["units"] == {"length": "mm"}
