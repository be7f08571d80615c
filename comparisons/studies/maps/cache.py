"""Finished points of a map on disk: one file a point, whole or not at all."""

import json
import os
from contextlib import suppress
from pathlib import Path

from comparisons.common.provenance import as_json

FOLDER = "map_points"
PART = ".part"


class PointStore:
    """The points that a folder holds, each under the key of what was asked."""

    def __init__(self, out: Path) -> None:
        self.folder = out / FOLDER

    def load(self, key: str) -> dict | None:
        """The answer kept under a key, None where there is none that is whole."""
        try:
            kept = json.loads(self._path(key).read_text(encoding="utf-8"))
            return kept if {"found", "seconds"} <= kept.keys() else None
        except (OSError, ValueError, AttributeError):
            return None

    def save(self, key: str, answer: dict) -> None:
        """Keep an answer; it is there whole, or not at all, whatever ends this process."""
        self.folder.mkdir(parents=True, exist_ok=True)
        part = self.folder / f".{key}.{os.getpid()}{PART}"
        part.write_text(as_json(answer), encoding="utf-8")
        os.replace(part, self._path(key))

    def tidy(self) -> None:
        """Remove what a process left that was killed while it wrote."""
        for part in self.folder.glob(f".*{PART}"):
            with suppress(FileNotFoundError):
                part.unlink()

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.json"
