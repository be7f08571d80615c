"""What the next round of an adapted contact refines, from the errors of the last one.

Hats and elements share an error. Each is refined where that takes the fewest of them, by how errors
fall with their number on a patch and with their size.

    n_k    edges on half of patch k        e_k    L2 error of the pressure on it [Pa m^(1/2)]
    h_m    size of element m [m]           E_m    its error in the norm of energy [(J/m)^(1/2)]
    q      degree of the displacement
"""

import numpy as np

from analytic.contact.smooth_pressure import Patch

FEWEST_EDGES, MOST_FINER = 5, 4.0  # on half a patch; by how much a round may refine it


def next_edges(
    patches: tuple[Patch, ...], hats: np.ndarray, aim: float
) -> tuple[np.ndarray, np.ndarray]:
    """Ends (k, 2) [m] of the patches, and edges (k,) on their halves for an error of `aim`.

    Graded edges err like n^-2: e_k^2 n_k^4 stays, and the fewest altogether have n_k in proportion
    to its fifth root. How many there were, the edges at the ends tell.
    """
    ends = np.array([patch.ends for patch in patches])
    half, edge = 0.5 * np.diff(ends, axis=1)[:, 0], np.diff(hats)
    shortest = np.array([0.5 * (edge[patch.first] + edge[patch.last + 1]) for patch in patches])
    now = np.sqrt(half / shortest)
    weight = np.array([patch.error**2 for patch in patches]) * now**4
    wanted = (np.sum(weight**0.2) / aim**2) ** 0.25 * weight**0.2
    wanted = np.clip(wanted, FEWEST_EDGES, np.maximum(FEWEST_EDGES, MOST_FINER * now))
    return joined_patches(ends, wanted)


def joined_patches(ends: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Patches too close for two of their shortest edges between them taken as one."""
    kept_ends, kept_edges = [ends[0]], [edges[0]]
    for (start, end), count in zip(ends[1:], edges[1:], strict=True):
        before = kept_ends[-1]
        shortest = min(before[1] - before[0], end - start) / max(count, kept_edges[-1]) ** 2
        if start - before[1] < shortest:
            kept_ends[-1] = np.array([before[0], end])
            kept_edges[-1] += count
        else:
            kept_ends.append(np.array([start, end]))
            kept_edges.append(count)
    return np.array(kept_ends), np.array(kept_edges)


def next_sizes(energy: np.ndarray, aim: float, degree: int) -> np.ndarray:
    """Factors (m,) of the elements' sizes that leave a sum of `aim` [J/m] of the squares of their
    errors (m,), with the fewest elements: each errs alike then.

    E_m ~ h_m^(q+1), and an element makes way for h_m^2 of the next ones.
    """
    order = degree + 1
    energy = np.maximum(energy, 1e-12 * energy.max())
    alike = (aim / np.sum(energy ** (2.0 / order))) ** (order / (2.0 * degree))
    return (alike / energy) ** (1.0 / order)
