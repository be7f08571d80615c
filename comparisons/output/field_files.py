"""Stresses and displacements of a model as a vtu, which ParaView, PyVista and meshio open.

The file also says what it is of: `title`, `units` and `scene`, the latter two as JSON. They are
bytes in the field data, to be read by bytes(data["scene"]).decode(), for meshio opens no file with
texts there. The scene stands as text in contact.csv beside it, too.

Numbers are in single precision; those on a mesh of finite elements have 17 significant bits, which
moves each by less than 7.6e-6 of itself: a tenth of the least uncertainty that a stress of a scene
that is shipped has there (8.2e-5). They stand at the corners of the elements: files are for
looking at, and the nodes between corners, three times as many, are left to mesh.msh. Largest values
of a run are not read from them."""

import base64
import json
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from analytic.stress_state import StressState
from comparisons.figures.figure import grouped
from comparisons.judging.study import Run
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.readings import stresses_at

SIGNIFICANT = 17  # bits of a number on a mesh of finite elements
COMPONENTS = ("sx", "sz", "sy", "txz", "tau1", "von_mises")  # [Pa]
# with the direction of s1, the largest principal stress in the plane, as a vector
STRESSES = (*COMPONENTS, "s1_direction")
CELL_TYPES = {3: 5, 4: 9}  # VTK's number for triangles and quadrilaterals, by their corners


@dataclass(frozen=True)
class FieldFile:
    """Arrays at points that cells connect."""

    points: np.ndarray  # (n, 3) [m] x, z, 0: the plane of mesh.msh
    cells: np.ndarray  # (m, k) indices of points, three or four
    arrays: dict[str, np.ndarray]  # (n,) by name, or vectors (n, 3), in `units`
    units: dict[str, str]  # of the arrays by name, and of "points"
    notes: dict[str, str]  # what the file says of itself, as texts


def scene_text(problem: Problem) -> str:
    """A problem's scene as one line of JSON, SI units."""
    return json.dumps(problem.surface.as_dict(problem.scene), ensure_ascii=False, allow_nan=False)


def field_of(run: Run, levels: Mapping[float, Level]) -> FieldFile:
    """Stresses at the points of a model's levels, by friction, of one contact, as STRESSES.

    On a mesh of finite elements also their `displacement`, a vector (n, 3) [m] in the axes of the
    points, zero where the body is held; and `half_plane_` and `difference_` COMPONENTS: the
    half-plane's stresses at the same points, and these less the finite elements', as rounded.
    Of several friction coefficients that share a contact each array has its own in the name. Where
    the body yields there is also what flow leaves behind when the roller is gone."""
    scene, (level, *_) = run.problem.scene, levels.values()
    nu = scene.body.poissons_ratio
    on_mesh = level.field_on_mesh
    if on_mesh is not None:
        on_mesh = on_mesh.at_corners
        plane, stresses = on_mesh.points, on_mesh.stresses
        cells, nu = on_mesh.triangles, on_mesh.poissons_ratio
    else:
        x, z = np.meshgrid(run.window.x, run.window.z)
        plane = np.column_stack([x.ravel(), z.ravel()])
        fields = {friction: of.stress.field for friction, of in levels.items()}
        stresses = {
            friction: StressState(field.sx.ravel(), field.sz.ravel(), field.txz.ravel())
            for friction, field in fields.items()
        }
        rows, columns = x.shape
        corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        cells = np.column_stack([corner, corner + 1, corner + columns + 1, corner + columns])
    arrays = _named(stresses, lambda s: _components(s, nu) | {"s1_direction": _direction(s)})
    if on_mesh is not None:
        arrays |= _named(on_mesh.displacement, lambda u: {"displacement": _in_space(u)})
        arrays = _rounded(arrays | on_mesh.others)
        if "half_plane" in run.runs:
            arrays |= _beside(run, level, plane, stresses, arrays)
    arrays = {name: values.astype(np.float32) for name, values in arrays.items()}
    points = _in_space(plane).astype(np.float32)
    units = {"points": "m"} | {name: _unit(name) for name in arrays}
    notes = {"title": scene.title, "units": json.dumps(units), "scene": scene_text(run.problem)}
    return FieldFile(points, cells, arrays, units, notes)


