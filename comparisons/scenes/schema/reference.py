"""The fields of a scene on their page: `python -m comparisons.scenes.schema.reference`
writes them anew.

Of each section it writes the heading, what the section is and the table of its fields; what stands
on the page after a table is kept."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from pydantic import BaseModel

from comparisons.scenes.profile import VARIETIES, Variety
from comparisons.scenes.scene import Scene, sections_of
from comparisons.scenes.schema.json_schema import forms, json_schema, words

PAGE = Path(__file__).parents[2] / "docs/scene_fields.md"
SECTION = re.compile(r"^## \[(\w+)(\.NAME)?\]\n.*?^\| `\1` .*?\n(?!\|)", re.MULTILINE | re.DOTALL)
KINDS = re.compile(r"^\| `kind` \| needed .*?\n(?!\|)", re.MULTILINE | re.DOTALL)
WRITING = re.compile(r': a number in [^ ]+ or "[^"]*"')  # of a quantity: the page says it once


def with_fields(page: str) -> str:
    """The page with what the fields say of themselves."""
    sections = sections_of(Scene)
    page = SECTION.sub(lambda found: _section(found[1], found[2] or "", sections[found[1]]), page)
    kinds = [_kind(name, variety) for name, variety in VARIETIES.items() if name != "file"]
    return KINDS.sub(lambda _: _table(("`kind`", "needed", "optional"), *kinds), page)


def _section(name: str, several: str, kind: type[BaseModel]) -> str:
    said, root = re.sub(r"\n\s*", " ", kind.__doc__), json_schema(kind)
    rows = _rows("", root, root, kind.FOLLOW)
    head = (f"`{name}`", "is", "allowed", "by default")
    return f"## [{name}{several}]\n\n{said}\n\n{_table(head, *rows)}"


def _rows(
    before: str, table: Mapping, root: Mapping, follow: tuple[str, ...] = ()
) -> Iterator[tuple[str, ...]]:
    """A row for each field, and for each of a table in it."""
    for name, field in table["properties"].items():
        default = "needed" if name in table["required"] else _default(field.get("default"))
        default = "of the `material`" if name in follow else default
        allowed = WRITING.sub("", words(field, root))
        yield f"`{before}{name}`", field["description"], allowed, default
        for form in forms(field, root):
            if "properties" in form and "title" not in form:
                yield from _rows(f"{before}{name}.", form, root)


def _default(value: object) -> str:
    """A default, empty where there is none: of one value, as it stands for a list of it."""
    [value] = value if isinstance(value, list) and len(value) == 1 else [value]
    if value is None:
        return ""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    return f"`{value:g}`" if isinstance(value, float) else f"`{value}`"


def _kind(name: str, variety: Variety) -> tuple[str, str, str]:
    """The row of a kind of computed surface."""
    either = [" or ".join(f"`{field}`" for field in fields) for fields in variety.one_of]
    needed = [f"`{field}`" for field in variety.needed if field != "kind"]
    others = [f"`{field}`" for field in (*variety.defaults, *variety.optional)]
    return f'`"{name}"`', ", ".join([*needed, *either]), ", ".join(others)


def _table(*rows: tuple[str, ...]) -> str:
    head, *others = (f"| {' | '.join(row)} |" for row in rows)
    return "\n".join([head, f"|{' --- |' * len(rows[0])}", *others, ""])


if __name__ == "__main__":
    PAGE.write_text(with_fields(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
