"""The norm of a difference, how far two pressures lie beside each other, and what is left then.

On the deformed surface asperities move with the material: together, and apart where the surface
stretches. Narrow peaks that move by a part of their width make a large L2 norm, while the peaks
themselves hardly differ. What is at x moves to x + shift + stretch x; both are those that minimise

    ||p((x - shift) / (1 + stretch)) - reference(x)|| / ||reference||

searched first over whole pitches, by correlation, then refined."""

from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.optimize import minimize

from analytic.grid import HatGrid

FARTHEST = 0.05  # of the contact's extent: the largest shift, and the largest stretch, searched
APART = 2.0  # pitches that the contact's ends move from one searched stretch to the next
SETTLED = 1e-4  # pitches


@dataclass(frozen=True)
class SidewaysShift:
    """The movement of a pressure that brings it nearest to the reference."""

    shift: float  # [m] at x = 0, positive towards +x
    stretch: float  # further shift by x [1]
    mean: float  # [m] size of the movement, by the reference's pressures
    left: float  # relative L2 norm of the difference after it


def sideways_shift(grid: HatGrid, pressure: np.ndarray, reference: np.ndarray) -> SidewaysShift:
    """Of a pressure (n,) [Pa] at the grid's nodes against a reference (n,) that is not zero."""
    x, pitch = grid.x, grid.pitch
    touched = x[(pressure > 0.0) | (reference > 0.0)]
    extent = float(np.ptp(touched)) + pitch
    # both unknowns in pitches: of the shift, and of the stretch at the ends of the contact
    per_pitch = np.array([pitch, 2.0 * pitch / extent])

    def moved(shift: float, stretch: float) -> np.ndarray:
        return np.interp((x - shift) / (1.0 + stretch), x, pressure, left=0.0, right=0.0)

    def left(movement: np.ndarray) -> float:
        return relative_l2(moved(*(movement * per_pitch)), reference)

    most = int(FARTHEST * extent / (2.0 * APART * pitch)) + 1
    lags = np.arange(1 - len(x), len(x))
    near = np.abs(lags) * pitch <= FARTHEST * extent
    length = next_fast_len(2 * len(x), real=True)
    spectrum = rfft(reference, length)
    starts = [np.zeros(2)]
    for stretch in APART * np.arange(-most, most + 1):
        stretched = moved(0.0, stretch * per_pitch[1])
        product = irfft(spectrum * rfft(stretched, length).conj(), length)[lags]
        product = np.where(near, product, -np.inf)
        starts.append(np.array([float(lags[np.argmax(product)]), stretch]))
    best = min(starts, key=left)
    simplex = best + np.array([[0.0, 0.0], [0.5, 0.0], [0.0, 0.5 * APART]])
    options = {"xatol": SETTLED, "fatol": 1.0, "initial_simplex": simplex}
    nearest = minimize(left, best, method="Nelder-Mead", options=options).x
    shift, stretch = map(float, min((best, nearest), key=left) * per_pitch)
    mean = float(np.average(np.abs(shift + stretch * x) / (1.0 + stretch), weights=reference))
    return SidewaysShift(shift, stretch, mean, left(np.array([shift, stretch]) / per_pitch))


def relative_l2(
    values: np.ndarray, reference: np.ndarray, weights: np.ndarray | float = 1.0
) -> float:
    """||values - reference|| / ||reference||; points where either is not finite are left out."""
    known = np.isfinite(values) & np.isfinite(reference)
    if not known.all():
        weights = np.broadcast_to(weights, values.shape)[known]
        values, reference = values[known], reference[known]
    size = np.sum(weights * reference**2)
    if size == 0.0:
        return 0.0 if not np.any(values) else np.inf
    return float(np.sqrt(np.sum(weights * (values - reference) ** 2) / size))
