"""Solids that a scene may name, read from materials.toml: elastic constants, the law of elasticity
that was measured, thermal constants, typical strengths, each with its source.

Also which measured solids a body may be like (`measured_solids`) whose own law is not known."""

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from analytic.material import Law, Material
from analytic.material.third_order import murnaghan_constants, murnaghan_errors, peak_change
from comparisons.common.errors import nearest
from comparisons.common.units import (
    CONDUCTIVITY,
    DENSITY,
    DIMENSIONLESS,
    EXPANSION,
    PRESSURE,
    SPECIFIC_HEAT,
    SPEED,
    Dimension,
    describe,
    to_si,
)
from comparisons.scenes.fields import FieldType

SOLIDS = Path(__file__).with_name("materials.toml")
ELASTIC = {"youngs_modulus": PRESSURE, "poissons_ratio": DIMENSIONLESS}
THERMAL = {
    "density": DENSITY,
    "conductivity": CONDUCTIVITY,
    "specific_heat": SPECIFIC_HEAT,
    "expansion": EXPANSION,
}
TYPICAL = {"yield_stress": PRESSURE, "hardness": PRESSURE}
DIMENSIONS = ELASTIC | THERMAL | TYPICAL
MEASURED = {"longitudinal": SPEED, "transverse": SPEED, "poissons_ratio": DIMENSIONLESS}
# The next wider class of one with fewer than two solids of known third-order constants.
METAL, ANY = "metal", "solid"
WIDER = {
    **dict.fromkeys(("steel", "iron", "aluminium", "copper", "titanium"), METAL),
    **dict.fromkeys(("refractory metal", "magnesium"), METAL),
    **dict.fromkeys(("glassy polymer", "semicrystalline polymer"), "polymer"),
}
RUBBER = "rubber"
# Moduli and ratios of one kind of solid scatter by so much: steels from 193 to 213 GPa, glasses
# from 0.19 to 0.24.
NEAR_MODULUS, NEAR_RATIO = 0.1, 0.03
# What a designation that no solid has tells of its class.
LOOKS_LIKE = {
    "iron": re.compile(r"iron|gj[slmv]|ggg?\d|fcd?\d"),
    "steel": re.compile(
        r"steel|\d(cr|mn|ni|mo|si|v\d)|^1\.\d{4}$|^c\d\d|^s[uc]\w?\d|^(1[0-5]|4[0-8]|51|86|93)\d\d$"
    ),
}
NORM = re.compile(r"^(aisi|sae|jis|din|uns|astm|w\.?-?nr\.?)[\s/-]+", re.I)  # before a designation
SLIP = 0.88  # difflib's ratio of a name and a slip of the pen in it
SAME = 1e-9  # relative: a value written beside a solid's name is that solid's


@dataclass(frozen=True)
class Value:
    """A number in SI with its standard error, or with the range whose middle it is, and the keys of
    its sources."""

    value: float
    sources: tuple[str, ...]
    error: float | None = None
    span: tuple[float, float] | None = None


@dataclass(frozen=True)
class Solid:
    """One entry. `values` holds those of ELASTIC and THERMAL that are known, `typical` those of
    TYPICAL. `law` is what was measured, None where nothing was, and `missing` then says so."""

    name: str
    aliases: tuple[str, ...]
    alias_sources: tuple[str, ...]
    kind: str  # its class
    description: str
    values: dict[str, Value]
    typical: dict[str, Value]
    law: Law | None
    law_sources: tuple[str, ...]
    missing: str
    note: str

    @property
    def material(self) -> Material | None:
        """Elastic material; None where Poisson's ratio is not known."""
        if not ELASTIC.keys() <= self.values.keys():
            return None
        return Material(*(self.values[name].value for name in ELASTIC), self.law or Law())

    @property
    def has_constants(self) -> bool:
        """Whether third-order constants of it are known."""
        return self.law is not None and self.law.murnaghan is not None

    def agrees(self, name: str, value: object) -> bool:
        """Whether `value` [SI] of a field is the solid's own, within two standard errors."""
        if name not in self.values or not isinstance(value, int | float):
            return False
        known = self.values[name]
        return abs(value - known.value) <= max(2.0 * (known.error or 0.0), SAME * abs(known.value))


class SolidName(FieldType):
    """The name of a solid, or one of its other names; it is read as the first."""

    def read(self, entry: object) -> str:
        if (solid := solid_named(entry)) is None:
            hint = f"; {names_for(entry)}" if isinstance(entry, str) else ""
            raise ValueError(f"is {describe(entry)}, which is no known solid{hint}")
        return solid.name

    def schema(self) -> dict:
        words = 'the name of a solid such as "carbon steel" (crosscheck materials lists them)'
        return {"title": words, "anyOf": [{"enum": list(solids())}, {"type": "string"}]}


