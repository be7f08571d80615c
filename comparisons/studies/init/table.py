"""What `crosscheck init` shows: how the profile was read, its roughness, a picture of it."""

from typing import TYPE_CHECKING

from comparisons.common.numbers import significant, with_unit
from comparisons.report.tables.problem import in_mm
from comparisons.report.terminal import PLAIN
from comparisons.results.plausibility import warnings_about_surface
from comparisons.scenes.scene import ProfileInfo
from comparisons.studies.init.begin import Begun
from comparisons.studies.init.dots import drawn

if TYPE_CHECKING:
    from rich.console import RenderableType

ROWS, MOST_COLUMNS = 6, 100
NONE = "-"


def init_table(begun: Begun, columns: int | None, unicode: bool) -> "RenderableType":
    """The summary; with a picture `columns` wide, None for none."""
    from rich import box
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    info = begun.scene.profile_info
    read = f"{info.source}: {info.format}, {info.samples} samples, "
    read += f"{_length(info.length)} long, {_length(info.spacing)} apart"
    parts: list[RenderableType] = [Text(read.translate(PLAIN), style="bold")]
    if info.place:
        parts.append(Text(info.place))
    parts.append("")
    if columns:
        parts += [*_picture(begun, min(columns, MOST_COLUMNS), not unicode), ""]
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    for name in ("roughness", "as pressed", "ISO 21920-2"):
        table.add_column(name, justify="left" if name == "roughness" else "right")
    for row in _rows(info):
        table.add_row(*(cell.translate(PLAIN) for cell in row))
    parts += [table, ""]
    if info.standard is None:
        parts += [Text(f"none by ISO 21920-2: {info.standard_why}"), ""]
    parts += [
        Text(f"plausibility warning: {each}".translate(PLAIN))
        for each in warnings_about_surface(info)
    ]
    for name, because in begun.look.guesses.items():
        parts.append(Text(f"{name} = {begun.look.fields[name]}: {because}"))
    parts += ["", Text(f"scene   {begun.path}"), Text(f"next    crosscheck run {begun.path}")]
    return Group(*parts)


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


def _picture(begun: Begun, columns: int, plain: bool) -> "list[RenderableType]":
    """The profile as it is pressed, its heights at the left and its ends below."""
    from rich.text import Text

    profile = begun.scene.profile
    x, height = profile.x + begun.scene.position, profile.height
    marks = [with_unit(v, "m", 3).translate(PLAIN) for v in (height.max(), height.min())]
    margin = max(map(len, marks)) + 1
    lines = drawn(x, height, columns - margin, ROWS, plain)
    labels = [marks[0], *[""] * (ROWS - 2), marks[1]]
    ends = [with_unit(v, "m", 3).translate(PLAIN) for v in (x[0], x[-1])]
    below = f"{ends[0]}{ends[1]:>{columns - margin - len(ends[0])}}"
    return [
        *(Text(f"{label:>{margin - 1}} {line}", no_wrap=True)
          for label, line in zip(labels, lines, strict=True)),
        Text(" " * margin + below, no_wrap=True),
    ]  # fmt: skip
