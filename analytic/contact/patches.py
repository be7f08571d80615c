"""Contact patches, where the bodies touch, with their edges found between the nodes."""

import numpy as np

from analytic.numerics import runs_of

CLEAR = 6  # open nodes that the extrapolation of an edge needs


def contact_patches(x: np.ndarray, pressure: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Patches (k, 2) [m], ascending, from nodal pressures and mean gaps over the hats (n,) [Pa, m].

    `x` (n,) [m] is a uniform grid. Beyond the edge e of a smooth contact the gap opens as
    (x - e)^(3/2) (Johnson 1985, section 4.2), so its power 2/3 is nearly straight: a parabola
    through the second to fourth open nodes, past the first that the discrete edge disturbs,
    vanishes within a tenth of the pitch of e. Where the next patch is nearer than CLEAR nodes
    the edge is taken half a pitch beyond the last touching node."""
    first, after = runs_of(pressure > 0.0)
    last = after - 1
    pitch = x[1] - x[0]
    patches = np.empty((len(first), 2))
    for k, (i, j) in enumerate(zip(first, last, strict=True)):
        left = gap[last[k - 1] + 1 if k else 0 : i][::-1]
        right = gap[j + 1 : first[k + 1] if k + 1 < len(first) else len(x)]
        patches[k] = x[i] - _edge(left) * pitch, x[j] + _edge(right) * pitch
    return patches


def _edge(opening: np.ndarray) -> float:
    """Distance (0 to 1 pitch) of the edge from the last touching node; gaps from there outwards."""
    if len(opening) < CLEAR:
        return 0.5
    bulge = (opening[:4] - 2.0 * opening[1:5] + opening[2:6]) / 12.0
    second, third, fourth = np.maximum(opening[1:5] - bulge, 0.0)[:3] ** (2.0 / 3.0)
    bend = 0.5 * (second - 2.0 * third + fourth)
    slope = 0.5 * (fourth - second)
    discriminant = slope**2 - 4.0 * bend * third
    if slope <= 0.0 or discriminant < 0.0:
        return 0.5
    # root of third + slope s + bend s^2 next to s = 0, in the form that survives bend = 0
    root = -2.0 * third / (slope + np.sqrt(discriminant))
    return float(np.clip(3.0 + root, 0.0, 1.0))
