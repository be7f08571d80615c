"""`crosscheck materials`: the solids that a scene may name, each number with its source."""

from dataclasses import asdict
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
    from comparisons.scenes.materials import DIMENSIONS, sources

    entry = asdict(solid)
    for name, value in (entry["values"] | entry["typical"]).items():
        value["unit"] = DIMENSIONS[name].si_unit
    known = {key: sources()[key] for key in _keys(solid)}
    return entry | {"bounded_by": _bounds(solid), "sources": known}


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
    """l, m, n with their errors, and the source; what stands in for them."""
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

    measured, bounds = ", ".join(solid.law_sources), " and ".join(_bounds(solid))
    law = "not known" if solid.law is None else solid.law.name
    constants = zip("lmn", _constants(solid)[:3], strict=True)
    rows = [
        ("solid", solid.name, ""),
        ("other names", ", ".join(solid.aliases), ", ".join(solid.alias_sources)),
        ("class", solid.kind, solid.description),
        *((key, _shown(key, v), ", ".join(v.sources)) for key, v in solid.values.items()),
        *((name, f"{cell} GPa", measured) for name, cell in constants if solid.has_constants),
        *([] if solid.has_constants else [("law", law, solid.missing or measured)]),
        ("its bounds", "", bounds and f"{bounds}, scaled to its shear modulus"),
        *(
            (key, _shown(key, v), f"typical, never filled in; {', '.join(v.sources)}")
            for key, v in solid.typical.items()
        ),
        ("note", "", solid.note),
        *((key, "", sources()[key]) for key in _keys(solid)),
    ]
    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for row in rows:
        if any(row[1:]):
            table.add_row(*map(Text, row))  # in a Text brackets are no markup
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
