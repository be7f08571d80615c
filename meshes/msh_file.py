"""The real body's mesh as a gmsh file (MSH 2.2, binary).

All readers know format 2.2 with its named sides."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from meshes.block import BlockMesh, real_points, unique_edges

# Physical groups: name, tag; the sides are curves, the body is a surface.
SIDES = {"top": 1, "right": 2, "bottom": 3, "left": 4}
BODY = ("body", 5)
LINE3, TRIANGLE6 = (1, 8), (2, 9)  # dimension and gmsh's number


def side_lines(mesh: BlockMesh) -> dict[str, np.ndarray]:
    """Edges (k, 3) of each side of SIDES: two vertices, then the midpoint."""
    edges, edge_of = unique_edges(mesh.triangles[:, :3])
    outer = np.flatnonzero(np.bincount(edge_of.ravel()) == 1)
    lines = np.column_stack([edges[outer], int(mesh.triangles[:, :3].max()) + 1 + outer])
    x, z = mesh.points[lines[:, 2]].T
    half, depth = mesh.spec.half_width, mesh.spec.depth
    on = {"top": z == 0.0, "right": x == half, "bottom": z == depth, "left": x == -half}
    return {name: lines[on[name]] for name in SIDES}


def write_msh(mesh: BlockMesh, path: Path, notes: Mapping[str, str] = {}) -> None:
    """Saves the real body in x, z, 0 [m], z into the body, and its named sides.

    notes  texts by name, for a section that all readers skip"""
    points, sides = real_points(mesh), side_lines(mesh)
    nodes = np.zeros(len(points), [("number", "<i4"), ("place", "<f8", 3)])
    nodes["number"], nodes["place"][:, :2] = 1 + np.arange(len(points)), points
    groups = [(name, tag, *LINE3, sides[name]) for name, tag in SIDES.items()]
    groups.append((*BODY, *TRIANGLE6, mesh.triangles))
    names, integers, count = f"{len(groups)}\n", [], 0
    for name, tag, dimension, kind, corners in groups:
        names += f'{dimension} {tag} "{name}"\n'
        numbers, tags = 1 + count + np.arange(len(corners)), np.full((len(corners), 2), tag)
        integers += [[kind, *tags.shape], np.column_stack([numbers, tags, 1 + corners]).ravel()]
        count += len(corners)
    said = "".join(f"{name}: {' '.join(text.split())}\n" for name, text in notes.items())
    sections = {
        b"MeshFormat": b"2.2 1 8\n\1\0\0\0\n",  # the last tells the order of bytes
        b"PhysicalNames": names.encode(),
        b"Nodes": b"%d\n%b\n" % (len(nodes), nodes.tobytes()),
        b"Elements": b"%d\n%b\n" % (count, np.concatenate(integers).astype("<i4").tobytes()),
        b"Comments": said.encode(),
    }
    content = (b"$%b\n%b$End%b\n" % (name, text, name) for name, text in sections.items())
    path.write_bytes(b"".join(content))
