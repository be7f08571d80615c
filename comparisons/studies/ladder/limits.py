"""How far a run goes: to the rung that its budget names, and no further than one that holds."""

from comparisons.figures.quantity import MODELS, UP_TO
from comparisons.scenes.scene import Scene

BY_HALF_PLANE = UP_TO[:3]  # rungs that take no finite elements
# What a scene's finite elements do without on a rung.
WITHOUT = {
    "linear": {
        "finite_element.deformation": "linear",
        "finite_element.plastic": False,
        "budget.effects": False,
    },
    "finite": {"finite_element.plastic": False},
}


def limited(scene: Scene, models: tuple[str, ...]) -> tuple[Scene, tuple[str, ...]]:
    """The scene and its models without what lies beyond `budget.up_to`."""
    rung = scene.budget.up_to
    if rung in BY_HALF_PLANE:
        return scene, MODELS[:1]
    return scene.unchecked(WITHOUT.get(rung, {})), models


def may_stop_early(scene: Scene, models: tuple[str, ...]) -> bool:
    """Whether the half-plane alone is asked first."""
    return scene.budget.up_to != UP_TO[-1] and models == MODELS and scene.load.kind != "approach"
