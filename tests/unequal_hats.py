"""The half-plane's compliance for hats of unequal pitch, as a matrix.

For pressures p_i on hats phi_i between nodes that need not be equally far apart,

    D_ij = -(2 / (pi E*)) integral integral phi_i(x) phi_j(y) ln(|x - y| / L) dy dx,

what `analytic.operators.half_plane.HalfPlane` computes on a uniform grid. The second derivative of
a hat is three deltas c_ia at its nodes, so that with M'''' = ln

    integral integral phi_i phi_j ln|x - y| = sum_ab c_ia c_jb M(x_a - x_b),
    M(t) = t^4 (ln|t| - 25/12) / 24,

exact, but for close hats only: sums of fourth differences cancel far away, where Gauss's rule on
each cell is as good.

    hats  (n + 2,) nodes [m], ascending, with the feet of the outer two    E*  modulus [Pa]
    L     datum length [m]; default the distance of the two feet, as on a uniform grid
"""

import numpy as np
from scipy.sparse import csr_matrix

# Points of Gauss's rule on a cell, and hats that are far: farther apart than so many times the
# wider one. Together they leave 4e-9 of the entries of equal hats, 1e-6 of those of hats whose
# pitches jump tenfold.
GAUSS_POINTS = 3
FAR = 2.0


def hat_weights(hats: np.ndarray) -> np.ndarray:
    """Areas (n,) [m] under hats of height 1 with nodes and feet (n + 2,) [m]."""
    return 0.5 * (hats[2:] - hats[:-2])


def half_plane_matrix(hats: np.ndarray, modulus: float, datum: float | None = None) -> np.ndarray:
    """D (n, n) [m^2/Pa] of this module."""
    span = hats[-1] - hats[0]
    scaled = (hats - hats[0]) / span
    logs = _far(scaled)
    i, j = _close(scaled)
    logs[i, j] = _exact(scaled, i, j)
    weights = hat_weights(scaled)
    logs += np.log(span / (span if datum is None else datum)) * np.outer(weights, weights)
    return -(2.0 * span**2 / (np.pi * modulus)) * logs


def _far(hats: np.ndarray) -> np.ndarray:
    """Double integrals (n, n) of ln|x - y| by Gauss's rule; worthless for close hats."""
    at, weight = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    rising, cell = 0.5 * (1.0 + at), np.diff(hats)
    place = hats[:-1, None] + cell[:, None] * rising
    count = len(hats) - 2
    amount = 0.5 * cell[:, None] * weight
    value = np.stack([amount * (1.0 - rising), amount * rising])
    hat = np.stack([np.arange(-1, count), np.arange(count + 1)])[..., None]
    hat, point = np.broadcast_arrays(hat, np.arange(place.size).reshape(place.shape))
    inside = (hat >= 0) & (hat < count)
    spread = csr_matrix((value[inside], (hat[inside], point[inside])), shape=(count, place.size))
    distance = np.abs(np.subtract.outer(place.ravel(), place.ravel()))
    np.fill_diagonal(distance, 1.0)
    return spread @ (spread @ np.log(distance)).T


def _close(hats: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs i, j of hats less than FAR widths of the wider one apart."""
    start, end = hats[:-2], hats[2:]
    width = end - start
    apart = np.maximum(np.subtract.outer(start, end), np.subtract.outer(start, end).T)
    return np.nonzero(apart < FAR * np.maximum.outer(width, width))


def _exact(hats: np.ndarray, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """Double integrals (k,) of ln|x - y| over pairs of hats, by fourth differences."""
    before, after = 1.0 / np.diff(hats)[:-1], 1.0 / np.diff(hats)[1:]
    bend = np.stack([before, -(before + after), after])
    total = np.zeros(len(i))
    for a in range(3):
        for b in range(3):
            t = np.abs(hats[i + a] - hats[j + b])
            log = np.log(np.where(t > 0.0, t, 1.0))
            total += bend[a, i] * bend[b, j] * t**4 * (log - 25.0 / 12.0) / 24.0
    return total
