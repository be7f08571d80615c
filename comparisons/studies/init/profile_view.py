"""What `crosscheck init` shows: how the profile was read, its roughness, a picture of it."""

from typing import TYPE_CHECKING

import numpy as np

from analytic.surface.roughness_standard import SECTIONS
from comparisons.common.numbers import significant, with_unit
from comparisons.report.tables.problem import in_mm, sections_text, standard_text
from comparisons.report.terminal import PLAIN, plain_table
from comparisons.results.plausibility import warnings_about_surface
from comparisons.scenes.scene import ProfileInfo
from comparisons.studies.init.first_scene import FirstScene

if TYPE_CHECKING:
    from rich.console import RenderableType


# Bits of a braille character's dots: rows from the top, columns from the left (Unicode, U+2800).
BRAILLE = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
ASCII = {(False, False): " ", (True, False): "'", (False, True): ".", (True, True): ":"}
ROWS, MOST_COLUMNS = 6, 100  # of the picture
NONE = "-"
UNEVEN = 0.01  # of the spacing: samples whose distances differ by more are not even


def init_table(made: FirstScene, columns: int | None, unicode: bool) -> "RenderableType":
    """For rich to print; with a picture that is `columns` wide, without one where it is None."""
    from rich.console import Group
    from rich.text import Text

    info = made.scene.profile_info
    read = f"{info.source}: {info.format}, {info.samples} samples, "
    read += f"{_length(info.length)} long, {_apart(info)} apart"
    parts: list[RenderableType] = [Text(read.translate(PLAIN), style="bold")]
    if info.place:
        parts.append(Text(info.place))
    parts.append("")
    if columns:
        parts += [*_picture(made, min(columns, MOST_COLUMNS), not unicode), ""]
    table = plain_table("roughness", numbers=("as pressed", "ISO 21920-2"))
    for row in _rows(info):
        table.add_row(*(cell.translate(PLAIN) for cell in row))
    parts += [table, ""]
    parts += [*(Text(each.translate(PLAIN)) for each in _two_columns(info)), ""]
    parts += [
        Text(f"plausibility warning: {each}".translate(PLAIN))
        for each in warnings_about_surface(info)
    ]
    for name, because in made.profile.reasons.items():
        parts.append(Text(f"{name} = {made.profile.fields[name]}: {because}"))
    parts += ["", Text(f"scene   {made.path}")]
    if made.picture is not None:
        parts.append(Text(f"picture {made.picture}"))
    parts += [Text(f"next    crosscheck run {made.path}")]
    return Group(*parts)


def _two_columns(info: ProfileInfo) -> list[str]:
    """What the two columns of roughness are of, and why they differ."""
    off = "nothing" if info.form.kind == "none" else f"its {info.form.kind}"
    pressed = f"as pressed: the whole trace without {off}"
    if info.standard is None:
        return [pressed, f"none by ISO 21920-2: {info.standard_why}"]
    found = f"ISO 21920-2: {standard_text(info)}"
    few = info.standard.sections < SECTIONS
    return [pressed, found] + [f"section lengths: {sections_text(info.standard)}"] * few


def _apart(info: ProfileInfo) -> str:
    """The distance of samples, or from which to which it goes."""
    steps = np.diff(info.trace.x)
    least, most = float(steps.min()), float(steps.max())
    even = most - least <= UNEVEN * info.spacing
    return _length(info.spacing) if even else f"{_length(least)} to {_length(most)}"


def _rows(info: ProfileInfo) -> list[tuple[str, str, str]]:
    pressed, standard = info.roughness, info.standard
    rows = []
    for label, name, in_standard, is_length in (
        ("Ra", "ra", "ra", True),
        ("Rq", "rq", "rq", True),
        ("Rz", None, "rz", True),
        ("Rt", "rt", "rt", True),
        ("Rsk", "rsk", "rsk", False),
        ("Rku", "rku", "rku", False),
        ("Rdq, rms slope", "rms_slope", "rdq", False),
        ("largest slope", "max_slope", None, False),
        ("RSm", None, "rsm", True),
        ("cut-off", None, "cutoff", True),
        ("short cut-off", None, "short_cutoff", True),
    ):
        cells = [
            _figure(getattr(source, field) if source and field else None, is_length)
            for source, field in ((pressed, name), (standard, in_standard))
        ]
        if label == "cut-off" and standard is not None:
            cells[1] = in_mm(standard.cutoff)
        rows.append((label, *cells))
    return rows


def _figure(value: float | None, is_length: bool) -> str:
    if value is None:
        return NONE
    return _length(value) if is_length else significant(value, 3)


def _length(value: float) -> str:
    return with_unit(value, "m")


def _picture(made: FirstScene, columns: int, plain: bool) -> "list[RenderableType]":
    """The profile as it is pressed, its heights at the left and its ends below."""
    from rich.text import Text

    profile = made.scene.profile
    x, height = profile.x + made.scene.position, profile.height
    marks = [with_unit(v, "m", 3).translate(PLAIN) for v in (height.max(), height.min())]
    margin = max(map(len, marks)) + 1
    lines = curve(x, height, columns - margin, ROWS, plain)
    labels = [marks[0], *[""] * (ROWS - 2), marks[1]]
    ends = [with_unit(v, "m", 3).translate(PLAIN) for v in (x[0], x[-1])]
    below = f"{ends[0]}{ends[1]:>{columns - margin - len(ends[0])}}"
    return [
        *(Text(f"{label:>{margin - 1}} {line}", no_wrap=True)
          for label, line in zip(labels, lines, strict=True)),
        Text(" " * margin + below, no_wrap=True),
    ]  # fmt: skip


def curve(x: np.ndarray, y: np.ndarray, columns: int, rows: int, plain: bool = False) -> list[str]:
    """The curve through (x, y), x ascending, as `rows` lines of `columns` characters.

    In each column of dots it spans from its lowest to its highest value there.
    plain   ASCII: a character has two dots, one above the other, instead of braille's four by two
    """
    across, down = (1, 2) if plain else (2, 4)
    dots = _dots(x, y, columns * across, rows * down)
    blocks = dots.reshape(rows, down, columns, across).transpose(0, 2, 1, 3)
    if plain:
        return ["".join(ASCII[tuple(block[:, 0])] for block in line) for line in blocks]
    codes = 0x2800 + np.sum(blocks * BRAILLE, axis=(2, 3))
    return ["".join(map(chr, line)) for line in codes]


def _dots(x: np.ndarray, y: np.ndarray, width: int, height: int) -> np.ndarray:
    """(height, width) bool: the dots that the curve covers, the top row first."""
    ends = np.linspace(x[0], x[-1], width + 1)
    at_ends = np.interp(ends, x, y)
    column = np.clip(np.searchsorted(ends, x, side="right") - 1, 0, width - 1)
    low = np.minimum(at_ends[:-1], at_ends[1:])
    high = np.maximum(at_ends[:-1], at_ends[1:])
    np.minimum.at(low, column, y)
    np.maximum.at(high, column, y)
    bottom, top = float(y.min()), float(y.max())
    size = (top - bottom) or 1.0
    first = np.minimum(height * (low - bottom) / size, height - 1).astype(int)
    last = np.maximum(np.ceil(height * (high - bottom) / size).astype(int) - 1, first)
    level = np.arange(height)[::-1, None]
    return (level >= first) & (level <= last)
