"""Result files of other codes on any mesh, by the libraries that know them.

frd                        CalculiX, ASCII or binary     pyvista-frd-reader
vtu, vtk, vtkhdf, pvd, …   ParaView and many codes       pyvista
e, exo, ex2                Exodus: MOOSE, Sierra         pyvista
med, xdmf, msh, …          Salome, FEniCS, gmsh          meshio; med and xdmf take h5py"""

import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from comparisons.common.provenance import PROJECT

if TYPE_CHECKING:
    from pyvista import UnstructuredGrid

INSTALL = "python -m pip install pyvista-frd-reader h5py"
END_OF_FRD = b"9999"


def read_mesh(path: Path, step: int | None) -> "UnstructuredGrid":
    """Mesh and arrays at a step in time, the last by default.
    Raises ValueError with what is wrong."""
    from vtkmodules.vtkCommonCore import vtkObject

    shown = vtkObject.GetGlobalWarningDisplay()
    vtkObject.SetGlobalWarningDisplay(0)  # on standard error, beside the one line that is raised
    try:
        mesh = READERS.get(path.suffix.lower(), _by_vtk)(path, step)
    except ImportError as error:
        raise ValueError(f"takes {error.name}, which is not installed; {INSTALL}") from None
    except ValueError:
        raise
    except Exception as error:  # of a damaged file libraries may say anything
        raise ValueError(f"cannot be read ({error}); allowed is a whole result file") from None
    finally:
        vtkObject.SetGlobalWarningDisplay(shown)
    if mesh.n_points == 0 or mesh.n_cells == 0:
        raise ValueError("holds no mesh; allowed is a whole result file")
    return mesh


def _chosen(count: int, step: int | None) -> int:
    if step is not None and step >= count:
        raise ValueError(f"has {count} steps; allowed is a step from 0 to {count - 1}")
    return count - 1 if step is None else step


def _at_step(reader: object, step: int | None) -> "UnstructuredGrid":
    count = getattr(reader, "number_time_points", 0)
    if count:
        reader.set_active_time_point(_chosen(count, step))
    mesh = reader.read()
    mesh = mesh.combine() if hasattr(mesh, "combine") else mesh
    return mesh.cast_to_unstructured_grid()


def _frd(path: Path, step: int | None) -> "UnstructuredGrid":
    from pyvista_frd import FRDReader

    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 64))
        if not file.read().rstrip().endswith(END_OF_FRD):
            raise ValueError("ends before its last line, 9999; allowed is the whole file")
    return _at_step(FRDReader(path), step)


def _by_vtk(path: Path, step: int | None) -> "UnstructuredGrid":
    import pyvista

    return _at_step(pyvista.get_reader(path), step)


def _by_meshio(path: Path, step: int | None) -> "UnstructuredGrid":
    """In a process of its own: its HDF5 and that of the finite elements may be two versions."""
    import pyvista

    with TemporaryDirectory() as folder:
        out = Path(folder) / "mesh.vtu"
        steps = [] if step is None else [str(step)]
        command = [sys.executable, "-m", __name__, str(path.absolute()), str(out), *steps]
        done = subprocess.run(command, capture_output=True, text=True, cwd=PROJECT)
        if done.returncode:
            raise ValueError(" ".join(done.stderr.splitlines()[-1:]))
        return pyvista.read(out)


def _converted(path: Path, out: Path, step: int | None) -> None:
    """Write what meshio reads of a file, at a step, as vtu."""
    import meshio

    mesh = None
    if path.suffix.lower() in (".xdmf", ".xmf"):
        with suppress(meshio.ReadError), meshio.xdmf.TimeSeriesReader(path) as series:
            points, cells = series.read_points_cells()
            _, arrays, of_cells = series.read_data(_chosen(series.num_steps, step))
            mesh = meshio.Mesh(points, cells, arrays, of_cells)
    mesh = mesh or meshio.read(path)
    meshio.Mesh(mesh.points, mesh.cells, mesh.point_data, mesh.cell_data).write(out)


READERS: dict[str, Callable[[Path, int | None], "UnstructuredGrid"]] = {
    ".frd": _frd,
    **dict.fromkeys((".med", ".xdmf", ".xmf", ".msh"), _by_meshio),
}

if __name__ == "__main__":
    try:
        _converted(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]) if sys.argv[3:] else None)
    except ImportError as error:
        sys.exit(f"takes {error.name}, which is not installed; {INSTALL}")
    except Exception as error:
        said = str(error) if "allowed" in str(error) else f"cannot be read ({error})"
        sys.exit(" ".join(said.split()))
