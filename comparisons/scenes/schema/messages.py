"""The one line that says what is wrong with a scene: "file: section.field: problem; allowed is …".

Pydantic finds what is wrong, the JSON Schema says what is allowed."""

from collections.abc import Mapping, Sequence
from typing import Annotated

from pydantic import BaseModel, TypeAdapter, ValidationError

from comparisons.common.errors import SceneError, nearest
from comparisons.common.units import describe
from comparisons.scenes.fields import FieldError, file_fields
from comparisons.scenes.schema.json_schema import choices_of, forms, json_schema, node_at, words

ALIKE = 0.6  # difflib's ratio of a name that may be meant
# What is often called otherwise.
MEANT = dict.fromkeys(("force", "load", "line_load", "normal_load"), "load.per_length")
MEANT |= {"diameter": "roller.radius", "e": "body.youngs_modulus", "nu": "body.poissons_ratio"}
Place = tuple[str | int, ...]


def scene_error(
    scene: type[BaseModel], error: ValidationError, tables: object, source: str
) -> SceneError:
    """The one line for the tables of a scene that `source` names."""
    return SceneError(f"{source}: {_line(error.errors(include_url=False), tables, scene)}")


def read_field(section: type[BaseModel], name: str, entry: object) -> object:
    """The value of one field of a section. Raises ValueError, "problem; allowed is …"."""
    info = file_fields(section)[name]
    try:
        return TypeAdapter(Annotated[info.annotation, info]).validate_python(entry)
    except ValidationError as error:
        problems = [{**p, "loc": (name, *p["loc"])} for p in error.errors(include_url=False)]
        line = _line(problems, {name: entry}, section)
        raise ValueError(line.partition(": ")[2]) from error


def _line(problems: Sequence[Mapping], tables: object, kind: type[BaseModel]) -> str:
    """The line for the first problem: of the forms that a field may have, the one that comes
    nearest. A misspelt name usually leaves a needed field missing as well, so it comes first."""
    unknown = [problem for problem in problems if problem["type"] == "extra_forbidden"]
    found = [(*_found(problem, tables), problem) for problem in unknown or problems]
    same = [one for one in found if one[0][:2] == found[0][0][:2]]
    place, entry, problem = max(same, key=lambda one: len(one[0]))
    root = json_schema(kind)
    return _unknown(place, entry, root) if unknown else _wrong(place, entry, problem, root)


def _found(problem: Mapping, tables: object) -> tuple[Place, object]:
    """Where in the tables a problem is, and what stands there. The location that pydantic gives
    names the form of a field as well."""
    place: Place = ()
    for part in problem["loc"]:
        is_index = isinstance(part, int) and isinstance(tables, list | tuple)
        if part < len(tables) if is_index else isinstance(tables, Mapping) and part in tables:
            place, tables = (*place, part), tables[part]
    if _is_missing(problem):
        place, tables = (*place, problem["loc"][-1]), None
    return place, tables


def _is_missing(problem: Mapping) -> bool:
    """True where a field is missing; a list may be too short."""
    return problem["type"] == "missing" and isinstance(problem["loc"][-1], str)


def _wrong(place: Place, entry: object, problem: Mapping, root: Mapping) -> str:
    """The line for a value that is missing, of the wrong type or size, or against a rule."""
    cause = problem.get("ctx", {}).get("error")
    if isinstance(cause, FieldError):
        place = (*place, *cause.field.split("."))
    node = node_at(place, root)
    if _is_missing(problem):
        said = "is missing"
    elif cause is not None:
        said = str(cause)
    else:
        size = f" of {len(entry)}" if isinstance(entry, list | tuple) else ""
        said = f"is {describe(entry)}{size}{_hint(entry, node, root)}"
    if isinstance(place[-1], int):
        said = said.replace("is ", "holds ", 1)
    if "allowed" not in said and node is not None:
        said += f"; allowed is {_allowed(place, node, root)}"
    return f"{'.'.join(part for part in place if isinstance(part, str))}: {said}"


def _allowed(place: Place, node: Mapping, root: Mapping) -> str:
    """Words on what a node may hold: a section, or a field."""
    named = "additionalProperties" in root["properties"].get(place[0], {})  # [answers.NAME]
    is_section = len(place) <= 1 + named and forms(node, root)[0].get("type") == "object"
    return f"a section [{'.'.join(place)}]" if is_section else words(node, root)


def _hint(entry: object, node: Mapping | None, root: Mapping) -> str:
    """The choice that may be meant."""
    choices = [word for form in forms(node or {}, root) for word in choices_of(form)]
    near = nearest(entry, choices, ALIKE) if isinstance(entry, str) else None
    return f' (did you mean "{near}"?)' if near else ""


def _unknown(place: Place, entry: object, root: Mapping) -> str:
    """The line for a name that no table has: the nearest one, in its own table if there is one
    alike."""
    *inside, name = (str(part) or '""' for part in place)
    shown, tables = ".".join([*inside, name]), _fields(root, root)
    titles = {name: f"[{name}]" for name, fields in tables.items() if fields}
    if not inside and isinstance(entry, Mapping):
        return f"{shown}: is no known section; the nearest is {_nearest(name, titles)}"
    within = {"title": "title", **titles}
    if inside:
        within = {f: ".".join([*inside, f]) for f in _fields(node_at(place[:-1], root), root)}
    # of the same name in two sections, the first's: what is pressed, not how uncertain it is
    pairs = [(section, f) for section in reversed(titles) for f in tables[section]]
    anywhere = {field: f"{section}.{field}" for section, field in pairs}
    near = MEANT.get(name.casefold()) or anywhere.get(name.casefold())
    near = near or _nearest(name, within, ALIKE) or _nearest(name, anywhere, ALIKE)
    near = near or _nearest(name, within)
    meant = ", a force per length" if near == "load.per_length" else ""
    return f"{shown}: is no known field; the nearest is {near}{meant}"


def _fields(node: Mapping, root: Mapping) -> dict[str, list[str]]:
    """The fields of a table, each with its own where it is a table, too."""
    tables = [form.get("properties", {}) for form in forms(node, root)]
    return {
        name: [field for form in forms(inside, root) for field in form.get("properties", ())]
        for table in tables
        for name, inside in table.items()
    }


def _nearest(name: str, shown: dict[str, str], alike: float = 0.0) -> str | None:
    """How the name most like `name` is shown."""
    return shown.get(nearest(name.casefold(), shown, alike))
