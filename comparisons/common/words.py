"""Names of models and quantities as a reader says them, with the symbols of the pictures."""

from comparisons.common.quantities import QUANTITIES

MODELS = {"half_plane": "half-plane", "finite_element": "finite-element"}  # the … model
LABELS = {"half_plane": "half-plane", "finite_element": "finite elements"}
_SYMBOLS = {
    "tau1_max": "largest principal shear stress τ₁",
    "tau1_max_depth": "depth of the largest τ₁",
    "txz_max_abs": "largest orthogonal shear stress |τxz|",
}


def label(quantity: str) -> str:
    """A quantity of result.json in words; a name that is none stays as it is."""
    if quantity not in QUANTITIES:
        return quantity.replace("_", " ")
    return _SYMBOLS.get(quantity, QUANTITIES[quantity].label.replace("tau1", "τ₁"))
