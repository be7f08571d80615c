"""The JSON Schema of a scene, made by pydantic from the fields of its sections; what a field may
hold, in words.

Editors complete and check scene files by it. The title of a type says what is allowed; null, which
TOML does not have, is left out."""

import copy
import json
from collections.abc import Mapping, Sequence
from functools import cache

from pydantic import BaseModel
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import CoreSchema

from comparisons.scenes.fields import plain

DIALECT = "https://json-schema.org/draft/2020-12/schema"


class _SceneSchema(GenerateJsonSchema):
    """Nothing is null, and what follows from a solid may be left out."""

    def nullable_schema(self, schema: Mapping) -> dict:
        return self.generate_inner(schema["schema"])

    def default_schema(self, schema: Mapping) -> dict:
        inner, default = self.generate_inner(schema["schema"]), plain(schema["default"])
        has_none = default is None or isinstance(default, dict)
        return inner if has_none else {**inner, "default": default}

    def field_title_should_be_set(self, schema: CoreSchema) -> bool:
        return False

    def model_schema(self, schema: Mapping) -> dict:
        made = super().model_schema(schema)
        made["required"] = sorted({*made.get("required", ())} - {*schema["cls"].FOLLOW})
        return made


@cache
def json_schema(kind: type[BaseModel]) -> dict:
    """The JSON Schema (draft 2020-12) of a scene, or of one section."""
    schema = kind.model_json_schema(schema_generator=_SceneSchema)
    for table in (schema, *schema.get("$defs", {}).values()):
        del table["title"]  # of the class
    return {"$schema": DIALECT, **schema}


def schema_for_editors(kind: type[BaseModel]) -> dict:
    """The JSON Schema of a scene, with what is allowed in the descriptions of its fields, too."""
    schema = copy.deepcopy(json_schema(kind))
    for table in (schema, *schema["$defs"].values()):
        for field in table["properties"].values():
            if "description" in field:
                field["description"] += f". Allowed: {words(field, schema)}"
    return schema


def forms(node: Mapping, root: Mapping) -> list[Mapping]:
    """Schemas that a part of a schema allows one of, with references followed."""
    if "$ref" in node:
        node = root["$defs"][node["$ref"].rpartition("/")[2]]
    parts = node.get("anyOf") or node.get("allOf")  # pydantic before 2.10 wraps a reference
    return [form for part in parts for form in forms(part, root)] if parts else [node]


def node_at(place: Sequence[str | int], root: Mapping) -> Mapping | None:
    """The part of a schema for a path into the tables of a scene; None where there is none."""
    node: Mapping | None = root
    for part in place:
        inside = (_inside(form, part) for form in forms(node or {}, root))
        node = next(filter(None, inside), None)
    return node


def _inside(form: Mapping, part: str | int) -> Mapping | None:
    if isinstance(part, str):
        return form.get("properties", {}).get(part) or form.get("additionalProperties")
    return next(iter(form.get("prefixItems", ())[part:]), form.get("items"))


def choices_of(form: Mapping) -> list:
    """The values of which a field takes one; [] where it takes others."""
    return form.get("enum", [form["const"]] if "const" in form else [])


def allowed(kind: type[BaseModel], *place: str) -> str:
    """Words on what a field of a section may hold."""
    root = json_schema(kind)
    return words(node_at(place, root), root)


def words(node: Mapping, root: Mapping) -> str:
    """Words on what a part of a schema allows."""
    if "title" in node:
        return node["title"]
    example = f", such as {json.dumps(node['examples'][0])}" if "examples" in node else ""
    if "anyOf" in node:
        return ", or ".join(words(part, root) for part in node["anyOf"]) + example
    [node] = forms(node, root)
    if choices := choices_of(node):
        return " or ".join(map(json.dumps, choices))
    if node["type"] in ("array", "object"):
        return (_list if node["type"] == "array" else _table)(node, root) + example
    whole = "a whole number from {minimum} to {maximum}"
    kinds = {"boolean": "true or false", "string": "a string of one line", "integer": whole}
    return kinds[node["type"]].format_map(node) + example


def _list(node: Mapping, root: Mapping) -> str:
    items = node.get("prefixItems", [node.get("items")])
    least, most = node["minItems"], node["maxItems"]
    size = f"of {most}" if least == most else f"of {least} to {most}"
    kinds = list(dict.fromkeys(words(item, root) for item in items))
    return f"a list {size}{', each' if len(kinds) == 1 else ':'} {' and '.join(kinds)}"


def _table(node: Mapping, root: Mapping) -> str:
    fields = node["properties"]
    if not node["required"]:
        return f"a table with one or several of {', '.join(fields)}"
    kinds = {words(field, root) for field in fields.values()}
    each = f",{' each' if len(fields) > 1 else ''} {kinds.pop()}" if len(kinds) == 1 else ""
    return f"a table {{{', '.join(f'{name} = …' for name in fields)}}}{each}"
