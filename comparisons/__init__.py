"""Scene, plan, both models, uncertainty, verdicts, report and the command line."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comparisons.scenes.scene import Scene

__all__ = ["Scene"]


def __getattr__(name: str) -> object:
    """What is public, loaded when it is asked for."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from comparisons.scenes.scene import Scene

    return Scene
