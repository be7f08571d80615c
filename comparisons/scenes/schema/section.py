"""What every section of a scene file is: a table of typed fields, and rules between them."""

from typing import Annotated, get_args

from pydantic import BaseModel, ConfigDict
from pydantic.fields import FieldInfo

from comparisons.common.units import DIMENSIONLESS, LENGTH
from comparisons.scenes.schema.fields import FieldType, Number

Length = Annotated[float, Number(LENGTH, above=0.0)]
Fraction = Annotated[float, Number(DIMENSIONLESS, above=0.0, below=1.0)]


class FieldError(ValueError):
    """A rule between fields is broken; `field` names the one to change, within its section."""

    def __init__(self, field: str, message: str) -> None:
        super().__init__(message)
        self.field = field


class Table(BaseModel):
    """One section: unknown fields are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def allowed(table: type[Table], name: str) -> str:
    """What a field may hold, in words."""
    return field_type(table, name).allowed()


def field_type(table: type[Table], name: str) -> FieldType:
    """What reads a field."""
    notes = _annotations(table.model_fields[name])
    return next(note for note in notes if isinstance(note, FieldType))


def _annotations(info: FieldInfo) -> tuple:
    """A field's notes; those of `Annotated[…] | None` stand inside the union."""
    inner = [note for part in get_args(info.annotation) for note in get_args(part)[1:]]
    return (*info.metadata, *inner)
