"""Result files of other codes on any mesh, by the libraries that know them.

frd                        CalculiX, ASCII or binary     pyvista-frd-reader
vtu, vtk, vtkhdf, pvd, …   ParaView and many codes       pyvista
e, exo, ex2                Exodus: MOOSE, Sierra         pyvista
med, xdmf, msh, …          Salome, FEniCS, gmsh          meshio; med and xdmf take h5py

They read in a process of their own, this module as a script: a damaged file may crash them, and
their HDF5 and that of the finite elements may be two versions."""

import logging.handlers
import resource
import sys
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from analytic.surface.readers.child import ReaderError, said_by
from comparisons.common.provenance import PROJECT

if TYPE_CHECKING:
    from pyvista import PolyData, UnstructuredGrid

INSTALL = "python -m pip install pyvista-frd-reader h5py"
END_OF_FRD = b"9999"
XDMF = ".xdmf", ".xmf"
BY_MESHIO = (*XDMF, ".med", ".msh")
MOST_MEMORY = 8 * 10**9  # bytes of address space of the reader


def read_mesh(path: Path, step: int | None) -> "PolyData":
    """The outer faces of a mesh, triangles between all of their nodes, with the arrays at these, at
    a step in time, the last by default; a plane mesh is all face. Raises ValueError with what is
    wrong."""
    with TemporaryDirectory() as folder:
        out = Path(folder) / "faces.vtp"
        steps = [] if step is None else [str(step)]
        command = [sys.executable, "-m", __name__, str(path.absolute()), str(out), *steps]
        try:
            said_by(command, cwd=str(PROJECT))
        except ReaderError as error:
            whole = "" if "allowed" in str(error) else "; allowed is a whole result file"
            raise ValueError(f"{error}{whole}") from None
        import pyvista

        return pyvista.read(out)


def _chosen(count: int, step: int | None) -> int:
    if step is not None and step >= count:
        raise ValueError(f"has {count} steps; allowed is a step from 0 to {count - 1}")
    return count - 1 if step is None else step


def _grid(path: Path, step: int | None) -> "UnstructuredGrid":
    """Grid in a file, at a step in time."""
    import pyvista

    kind = path.suffix.lower()
    if kind in BY_MESHIO:
        return _by_meshio(path, step)
    if kind == ".frd":
        from pyvista_frd import FRDReader

        with path.open("rb") as file:
            file.seek(max(0, path.stat().st_size - 64))
            if not file.read().rstrip().endswith(END_OF_FRD):
                raise ValueError("ends before its last line, 9999; allowed is the whole file")
        reader = FRDReader(path)
    else:
        reader = pyvista.get_reader(path)
    if count := getattr(reader, "number_time_points", 0):
        reader.set_active_time_point(_chosen(count, step))
    mesh = reader.read()
    mesh = mesh.combine() if hasattr(mesh, "combine") else mesh
    return mesh.cast_to_unstructured_grid()


def _by_meshio(path: Path, step: int | None) -> "UnstructuredGrid":
    import meshio
    import pyvista

    if path.suffix.lower() in XDMF:
        with suppress(meshio.ReadError), meshio.xdmf.TimeSeriesReader(path) as series:
            points, cells = series.read_points_cells()
            _, *arrays = series.read_data(_chosen(series.num_steps, step))
            return pyvista.from_meshio(meshio.Mesh(points, cells, *arrays))
    return pyvista.from_meshio(meshio.read(path))


def _write_faces(path: Path, out: Path, step: int | None) -> None:
    """Write the faces of what is in a file, in this process."""
    import pyvista
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

    mesh = _grid(path, step)
    nodes = mesh.cell_connectivity
    if mesh.n_points == 0 or len(nodes) == 0:
        raise ValueError("holds no mesh; allowed is a whole result file")
    if nodes.min() < 0 or nodes.max() >= mesh.n_points:
        raise ValueError("has cells on nodes that it has not; allowed is a whole result file")
    faces = vtkDataSetSurfaceFilter()
    faces.SetInputData(mesh.cell_data_to_point_data() if mesh.cell_data else mesh)
    faces.SetNonlinearSubdivisionLevel(1)
    faces.Update()
    pyvista.wrap(faces.GetOutput()).triangulate().save(out)


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    logged = logging.handlers.BufferingHandler(1000)  # VTK's first complaint is the cause
    logging.basicConfig(handlers=[logged])
    try:
        source, target, *steps = sys.argv[1:]
        _write_faces(Path(source), Path(target), int(steps[0]) if steps else None)
    except ImportError as error:
        sys.exit(f"needs {error.name}, which is not installed; {INSTALL}")
    except Exception as error:  # of a damaged file libraries may say anything
        causes = [record.getMessage() for record in logged.buffer] or [str(error)]
        said = str(error) if "allowed" in str(error) else f"cannot be read ({causes[0]})"
        sys.exit(" ".join(said.split()))
