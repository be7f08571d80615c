"""The two models of every scene: their names in results, on the command line and in words."""

MODELS = ("half_plane", "finite_element")
HYPHENATED = {"half_plane": "half-plane", "finite_element": "finite-element"}  # the … model
LABELS = {"half_plane": "half-plane", "finite_element": "finite elements"}
