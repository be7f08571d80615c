"""Finished results on disk, so that a command that was stopped goes on: one .npz file a result.

A file holds the arrays of a result and a JSON text that says how they make it up. It is there whole
or not at all, and is read only by the key and name that it was saved under."""

import io
import json
import shutil
import typing
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path

import numpy as np

from comparisons.common.files import write_whole


@dataclass(frozen=True)
class Cache:
    """Results of one key in a folder, each under a name."""

    folder: Path | None  # None caches nothing
    # hash of everything that shapes the results (`comparisons.common.provenance`), or what finds it
    key: str | Callable[[], str]
    kinds: dict[str, type]  # the dataclasses that results are made of, by name (`kinds_of`)

    def load(self, name: str) -> object | None:
        """The result saved under a name; None without a whole one of the same key."""
        if self.folder is None:
            return None
        try:
            with np.load(self.path(name), allow_pickle=False) as file:
                outline = json.loads(str(file["outline"]))
                if (outline["key"], outline["name"]) != (self._key(), name):
                    return None
                arrays = {entry: file[entry] for entry in file.files}
            return decoded(outline["value"], arrays, self.kinds)
        except Exception:  # zipfile, zlib, numpy, json and checks of dataclasses have their own
            return None

    def save(self, name: str, value: object) -> None:
        """Write a result: dataclasses, dictionaries, tuples, arrays, numbers, texts.
        The same command may end elsewhere and remove the folder; what is lost is computed again."""
        if self.folder is None:
            return
        arrays: dict[str, np.ndarray] = {}
        outline = json.dumps({"key": self._key(), "name": name, "value": encoded(value, arrays)})
        # in memory first: an interrupt amid an archive whose file is closed would be complained of
        content = io.BytesIO()
        np.savez(content, outline=np.array(outline), **arrays)
        with suppress(FileNotFoundError):
            write_whole(self.path(name), content.getvalue())

    def discard(self) -> None:
        """Remove the results, and the folder around theirs unless it holds those of others."""
        if self.folder is not None:
            shutil.rmtree(self.folder, ignore_errors=True)
            with suppress(OSError):
                self.folder.parent.rmdir()

    def path(self, name: str) -> Path:
        return self.folder / f"{name}.npz"

    def _key(self) -> str:
        return self.key if isinstance(self.key, str) else self.key()


NO_CACHE = Cache(None, "", {})


def kinds_of(*roots: type) -> dict[str, type]:
    """Every dataclass that values of these types and their fields may be made of, by name."""
    kinds: dict[str, type] = {}
    left = list(roots)
    while left:
        kind = left.pop()
        if is_dataclass(kind) and kind.__name__ not in kinds:
            kinds[kind.__name__] = kind
            for hint in typing.get_type_hints(kind).values():
                left += types_in(hint)
    return kinds


def types_in(hint: object) -> Iterator[type]:
    """The classes that a type hint mentions."""
    if isinstance(hint, type):
        yield hint
    for part in typing.get_args(hint):
        yield from types_in(part)


def encoded(value: object, arrays: dict[str, np.ndarray]) -> object:
    """JSON that stands for a value; its arrays go to `arrays` under the names it mentions."""
    if is_dataclass(value):
        parts = {f.name: encoded(getattr(value, f.name), arrays) for f in fields(value)}
        return {"kind": type(value).__name__, "fields": parts}
    if isinstance(value, np.ndarray):
        name = next((n for n, known in arrays.items() if known is value), f"a{len(arrays)}")
        arrays[name] = value
        return {"array": name}
    if isinstance(value, tuple):
        return {"tuple": [encoded(item, arrays) for item in value]}
    if isinstance(value, dict):
        return {"dict": [[key, encoded(item, arrays)] for key, item in value.items()]}
    if isinstance(value, np.generic):
        return value.item()
    return value


def decoded(code: object, arrays: dict[str, np.ndarray], kinds: dict[str, type]) -> object:
    """The value that `encoded` took; `kinds` are its dataclasses by name."""
    if not isinstance(code, dict):
        return code
    if "array" in code:
        return arrays[code["array"]]
    if "tuple" in code:
        return tuple(decoded(item, arrays, kinds) for item in code["tuple"])
    if "dict" in code:
        return {key: decoded(item, arrays, kinds) for key, item in code["dict"]}
    parts = {name: decoded(item, arrays, kinds) for name, item in code["fields"].items()}
    return kinds[code["kind"]](**parts)
