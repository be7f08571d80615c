"""Options of `crosscheck init` as fields of [profile], held to what a scene allows there."""

from collections.abc import Mapping

from comparisons.common.errors import InputError
from comparisons.common.units import LENGTH
from comparisons.scenes.schema.fields import Number, Unit, Whole
from comparisons.studies.init.scene_text import toml

TYPES = {
    "x_unit": Unit(LENGTH),
    "z_unit": Unit(LENGTH),
    "spacing": Number(LENGTH, above=0.0),
    "row": Whole(0, 2**31),
    "column": Whole(0, 2**31),
}
APART = (("x_unit", "spacing"), ("row", "column"))


def asked_fields(options: Mapping[str, str | int | None]) -> dict[str, str]:
    """The options that were given, as TOML; raises InputError for a wrong one."""
    given = {name: value for name, value in options.items() if value is not None}
    for name, value in given.items():
        try:
            TYPES[name].read(value)
        except ValueError as error:
            raise InputError(f"--{name.replace('_', '-')}: {error}") from error
    for first, second in APART:
        if first in given and second in given:
            raise InputError(
                f"--{second}: is given beside --{first.replace('_', '-')}; allowed is one of them"
            )
    return {name: toml(v) if isinstance(v, str) else str(v) for name, v in given.items()}
