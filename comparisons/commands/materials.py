"""`crosscheck materials`: the solids that a scene may name, each number with its source."""

from typing import TYPE_CHECKING, Annotated

from typer import Argument

from comparisons.commands.arguments import json_option
from comparisons.commands.output import show_either
from comparisons.common.errors import ExitStatus, InputError

if TYPE_CHECKING:
    from rich.table import Table

    from comparisons.scenes.materials import Solid, Value

UNKNOWN = "-"


def materials(
    name: Annotated[
        str | None, Argument(help="A solid, of which everything is shown with its sources.")
    ] = None,
    as_json: Annotated[bool, json_option("the solids as JSON")] = False,
) -> int:
    """List the solids that a scene may name. Of one, its numbers with their sources."""
    from comparisons.scenes.materials import names_for, solid_named, solids

    listed = [solid_named(name)] if name is not None else list(solids().values())
    if None in listed:
        raise InputError(f"{name}: is no known solid; {names_for(name)}")
    show_either(
        as_json,
        lambda: [entry_of(solid) for solid in listed],
        lambda: solids_table(listed) if name is None else page(listed[0]),
    )
    return ExitStatus.DONE


def entry_of(solid: "Solid") -> dict:
    """A solid as JSON has it: SI, None for what is not known."""
    from comparisons.scenes.materials import sources

    law = solid.law
    return {
        "name": solid.name,
        "aliases": list(solid.aliases),
        "alias_sources": list(solid.alias_sources),
        "class": solid.kind,
        "description": solid.description,
        "values": {key: _value(key, value) for key, value in solid.values.items()},
        "law": None if law is None else law.name,
        "third_order": law and law.murnaghan and dict(zip("lmn", law.murnaghan, strict=True)),
        "third_order_errors": law
        and law.standard_errors
        and dict(zip("lmn", law.standard_errors, strict=True)),
        "third_order_sources": list(solid.law_sources),
        "missing": solid.missing,
        "bounded_by": _bounds(solid),
        "typical": {key: _value(key, value) for key, value in solid.typical.items()},
        "note": solid.note,
        "sources": {key: sources()[key] for key in _keys(solid)},
    }


def _value(key: str, value: "Value") -> dict:
    from comparisons.scenes.materials import DIMENSIONS

    return {
        "value": value.value,
        "unit": DIMENSIONS[key].si_unit,
        "error": value.error,
        "span": value.span and list(value.span),
        "sources": list(value.sources),
    }


def _bounds(solid: "Solid") -> list[str]:
    """The solids between whose laws that of one lies of which none was measured."""
    from comparisons.scenes.materials import bounding_solids

    if solid.law is not None or solid.material is None:
        return []
    material = solid.material
    pair = bounding_solids(solid.kind, material.youngs_modulus, material.poissons_ratio)
    return [bound.name for bound in pair]


def _keys(solid: "Solid") -> list[str]:
    """The keys of every source of a solid, in the order in which they come up."""
    values = (*solid.values.values(), *solid.typical.values())
    keys = [key for value in values for key in value.sources]
    return list(dict.fromkeys([*keys, *solid.law_sources, *solid.alias_sources]))


def solids_table(listed: list["Solid"]) -> "Table":
    """Name, class, moduli and third-order constants [GPa] with their standard errors."""
    from rich.table import Table

    table = Table("solid", "class", box=None, padding=(0, 2, 0, 0))
    for head in ("E [GPa]", "nu", "l [GPa]", "m [GPa]", "n [GPa]"):
        table.add_column(head, justify="right")
    table.add_column("source of l, m, n")
    for solid in listed:
        young, ratio = (solid.values.get(name) for name in ("youngs_modulus", "poissons_ratio"))
        nu = UNKNOWN if ratio is None else f"{ratio.value:.3g}"
        table.add_row(solid.name, solid.kind, f"{young.value / 1e9:.4g}", nu, *_constants(solid))
    return table


def _constants(solid: "Solid") -> list[str]:
    """l, m, n with their errors, and the source; what stands in their place."""
    law = solid.law
    if law is None or law.murnaghan is None:
        return [UNKNOWN] * 3 + ["none found" if law is None else f"{law.name}: its class"]
    errors = law.standard_errors or (None,) * 3
    cells = [
        f"{value / 1e9:.4g}" + ("" if error is None else f" ± {error / 1e9:.2g}")
        for value, error in zip(law.murnaghan, errors, strict=True)
    ]
    return [*cells, ", ".join(solid.law_sources)]


def page(solid: "Solid") -> "Table":
    """Everything of one solid, each number with the keys of its sources, and what those are."""
    from rich.table import Table
    from rich.text import Text

    from comparisons.scenes.materials import sources

    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)

    def add(*cells: str) -> None:
        table.add_row(*map(Text, cells))  # in a Text brackets are no markup

    add("solid", solid.name, "")
    if solid.aliases:
        add("other names", ", ".join(solid.aliases), ", ".join(solid.alias_sources))
    add("class", solid.kind, solid.description)
    for key, value in solid.values.items():
        add(key, _shown(key, value), ", ".join(value.sources))
    for name, cell in zip("lmn", _constants(solid)[:3], strict=True):
        if solid.has_constants:
            add(name, f"{cell} GPa", ", ".join(solid.law_sources))
    if not solid.has_constants:
        law = "not known" if solid.law is None else solid.law.name
        add("law", law, solid.missing or ", ".join(solid.law_sources))
    if bounds := _bounds(solid):
        add("its bounds", "", f"{' and '.join(bounds)}, scaled to its shear modulus")
    for key, value in solid.typical.items():
        words = "typical, never filled in; " + ", ".join(value.sources)
        add(key, _shown(key, value), words)
    if solid.note:
        add("note", "", solid.note)
    for key in _keys(solid):
        add(key, "", sources()[key])
    return table


def _shown(key: str, value: "Value") -> str:
    """A value with its unit, and its standard error or its range."""
    from comparisons.common.numbers import significant, with_unit
    from comparisons.scenes.materials import DIMENSIONS

    unit = DIMENSIONS[key].si_unit

    def text(number: float) -> str:
        return with_unit(number, unit) if unit == "Pa" else significant(number, 4)

    shown = text(value.value) + ("" if unit == "Pa" else f" {unit}")
    if value.error is not None:
        return f"{shown} ± {text(value.error)}"
    return shown if value.span is None else f"{shown} ({' to '.join(map(text, value.span))})"
