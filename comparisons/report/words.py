"""Names of the models as a reader says them."""

MODELS = {"half_plane": "half-plane", "finite_element": "finite-element"}  # the … model
LABELS = {"half_plane": "half-plane", "finite_element": "finite elements"}
