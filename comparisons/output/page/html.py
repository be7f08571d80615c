"""Pages and other files from templates: filters for text, the one script that a page may run."""

import base64
import hashlib
import re
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup, escape

FOLDER = Path(__file__).parent / "templates"
UNIT = re.compile(r"(?<=\d) (?=%|p₀|(?:a|[kMGmµnp]?(?:m|s|Pa|B)|N/mm?|byte)\b)")
HEADING = re.compile(r"<h3>([^<]*)</h3>")
STARRED = re.compile(r"\*(\w[^*]*\w)\*")
BAR = re.compile(r"\|(?=τ)")
WORDS = 6  # of a name that is made of a text
STYLES = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def rendered(template: str | Path, **values: object) -> str:
    """A template with values in it; in HTML text among them is escaped.

    template  one of this folder, or the path of another one, which may use this folder's macros"""
    path = FOLDER / template
    return _environment(path.parent).get_template(path.name).render(**values)


@cache
def _environment(folder: Path) -> Environment:
    made = Environment(
        loader=FileSystemLoader([folder, FOLDER]),
        autoescape=select_autoescape(("html.j2",)),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.filters |= {known.__name__: known for known in (tight, anchored, slug, set_off)}
    made.filters["kind"] = lambda item: type(item).__name__
    made.globals["css"] = lambda *names: Markup(
        "\n".join(made.loader.get_source(made, name)[0] for name in names)
    )
    return made


def tight(text: str) -> str:
    """The text without line ends between a number and its unit, or inside |τ|."""
    return BAR.sub("|\u2060", UNIT.sub("\u00a0", text))


def set_off(text: str) -> Markup:
    """The text with *words* between asterisks in italics."""
    return Markup(STARRED.sub(r"<i>\1</i>", str(escape(text))))


def slug(text: str) -> str:
    """The first words of a text as a name for files and anchors."""
    return "-".join(re.findall(r"\w+", text.lower())[:WORDS])


def anchored(text: str) -> Markup:
    """HTML whose headings of the third order have ids by their words, each another one."""
    known: list[str] = []

    def with_id(heading: re.Match[str]) -> str:
        known.append(slug(heading[1]))
        count = known.count(known[-1])
        name = escape(known[-1] if count == 1 else f"{known[-1]}-{count}")
        return f'<h3 id="{name}">{heading[1]}</h3>'

    return Markup(HEADING.sub(with_id, text))


def inline(name: str) -> tuple[Markup, str]:
    """A script of this folder, and a Content-Security-Policy that allows no other script."""
    text = (FOLDER / name).read_text(encoding="utf-8")
    seal = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
    return Markup(text), f"{STYLES}; script-src 'sha256-{seal}'"