@cache
def solids() -> dict[str, Solid]:
    """Every solid by name, in the order of the file."""
    entries = tomllib.loads(SOLIDS.read_text(encoding="utf-8"))["solid"]
    return {entry["name"]: _solid(entry) for entry in entries}


@cache
def sources() -> dict[str, str]:
    """Sources, by their keys."""
    return tomllib.loads(SOLIDS.read_text(encoding="utf-8"))["sources"]


@cache
def _names() -> dict[str, str]:
    """First names of all solids, by their names as `_key` writes them."""
    return {
        _key(name): solid.name
        for solid in solids().values()
        for name in (solid.name, *solid.aliases)
    }


def _key(name: str) -> str:
    """A name without its norm, blanks and hyphens, in small letters: AISI 4140 is 4140."""
    while (bare := NORM.sub("", name.strip())) != name:
        name = bare
    return re.sub(r"[\s_-]", "", name).casefold()


def solid_named(name: object) -> Solid | None:
    """The solid of that name or other name, with its norm or without; None if there is none."""
    first = _names().get(_key(name)) if isinstance(name, str) else None
    return None if first is None else solids()[first]


def names_for(name: str) -> str:
    """Message on a name that no solid has: the one that it is a slip of the pen for, or the
    names of the solids of its class, of all where it tells none.

    A name of other digits is another solid, however alike."""
    digits = re.sub(r"\D", "", name)
    alike = [known for known in _names() if re.sub(r"\D", "", known) == digits]
    if near := nearest(_key(name), alike, SLIP):
        return f'did you mean "{_names()[near]}"?'
    kind = next((kind for kind, looks in LOOKS_LIKE.items() if looks.search(_key(name))), None)
    listed = [solid.name for solid in solids().values() if kind in (None, solid.kind)]
    return f"the known {kind or 'solid'}s are {', '.join(listed)}"


@cache
def kinds_like(youngs_modulus: float, poissons_ratio: float) -> tuple[str, ...]:
    """The classes of solids that have about these constants: NEAR_MODULUS, relative, and
    NEAR_RATIO, absolute; several where they cannot be told apart, none for constants that no known
    solid has."""
    like = (
        solid.kind
        for solid in solids().values()
        if solid.material is not None
        and abs(solid.material.youngs_modulus / youngs_modulus - 1.0) <= NEAR_MODULUS
        and abs(solid.material.poissons_ratio - poissons_ratio) <= NEAR_RATIO
    )
    return tuple(dict.fromkeys(like))


def measured_solids(*kinds: str) -> list[Solid]:
    """Solids of known third-order constants in any of the classes, or in the next wider ones where
    these have fewer than two; all there are without a class."""
    within = kinds or (ANY,)
    while len(measured := [solid for solid in solids().values() if _is_of(solid, within)]) < 2:
        within = tuple(dict.fromkeys(WIDER.get(kind, ANY) for kind in within))
    return measured


def bounding_solids(kind: str, youngs_modulus: float, poissons_ratio: float) -> tuple[Solid, Solid]:
    """Two of `measured_solids`, whose constants, scaled to the body's shear modulus, lower and
    raise the peak pressure of a smooth contact most."""
    body = Material(youngs_modulus, poissons_ratio)

    def change(solid: Solid) -> float:
        return peak_change(scaled_law(solid, body), body)

    return min(measured_solids(kind), key=change), max(measured_solids(kind), key=change)


def typical_range(name: str, solid: str | None, kinds: Iterable[str]) -> tuple[float, float] | None:
    """Range [SI] of a strength of TYPICAL, of a solid where it is known, else of the classes; None
    where nothing is known."""
    of_solid = [solids()[solid]] if solid is not None else []
    for those in (of_solid, [other for other in solids().values() if other.kind in set(kinds)]):
        known = [other.typical[name] for other in those if name in other.typical]
        if known:
            ends = [value.span or (value.value, value.value) for value in known]
            return min(low for low, _ in ends), max(high for _, high in ends)
    return None


def scaled_law(solid: Solid, body: Material) -> Law:
    """The solid's third-order constants and errors, for a body with another shear modulus."""
    factor = body.shear_modulus / solid.material.shear_modulus
    errors = solid.law.standard_errors
    return Law(
        solid.law.name,
        tuple(factor * constant for constant in solid.law.murnaghan),
        errors and tuple(factor * error for error in errors),
    )


