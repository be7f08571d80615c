"""The one error of this package."""


class MeshError(RuntimeError):
    """A mesh cannot be had: impossible request, failed mesher, or elements not fit to solve on."""
