"""`crosscheck doctor`: what works here, by importing it and solving something tiny with it."""

import os
import platform
import signal
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Annotated

from comparisons.commands.arguments import job, json_option
from comparisons.commands.output import progress, show, show_json
from comparisons.common.errors import ExitStatus
from comparisons.common.progress import Step

if TYPE_CHECKING:
    from rich.table import Table

PATIENCE = 60.0  # s; the first trial that compiles a form takes twenty
# Without a display; as root and on a single core, as in a container.
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "VTK_DEFAULT_OPENGL_WINDOW": "vtkEGLRenderWindow",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
} | {
    f"{launcher}_ALLOW_RUN_AS_ROOT{suffix}": "1"
    for launcher in ("OMPI", "PRTE")
    for suffix in ("", "_CONFIRM")
}
CONTACT = """from comparisons import api
steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
scene = {"roller": {"radius": 0.01, **steel}, "body": steel, "load": {"per_length": 1e6},
         "tolerance": {"peak_pressure": 0.5, "contact_length": 0.5}, "budget": {"effects": False},
         "resolution": {"pitch": "30 um", "levels": 2}, "finite_element": {"block": 20}}
found = api.run(scene, MODEL).result
peak = found["models"][MODEL.replace("-", "_")][0]["contact"]["peak_pressure"]
error = abs(peak / found["hertz"]["peak_pressure"] - 1.0)
assert error < 0.02, f"misses Hertz's pressure by {100.0 * error:.2g} %"
print(f"coarse smooth contact within {100.0 * error:.2f} % of Hertz's")"""


# Programs, a process each, that print the version of an item if it works, and fail otherwise.
TRIALS = {
    "numpy and scipy": """import numpy, scipy, scipy.fft
assert numpy.linalg.solve([[2.0]], [4.0]) == 2.0, "solves wrongly"
assert abs(scipy.fft.irfft(scipy.fft.rfft([1.0, 2.0])) - [1.0, 2.0]).max() < 1e-12, "wrong FFT"
print(numpy.__version__, "and", scipy.__version__)""",
    "dolfinx": """import dolfinx, dolfinx.fem, ufl; from mpi4py import MPI
square = dolfinx.mesh.create_unit_square(MPI.COMM_SELF, 1, 1)
area = dolfinx.fem.form(dolfinx.fem.Constant(square, 1.0) * ufl.dx)
assert abs(dolfinx.fem.assemble_scalar(area) - 1.0) < 1e-12, "integrates wrongly"
print(dolfinx.__version__)""",
    "petsc4py": """from petsc4py import PETSc
matrix = PETSc.Mat().createAIJ([1, 1], comm=PETSc.COMM_SELF); matrix.setUp()
matrix[0, 0] = 2.0; matrix.assemble()
right, solution = matrix.createVecLeft(), matrix.createVecRight(); right.set(4.0)
solver = PETSc.KSP().create(PETSc.COMM_SELF); solver.setOperators(matrix)
solver.getPC().setType("cholesky"); solver.getPC().setFactorSolverType("mumps")
solver.solve(right, solution)
assert abs(solution.getArray()[0] - 2.0) < 1e-12, "MUMPS solves wrongly"
print(".".join(map(str, PETSc.Sys.getVersion())), "with MUMPS")""",
    "MPI": """import mpi4py; from mpi4py import MPI
count = MPI.COMM_WORLD.allreduce(1)
assert count == 2, f"2 processes see {count}"
if MPI.COMM_WORLD.rank == 0: print(mpi4py.__version__, MPI.Get_library_version().split(",")[0])""",
    "gmsh": """import gmsh; gmsh.initialize(["gmsh", "-v", "0"])
gmsh.model.occ.addRectangle(0.0, 0.0, 0.0, 1.0, 1.0); gmsh.model.occ.synchronize()
gmsh.model.mesh.generate(2)
print(gmsh.__version__)""",
    "pyvista": """import pyvista, vtk
plotter = pyvista.Plotter(off_screen=True, window_size=(64, 64))
plotter.add_mesh(pyvista.Sphere(), color="red")
assert plotter.screenshot(None, return_img=True).std() > 1.0, "draws nothing"
print(f"{pyvista.__version__}, VTK {vtk.vtkVersion.GetVTKVersion()}")""",
    "others": """import io; from importlib.metadata import version
import jinja2, meshio, pint, pydantic, rich, typer; from matplotlib.figure import Figure
Figure().add_subplot(projection="3d").figure.savefig(io.BytesIO())
names = ("jinja2", "matplotlib", "meshio", "pint", "pydantic", "rich", "typer")
print(", ".join(f"{name} {version(name)}" for name in names))""",
    "half-plane": f"MODEL = 'half-plane'\n{CONTACT}",
    "finite elements": f"MODEL = 'finite-element'\n{CONTACT}",
}
STARTED_BY = {"MPI": ("mpirun", "-n", "2")}  # the interpreter that runs a trial
REMEDY = "./crosscheck installs everything anew once its folder .venv is removed."


@dataclass(frozen=True)
class Finding:
    """Whether an item works, and its version or what is wrong."""

    name: str
    ok: bool
    detail: str


@job
def doctor(as_json: Annotated[bool, json_option("the findings as JSON")] = False) -> int:
    """Show what is installed, what is missing, and how to get it."""
    from comparisons.common.provenance import PROJECT, revision

    findings = [Finding("Python", True, f"{platform.python_version()}, {sys.executable}")]
    findings.append(Finding("crosscheck", True, f"{revision() or 'no revision'}, {PROJECT}"))
    with progress() as callback, ThreadPoolExecutor(2) as pool:
        for number, finding in enumerate(pool.map(attempt, TRIALS, TRIALS.values()), start=1):
            findings.append(finding)
            callback(Step(f"tried {finding.name}", number / len(TRIALS)))
    works = all(finding.ok for finding in findings)
    if as_json:
        show_json([asdict(finding) for finding in findings])
    else:
        show(findings_table(findings))
        if not works:
            print(REMEDY)
    return ExitStatus.DONE if works else ExitStatus.SOMETHING_MISSING


def attempt(name: str, program: str, patience: float = PATIENCE) -> Finding:
    """Run a trial for at most `patience` seconds."""
    command = [*STARTED_BY.get(name, ()), sys.executable, "-P", "-c", program]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=patience,
            stdin=subprocess.DEVNULL, env=os.environ | ENVIRONMENT,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return Finding(name, False, f"does not answer within {patience:g} s")
    except OSError as error:
        return Finding(name, False, f"{error.filename}: {error.strerror}")
    if done.returncode == 0:
        return Finding(name, True, done.stdout.strip().splitlines()[-1])
    if done.returncode < 0:
        return Finding(name, False, f"crashes ({signal.Signals(-done.returncode).name})")
    lines = [line.strip() for line in done.stderr.splitlines() if any(map(str.isalpha, line))]
    named = [line for line in lines if "Error: " in line]
    return Finding(name, False, [f"ends with {done.returncode}", *lines[-1:], *named[-1:]][-1])


def findings_table(findings: Sequence[Finding]) -> "Table":
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table("item", "works", box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
    table.add_column("version, or what is wrong", overflow="fold")
    for found in findings:
        works = Text("yes", style="green") if found.ok else Text("no", style="bold red")
        table.add_row(found.name, works, Text(found.detail))
    return table