def _is_of(solid: Solid, kinds: tuple[str, ...]) -> bool:
    """Whether its constants are known, and it is of one of the classes, or of one that these are
    wider than."""
    return solid.has_constants and bool({ANY, solid.kind, WIDER.get(solid.kind)} & set(kinds))


def _solid(entry: Mapping) -> Solid:
    values = _elastic(entry)
    values |= {name: _value(entry[name], THERMAL[name]) for name in THERMAL if name in entry}
    law, law_sources = _law(entry, values)
    typical = entry.get("typical", {})
    return Solid(
        name=entry["name"],
        aliases=tuple(entry.get("aliases", ())),
        alias_sources=_keys({"source": entry.get("alias_source", ())}),
        kind=entry["class"],
        description=entry["description"],
        values=values,
        typical={name: _value(table, TYPICAL[name]) for name, table in typical.items()},
        law=law,
        law_sources=law_sources,
        missing=entry.get("no_third_order", ""),
        note=entry.get("note", ""),
    )


def _value(table: Mapping, dimension: Dimension) -> Value:
    """A number, or the middle of a range."""
    if not isinstance(table["value"], list):
        return Value(to_si(table["value"], dimension), _keys(table))
    low, high = (to_si(end, dimension) for end in table["value"])
    return Value(0.5 * (low + high), _keys(table), span=(low, high))


def _keys(table: Mapping) -> tuple[str, ...]:
    source = table["source"]
    return (source,) if isinstance(source, str) else tuple(source)


def _elastic(entry: Mapping) -> dict[str, Value]:
    """Young's modulus and Poisson's ratio of what was measured, with the errors that follow."""
    table, keys = dict(entry["elastic"]), _keys(entry["elastic"])
    del table["source"]
    measured, spans = {}, {}
    for name, given in table.items():
        dimension = {**MEASURED, **THERMAL}.get(name, PRESSURE)
        value = _value({"value": given, "source": keys}, dimension)
        measured[name], spans[name] = value.value, value.span
    errors = _errors(entry.get("elastic_errors", {}), measured, PRESSURE)
    constants = dict.fromkeys(ELASTIC, 0.0)
    results = _constants(measured)
    for name in errors:
        moved = _constants(measured | {name: measured[name] + errors[name]})
        constants = {key: constants[key] + (moved[key] - results[key]) ** 2 for key in results}
    return {
        key: Value(value, keys, float(np.sqrt(constants[key])) if errors else None, spans.get(key))
        for key, value in results.items()
    }


def _errors(
    table: Mapping[str, str], values: Mapping[str, float], dimension: Dimension
) -> dict[str, float]:
    """Standard errors [SI] of values, as they are or in per cent of them."""
    return {
        name: abs(values[name]) * to_si(text, DIMENSIONLESS)
        if text.endswith("%")
        else to_si(text, dimension)
        for name, text in table.items()
    }


def _constants(measured: Mapping[str, float]) -> dict[str, float]:
    """Young's modulus [Pa] and Poisson's ratio of two moduli, of one alone itself, or of a density
    [kg/m^3] and both speeds of sound [m/s]."""
    if measured.keys() <= ELASTIC.keys():
        return dict(measured)
    known = dict(measured)
    if "density" in known:
        known["shear"] = known["density"] * known["transverse"] ** 2
        known["lame"] = known["density"] * known["longitudinal"] ** 2 - 2.0 * known["shear"]
    if "bulk" in known:
        known["lame"] = known["bulk"] - 2.0 * known["shear"] / 3.0
    shear, ratio = known["shear"], known.get("poissons_ratio")
    if ratio is None:
        ratio = 0.5 * known["lame"] / (known["lame"] + shear)
    return {"youngs_modulus": 2.0 * shear * (1.0 + ratio), "poissons_ratio": ratio}


def _law(entry: Mapping, values: Mapping[str, Value]) -> tuple[Law | None, tuple[str, ...]]:
    """The measured law and its sources."""
    if "law" in entry:
        return Law(entry["law"]["name"]), _keys(entry["law"])
    if "third_order" not in entry:
        return None, ()
    table = dict(entry["third_order"])
    keys = _keys(table)
    del table["source"]
    constants = {name: to_si(value, PRESSURE) for name, value in table.items()}
    material = Material(*(values[name].value for name in ELASTIC))
    errors = _errors(entry.get("third_order_errors", {}), constants, PRESSURE)
    return Law(
        "murnaghan",
        murnaghan_constants(constants, material),
        murnaghan_errors(constants, errors, material) if errors else None,
    ), keys
