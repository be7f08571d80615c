"""What the doctor tries: programs that print a version where an item works, and fail otherwise."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Trial:
    """A program that prints the version of an item if the item works, and fails otherwise."""

    name: str
    program: str
    remedy: str
    before: tuple[str, ...] = ()  # what to start the interpreter with


TRIALS = (
    Trial(
        "numpy",
        """
import numpy
assert numpy.linalg.norm(numpy.array([3.0, 4.0])) == 5.0, "its linear algebra is wrong"
print(numpy.__version__)
""",
        "apt-get install python3-numpy (dolfinx needs Debian's), and pip uninstall numpy.",
    ),
    Trial(
        "scipy",
        """
import numpy, scipy, scipy.fft, scipy.linalg
values = numpy.arange(8.0)
assert abs(scipy.fft.irfft(scipy.fft.rfft(values)) - values).max() < 1e-12, "its FFT is wrong"
assert scipy.linalg.solve([[2.0]], [4.0]) == 2.0, "its linear algebra is wrong"
print(scipy.__version__)
""",
        "apt-get install python3-scipy (dolfinx needs Debian's), and pip uninstall scipy.",
    ),
    Trial(
        "dolfinx",
        """
import dolfinx, ufl
from dolfinx import fem, mesh
from mpi4py import MPI
square = mesh.create_unit_square(MPI.COMM_SELF, 1, 1)
area = fem.assemble_scalar(fem.form(fem.Constant(square, 1.0) * ufl.dx))
assert abs(area - 1.0) < 1e-12, f"the unit square has the area {area}"
print(dolfinx.__version__)
""",
        "apt-get install --no-install-recommends python3-dolfinx, and use /usr/bin/python3.",
    ),
    Trial(
        "petsc4py",
        """
from petsc4py import PETSc
assert PETSc.ScalarType is not PETSc.ComplexType, "built for complex numbers"
matrix = PETSc.Mat().createAIJ([2, 2], comm=PETSc.COMM_SELF)
matrix.setUp()
matrix[0, 0], matrix[1, 1] = 2.0, 4.0
matrix.assemble()
right, solution = matrix.createVecLeft(), matrix.createVecRight()
right.set(1.0)
solver = PETSc.KSP().create(PETSc.COMM_SELF)
solver.setOperators(matrix)
solver.setType("preonly")
solver.getPC().setType("cholesky")
solver.getPC().setFactorSolverType("mumps")
solver.solve(right, solution)
assert abs(solution.getArray() - [0.5, 0.25]).max() < 1e-12, "MUMPS solves wrongly"
print(".".join(map(str, PETSc.Sys.getVersion())), "with MUMPS")
""",
        "apt-get install --no-install-recommends python3-petsc4py (the real one, with MUMPS).",
    ),
    Trial(
        "MPI",
        """
import mpi4py
from mpi4py import MPI
count = MPI.COMM_WORLD.allreduce(1)
assert count == 2, f"2 processes see {count}"
if MPI.COMM_WORLD.rank == 0:
    print(f"mpi4py {mpi4py.__version__},", MPI.Get_library_version().split(",")[0].strip())
""",
        "apt-get install --no-install-recommends python3-mpi4py mpi-default-bin.",
        before=("mpirun", "-n", "2"),
    ),
    Trial(
        "gmsh",
        """
import gmsh
gmsh.initialize(["gmsh", "-v", "0"])
gmsh.model.occ.addRectangle(0.0, 0.0, 0.0, 1.0, 1.0)
gmsh.model.occ.synchronize()
gmsh.model.mesh.generate(2)
assert len(gmsh.model.mesh.getElementsByType(2)[0]) > 1, "no triangles"
print(gmsh.__version__)
""",
        "pip install gmsh, and apt-get install libglu1-mesa libgl1 libxrender1 libxcursor1 "
        "libxfixes3 libxft2 libfontconfig1 libxinerama1.",
    ),
    Trial(
        "meshio",
        """
import os, tempfile
import meshio, numpy
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "triangle.vtu")
    meshio.Mesh(numpy.eye(3), [("triangle", numpy.array([[0, 1, 2]]))]).write(path)
    assert (meshio.read(path).points == numpy.eye(3)).all(), "reads back something else"
print(meshio.__version__)
""",
        "pip install meshio.",
    ),
    Trial(
        "pyvista",
        """
import numpy, pyvista, vtkmodules.vtkCommonCore
corners = numpy.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
plotter = pyvista.Plotter(off_screen=True, window_size=(64, 64))
plotter.add_mesh(pyvista.PolyData(corners, numpy.array([3, 0, 1, 2])), color="red")
assert plotter.screenshot(None, return_img=True).std() > 1.0, "draws nothing"
print(f"{pyvista.__version__}, VTK {vtkmodules.vtkCommonCore.vtkVersion.GetVTKVersion()}")
""",
        "pip install pyvista, and apt-get install libegl1 libgl1-mesa-dri.",
    ),
    Trial(
        "matplotlib",
        """
import io, matplotlib
from matplotlib.figure import Figure
figure = Figure()
figure.add_subplot(projection="3d").plot([0.0, 1.0], [0.0, 1.0], [0.0, 1.0])
figure.savefig(io.BytesIO(), format="png")
print(matplotlib.__version__)
""",
        "Have one matplotlib only: remove Debian's python3-matplotlib or pip's.",
    ),
    Trial(
        "others",
        """
