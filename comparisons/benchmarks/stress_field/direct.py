"""Direct summation of subsurface stresses, vectorised in blocks that stay in the cache.

Three forms, none of which uses that points may stand on a grid:

    hats          per point and element the closed form at its three nodes: 3 arctan2, 3 log
    strips        Bailey and Sayles 1991, eq. (1) and (2), as published: 2 arctan2, 2 hypot, 1 log,
                  sines and cosines of both angles; of other elements, so its result differs
    shared_nodes  hats again, angle and logarithm once a node and weighed with the load's change of
                  slope there: what superposition on a uniform line leaves
"""

from collections.abc import Callable

import numpy as np

FRICTION = 0.1
_PAIRS = 2**15  # of point and element at a time


def direct(
    terms: Callable[..., np.ndarray],
    nodes: np.ndarray,
    load: np.ndarray,
    x: np.ndarray,
    z: np.ndarray,
) -> np.ndarray:
    """sx, sz, txz (3, points) under p and q = FRICTION p by one of the three forms below."""
    parts = np.empty((4, x.size))
    step = max(1, _PAIRS // len(nodes))
    pitch = (nodes[-1] - nodes[0]) / (len(nodes) - 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        for start in range(0, x.size, step):
            here = slice(start, start + step)
            parts[:, here] = terms(x[here, None], z[here, None], nodes, load, pitch)
    sx, sz, txz, sx_traction = parts
    return np.array([sx + FRICTION * sx_traction, sz + FRICTION * txz, txz + FRICTION * sx])


def hats(
    x: np.ndarray, z: np.ndarray, nodes: np.ndarray, load: np.ndarray, pitch: float
) -> np.ndarray:
    """Sums of the hats' closed form (4, points): x, z (points, 1)."""
    offsets = [x - (nodes + shift) for shift in (-pitch, 0.0, pitch)]
    angles = [np.arctan2(z, y) for y in offsets]
    # r = 0 only on a node of the surface, where y ln r and z ln r are zero
    logs = [0.5 * np.log(np.maximum(y * y + z * z, 1e-300)) for y in offsets]
    angle, log = _bent(angles), _bent(logs)
    angle_moment = _bent([y * a for y, a in zip(offsets, angles, strict=True)])
    log_moment = _bent([y * a for y, a in zip(offsets, logs, strict=True)])
    return np.array(
        [
            (angle_moment + 2.0 * z * log) @ load,
            angle_moment @ load,
            -(z * angle) @ load,
            (3.0 * z * angle - 2.0 * log_moment) @ load,
        ]
    ) / (np.pi * pitch)


def strips(
    x: np.ndarray, z: np.ndarray, nodes: np.ndarray, load: np.ndarray, pitch: float
) -> np.ndarray:
    """Sums of the published equations for uniform strips (4, points)."""
    right, left = x - (nodes + 0.5 * pitch), x - (nodes - 0.5 * pitch)
    t1, t2 = np.arctan2(z, right), np.arctan2(z, left)
    turn = 2.0 * (t1 - t2)
    sines = np.sin(2.0 * t1) - np.sin(2.0 * t2)
    cosines = np.cos(2.0 * t1) - np.cos(2.0 * t2)
    log = 4.0 * np.log(np.hypot(right, z) / np.hypot(left, z))
    return np.array(
        [
            -(turn + sines) @ load,
            -(turn - sines) @ load,
            cosines @ load,
            (log - cosines) @ load,
        ]
    ) / (2.0 * np.pi)


def shared_nodes(
    x: np.ndarray, z: np.ndarray, nodes: np.ndarray, load: np.ndarray, pitch: float
) -> np.ndarray:
    """The hats' sums (4, points) with each node's angle and logarithm taken once."""
    ends = np.concatenate([[nodes[0] - pitch], nodes, [nodes[-1] + pitch]])
    bend = np.convolve(load, [1.0, -2.0, 1.0]) / (np.pi * pitch)
    y = x - ends
    angle, log = np.arctan2(z, y), 0.5 * np.log(np.maximum(y * y + z * z, 1e-300))
    z = z[:, 0]
    sz, turn = (y * angle) @ bend, z * (angle @ bend)
    return np.array([sz + 2.0 * z * (log @ bend), sz, -turn, 3.0 * turn - 2.0 * ((y * log) @ bend)])


def _bent(at: list[np.ndarray]) -> np.ndarray:
    return at[0] - 2.0 * at[1] + at[2]
