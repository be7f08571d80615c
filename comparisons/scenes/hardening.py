"""The hardening of a body that flows, as a scene has it: `body.hardening`."""

from dataclasses import dataclass
from typing import ClassVar

from comparisons.common.units import DIMENSIONLESS, PRESSURE, describe
from comparisons.scenes.fields import MOST_VALUES, FieldType, Number

STRESS = Number(PRESSURE, above=0.0)
STRAIN = Number(DIMENSIONLESS, at_least=0.0)


@dataclass(frozen=True)
class HardeningField(FieldType):
    """A table with one isotropic law, {kinematic = …}, or both: by name, what the law takes."""

    LAWS: ClassVar[dict[str, dict[str, Number]]] = {
        "voce": {"saturated": STRESS, "rate": Number(DIMENSIONLESS, above=0.0)},
        "ludwik": {"strength": STRESS, "exponent": Number(DIMENSIONLESS, above=0.0, at_most=1.0)},
    }

    def read(self, entry: object) -> dict[str, object]:
        if not isinstance(entry, dict) or not entry:
            raise self.wrong(f"is {describe(entry)}")
        names, read = (*self.LAWS, "table", "kinematic"), {}
        for name, value in entry.items():
            if name not in names:
                raise self.wrong(f'holds "{name}"{self.hint(name, names)}')
            read[name] = self._law(name, value)
        return read

    def _law(self, name: str, value: object) -> object:
        if name == "kinematic":
            return STRESS.read(value)
        if name == "table":
            return self._table(value)
        wanted = self.LAWS[name]
        if not isinstance(value, dict) or set(value) != set(wanted):
            raise self.wrong(f"has {name} = {describe(value)}, not {' and '.join(wanted)}")
        return {key: number.read(value[key]) for key, number in wanted.items()}

    def _table(self, value: object) -> tuple[tuple[float, float], ...]:
        rows = value if isinstance(value, list | tuple) else []
        if not 2 <= len(rows) <= MOST_VALUES:
            raise self.wrong(f"has a table of {len(rows)} rows, not 2 to {MOST_VALUES}")
        for row in rows:
            if not isinstance(row, list | tuple) or len(row) != 2:
                raise self.wrong(f"has a row {describe(row)} of its table, no pair")
        return tuple((STRAIN.read(strain), STRESS.read(stress)) for strain, stress in rows)

    def allowed(self) -> str:
        return (
            'a table with one of table = [[0, "280 MPa"], …] (plastic strain, stress), '
            "voce = {saturated = …, rate = …} and ludwik = {strength = …, exponent = …}, "
            'and kinematic = "1 GPa" by itself or beside it'
        )
