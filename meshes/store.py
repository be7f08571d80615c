"""The real body's mesh as a gmsh file (MSH 2.2, binary), and back.

Format 2.2 because meshio, gmsh and what builds on them read it alike, named sides included;
meshio writes 4.1 with empty extents of the entities.
"""

import json
import os
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

import numpy as np

from meshes.block import BlockMesh, BlockSpec
from meshes.errors import MeshError
from meshes.quality import quality_of, real_points
from meshes.second_order import unique_edges

# Physical groups: name, tag; the sides are curves, the body is a surface.
SIDES = {"top": 1, "right": 2, "bottom": 3, "left": 4}
BODY = ("body", 5)
# Node data: the vector to subtract to come back to the flat block, its third component zero.
SHIFT = "shift"
# Readers skip sections that they do not know.
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
    """Saves the real body, its named sides and what is needed to read it back.

    Coordinates are x, z, 0 [m], z into the body. The file appears whole or not at all.
    """
    import meshio

    path = Path(path)
    lines = side_lines(mesh)
    cells = [("line3", lines[name]) for name in SIDES] + [("triangle6", mesh.triangles)]
    tags = [
        np.full(len(block), tag)
        for (_, block), tag in zip(cells, [*SIDES.values(), BODY[1]], strict=True)
    ]
    points = real_points(mesh)
    content = meshio.Mesh(
        _three_components(points),
        cells,
        point_data={SHIFT: _three_components(mesh.shift)},
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data={name: np.array([tag, 1]) for name, tag in SIDES.items()}
        | {BODY[0]: np.array([BODY[1], 2])},
    )
    spec = {
        name: value.tolist() if isinstance(value, np.ndarray) else value
        for name, value in asdict(mesh.spec).items()
    }
    unfinished = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        meshio.write(unfinished, content, file_format="gmsh22", binary=True)
        with unfinished.open("a") as file:
            file.write(f"${SPEC_SECTION}\n{json.dumps(spec, default=float)}\n$End{SPEC_SECTION}\n")
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)


def append_comment(path: str | Path, notes: Mapping[str, str]) -> None:
    """Say more of a gmsh file in a section that all readers skip: a line "name: text" each."""
    lines = "".join(f"{name}: {' '.join(text.split())}\n" for name, text in notes.items())
    with Path(path).open("a", encoding="utf-8") as file:
        file.write(f"$Comments\n{lines}$EndComments\n")


def read_msh(path: str | Path) -> BlockMesh:
    """The mesh that write_msh saved: same real points, shift, triangles and spec.

    Points of the flat block come back within the rounding of points + shift - shift; those of a
    rough top side are exact. A shift of one component, as files of former versions hold it, is one
    in z. Raises MeshError when the file is not one of write_msh.
    """
    import meshio

    path = Path(path)
    spec = read_spec(path)
    content = meshio.read(path, file_format="gmsh")
    shift = np.asarray(content.point_data[SHIFT], dtype=float)
    shift = shift[:, :2] if shift.ndim == 2 else np.column_stack([np.zeros_like(shift), shift])
    points = content.points[:, :2] - shift
    triangles = content.cells_dict["triangle6"].astype(np.int64)
    mesh = BlockMesh(points, triangles, shift, spec)
    return BlockMesh(points, triangles, shift, spec, quality_of(mesh))


def _three_components(vectors: np.ndarray) -> np.ndarray:
    """Vectors (n, 2) with a zero for the direction across the plane."""
    return np.column_stack([vectors, np.zeros(len(vectors))])


def read_spec(path: Path) -> BlockSpec:
    """The BlockSpec kept at the end of the file."""
    start = f"\n${SPEC_SECTION}\n".encode()
    content = path.read_bytes()
    at = content.rfind(start)
    if at < 0:
        raise MeshError(f"{path} holds no block mesh of this program")
    kept = json.loads(content[at + len(start) :].split(b"\n", 1)[0])
    window = None if kept["window"] is None else tuple(kept["window"])
    intervals = np.array(kept["intervals"], dtype=float).reshape(-1, 2)
    vertices = kept.get("vertices")
    vertices = None if vertices is None else np.array(vertices, dtype=float)
    kept |= {"intervals": intervals, "window": window, "vertices": vertices}
    return BlockSpec(**kept)
