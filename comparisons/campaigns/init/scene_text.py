"""A scene file with every field of a measured profile's scene in it, each explained.

Meanings and examples are those of `fields.toml`; what a field may hold is said by
`comparisons.scenes.fields.allowed`, as in error messages."""

import json
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from textwrap import wrap

from comparisons.scenes.fields import allowed
from comparisons.scenes.scene import Scene, sections_of

FIELDS = Path(__file__).with_name("fields.toml")
WIDTH = 96
NO_BREAK = "\N{NO-BREAK SPACE}"
HEAD = """\
# A scene for crosscheck, as TOML. Numbers are in SI; text has a unit: "8.2 mm", "207 GPa".
# Lines that start with "#" and a blank explain the line below them; those that start with "#"
# alone are fields that are not used: take the sign away to use them.
"""

Values = Mapping[str, Mapping[str, str]]


def scene_text(title: str, values: Values, notes: Values) -> str:
    """The text of a scene file.

    values  by section and field: what it is set to, as TOML; other fields stand there unused
    notes   by section and field: a remark"""
    sections, kinds = tomllib.loads(FIELDS.read_text(encoding="utf-8")), sections_of(Scene)
    heading = f"{sections.pop('title')}; allowed is {allowed(Scene, 'title')}"
    lines = [HEAD, *_comment(heading), f"title = {toml(title)}"]
    for section, fields in sections.items():
        used = values.get(section, {})
        lines += ["", *_comment(fields.pop("section")), f"{'' if used else '#'}[{section}]"]
        for name, (meaning, example) in fields.items():
            said = f"{meaning}; allowed is {allowed(kinds[section], name)}"
            note = notes.get(section, {}).get(name)
            lines += _comment(f"{said} ({note})" if note else said)
            lines.append(f"{name} = {used[name]}" if name in used else f"#{name} = {example}")
    return "\n".join(lines) + "\n"


def toml(value: object) -> str:
    """Text, numbers and lists of them as TOML."""
    return json.dumps(value, ensure_ascii=False)


def value_of(text: str) -> object:
    return tomllib.loads(f"value = {text}")["value"]


def _comment(text: str) -> list[str]:
    whole = re.sub(r'"[^"]*"', lambda quoted: quoted[0].replace(" ", NO_BREAK), text)
    lines = wrap(whole, WIDTH, break_long_words=False, break_on_hyphens=False)
    return [f"# {line}".replace(NO_BREAK, " ") for line in lines]