from importlib.metadata import version
import jinja2, pint, pydantic, rich, typer
assert pydantic.TypeAdapter(float).validate_python("1.5") == 1.5, "pydantic reads wrongly"
assert pint.UnitRegistry().Quantity("2 mm").to("m").magnitude == 0.002, "pint converts wrongly"
assert jinja2.Template("{{ x }}").render(x=1) == "1", "jinja2 writes wrongly"
print(", ".join(f"{n} {version(n)}" for n in ("jinja2", "pint", "pydantic", "rich", "typer")))
""",
        "pip install jinja2 pint pydantic rich typer.",
    ),
    Trial(
        "half-plane",
        """
from comparisons import api
steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
scene = {"roller": {"radius": 0.01, **steel}, "body": steel, "load": {"per_length": 1e6}}
found = api.run(scene, "half-plane").result
peak = found["models"]["half_plane"][0]["contact"]["peak_pressure"]
error = peak / found["hertz"]["peak_pressure"] - 1.0
assert abs(error) < 1e-3, f"misses Hertz's pressure by {100.0 * error:.2g} %"
print(f"a smooth contact within {100.0 * abs(error):.4f} % of Hertz's")
""",
        "Mend numpy and scipy first; where they work, this is a defect of crosscheck.",
    ),
    Trial(
        "finite elements",
        """
from comparisons import api
steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
scene = {
    "roller": {"radius": 0.01, **steel}, "body": steel, "load": {"per_length": 1e6},
    "tolerance": {"peak_pressure": 0.5, "contact_length": 0.5},
    "resolution": {"pitch": "30 um", "levels": 2}, "finite_element": {"block": 20},
    "budget": {"effects": False},
}
found = api.run(scene, "finite-element").result
peak = found["models"]["finite_element"][0]["contact"]["peak_pressure"]
error = peak / found["hertz"]["peak_pressure"] - 1.0
assert abs(error) < 0.02, f"miss Hertz's pressure by {100.0 * error:.2g} %"
print(f"a coarse smooth contact within {100.0 * abs(error):.2f} % of Hertz's")
""",
        "Mend dolfinx, petsc4py and gmsh first; where they work, this is a defect of crosscheck.",
    ),
    Trial(
        "files of fields",
        """
import importlib.util, tempfile
from importlib.metadata import version
from pathlib import Path
import meshio, numpy, pyvista
from comparisons.results.field_files import FORMATS, FieldFile, write_field
corners = numpy.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]])
cells, values = numpy.array([[0, 1, 2, 3]]), {"sx": numpy.arange(4.0)}
field = FieldFile(corners, "quad", cells, values, {"sx": "Pa"}, "a square", "{}")
with tempfile.TemporaryDirectory() as folder:
    for name in FORMATS:
        path = write_field(Path(folder), field, name)
        read = pyvista.read(path) if name == "vtkhdf" else meshio.read(path)
        assert (read.point_data["sx"] == values["sx"]).all(), f"{name} reads back something else"
parquet = f"Parquet by pyarrow {version('pyarrow')}" if importlib.util.find_spec("pyarrow") else (
    "no Parquet (pip install pyarrow)")
print(f"{', '.join(FORMATS)} by VTK {version('vtk')}; CSV; {parquet}")
""",
        "pip install 'vtk>=9.4.2' meshio pyvista.",
    ),
)
# Absence is no illness: a file that needs it is answered with how to get it.
OPTIONAL = (
    Trial(
        "profiles",
        """
import sys, tempfile
from pathlib import Path
sys.modules["mpi4py"] = None
from analytic.surface.readers.files import read_measured
SDF = (
    "aISO-1.0\\nNumPoints = 5\\nNumProfiles = 1\\nXscale = 1e-6\\nYscale = 1e-6\\nZscale = 1e-6\\n"
    "DataType = 7\\n*\\n0 1 0 2 0\\n*\\n"
)
with tempfile.TemporaryDirectory() as folder:
    text, sdf = Path(folder, "trace.csv"), Path(folder, "trace.sdf")
    text.write_text("x;z\\n" + "".join(f"{i},0;{i % 2},5\\n" for i in range(5)))
    sdf.write_text(SDF)
    read = read_measured(text, x_scale=1e-6, height_scale=1e-6).profile
    assert read.height.max() == 1.5e-6, "text is read wrongly"
    read = read_measured(sdf).profile
    assert read.height.max() == 2e-6, "SDF is read wrongly"
try:
    import SurfaceTopography
    from SurfaceTopography.IO import readers
    print(f"text, SDF, {len(readers)} by SurfaceTopography {SurfaceTopography.__version__}")
except ModuleNotFoundError as error:
    assert error.name == "SurfaceTopography", f"it lacks {error.name}"
    print("text and SDF; others by the optional SurfaceTopography, not installed")
""",
        "pip uninstall SurfaceTopography, or install crosscheck[surface].",
    ),
    Trial(
        "PDF",
        """
import subprocess, tempfile
from pathlib import Path
from comparisons.report.pdf import REMEDY, browser, print_pdf
found = browser()
if found is None:
    print(f"not printed: neither Chromium nor Chrome is installed ({REMEDY})")
else:
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder, "page.html")
        page.write_text("<p>A page.</p>")
        print_pdf(page, Path(folder, "page.pdf"))
    print(subprocess.check_output([found, "--version"], text=True).strip())
""",
        "apt-get install --reinstall chromium, or open report.html and print it from there.",
    ),
)
