"""Surface vertices graded towards the ends of contact.

At the distance d from an end of contact the pressure varies as sqrt(d). A piecewise-linear pressure
on the vertices d_k = L (k / n)^2 has an error proportional to n^-2, one on equal edges an error
proportional to their length. The edges at the distance d inside and outside an end have the lengths

    max(e, sqrt(4 e d - e^2)),    e + g_o d,     e = L / n^2;

between two patches the smaller of the two lengths. Edges inside may be limited on a rough surface.

    L    half of the patch [m]        n    edges on it        g_o  OUTWARD, slope of the edges
"""

import numpy as np

from meshes.boundary import graded_line

# Outside the gap opens as d^(3/2). A steeper law is too coarse for the stress beside the contact; a
# flatter one costs hats without contact.
OUTWARD = 0.35
# Range beyond the outermost ends, in half-patches: the solved end still lies in it.
BEYOND = 0.25


def graded_vertices(patches: np.ndarray, edges: np.ndarray, largest: float = np.inf) -> np.ndarray:
    """Ascending x [m] of vertices for predicted contact on `patches` (k, 2) [m], disjoint.

    edges (k,) is the number on half of each patch without the limit `largest` [m] on their length.
    Every end of a patch is a vertex.
    """
    half = 0.5 * (patches[:, 1] - patches[:, 0])
    shortest = half / np.asarray(edges, dtype=float) ** 2

    def inside(k: int) -> np.ndarray:
        start, end = patches[k]
        e = shortest[k]

        def size(x: np.ndarray) -> np.ndarray:
            square = 4.0 * e * np.minimum(x - start, end - x) - e**2
            return np.minimum(np.sqrt(np.maximum(square, e**2)), largest)

        # Symmetric about the middle.
        left = graded_line(start, 0.5 * (start + end), size)
        return np.concatenate([left, (start + end) - left[-2:0:-1], [end]])

    def between(k: int) -> np.ndarray:
        start, end = patches[k, 1], patches[k + 1, 0]

        def size(x: np.ndarray) -> np.ndarray:
            from_left, from_right = shortest[k] + OUTWARD * (x - start), shortest[k + 1]
            return np.minimum(from_left, from_right + OUTWARD * (end - x))

        return graded_line(start, end, size)

    def beyond(k: int) -> np.ndarray:
        """Distances from the outer end of patch k."""
        return graded_line(0.0, BEYOND * half[k], lambda d: shortest[k] + OUTWARD * d)

    pieces = [patches[0, 0] - beyond(0)[::-1]]
    for k in range(len(patches)):
        pieces.append(inside(k)[1:])
        pieces.append(between(k)[1:] if k + 1 < len(patches) else patches[k, 1] + beyond(k)[1:])
    return np.concatenate(pieces)
