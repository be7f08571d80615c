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
)
# Absence is no illness: a file that needs it is answered with how to get it.
OPTIONAL = (
    Trial(
        "instruments' files",
        """
import sys
sys.modules["mpi4py"] = None
try:
    import SurfaceTopography
    from SurfaceTopography.IO import readers
    print(f"SurfaceTopography {SurfaceTopography.__version__}, {len(readers)} formats")
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
from comparisons.pdf import REMEDY, browser, print_pdf
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
