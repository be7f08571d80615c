"""What `crosscheck init` shows: how the profile was read, and its roughness."""

from typing import TYPE_CHECKING

import numpy as np

from analytic.surface.roughness_standard import SECTIONS
from comparisons.campaigns.init.first_scene import FirstScene
from comparisons.common.numbers import significant, with_unit
from comparisons.output.page.tables.problem import in_mm, sections_text, standard_text
from comparisons.output.plausibility import warnings_about_surface
from comparisons.output.terminal import PLAIN, plain_table
from comparisons.scenes.surface import ProfileInfo

if TYPE_CHECKING:
    from rich.console import RenderableType


NONE = "-"
UNEVEN = 0.01  # of the spacing: samples whose distances differ by more are not even


def init_table(made: FirstScene) -> "RenderableType":
    from rich.console import Group
    from rich.text import Text

    info = made.surface.info
    read = f"{info.source}: {info.format}, {info.samples} samples, "
    read += f"{_length(info.length)} long, {_apart(info)} apart"
    parts: list[RenderableType] = [Text(read.translate(PLAIN), style="bold")]
    if info.place:
        parts.append(Text(info.place))
    parts.append("")
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