def _rounded(arrays: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays whose numbers have SIGNIFICANT bits; NaN stays."""
    parts = {name: np.frexp(values) for name, values in arrays.items()}
    one = 2.0**SIGNIFICANT
    return {
        name: np.ldexp(np.rint(part * one) / one, power) for name, (part, power) in parts.items()
    }


def _named(by_friction: Mapping, arrays: Callable[..., dict]) -> dict[str, np.ndarray]:
    """The arrays of every friction coefficient, which is in their names where there are several."""
    suffix = " (friction {:g})" if len(by_friction) > 1 else ""
    return {
        name + suffix.format(friction): values
        for friction, of in by_friction.items()
        for name, values in arrays(of).items()
    }


def _unit(name: str) -> str:
    if name.startswith("displacement"):
        return "m"
    return "1" if "strain" in name or name.startswith("s1_") else "Pa"


def _in_space(plane: np.ndarray) -> np.ndarray:
    """x, z, 0 (n, 3) from x, z (n, 2)."""
    return np.pad(plane, ((0, 0), (0, 1)))


def _components(s: StressState, nu: float | np.ndarray) -> dict[str, np.ndarray]:
    values = (s.sx, s.sz, s.sy(nu), s.txz, s.tau1, s.von_mises(nu))
    return dict(zip(COMPONENTS, values, strict=True))


def _beside(
    run: Run,
    level: Level,
    plane: np.ndarray,
    stresses: Mapping[float, StressState],
    on_mesh: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """The half-plane's stresses at points (n, 2), and these less what is `on_mesh`; NaN above the
    mean line."""
    problem, at_points = run.problem, {}
    cases = [case for case in run.solved.cases if case.friction in stresses]
    of_half_plane = {case.friction: case.runs["half_plane"].beside(level) for case in cases}
    for same in grouped(of_half_plane, lambda mu: id(of_half_plane[mu].solution.pressure)):
        at_points |= stresses_at(problem, of_half_plane[same[0]], tuple(same), *plane.T)
    nu = problem.scene.body.poissons_ratio
    arrays = _rounded(_named(at_points, lambda s: _components(s, nu)))
    return {
        before + name: values
        for name, array in arrays.items()
        for before, values in (
            ("half_plane_", array),
            ("difference_", array - on_mesh[name]),
        )
    }


def _direction(stress: StressState) -> np.ndarray:
    """Unit vectors (n, 3) along the largest principal stress in the plane, of either sign."""
    angle = 0.5 * np.arctan2(2.0 * stress.txz, stress.sx - stress.sz)
    return np.column_stack([np.cos(angle), np.sin(angle), 0.0 * angle])


def write_field(path: Path, field: FieldFile) -> None:
    """Write a vtu: VTK's XML, each array by itself in base64, compressed by zlib."""
    count, corners = field.cells.shape
    first = {"type": "UnstructuredGrid", "version": "1.0", "byte_order": "LittleEndian"}
    first |= {"header_type": "UInt32", "compressor": "vtkZLibDataCompressor"}
    file = ElementTree.Element("VTKFile", first)
    grid = ElementTree.SubElement(file, "UnstructuredGrid")
    notes = ElementTree.SubElement(grid, "FieldData")
    for name, text in field.notes.items():
        codes = np.frombuffer(text.encode(), dtype=np.uint8)
        _add_array(notes, name, codes, NumberOfTuples=str(len(codes)))
    sizes = {"NumberOfPoints": str(len(field.points)), "NumberOfCells": str(count)}
    piece = ElementTree.SubElement(grid, "Piece", sizes)
    at_points = ElementTree.SubElement(piece, "PointData")
    for name, values in field.arrays.items():
        array = _add_array(at_points, name, values)
        unit = {"name": "UNITS_LABEL", "location": "vtkDataArray"}
        ElementTree.SubElement(array, "InformationKey", unit).text = field.units[name]
    _add_array(ElementTree.SubElement(piece, "Points"), "Points", field.points)
    cells = ElementTree.SubElement(piece, "Cells")
    _add_array(cells, "connectivity", field.cells.ravel())
    _add_array(cells, "offsets", corners * np.arange(1, count + 1))
    _add_array(cells, "types", np.full(count, CELL_TYPES[corners], dtype=np.uint8))
    ElementTree.ElementTree(file).write(path, encoding="utf-8", xml_declaration=True)


def _add_array(
    parent: ElementTree.Element, name: str, values: np.ndarray, **more: str
) -> ElementTree.Element:
    """Add a DataArray of one compressed block; returns it."""
    kind = {"f": "Float", "i": "Int", "u": "UInt"}[values.dtype.kind] + str(8 * values.itemsize)
    if values.ndim > 1:
        more["NumberOfComponents"] = str(values.shape[1])
    how = {"type": kind, "Name": name, "format": "binary"}
    array = ElementTree.SubElement(parent, "DataArray", how | more)
    content = values.astype(values.dtype.newbyteorder("<")).tobytes()
    # LZMA makes of rounded numbers a fifth less and takes eight times as long; higher levels of
    # zlib make them no smaller
    block = zlib.compress(content, 1)
    head = np.array([1, len(content), 0, len(block)], dtype="<u4")  # blocks, their size, rest
    array.text = (base64.b64encode(head) + base64.b64encode(block)).decode()
    return array
