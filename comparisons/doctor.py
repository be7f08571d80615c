"""What is installed, which versions, what is missing and how to get it.

Everything is tried, not only looked up: a library that imports may still crash when it draws, and
a solver may come without the factorisation that is needed. Each trial is a process of its own, so
that a crash or a hang is a finding like any other. Needs the standard library only, for the
doctor must be the last to fall ill.
"""

import os
import platform
import signal
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table

OLDEST_PYTHON = (3, 11)
# s; a healthy trial ends within three, the first one that compiles a form within twenty.
PATIENCE = 60.0
AT_ONCE = 2

# Without a display and without asking for one; as root and on a single core, as in a container.
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "VTK_DEFAULT_OPENGL_WINDOW": "vtkEGLRenderWindow",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "PRTE_ALLOW_RUN_AS_ROOT": "1",
    "PRTE_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}


@dataclass(frozen=True)
class Check:
    """One item: whether it works, its version or what went wrong, and how to mend it ("" if ok)."""

    name: str
    ok: bool
    detail: str
    remedy: str


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


def doctor() -> list[Check]:
    """Try everything that crosscheck uses; one check an item, Python first."""
    with ThreadPoolExecutor(AT_ONCE) as pool:
        return [_python(), *pool.map(attempt, TRIALS)]


def attempt(trial: Trial, patience: float = PATIENCE) -> Check:
    """Run a trial for at most `patience` seconds."""
    try:
        done = subprocess.run(
            [*trial.before, sys.executable, "-c", trial.program],
            capture_output=True,
            text=True,
            errors="replace",
            stdin=subprocess.DEVNULL,
            env=os.environ | ENVIRONMENT,
            timeout=patience,
        )
    except subprocess.TimeoutExpired:
        return Check(trial.name, False, f"does not answer within {patience:g} s", trial.remedy)
    except OSError as error:
        return Check(trial.name, False, f"{error.filename}: {error.strerror}", trial.remedy)
    if done.returncode < 0:
        name = signal.Signals(-done.returncode).name
        return Check(trial.name, False, f"crashes ({name})", trial.remedy)
    if done.returncode > 0:
        return Check(trial.name, False, _complaint(done.stderr), trial.remedy)
    return Check(trial.name, True, (done.stdout.strip() or "no version").splitlines()[-1], "")


def doctor_table(checks: Sequence[Check]) -> "Table":
    """The checks for people to read: a row an item."""
    from rich.table import Table
    from rich.text import Text

    table = Table("item", "works", "version, or what is wrong", "how to get it")
    for check in checks:
        works = Text("yes", style="green") if check.ok else Text("no", style="bold red")
        table.add_row(check.name, works, Text(check.detail), Text(check.remedy))
    return table


def _python() -> Check:
    ok = sys.version_info >= OLDEST_PYTHON
    oldest = ".".join(map(str, OLDEST_PYTHON))
    remedy = "" if ok else f"Use Python {oldest} or newer: Debian 12 and later have it."
    return Check("Python", ok, f"{platform.python_version()}, {sys.executable}", remedy)


def _complaint(text: str) -> str:
    """The last line that names an exception, or else the last that has words."""
    lines = [line.strip() for line in text.splitlines() if any(map(str.isalpha, line))]
    errors = [line for line in lines if "Error: " in line]
    return [*["fails without a word"], *lines[-1:], *errors[-1:]][-1]
