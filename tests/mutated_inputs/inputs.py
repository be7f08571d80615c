"""Mutated scenes, profiles and results, written one after the other; the same for a seed."""

import json
import random
import shutil
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from comparisons.figures.quantity import MODELS
from comparisons.runs.run import run
from comparisons.scenes.files import SCENES
from comparisons.scenes.scene import Scene

from .mutations import (
    BODIES,
    FULL,
    LOAD,
    STRESS,
    flipped,
    json_with_a_mistake,
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
    """The same with mutated profiles under good scenes."""
    for number in numbers:
        draw = random.Random(f"profile {seed} {number}")
        trace, heights_alone = _mutated_trace(folder, draw)
        path = folder / "scene.toml"
        path.write_text(reading_scene(draw, trace.name, heights_alone))
        yield number, path


def profiles_alone(folder: Path, numbers: Iterable[int], seed: int) -> Iterator[tuple[int, Path]]:
    """The same without a scene."""
    for number in numbers:
        trace, _ = _mutated_trace(folder, random.Random(f"alone {seed} {number}"))
        yield number, trace


def _mutated_trace(folder: Path, draw: random.Random) -> tuple[Path, bool]:
    """The file of a mutated profile, and whether it gives heights alone."""
    name, content, heights_alone = traces(draw)
    (folder / name).write_bytes(mutated_profile(draw, content))
    return folder / name, heights_alone


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


def results(folder: Path, numbers: Iterable[int], seed: int) -> Iterator[tuple[int, Path]]:
    """Numbers and paths of folders that runs have left, with a mistake in one of their files."""
    bases = [folder / name for name in ("both", "half_plane")]
    effects = "[budget]\neffects = false\n"
    tiny = '[resolution]\nlevels = 2\npitch = "20 um"\n[finite_element]\nblock = 20.0\n'
    (folder / "both.toml").write_text(BODIES + LOAD + STRESS + tiny + effects)
    (folder / "half_plane.toml").write_text(FULL[5] + STRESS)
    for base in bases:
        models = MODELS if base.name == "both" else ("half_plane",)
        run(Scene.read(base.with_suffix(".toml")), base, models)
    for number in numbers:
        draw = random.Random(f"result {seed} {number}")
        path = folder / "run"
        shutil.rmtree(path, ignore_errors=True)
        shutil.copytree(draw.choice(bases), path)
        file = path / draw.choice(("result.json", "record.json", "report.npz", "report.npz"))
        if draw.random() < 0.2:
            file = draw.choice([entry for entry in path.rglob("*") if entry.is_file()])
            file.write_bytes(flipped(draw, file.read_bytes()))
        elif file.suffix == ".json":
            for _ in range(draw.choice((1, 1, 3))):
                changed = json_with_a_mistake(draw, json.loads(file.read_text()))
                file.write_text(json.dumps(changed))
        else:
            with np.load(file) as arrays:
                kept = dict(arrays)
            outline = json_with_a_mistake(draw, json.loads(str(kept["outline"])))
            np.savez(file, **{**kept, "outline": np.array(json.dumps(outline))})
        yield number, path
