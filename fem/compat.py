"""The only module that depends on the version of dolfinx: 0.5, 0.9, 0.10 or 0.11.

Each function hides one difference and names it."""

import inspect
import logging
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.metadata import distribution
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import ufl
    from dolfinx.fem import Form, Function, FunctionSpace
    from dolfinx.mesh import Mesh
    from petsc4py.PETSc import Mat

_COMPILED: dict[tuple, tuple] = {}  # by 0.5's compiler, in this process


@contextmanager
def quick_versions() -> Iterator[None]:
    """While dolfinx is loaded: 0.5's ufl and ffcx load pkg_resources, as slow as all the rest,
    for their own version. Asked for anything else, what stands for it gives way to the module."""
    name, stand_in = "pkg_resources", ModuleType("pkg_resources")

    def real(wanted: str) -> object:
        sys.modules.pop(name, None)
        return getattr(import_module(name), wanted)

    vars(stand_in).update(get_distribution=distribution, __getattr__=real)
    sys.modules.setdefault(name, stand_in)
    try:
        yield
    finally:
        if sys.modules.get(name) is stand_in:
            del sys.modules[name]


def quiet_compiler() -> None:
    """Keep the compiler's progress off the terminal: on 0.5 it logs to the root logger at INFO."""
    root = logging.getLogger()
    if root.level < logging.WARNING:
        root.setLevel(logging.WARNING)
    for handler in root.handlers:
        handler.setLevel(max(handler.level, logging.WARNING))


def triangle_mesh(cells: np.ndarray, points: np.ndarray, degree: int) -> "Mesh":
    """dolfinx mesh of triangles with coordinates of polynomial `degree` 1 or 2. `cells` (m, 3 or 6)
    in dolfinx node order, `points` (n, 2). 0.5 takes a UFL mesh, later ones a basix element. On 0.5
    the first compiled form rewrites the element as equispaced; unless it is declared so, later
    processes compile again. An adjacency list of cells avoids 0.5's slow conversion from an
    array."""
    from dolfinx.mesh import create_mesh
    from mpi4py import MPI

    quiet_compiler()
    cells = np.ascontiguousarray(cells, dtype=np.int64)
    points = np.ascontiguousarray(points, dtype=np.float64)
    if "domain" in inspect.signature(create_mesh).parameters:
        import ufl
        from dolfinx.cpp.graph import AdjacencyList_int64

        triangle = ufl.Cell("triangle", geometric_dimension=2)
        scalar = ufl.FiniteElement("Lagrange", triangle, degree, variant="equispaced")
        domain = ufl.Mesh(ufl.VectorElement(scalar))
        return create_mesh(MPI.COMM_SELF, AdjacencyList_int64(cells), points, domain)
    return create_mesh(MPI.COMM_SELF, cells, x=points, e=_equispaced(degree))


def _equispaced(degree: int, shape: tuple | None = (2,)):
    """basix's element of evenly spaced nodes, for 0.9 and later; a scalar one has no shape."""
    import basix
    import basix.ufl

    variant = basix.LagrangeVariant.equispaced
    return basix.ufl.element(basix.ElementFamily.P, "triangle", degree, variant, shape=shape)


def continuous_space(mesh: "Mesh", degree: int, shape: tuple | None) -> "FunctionSpace":
    """Continuous space of evenly spaced nodes: of vectors with a `shape` (2,), of scalars without.
    0.5 takes a UFL element, later ones a basix element; both space cubic nodes unevenly by default.
    0.5 looks up the compiled element on disk each time; here once a process."""
    from dolfinx import fem

    if not hasattr(fem, "VectorFunctionSpace"):
        return fem.functionspace(mesh, _equispaced(degree, shape))
    import ufl
    from dolfinx import cpp

    scalar = ufl.FiniteElement("Lagrange", mesh.ufl_cell(), degree, variant="equispaced")
    used = ufl.VectorElement(scalar) if shape else scalar
    name = ("element", degree, shape)
    parts, module, _ = _compiled_once(name, lambda: used)
    ffi = module.ffi
    element, dofmap = (ffi.cast("uintptr_t", ffi.addressof(part)) for part in parts)
    element = cpp.fem.FiniteElement(element)
    dofmap = cpp.fem.create_dofmap(mesh.comm, dofmap, mesh.topology, element)
    return fem.FunctionSpace(mesh, used, cpp.fem.FunctionSpace(mesh._mesh, element, dofmap))


def _compiled_once(name: tuple, make: Callable[[], object]) -> tuple:
    """Compile a named UFL object once with 0.5's compiler: compiled parts, module, code."""
    from dolfinx import jit
    from mpi4py import MPI

    if name not in _COMPILED:
        _COMPILED[name] = jit.ffcx_jit(MPI.COMM_SELF, make())
    return _COMPILED[name]


