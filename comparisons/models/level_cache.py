"""Finished levels of an unfinished run, on disk, so that a run that was stopped goes on.

The folder is hidden in the run's own, or beside it while there is none, and goes when the run
has ended. What a level is good for is told by a key, the hash of everything that shapes it: scene,
profile, models, versions, and the program's own code.
"""

import hashlib
import json
import marshal
import shutil
from pathlib import Path
from types import CodeType

from analytic.contact.problem import ContactSolution, Residuals
from analytic.grid import HatGrid
from analytic.stress_state import Extremum, StressState
from comparisons.common.cache import keep, kept
from comparisons.common.files import unfinished
from comparisons.common.mpi import from_first, is_first
from comparisons.common.provenance import digest, versions
from comparisons.models.finite_element.compliance_check import (
    Column,
    Differences,
    OperatorCheck,
    Wave,
)
from comparisons.models.level import Level, MeshField, StressResult
from comparisons.models.plan import Plan
from comparisons.scenes.scene import ResolvedScene
from meshes.block import BlockMesh, BlockSpec

KINDS = (
    Level,
    HatGrid,
    ContactSolution,
    Residuals,
    StressResult,
    Extremum,
    StressState,
    MeshField,
    BlockMesh,
    BlockSpec,
    OperatorCheck,
    Differences,
    Column,
    Wave,
)
SOURCES = Path(__file__).resolve().parents[2]
PACKAGES = ("analytic", "meshes", "fem", "comparisons")


class LevelCache:
    """Levels of the run that carries out `plan` for `scene` and writes `out`; keeps nothing for a
    run that writes nothing (None)."""

    def __init__(self, out: Path | None, scene: ResolvedScene, plan: Plan) -> None:
        self.folder = None if out is None else unfinished(out)
        self.key = key_of(scene, repr(plan))

    def load(self, name: str) -> Level | None:
        """The level kept under `name` by a run with the same key, else None."""
        if self.folder is None:
            return None
        return from_first(lambda: kept(self._path(name), self.key, KINDS))

    def save(self, name: str, level: Level) -> None:
        """Keep a level; whole or not at all."""
        if self.folder is not None and is_first():
            keep(self._path(name), self.key, level)

    def _path(self, name: str) -> Path:
        return self.folder / f"{name}.npz"

    def discard(self) -> None:
        """Remove what is kept."""
        if self.folder is not None and is_first():
            shutil.rmtree(self.folder, ignore_errors=True)


def key_of(scene: ResolvedScene, *others: object) -> str:
    """Hash of a scene, its profile, what `others` say in JSON, versions and the program's code."""
    profile = "" if scene.profile is None else digest(scene.profile.x, scene.profile.height)
    parts = [scene.tables, profile, *others, versions(), program_code()]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def program_code() -> str:
    """Hash of what the program computes with: its code without comments, docstrings and places of
    lines, which shape no figure."""
    total = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted((SOURCES / package).rglob("*.py")):
            code = compile(path.read_bytes(), path.name, "exec", dont_inherit=True, optimize=2)
            total.update(
                marshal.dumps(_placeless(code), 2)
            )  # 2: without references, so always alike
    return total.hexdigest()


def _placeless(code: CodeType) -> CodeType:
    """A module's or function's code without the lines that it stands on."""
    constants = tuple(_placeless(c) if isinstance(c, CodeType) else c for c in code.co_consts)
    return code.replace(co_consts=constants, co_firstlineno=0, co_linetable=b"")
