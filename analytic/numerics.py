"""What many modules demand of their arguments."""

import numpy as np


def check_positive(**named: float) -> None:
    """Raises ValueError, by name, for the first that is not a finite number above 0."""
    for name, value in named.items():
        if not (np.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} must be positive and finite, not {value:g}")
