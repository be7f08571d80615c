"""A scene file with every field in it: used ones, and unused ones to switch on, each explained."""

import json
import re
from collections.abc import Mapping
from textwrap import wrap

from comparisons.scenes.schema.fields import allowed
from comparisons.scenes.schema.scene import SECTIONS as TABLES
from comparisons.scenes.schema.scene import SceneFile
from comparisons.studies.init.fields import SECTIONS, TITLE

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

    values  section, then field: what it is set to, as TOML; other fields stand there unused
    notes   the same: what is to be said of it besides
    """
    heading = f"{TITLE[0]}; allowed is {allowed(SceneFile, 'title')}"
    lines = [HEAD, *_comment(heading), f"title = {toml(title)}"]
    for section, (words, fields) in SECTIONS.items():
        used = values.get(section, {})
        lines += ["", *_comment(words), f"{'' if used else '#'}[{section}]"]
        for name, (meaning, example) in fields.items():
            said = f"{meaning}; allowed is {allowed(TABLES[section], name)}"
            note = notes.get(section, {}).get(name)
            lines += _comment(f"{said} ({note})" if note else said)
            lines.append(f"{name} = {used[name]}" if name in used else f"#{name} = {example}")
    return "\n".join(lines) + "\n"


def toml(text: str) -> str:
    """A text as TOML writes it."""
    return json.dumps(text, ensure_ascii=False)


def _comment(text: str) -> list[str]:
    """Explaining lines; what stands in quotes is not broken."""
    whole = re.sub(r'"[^"]*"', lambda quoted: quoted[0].replace(" ", NO_BREAK), text)
    lines = wrap(whole, WIDTH, break_long_words=False, break_on_hyphens=False)
    return [f"# {line}".replace(NO_BREAK, " ") for line in lines]
