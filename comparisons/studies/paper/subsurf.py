"""Files of stresses as the paper's program SUBSURF leaves them: layer by layer, header last.

One line a layer, from the surface down, its numbers the stress over p0 from left to right: where a
map of roughness has heights in micrometres these have stresses, so that the same routines draw
both. Below the last layer stands a header of three parts, a line `name = value` each: the profile
that was measured, the contact that was analysed, and the stresses. Lengths are in m, pressures in
Pa; what does not apply is left out.

The paper tells this much of its files and no more: separators and names are this project's.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from comparisons.common.errors import InputError

DECIMALS = 5  # of p0
TITLE = "SUBSURF"
PARTS = ("profile", "contact", "stress")
LARGEST_FILE = 2**28  # bytes
SIZES = ("columns", "layers")
NEEDED = {
    "stress": ("component", "friction", *SIZES, "x_first", "x_step", "z_first", "z_step"),
    "contact": ("peak_pressure", "half_width"),
}

Value = str | float | int


@dataclass(frozen=True)
class SubsurfFile:
    """A field of one stress.

    stress  (layers, columns) over p0, z from the surface down, x from left to right
    header  by part (profile, contact, stress), then by name; lengths [m], pressures [Pa]
    """

    stress: np.ndarray
    header: dict[str, dict[str, Value]]

    @property
    def x(self) -> np.ndarray:
        """(columns,) [m]."""
        part = self.header["stress"]
        return part["x_first"] + part["x_step"] * np.arange(part["columns"])

    @property
    def z(self) -> np.ndarray:
        """(layers,) [m]."""
        part = self.header["stress"]
        return part["z_first"] + part["z_step"] * np.arange(part["layers"])


def write_subsurf(path: Path, content: SubsurfFile) -> None:
    """Write a field; reading it again gives the same header and the stresses to DECIMALS.

    Raises ValueError for stresses that are not finite, and for a header that lacks what
    `read_subsurf` needs or has other sizes than the stresses.
    """
    stress = np.asarray(content.stress, dtype=float)
    if stress.ndim != 2 or not np.all(np.isfinite(stress)):
        raise ValueError("stress must be finite and have two dimensions")
    sizes = content.header.get("stress", {})
    if (sizes.get("layers"), sizes.get("columns")) != stress.shape:
        raise ValueError(f"the header must state {stress.shape} layers and columns")
    lines = [_layer(row) for row in stress]
    lines.append(TITLE)
    for part in PARTS:
        named = content.header.get(part, {})
        for name in NEEDED.get(part, ()):
            if name not in named:
                raise ValueError(f"the header lacks {part}.{name}")
        lines.append(f"[{part}]")
        lines += [f"{name} = {_text(name, value)}" for name, value in named.items()]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def read_subsurf(path: Path) -> SubsurfFile:
    """A field as `write_subsurf` leaves it.

    Raises InputError, one line with file, line, what is wrong and what is allowed.
    """
    lines = _lines(path)
    if TITLE not in lines:
        raise InputError(
            f"{path}: has no line {TITLE}; allowed is a whole file, which ends with a header"
        )
    split = lines.index(TITLE)
    header = _header(path, lines[split + 1 :], split + 2)
    columns, layers = (header["stress"][name] for name in SIZES)
    if split != layers:
        raise InputError(
            f"{path}: has {split} layers above {TITLE}; allowed are {layers}, as its header says"
        )
    rows = [_row(path, number, line, columns) for number, line in enumerate(lines[:split], 1)]
    return SubsurfFile(np.array(rows), header)


def _layer(row: Iterable[float]) -> str:
    """A line of numbers; what rounds to nothing has no sign."""
    rounded = np.round(row, DECIMALS) + 0.0
    return " ".join(f"{value:.{DECIMALS}f}" for value in rounded)


def _text(name: str, value: Value) -> str:
    if isinstance(value, str):
        if "\n" in value or "\r" in value or value != value.strip() or not value:
            raise ValueError(f"the header's {name} must be one line of text, not {value!r}")
        return f'"{value}"'
    if not np.isfinite(value):
        raise ValueError(f"the header's {name} must be finite, not {value}")
    return repr(int(value) if isinstance(value, int | np.integer) else float(value))


def _lines(path: Path) -> list[str]:
    try:
        if not path.is_file():
            raise InputError(f"{path}: is no regular file; allowed is a file of SUBSURF")
        size = path.stat().st_size
        if size > LARGEST_FILE:
            raise InputError(f"{path}: has {size} bytes; allowed are {LARGEST_FILE}")
        return path.read_text(encoding="utf-8").split("\n")
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: is no text (byte {error.start} is not UTF-8); allowed is a file of SUBSURF"
        ) from error


def _row(path: Path, number: int, line: str, columns: int) -> list[float]:
    cells = line.split()
    if len(cells) != columns:
        raise InputError(
            f"{path}: line {number}: has {len(cells)} numbers; allowed are {columns}, as the "
            "header says"
        )
    try:
        row = [_number(cell) for cell in cells]
    except ValueError:
        row = [np.nan]
    if not np.all(np.isfinite(row)):
        raise InputError(f"{path}: line {number}: holds no numbers alone; allowed are finite ones")
    return row


def _number(text: str) -> float:
    """As Python reads it, but for the underscores that it lets pass."""
    return np.nan if "_" in text else float(text)


def _header(path: Path, lines: list[str], first: int) -> dict[str, dict[str, Value]]:
    header: dict[str, dict[str, Value]] = {}
    part = None
    for number, line in enumerate(lines, start=first):
        if not line.strip():
            continue
        heading = re.fullmatch(r"\[(\w+)\]", line)
        if heading:
            part = heading[1]
            if part not in PARTS or part in header:
                raise InputError(
                    f"{path}: line {number}: is the part {part}; allowed are "
                    f"{', '.join(PARTS)}, each once"
                )
            header[part] = {}
            continue
        found = re.fullmatch(r"(\w+) = (.+)", line)
        if found is None or part is None or found[1] in header[part]:
            raise InputError(
                f"{path}: line {number}: is {line[:40]!r}; allowed in the header are parts and "
                "lines name = value, each name once"
            )
        header[part][found[1]] = _value(path, number, found[2])
    _check(path, header)
    return header


def _value(path: Path, number: int, text: str) -> Value:
    if len(text) > 1 and text[0] == text[-1] == '"':
        return text[1:-1]
    if re.fullmatch(r"[+-]?[0-9]+", text):
        return int(text)
    try:
        value = _number(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise InputError(
            f'{path}: line {number}: the value is {text[:40]}; allowed is a finite number or "text"'
        )
    return value


def _check(path: Path, header: dict[str, dict[str, Value]]) -> None:
    """Refuse a header without what tells the field's places and unit."""
    for part, names in NEEDED.items():
        for name in names:
            value = header.get(part, {}).get(name)
            if value is None:
                raise InputError(f"{path}: the header lacks {name} of [{part}]; allowed is with it")
            if (name == "component") != isinstance(value, str):
                kind = "text" if name == "component" else "a number"
                raise InputError(f"{path}: {name} of [{part}] is {value!r}; allowed is {kind}")
    for name in SIZES:
        value = header["stress"][name]
        if not isinstance(value, int) or value < 1:
            raise InputError(f"{path}: {name} is {value}; allowed is a whole number from 1 on")
    for part, name in (
        ("stress", "x_step"),
        ("stress", "z_step"),
        ("contact", "peak_pressure"),
        ("contact", "half_width"),
    ):
        value = header[part][name]
        if value <= 0.0:
            raise InputError(f"{path}: {name} of [{part}] is {value}; allowed is above 0")
