"""The uniform line of nodes that pressures stand on, as the stresses take it."""

import numpy as np

_PITCH_TOLERANCE = 1e-6  # of the pitch: how far a node may stand from its place on the grid


def uniform_pitch(x_nodes: np.ndarray, pressure: np.ndarray) -> float:
    """Pitch [m] of the grid that carries `pressure`; ValueError where it is not uniform."""
    if np.ndim(x_nodes) != 1 or np.shape(x_nodes) != np.shape(pressure):
        raise ValueError("x_nodes and pressure must be one-dimensional and of equal length")
    if len(x_nodes) < 2:
        raise ValueError(f"a grid of pressures needs at least 2 nodes, not {len(x_nodes)}")
    if not (np.all(np.isfinite(x_nodes)) and np.all(np.isfinite(pressure))):
        raise ValueError("x_nodes and pressure must be finite")
    pitch = (x_nodes[-1] - x_nodes[0]) / (len(x_nodes) - 1)
    grid = x_nodes[0] + pitch * np.arange(len(x_nodes))
    if not (pitch > 0.0 and np.max(np.abs(x_nodes - grid)) <= _PITCH_TOLERANCE * pitch):
        raise ValueError("x_nodes must be uniform and ascending")
    return float(pitch)


def from_nearest(
    nodes: np.ndarray, pitch: float, x: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places x (m,) [m] and nodes (n,) [m], ascending, by whole pitches, which rounding spares.

    Whole pitches (n,) from the first node to each; those to the node nearest to each place (m,),
    and the pitches from there to the place (m,), 0 at a node as it was given.
    """
    whole = np.rint((nodes - nodes[0]) / pitch).astype(int)
    nearest = np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), x)
    return whole, whole[nearest], (x - nodes[nearest]) / pitch


def check_element(element: str) -> None:
    """ValueError unless `element` is "hat" or "strip"."""
    if element not in ("hat", "strip"):
        raise ValueError(f'element must be "hat" or "strip", not {element!r}')
