"""Scenes and materials that tests start from, and the places of the files that they read."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from comparisons.models.problem import Problem
    from comparisons.scenes.scene import Scene

PROJECT = Path(__file__).resolve().parents[1]
DATA = PROJECT / "tests/data"
PROFILES = PROJECT / "comparisons/scenes/library/profiles"
MEASURED = PROJECT.parent / "shared/profiles"  # other people's: tests without them are skipped

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
RUBBER = {"youngs_modulus": 3e6, "poissons_ratio": 0.45}
SMOOTH = {
    "title": "Smooth",
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 3.55e6},
}
# With a field of few points, and nothing beside the two models.
QUICK = SMOOTH | {"stress": {"points": [120, 40]}, "budget": {"effects": False}}


def changed(tables: dict, **sections: dict) -> dict:
    """The tables with some fields of some sections replaced, or added."""
    return tables | {name: tables.get(name, {}) | fields for name, fields in sections.items()}


def resolved(tables: dict, name: str = "made", folder: Path = Path(".")) -> "Scene":
    """The scene that a file of these tables describes."""
    from comparisons.scenes.scene import Origin, Scene

    return Scene.of(tables, Origin(name, folder, f"{name}.toml"))


def judging(scene: "Scene", tolerance: dict[str, float]) -> "Scene":
    """The scene that judges by these tolerances alone."""
    names = type(scene.tolerance).model_fields
    return scene.unchecked({f"tolerance.{name}": tolerance.get(name) for name in names})


def problem(tables: dict) -> "Problem":
    """The mechanical problem that a scene file of these tables poses."""
    from comparisons.models.problem import problem_of

    return problem_of(resolved(tables))


def hat_nodes(x0: float, pitch: float, count: int) -> np.ndarray:
    """x (count + 2,) [m] of the nodes of equal hats at x0 + i pitch, with their outer feet."""
    return x0 + pitch * np.arange(-1, count + 1)