def cell_nodes(space: "FunctionSpace") -> np.ndarray:
    """Node numbers (m, k) of the space's cells. 0.5 has an adjacency list."""
    nodes = space.dofmap.list
    if hasattr(nodes, "array"):
        return nodes.array.reshape(nodes.num_nodes, -1)
    return np.asarray(nodes)


def input_cells(mesh: "Mesh") -> np.ndarray:
    """Number in the arrays given to `triangle_mesh` of each cell."""
    return np.asarray(mesh.topology.original_cell_index, dtype=np.int64)


def cell_values(mesh: "Mesh", value: np.ndarray) -> "Function":
    """Function of a form that is `value` (m,) on the cells in their order. 0.5 has a class of
    spaces, later ones a function."""
    from dolfinx import fem

    make = getattr(fem, "functionspace", None) or fem.FunctionSpace
    function = fem.Function(make(mesh, ("DG", 0)))
    function.x.array[cell_nodes(function.function_space)[:, 0]] = value
    return function


def cell_points(mesh: "Mesh") -> np.ndarray:
    """Coordinate numbers (m, k) of cells. 0.5 has an adjacency list, 0.9 an array, 0.11 several."""
    geometry = mesh.geometry
    count = mesh.topology.index_map(mesh.topology.dim).size_local
    if hasattr(geometry, "dofmaps") and not callable(geometry.dofmaps):
        points = geometry.dofmaps[0]
    else:
        points = geometry.dofmap
    return np.asarray(points.array if hasattr(points, "array") else points).reshape(count, -1)


def input_points(mesh: "Mesh") -> np.ndarray:
    """Number in the arrays given to `triangle_mesh` of each of the mesh's coordinates. A list on
    0.5, an array later; a method or a property."""
    indices = mesh.geometry.input_global_indices
    return np.asarray(indices() if callable(indices) else indices, dtype=np.int64)


def form_cache() -> Path:
    """Folder of the compiled forms. 0.5 calls its settings parameters, later ones options."""
    import_module("mpi4py.MPI")  # of a wheel's dolfinx, which may not be loaded yet
    from dolfinx import jit

    settings = jit.get_options if hasattr(jit, "get_options") else jit.get_parameters
    return Path(settings()["cache_dir"])


def compile_form(bilinear: "ufl.Form") -> "Form":
    """The compiled form of a UFL form."""
    from dolfinx import fem

    quiet_compiler()
    return fem.form(bilinear)


def compile_bilinear(
    name: tuple, make: Callable[[], "ufl.Form"], space: "FunctionSpace", values: list
) -> "Form":
    """The compiled form that `make` gives, on a space; a name stands for one form on any mesh.
    `values` are all its constants, or all its functions, in the order in which they were made. 0.5
    processes the whole form to find it on disk; here once a process."""
    from dolfinx import fem

    if not hasattr(fem, "VectorFunctionSpace"):
        return compile_form(make())
    quiet_compiler()
    from dolfinx import cpp
    from dolfinx.fem.forms import FormMetaClass
    from petsc4py import PETSc

    form, module, code = _compiled_once(name, make)
    taken = [value._cpp_object for value in values]
    positions = form.original_coefficient_position
    functions = [taken[positions[i]] for i in range(form.num_coefficients)]
    constants = [] if functions else taken
    base = {np.float64: cpp.fem.Form_float64, np.complex128: cpp.fem.Form_complex128}
    kind = type("Form", (FormMetaClass, base[PETSc.ScalarType]), {})
    bare = space._cpp_object
    return kind(form, [bare, bare], functions, constants, {}, bare.mesh, module.ffi, code)


def conditioned(space: "FunctionSpace") -> object:
    """A space as boundary conditions take it. 0.5 tries the Python space first, and prints all
    nodes into the error."""
    from dolfinx import fem

    return space._cpp_object if hasattr(fem, "VectorFunctionSpace") else space


def petsc_matrix(bilinear: "Form", conditions: list) -> "Mat":
    """PETSc matrix of a compiled form; the identity in the rows and columns of `conditions`."""
    from dolfinx.fem.petsc import assemble_matrix

    matrix = assemble_matrix(bilinear, bcs=conditions)
    matrix.assemble()
    return matrix


def petsc() -> ModuleType:
    """petsc4py's PETSc. A wheel's, of 0.11, takes the MPI that mpi4py has loaded."""
    import_module("mpi4py.MPI")
    return import_module("petsc4py.PETSc")


def real_number(value: float) -> np.floating:
    """`value` in PETSc's scalar type, which constants and conditions need."""
    from petsc4py import PETSc

    return PETSc.ScalarType(value)
