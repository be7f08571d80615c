"""Ranges of the surface to refine, from the patches of predicted contact.

Their ends lie on the grid n * surface_size, where a pressure grid finds mesh vertices. If the
solved contact reaches beyond them, it is added to the patches, and the body meshed again."""

import numpy as np

from meshes.block import MeshError

# Ranges with fewer edges between them are joined: the elements could hardly grow in the gap.
MERGE_EDGES = 4
# Least rest between the last grid point and the side of the body, in edges.
LEAST_REST = 0.5
# Ends this close to a grid point, in edges, lie on it (rounding).
ON_GRID = 1e-6


def merge(ranges: np.ndarray, gap: float = 0.0) -> np.ndarray:
    """Disjoint ascending ranges (k, 2) that cover ranges (n, 2), no gap between them <= gap."""
    ranges = np.asarray(ranges, dtype=float).reshape(-1, 2)
    ranges = ranges[np.argsort(ranges[:, 0], kind="stable")]
    if len(ranges) == 0:
        return ranges
    reached = np.maximum.accumulate(ranges[:, 1])
    first = np.concatenate([[True], ranges[1:, 0] - reached[:-1] > gap])
    last = np.concatenate([first[1:], [True]])
    return np.column_stack([ranges[first, 0], reached[last]])


def refined_ranges(
    patches: np.ndarray, surface_size: float, *, margin: float, half_width: float
) -> np.ndarray:
    """Ranges (k, 2) of the surface [m] to refine, for a BlockSpec of that surface_size.

    patches (n, 2) [m] is the predicted contact, in any order, overlapping or of no length. Each is
    widened by margin [m] on both sides, extended to the grid n * surface_size, cut off at the sides
    of the body |x| = half_width [m], and joined with others fewer than MERGE_EDGES edges away.
    Raises MeshError if a patch lies outside the body or no edge fits into it."""
    patches = np.asarray(patches, dtype=float).reshape(-1, 2)
    if len(patches) == 0:
        return patches
    outside = (patches[:, 0] > half_width) | (patches[:, 1] < -half_width)
    if not np.isfinite(patches).all() or outside.any():
        worst = patches[np.argmax(outside)]
        raise MeshError(
            f"contact predicted from {worst[0]:g} to {worst[1]:g} m is not on the body, "
            f"|x| <= {half_width:g} m"
        )
    ends = (patches + margin * np.array([-1.0, 1.0])) / surface_size
    edges = np.column_stack([np.floor(ends[:, 0] + ON_GRID), np.ceil(ends[:, 1] - ON_GRID)])
    edges[:, 1] = np.maximum(edges[:, 1], edges[:, 0] + 1)
    to_side = half_width / surface_size
    last = np.floor(to_side + ON_GRID)
    if ON_GRID < to_side - last < LEAST_REST:
        last -= 1.0
    if last <= 0.0:
        raise MeshError(
            f"no surface edge of {surface_size:g} m fits into a body {2 * half_width:g} m wide"
        )
    edges[:, 0] = np.clip(edges[:, 0], -last, last - 1)
    edges[:, 1] = np.clip(edges[:, 1], 1 - last, last)
    return surface_size * merge(edges, gap=MERGE_EDGES - 0.5) + 0.0  # never -0


def unrefined_contact(intervals: np.ndarray, active: np.ndarray, reach: float = 0.0) -> np.ndarray:
    """Ranges (k, 2) [m] that are in contact but not refined. active (n,) [m] are the nodes in
    contact, each of which loads the surface up to reach [m] on both sides (the pitch of hat
    pressures). intervals (m, 2) [m] are the refined ranges."""
    intervals = merge(intervals)
    active = np.unique(np.asarray(active, dtype=float))
    loaded = active[:, None] + reach * np.array([-1.0, 1.0])
    if len(intervals) == 0:
        return merge(loaded)
    slack = 1e-9 * np.abs(np.diff(intervals, axis=1)).max()
    at = np.maximum(np.searchsorted(intervals[:, 0], active + slack, side="right") - 1, 0)
    inside = (loaded[:, 0] >= intervals[at, 0] - slack) & (loaded[:, 1] <= intervals[at, 1] + slack)
    return merge(loaded[~inside])
