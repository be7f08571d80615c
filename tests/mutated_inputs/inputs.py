"""Mutated scenes and profiles, written one after the other; the same for a seed."""

import random
import shutil
from collections.abc import Iterable, Iterator
from pathlib import Path

from comparisons.scenes.files import SCENES

from .mutations import (
    BODIES,
    FULL,
    LOAD,
    STRESS,
    mutated_profile,
    mutated_scene,
    reading_scene,
    traces,
)
from .outcomes import outcome, resolve


def scenes(folder: Path, numbers: Iterable[int], seed: int) -> Iterator[tuple[int, Path]]:
    """Number and path of each mutated scene, written into the folder one after the other."""
    shutil.copytree(SCENES / "profiles", folder / "profiles")
    bases = [path.read_text() for path in sorted(SCENES.glob("*.toml"))]
    bases += FULL
    for number in numbers:
        draw = random.Random(f"scene {seed} {number}")
        path = folder / "scene.toml"
        path.write_bytes(mutated_scene(draw, draw.choice(bases)))
        yield number, path


def profiles(folder: Path, numbers: Iterable[int], seed: int) -> Iterator[tuple[int, Path]]:
    """Number and path of each good scene with a mutated profile."""
    for number in numbers:
        draw = random.Random(f"profile {seed} {number}")
        name, content, heights_alone = traces(draw)
        (folder / name).write_bytes(mutated_profile(draw, content))
        path = folder / "scene.toml"
        path.write_text(reading_scene(draw, name, heights_alone))
        yield number, path


def tiny_scenes(folder: Path, numbers: Iterable[int], seed: int) -> Iterator[tuple[int, Path]]:
    """Mutated scenes of few elements, points and samples that can be resolved."""
    tiny = "[resolution]\nlevels = 2\n"
    smooth = BODIES + LOAD + STRESS
    bases = [smooth, smooth + tiny, BODIES + LOAD + tiny, *(FULL[i] for i in (0, 5, 6))]
    for number in numbers:
        draw = random.Random(f"tiny {seed} {number}")
        path = folder / "scene.toml"
        for _ in range(50):
            path.write_bytes(mutated_scene(draw, draw.choice(bases)))
            if outcome(resolve, path)[0] == "resolved":
                break
        yield number, path
