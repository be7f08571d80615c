"""The norm of a difference."""

import numpy as np


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
