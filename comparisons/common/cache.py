"""One finished result as one .npz file: its arrays, and a JSON text that says how they make it up.

A file is there whole or not at all, and is good for the key that it was kept under.
"""

import json
import os
import zlib
from collections.abc import Iterable
from dataclasses import fields, is_dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from comparisons.common.files import ATTEMPTS

PART = ".part.npz"
# What a damaged file raises, by which bit of it is wrong; of an unknown compression, RuntimeError.
DAMAGED = (
    OSError, ValueError, KeyError, TypeError, EOFError, RuntimeError, BadZipFile, zlib.error,
)  # fmt: skip


def keep(path: Path, key: str, value: object) -> None:
    """Keep a value; it is there whole, or not at all, whatever ends this process.

    value  dataclasses, dictionaries, tuples, arrays, numbers, texts. Another run may remove the
           folder at any moment; a value that is lost to that is computed again if it is needed.
    """
    arrays: dict[str, np.ndarray] = {}
    outline = {"key": key, "value": encoded(value, arrays)}
    part = path.with_name(f"{path.stem}.{os.getpid()}{PART}")
    for _ in range(ATTEMPTS):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            np.savez(part, outline=np.array(json.dumps(outline)), **arrays)
            os.replace(part, path)
            return
        except FileNotFoundError:
            continue


def kept(path: Path, key: str, kinds: Iterable[type]) -> object | None:
    """What a file holds, made of dataclasses of these `kinds`; None where it is not there, was cut
    short, or is good for another key."""
    try:
        with np.load(path, allow_pickle=False) as arrays:
            outline = json.loads(str(arrays["outline"]))
            if outline["key"] != key:
                return None
            return decoded(outline["value"], arrays, {kind.__name__: kind for kind in kinds})
    except DAMAGED:
        return None


def tidy(folder: Path) -> None:
    """Remove what a process left that was killed while it wrote."""
    for part in folder.glob(f"*{PART}"):
        part.unlink(missing_ok=True)


def encoded(value: object, arrays: dict[str, np.ndarray]) -> object:
    """JSON that stands for a value; its arrays go to `arrays` under the numbers it names."""
    if is_dataclass(value):
        parts = {f.name: encoded(getattr(value, f.name), arrays) for f in fields(value)}
        return {"kind": type(value).__name__, "fields": parts}
    if isinstance(value, np.ndarray):
        name = f"a{len(arrays)}"
        arrays[name] = value
        return {"array": name}
    if isinstance(value, tuple):
        return {"tuple": [encoded(item, arrays) for item in value]}
    if isinstance(value, frozenset):
        return {"set": sorted(value)}
    if isinstance(value, dict):
        return {"dict": [[key, encoded(item, arrays)] for key, item in value.items()]}
    if isinstance(value, np.generic):
        return value.item()
    return value


def decoded(given: object, arrays: dict[str, np.ndarray], kinds: dict[str, type]) -> object:
    """The value that `encoded` took; `kinds` are the dataclasses by name."""
    if not isinstance(given, dict):
        return given
    if "array" in given:
        return arrays[given["array"]]
    if "tuple" in given:
        return tuple(decoded(item, arrays, kinds) for item in given["tuple"])
    if "set" in given:
        return frozenset(given["set"])
    if "dict" in given:
        return {key: decoded(item, arrays, kinds) for key, item in given["dict"]}
    parts = {name: decoded(item, arrays, kinds) for name, item in given["fields"].items()}
    return kinds[given["kind"]](**parts)
