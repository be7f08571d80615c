"""pydantic's account of a wrong scene as one line: "file: section.field: problem; allowed is …"."""

import difflib

from pydantic import ValidationError

from comparisons.common.errors import SceneError
from comparisons.common.units import describe
from comparisons.scenes.schema.scene import SECTIONS
from comparisons.scenes.schema.section import FieldError, allowed

_NEAR = 0.6  # difflib's ratio from which two names count as alike


def scene_error(error: ValidationError, where: str) -> SceneError:
    """The one line that stands for `error`; `where` names the scene.

    A misspelt name usually leaves a needed field missing as well, so unknown names come first.
    """
    problems = error.errors(include_url=False)
    unknown = [problem for problem in problems if problem["type"] == "extra_forbidden"]
    return SceneError(f"{where}: {_line((unknown or problems)[0])}")


def _line(problem: dict) -> str:
    location = problem["loc"]
    kind = problem["type"]
    if kind == "extra_forbidden":
        return _unknown(location, problem["input"])
    if kind == "missing" and len(location) == 1:
        return f"{location[0]}: is missing; allowed is a section [{location[0]}]"
    if kind == "missing":
        section, name = location
        return f"{section}.{name}: is missing; allowed is {allowed(SECTIONS[section], name)}"
    if kind == "model_type":
        return (
            f"{location[0]}: is {describe(problem['input'])}; allowed is a section [{location[0]}]"
        )
    cause = problem.get("ctx", {}).get("error")
    if isinstance(cause, FieldError):
        location = (*location, cause.field)
    return f"{'.'.join(map(str, location))}: {cause or problem['msg']}"


def _unknown(location: tuple, given: object) -> str:
    """A name that no section has: the nearest one, in its own section if there is one alike."""
    *section, name = map(str, location)
    place = ".".join([*section, name])
    sections = {table: f"[{table}]" for table in SECTIONS}
    if not section and isinstance(given, dict):
        return f"{place}: is no known section; the nearest is {_nearest(name, sections, 0.0)}"
    fields = {
        table: {field: f"{table}.{field}" for field in model.model_fields}
        for table, model in SECTIONS.items()
    }
    own = fields[section[0]] if section else {"title": "title", **sections}
    anywhere = {field: shown for table in fields.values() for field, shown in table.items()}
    nearest = (
        _nearest(name, own, _NEAR) or _nearest(name, anywhere, _NEAR) or _nearest(name, own, 0.0)
    )
    return f"{place}: is no known field; the nearest is {nearest}"


def _nearest(name: str, shown: dict[str, str], cutoff: float) -> str | None:
    """How the name most like `name` is shown, if any is alike enough."""
    found = difflib.get_close_matches(name.casefold(), shown, n=1, cutoff=cutoff)
    return shown[found[0]] if found else None
