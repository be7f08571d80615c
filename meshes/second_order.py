"""Edge midpoints: from three-node to six-node triangles."""

import numpy as np

# Local ends of the three edges, in gmsh's order of the midpoints.
EDGES = np.array([[0, 1], [1, 2], [2, 0]])


def unique_edges(triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges (e, 2) with the lower vertex first, and for each triangle (m, 3) its three edges."""
    ends = np.sort(triangles[:, EDGES].reshape(-1, 2), axis=1).astype(np.int64)
    n = int(triangles.max()) + 1
    keys, edge_of = np.unique(ends[:, 0] * n + ends[:, 1], return_inverse=True)
    return np.column_stack([keys // n, keys % n]), edge_of.reshape(-1, 3)


def add_midpoints(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points (n + e, 2), vertices first, and six-node triangles (m, 6) in gmsh's node order."""
    edges, edge_of = unique_edges(triangles)
    middle = 0.5 * (vertices[edges[:, 0]] + vertices[edges[:, 1]])
    return np.concatenate([vertices, middle]), np.hstack([triangles, len(vertices) + edge_of])
