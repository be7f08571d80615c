"""The real body's mesh as a gmsh file (MSH 2.2, binary), and back.

All readers know format 2.2 with its named sides; meshio writes 4.1 with empty entities."""

import io
import json
from collections.abc import Mapping
from contextlib import redirect_stderr
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

from meshes.block import BlockMesh, BlockSpec, MeshError, real_points, unique_edges
from meshes.quality import quality_of

# Physical groups: name, tag; the sides are curves, the body is a surface.
SIDES = {"top": 1, "right": 2, "bottom": 3, "left": 4}
BODY = ("body", 5)
SHIFT = "shift"  # node data: BlockMesh.shift with a third component of zero
SPEC_SECTION = "BlockSpec"


def side_lines(mesh: BlockMesh) -> dict[str, np.ndarray]:
    """For each side of SIDES its edges (k, 3): two vertices, then the midpoint."""
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    outer = np.flatnonzero(np.bincount(edge_of.ravel()) == 1)
    lines = np.column_stack([edges[outer], int(mesh.triangles[:, :3].max()) + 1 + outer])
    x, z = mesh.points[lines[:, 2]].T
    half, depth = mesh.spec.half_width, mesh.spec.depth
    on = {"top": z == 0.0, "right": x == half, "bottom": z == depth, "left": x == -half}
    return {name: lines[on[name]] for name in SIDES}


def write_msh(mesh: BlockMesh, path: str | Path) -> None:
    """Saves the real body in x, z, 0 [m], z into the body, its named sides and its BlockSpec; its
    shift, too, where it has one."""
    import meshio

    lines = side_lines(mesh)
    cells = [("line3", lines[name]) for name in SIDES] + [("triangle6", mesh.triangles)]
    numbers = [*SIDES.values(), BODY[1]]
    tags = [np.full(len(block), tag) for (_, block), tag in zip(cells, numbers, strict=True)]
    names = {name: np.array([tag, 1]) for name, tag in SIDES.items()}
    content = meshio.Mesh(
        np.pad(real_points(mesh), ((0, 0), (0, 1))),
        cells,
        point_data={SHIFT: np.pad(mesh.shift, ((0, 0), (0, 1)))} if mesh.shift.any() else {},
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data=names | {BODY[0]: np.array([BODY[1], 2])},
    )
    meshio.write(path, content, file_format="gmsh22", binary=True)
    with Path(path).open("a") as file:
        spec = json.dumps(asdict(mesh.spec), default=lambda array: np.asarray(array).tolist())
        file.write(f"${SPEC_SECTION}\n{spec}\n$End{SPEC_SECTION}\n")


def append_comment(path: str | Path, notes: Mapping[str, str]) -> None:
    """Adds lines "name: text" to a gmsh file in a section that all readers skip."""
    lines = "".join(f"{name}: {' '.join(text.split())}\n" for name, text in notes.items())
    with Path(path).open("a", encoding="utf-8") as file:
        file.write(f"$Comments\n{lines}$EndComments\n")


def read_msh(path: str | Path) -> BlockMesh:
    """The mesh that write_msh saved, with points of the flat block to rounding. Former versions
    wrote a shift of one component, z, and one that is zero. Raises MeshError for other files."""
    from meshio import gmsh  # meshio's own `read` ends the process where it cannot

    path = Path(path)
    spec = read_spec(path)
    with redirect_stderr(io.StringIO()):  # and says there what the caller is told by an error
        content = gmsh.read(path)
    none = np.zeros(len(content.points))
    shift = np.asarray(content.point_data.get(SHIFT, none), dtype=float)
    shift = shift[:, :2] if shift.ndim == 2 else np.column_stack([np.zeros_like(shift), shift])
    points = content.points[:, :2] - shift
    triangles = content.cells_dict["triangle6"].astype(np.int64)
    mesh = BlockMesh(points, triangles, shift, spec)
    return replace(mesh, quality=quality_of(mesh))


def read_spec(path: Path) -> BlockSpec:
    """The BlockSpec at the end of the file."""
    start = f"\n${SPEC_SECTION}\n".encode()
    content = path.read_bytes()
    at = content.rfind(start)
    if at < 0:
        raise MeshError(f"{path} holds no block mesh of this program")
    values = json.loads(content[at + len(start) :].split(b"\n", 1)[0])
    values["intervals"] = np.array(values["intervals"], dtype=float).reshape(-1, 2)
    if values["window"] is not None:
        values["window"] = tuple(values["window"])
    if values.get("vertices") is not None:
        values["vertices"] = np.array(values["vertices"], dtype=float)
    return BlockSpec(**values)
