"""pydantic's account of a wrong scene as one line: "file: section.field: problem; allowed is …"."""

import difflib

from pydantic import ValidationError

from comparisons.errors import SceneError
from comparisons.scene_schema import SECTIONS, SceneTables
from comparisons.scene_table import FieldError, allowed
from comparisons.units import describe

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
    """A name that no section has: the nearest one, in its own section if there is one."""
    *section, name = map(str, location)
    shown = ".".join([*section, name]) if name.isprintable() else ascii(".".join([*section, name]))
    if not section and isinstance(given, dict):
        nearest = _nearest(name, list(SECTIONS), 0.0)
        return f"{shown}: is no known section; the nearest is [{nearest}]"
    own = list((SECTIONS[section[0]] if section else SceneTables).model_fields)
    everywhere = {
        field: table for table, model in SECTIONS.items() for field in model.model_fields
    } | dict.fromkeys(["title"], "")
    found = _nearest(name, own, _NEAR)
    table = section[0] if section else ""
    if found is None:
        found = _nearest(name, list(everywhere), _NEAR)
        table = everywhere.get(found, "")
    if found is None:
        found, table = _nearest(name, own, 0.0), section[0] if section else ""
    return f"{shown}: is no known field; the nearest is {f'{table}.{found}' if table else found}"


def _nearest(name: str, names: list[str], cutoff: float) -> str | None:
    found = difflib.get_close_matches(name.casefold(), names, n=1, cutoff=cutoff)
    return found[0] if found else None
