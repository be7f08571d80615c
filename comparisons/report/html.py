"""How pages are made: templates, what stands in them in words, and the one script they may run."""

import base64
import hashlib
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup

FOLDER = Path(__file__).parent / "templates"
UNIT = re.compile(r"(?<=\d) (?=%|p₀|(?:a|[kMGmµnp]?(?:m|s|Pa|B)|N/mm?|byte)\b)")
BAR = re.compile(r"\|(?=τ)")
STYLES = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def rendered(template: str, **values: object) -> str:
    """A template of this folder with values in it; text among them is escaped."""
    return _environment().get_template(template).render(**values)


@cache
def _environment() -> "Environment":
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    made = Environment(
        loader=FileSystemLoader(FOLDER),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["tight"] = tight
    made.globals["css"] = lambda *names: _joined(names)
    return made


def tight(text: str) -> str:
    """The text without line ends between a number and its unit, or inside |τ|."""
    return BAR.sub("|\u2060", UNIT.sub("\u00a0", text))


def inline(name: str) -> "tuple[Markup, str]":
    """A script of this folder, and the Content-Security-Policy under which it alone runs."""
    from markupsafe import Markup

    text = (FOLDER / name).read_text(encoding="utf-8")
    seal = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
    return Markup(text), f"{STYLES}; script-src 'sha256-{seal}'"


def _joined(names: tuple[str, ...]) -> "Markup":
    from markupsafe import Markup

    return Markup("\n".join((FOLDER / name).read_text(encoding="utf-8") for name in names))
