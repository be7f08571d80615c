"""Finished levels of an unfinished run, on disk, so that a run that was stopped goes on.

The folder is hidden in the run's own, or beside it while there is none, and goes when the run
has ended. A level is kept as one .npz file: its arrays, and a JSON text that says how they make
up the level. What it is good for is told by a key, the hash of everything that shapes a level:
scene, profile, models, versions, and the program's own text.
"""

import hashlib
import json
import os
import shutil
from dataclasses import fields, is_dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from analytic.contact import ContactSolution, Residuals
from analytic.gap import HatGrid
from analytic.plane_stress import Extremum, PlaneStress
from comparisons.files import ATTEMPTS, unfinished
from comparisons.level import Level, MeshField, StressResult
from comparisons.operator_check import Column, Differences, OperatorCheck, Wave
from comparisons.plan import Plan
from comparisons.rank import from_first, is_first
from comparisons.record import digest, versions
from comparisons.scene import ResolvedScene
from meshes.block import BlockMesh, BlockSpec

KEPT = {
    kind.__name__: kind
    for kind in (
        Level,
        HatGrid,
        ContactSolution,
        Residuals,
        StressResult,
        Extremum,
        PlaneStress,
        MeshField,
        BlockMesh,
        BlockSpec,
        OperatorCheck,
        Differences,
        Column,
        Wave,
    )
}
SOURCES = Path(__file__).resolve().parents[1]
PACKAGES = ("analytic", "meshes", "fem", "comparisons")


class Checkpoint:
    """Levels of the run that carries out `plan` for `scene` and writes `out`."""

    def __init__(self, out: Path, scene: ResolvedScene, plan: Plan) -> None:
        self.folder = unfinished(out)
        self.key = _key(scene, plan)

    def load(self, name: str) -> Level | None:
        """The level kept under `name` by a run with the same key, else None."""
        return from_first(lambda: self._read(name))

    def _read(self, name: str) -> Level | None:
        path = self.folder / f"{name}.npz"
        try:
            with np.load(path, allow_pickle=False) as arrays:
                outline = json.loads(str(arrays["outline"]))
                if outline["key"] != self.key:
                    return None
                return _decoded(outline["level"], arrays)
        except (OSError, ValueError, KeyError, EOFError, BadZipFile):
            return None  # absent, or cut short: it is computed again

    def save(self, name: str, level: Level) -> None:
        """Keep a level; whole or not at all.

        Another run into the same folder may end, and remove it, at any moment; a level that is
        lost to that is computed again if it is ever needed.
        """
        if not is_first():
            return
        arrays: dict[str, np.ndarray] = {}
        outline = {"key": self.key, "level": _encoded(level, arrays)}
        part = self.folder / f"{name}.{os.getpid()}.part.npz"
        for _ in range(ATTEMPTS):
            self.folder.mkdir(parents=True, exist_ok=True)
            try:
                np.savez(part, outline=np.array(json.dumps(outline)), **arrays)
                os.replace(part, self.folder / f"{name}.npz")
                return
            except FileNotFoundError:
                continue

    def discard(self) -> None:
        """Remove what is kept."""
        if is_first():
            shutil.rmtree(self.folder, ignore_errors=True)


def _key(scene: ResolvedScene, plan: Plan) -> str:
    profile = "" if scene.profile is None else digest(scene.profile.x, scene.profile.height)
    parts = [scene.tables, profile, repr(plan), versions(), program_text()]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def program_text() -> str:
    """Hash of the program itself: another one may give other figures."""
    text = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted((SOURCES / package).rglob("*.py")):
            text.update(path.read_bytes())
    return text.hexdigest()


def _encoded(value: object, arrays: dict[str, np.ndarray]) -> object:
    """JSON that stands for a value; its arrays go to `arrays` under the numbers it names."""
    if is_dataclass(value):
        parts = {f.name: _encoded(getattr(value, f.name), arrays) for f in fields(value)}
        return {"kind": type(value).__name__, "fields": parts}
    if isinstance(value, np.ndarray):
        name = f"a{len(arrays)}"
        arrays[name] = value
        return {"array": name}
    if isinstance(value, tuple):
        return {"tuple": [_encoded(item, arrays) for item in value]}
    if isinstance(value, dict):
        return {"dict": [[key, _encoded(item, arrays)] for key, item in value.items()]}
    if isinstance(value, np.generic):
        return value.item()
    return value


def _decoded(given: object, arrays: dict[str, np.ndarray]) -> object:
    if not isinstance(given, dict):
        return given
    if "array" in given:
        return arrays[given["array"]]
    if "tuple" in given:
        return tuple(_decoded(item, arrays) for item in given["tuple"])
    if "dict" in given:
        return {key: _decoded(item, arrays) for key, item in given["dict"]}
    parts = {name: _decoded(item, arrays) for name, item in given["fields"].items()}
    return KEPT[given["kind"]](**parts)
