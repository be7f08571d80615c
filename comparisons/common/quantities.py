"""The models and the figures that are compared: their names in result.json, and in words.

Figures of one model are numbers per level; figures of a pair are relative L2 norms of the
difference of two fields on the same points, with the finite elements as the reference.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic.exact.hertz import HertzContact


@dataclass(frozen=True)
class Quantity:
    """A compared figure.

    label         in words, for tables
    unit          of the figure in SI; "" for ratios
    scale         of the smooth contact: what a figure that vanishes is measured by
    formal_order  of convergence under refinement: 2 for the quadratic elements' smooth figures,
                  1 where the square-root edge of a contact governs, or how well it is found
    of_pair       a norm of a difference, no figure of one model
    needs_stress  only with a [stress] table
    """

    label: str
    unit: str
    scale: Callable[[HertzContact], float]
    formal_order: float
    of_pair: bool = False
    needs_stress: bool = False


def _pressure(hertz: HertzContact) -> float:
    return hertz.peak_pressure


def _half_width(hertz: HertzContact) -> float:
    return hertz.half_width


def _one(hertz: HertzContact) -> float:
    return 1.0


QUANTITIES: dict[str, Quantity] = {
    "peak_pressure": Quantity("peak pressure", "Pa", _pressure, 2.0),
    "contact_length": Quantity("contact length", "m", _half_width, 1.0),
    "contact_ratio": Quantity("contact length over Hertz 2a", "", _one, 1.0),
    "pressure_l2": Quantity("pressures, relative L2 difference", "", _one, 1.0, of_pair=True),
    "tau1_max": Quantity("largest principal shear stress", "Pa", _pressure, 2.0, needs_stress=True),
    "tau1_max_depth": Quantity(
        "depth of the largest principal shear", "m", _half_width, 2.0, needs_stress=True
    ),
    "txz_max_abs": Quantity(
        "largest orthogonal shear stress", "Pa", _pressure, 2.0, needs_stress=True
    ),
    "tau1_field_near": Quantity(
        "tau1 down to 0.1 a, relative L2 difference",
        "",
        _one,
        1.0,
        of_pair=True,
        needs_stress=True,
    ),
    "tau1_field_deep": Quantity(
        "tau1 deeper than 0.5 a, relative L2 difference",
        "",
        _one,
        1.0,
        of_pair=True,
        needs_stress=True,
    ),
}

_SYMBOLS = {
    "tau1_max": "largest principal shear stress τ₁",
    "tau1_max_depth": "depth of the largest τ₁",
    "txz_max_abs": "largest orthogonal shear stress |τxz|",
}
NEAR, DEEP = 0.1, 0.5  # bounds of the near and the deep field, in Hertz half-widths


def relative_l2(
    values: np.ndarray, reference: np.ndarray, weights: np.ndarray | float = 1.0
) -> float:
    """||values - reference|| / ||reference||; points where either is not finite are left out."""
    known = np.isfinite(values) & np.isfinite(reference)
    weights = np.broadcast_to(weights, values.shape)[known]
    size = np.sum(weights * reference[known] ** 2)
    if size == 0.0:
        return 0.0 if not np.any(values[known]) else np.inf
    return float(np.sqrt(np.sum(weights * (values[known] - reference[known]) ** 2) / size))


def layer_thickness(depths: np.ndarray) -> np.ndarray:
    """Thickness (m,) [m] that each of the ascending depths (m,) [m] stands for in an integral."""
    return np.gradient(depths) if len(depths) > 1 else np.ones(1)


def label(quantity: str) -> str:
    """A quantity of result.json in words; a name that is none stays as it is."""
    if quantity not in QUANTITIES:
        return quantity.replace("_", " ")
    return _SYMBOLS.get(quantity, QUANTITIES[quantity].label.replace("tau1", "τ₁"))
