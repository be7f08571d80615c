"""One tolerance for all that a scene judges, in place of the scene's own."""

from dataclasses import replace

from comparisons.common.errors import InputError
from comparisons.scenes.scene import ResolvedScene


def with_tolerance(scene: ResolvedScene, tolerance: float) -> ResolvedScene:
    """The scene with it; relative. Raises InputError unless it is above 0 and below 1."""
    if not 0.0 < tolerance < 1.0:
        raise InputError(f"--tolerance: is {tolerance:g}; allowed is above 0 and below 1")
    judged_by = dict.fromkeys(scene.tolerance, tolerance)
    return replace(scene, tolerance=judged_by, tables=scene.tables | {"tolerance": dict(judged_by)})
