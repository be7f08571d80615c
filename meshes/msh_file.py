"""The real body's mesh as a gmsh file (MSH 2.2, binary).

All readers know format 2.2 with its named sides; meshio writes 4.1 with empty entities."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from meshes.block import BlockMesh, real_points, unique_edges

# Physical groups: name, tag; the sides are curves, the body is a surface.
SIDES = {"top": 1, "right": 2, "bottom": 3, "left": 4}
BODY = ("body", 5)


def side_lines(mesh: BlockMesh) -> dict[str, np.ndarray]:
    """Edges (k, 3) of each side of SIDES: two vertices, then the midpoint."""
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    outer = np.flatnonzero(np.bincount(edge_of.ravel()) == 1)
    lines = np.column_stack([edges[outer], int(mesh.triangles[:, :3].max()) + 1 + outer])
    x, z = mesh.points[lines[:, 2]].T
    half, depth = mesh.spec.half_width, mesh.spec.depth
    on = {"top": z == 0.0, "right": x == half, "bottom": z == depth, "left": x == -half}
    return {name: lines[on[name]] for name in SIDES}


def write_msh(mesh: BlockMesh, path: str | Path, notes: Mapping[str, str] = {}) -> None:
    """Saves the real body in x, z, 0 [m], z into the body, and its named sides.

    notes  texts by name, for a section that all readers skip"""
    import meshio

    sides = side_lines(mesh)
    cells = [("line3", sides[name]) for name in SIDES] + [("triangle6", mesh.triangles)]
    numbers = [*SIDES.values(), BODY[1]]
    tags = [np.full(len(block), tag) for (_, block), tag in zip(cells, numbers, strict=True)]
    names = {name: np.array([tag, 1]) for name, tag in SIDES.items()}
    content = meshio.Mesh(
        np.pad(real_points(mesh), ((0, 0), (0, 1))),
        cells,
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data=names | {BODY[0]: np.array([BODY[1], 2])},
    )
    meshio.write(path, content, file_format="gmsh22", binary=True)
    lines = "".join(f"{name}: {' '.join(text.split())}\n" for name, text in notes.items())
    with Path(path).open("a", encoding="utf-8") as file:
        file.write(f"$Comments\n{lines}$EndComments\n")
