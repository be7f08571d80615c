"""The quadratic triangle: shape functions, their slopes, quadrature, on many elements at once.

Node order is gmsh's: vertices (0, 0), (1, 0), (0, 1), then the middles of edges 01, 12, 20.
Nomenclature: (r, s) reference coordinates, J = d(x, z)/d(r, s) Jacobian.
"""

import numpy as np

NODES = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5]])

# Edge middles' rule in the interior: degree 2, and where stresses of quadratic displacements
# are most accurate (Zienkiewicz and Taylor, The Finite Element Method, 5th ed., fig. 14.4).
GAUSS = np.array([[1, 1], [4, 1], [1, 4]]) / 6.0


def shapes(at: np.ndarray) -> np.ndarray:
    """Shape functions (..., 6) at reference points (..., 2)."""
    r, s = at[..., 0], at[..., 1]
    t = 1.0 - r - s
    return np.stack(
        [t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t],
        axis=-1,
    )


def slopes(at: np.ndarray) -> np.ndarray:
    """d shape / d(r, s) (..., 6, 2) at reference points (..., 2)."""
    r, s = at[..., 0], at[..., 1]
    t = 1.0 - r - s
    zero = np.zeros_like(r)
    along_r = [1 - 4 * t, 4 * r - 1, zero, 4 * (t - r), 4 * s, -4 * s]
    along_s = [1 - 4 * t, zero, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)]
    return np.stack([np.stack(along_r, axis=-1), np.stack(along_s, axis=-1)], axis=-1)


def jacobians(nodes: np.ndarray, at: np.ndarray) -> np.ndarray:
    """J (m, q, 2, 2) of elements with node coordinates (m, 6, 2) at reference points (q, 2)."""
    return np.einsum("mac,qad->mqcd", nodes, slopes(at), optimize=True)


def gradients(nodes: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """d values / d(x, z) (m, q, k, 2) of nodal values (m, 6, k) at reference points (q, 2)."""
    reference = np.einsum("mak,qad->mqkd", values, slopes(at), optimize=True)
    return reference @ np.linalg.inv(jacobians(nodes, at))
